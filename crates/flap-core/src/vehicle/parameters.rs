//! The parameters of a vehicle: those of its model for all wings, its own, those of single wings, and differences.

use self_cell::self_cell;

use super::geometry::Place;
use super::mount::{DIFFERENCE, Mount, VehicleError};
use crate::parameter::Range::{Any, Positive};
use crate::parameter::{Invalid, Kind, Parameter};

/// Groups of lists of parameters.
const VEHICLE: &str = "vehicle";

/// The parameters of a place.
#[rustfmt::skip]
const PLACE: [(&str, &str, &str); 6] = [
    ("position_x", "m", "Position of the shoulder, forward"),
    ("position_y", "m", "Position of the shoulder, to the left; of a mirrored wing to the right"),
    ("position_z", "m", "Position of the shoulder, upwards"),
    ("plane_roll", "rad", "Roll of the stroke plane, which lifts the wing's tip"),
    ("plane_pitch", "rad", "Pitch of the stroke plane, which lowers its front"),
    ("plane_yaw", "rad", "Yaw of the stroke plane, which turns its front away from the wing's side"),
];

/// The parameters of the vehicle as a whole.
const WHOLE: [Parameter<'static>; 4] = [
    about("about_x", "Point about which torques are taken, such as the centre of mass: forward."),
    about("about_y", "Point about which torques are taken, to the left."),
    about("about_z", "Point about which torques are taken, upwards."),
    Parameter {
        group: VEHICLE,
        ..Parameter::new(
            "total_mass",
            "kg",
            "",
            Kind::Following(Positive, "not known"),
            "Mass of the whole vehicle, for lift_to_weight.",
        )
    },
];

const fn about(name: &'static str, doc: &'static str) -> Parameter<'static> {
    Parameter { group: VEHICLE, default: 0.0, ..Parameter::new(name, "m", "", Kind::Number(Any), doc) }
}

/// A parameter of one wing, or a difference.
struct Own {
    name: String,
    unit: &'static str,
    kind: Kind,
    doc: String,
    group: String,
    default: f64,
}

impl Own {
    fn parameter(&self) -> Parameter<'_> {
        Parameter {
            group: &self.group,
            default: self.default,
            ..Parameter::new(&self.name, self.unit, "", self.kind, &self.doc)
        }
    }
}

type Parameters<'a> = Vec<Parameter<'a>>;

self_cell!(
    /// All parameters, with the texts of those that the model does not have.
    struct Named {
        owner: Vec<Own>,
        #[covariant]
        dependent: Parameters,
    }
);

/// The parameter table of a vehicle.
pub(super) struct Table {
    named: Named,
    /// The model's parameters, which come first.
    model: &'static [Parameter<'static>],
    /// The model's parameters that wings may have of their own.
    own: Vec<usize>,
    /// Number of wings.
    wings: usize,
    mirrored: Vec<bool>,
    has_differences: bool,
}

/// True if wings may have a value of their own of this parameter of the model.
pub(super) fn may_differ(parameter: &Parameter<'_>) -> bool {
    !matches!(parameter.kind, Kind::Choice(_)) && parameter.name != "drive_frequency"
}

impl Table {
    pub(super) fn new(model: &'static [Parameter<'static>], mounts: &[Mount]) -> Result<Table, VehicleError> {
        let own: Vec<usize> = (0..model.len()).filter(|&index| may_differ(&model[index])).collect();
        let mut owned: Vec<Own> = Vec::new();
        for mount in mounts {
            let wing = &mount.name;
            let group = format!("wing {wing}");
            let mut of_wing: Vec<Own> = PLACE
                .iter()
                .map(|(rest, unit, doc)| Own {
                    name: format!("{wing}_{rest}"),
                    unit,
                    kind: Kind::Number(Any),
                    doc: format!("{doc}: of the wing {wing}."),
                    group: group.clone(),
                    default: 0.0,
                })
                .collect();
            for parameter in own.iter().map(|&index| &model[index]) {
                let (Kind::Number(range) | Kind::Following(range, _)) = parameter.kind else { continue };
                of_wing.push(Own {
                    name: format!("{wing}_{}", parameter.name),
                    unit: parameter.unit,
                    kind: Kind::Following(range, parameter.name),
                    doc: format!("{} of the wing {wing} alone.", parameter.name),
                    group: group.clone(),
                    default: f64::NAN,
                });
            }
            let is_taken = |name: &str| {
                model.iter().chain(&WHOLE).any(|other| other.name == name)
                    || owned.iter().any(|other| other.name == name)
            };
            if let Some(clash) = of_wing.iter().find(|one| is_taken(&one.name)) {
                return Err(VehicleError::Clash { wing: wing.clone(), parameter: clash.name.clone() });
            }
            owned.extend(of_wing);
        }
        let mirrored: Vec<bool> = mounts.iter().map(|mount| mount.mirrored).collect();
        let has_differences = mirrored.contains(&true) && mirrored.contains(&false);
        if has_differences {
            owned.extend(own.iter().map(|&index| &model[index]).map(|parameter| Own {
                name: format!("{DIFFERENCE}_{}", parameter.name),
                unit: parameter.unit,
                kind: Kind::Number(Any),
                doc: format!(
                    "Left-right difference of {}: half of it is added to the wings that are not mirrored, and taken from \
                     those that are.",
                    parameter.name
                ),
                group: "left-right differences".to_owned(),
                default: 0.0,
            }));
        }
        let named = Named::new(owned, |owned| {
            model.iter().chain(&WHOLE).copied().chain(owned.iter().map(Own::parameter)).collect()
        });
        Ok(Table { named, model, own, wings: mounts.len(), mirrored, has_differences })
    }

    /// All parameters: those of the model, those of the vehicle, those of wings, and differences.
    pub(super) fn parameters(&self) -> &[Parameter<'_>] {
        self.named.borrow_dependent()
    }

    /// The number of the first parameter of a wing.
    fn begin(&self, wing: usize) -> usize {
        self.model.len() + WHOLE.len() + wing * (PLACE.len() + self.own.len())
    }

    /// The point about which torques are taken (m).
    pub(super) fn about(&self, values: &[f64]) -> [f64; 3] {
        core::array::from_fn(|i| values[self.model.len() + i])
    }

    /// The mass of the whole vehicle (kg); not a number if it is not known.
    pub(super) fn total_mass(&self, values: &[f64]) -> f64 {
        values[self.model.len() + 3]
    }

    /// The place of a wing.
    pub(super) fn place(&self, values: &[f64], wing: usize) -> Place {
        let begin = self.begin(wing);
        Place {
            position: core::array::from_fn(|i| values[begin + i]),
            plane: core::array::from_fn(|i| values[begin + 3 + i]),
        }
    }

    /// The values of a wing's own design point.
    ///
    /// # Errors
    /// If a difference takes a value out of its range, or is one of a parameter that follows others.
    pub(super) fn of_wing(&self, values: &[f64], wing: usize) -> Result<Vec<f64>, Invalid> {
        let mut own_values = values[..self.model.len()].to_vec();
        let own = self.begin(wing) + PLACE.len();
        let differences = self.begin(self.wings);
        let share = if self.mirrored[wing] { -0.5 } else { 0.5 };
        for (i, &index) in self.own.iter().enumerate() {
            let value = &mut own_values[index];
            if !values[own + i].is_nan() {
                *value = values[own + i];
            }
            let difference = if self.has_differences { values[differences + i] } else { 0.0 };
            if difference == 0.0 {
                continue;
            }
            let parameter = &self.model[index];
            if value.is_nan() {
                return Err(Invalid::new(format!(
                    "{DIFFERENCE}_{0} needs a value of {0}, which is not set",
                    parameter.name
                )));
            }
            *value += share * difference;
            if let Kind::Number(range) | Kind::Following(range, _) = parameter.kind {
                Invalid::unless_within(parameter.name, *value, range)?;
            }
        }
        Ok(own_values)
    }
}

/// The parameter of all wings whose value a wing's own one has where it is not set; `None` of other parameters.
pub fn of_all_wings(parameters: &[Parameter<'_>], index: usize) -> Option<usize> {
    let Kind::Following(_, follows) = parameters[index].kind else { return None };
    let wing = parameters[index].name.strip_suffix(follows)?;
    if wing.ends_with('_') { Parameter::index(parameters, follows) } else { None }
}

/// The value of a parameter at a point. A wing's own parameter that is not set has the value of all wings.
pub fn standing(parameters: &[Parameter<'_>], values: &[f64], index: usize) -> f64 {
    let shared = of_all_wings(parameters, index).filter(|_| values[index].is_nan());
    values[shared.unwrap_or(index)]
}
