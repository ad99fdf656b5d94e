//! Parameters of a vehicle. A vehicle has the parameters of the model for all wings, parameters of the whole
//! vehicle, and parameters of single wings. A vehicle also has parameters for the differences between left
//! and right wings.

use self_cell::self_cell;

use super::geometry::Place;
use super::mount::{DIFFERENCE, Mount, VehicleError};
use crate::body::BodyParameters;
use crate::model::GRAVITY;
use crate::parameter::Range::{Any, Positive};
use crate::parameter::{Invalid, Kind, Parameter};

/// Headings in lists of parameters.
const VEHICLE: &str = "vehicle";

/// Parameters of the position of a wing.
#[rustfmt::skip]
const PLACE: [(&str, &str, &str); 6] = [
    ("position_x", "m", "Forward position of the shoulder of a wing"),
    ("position_y", "m", "Position of the shoulder of a wing to the left (to the right for a mirrored wing)"),
    ("position_z", "m", "Upward position of the shoulder of a wing"),
    ("plane_roll", "rad", "Roll of the stroke plane; positive values lift the tip of the wing"),
    ("plane_pitch", "rad", "Pitch of the stroke plane; positive values lower the front of the plane"),
    ("plane_yaw", "rad", "Yaw of the stroke plane; positive values turn the front of the plane outwards, to the side of the wing"),
];

/// Parameters of the vehicle as a whole.
#[rustfmt::skip]
const WHOLE: [Parameter<'static>; 9] = [
    about("about_x", "Forward position of the reference point of the torques, such as the centre of mass."),
    about("about_y", "Position to the left of the reference point of the torques."),
    about("about_z", "Upward position of the reference point of the torques."),
    Parameter {
        group: VEHICLE,
        ..Parameter::new(
            "total_mass",
            "kg",
            "",
            Kind::Following(Positive, "not known"),
            "Mass of the whole vehicle, for the column lift_to_weight and for hover.",
        )
    },
    inertia("body_inertia_roll", "Moment of inertia of the whole vehicle about the x axis through its centre of mass."),
    inertia("body_inertia_pitch", "Moment of inertia of the whole vehicle about the y axis through its centre of mass."),
    inertia("body_inertia_yaw", "Moment of inertia of the whole vehicle about the z axis through its centre of mass."),
    Parameter {
        group: VEHICLE,
        default: 0.0,
        ..Parameter::new("body_inertia_product", "kg*m^2", "", Kind::Number(Any), "Product of inertia of the whole vehicle, the integral of x z dm about the centre of mass.")
    },
    Parameter {
        group: VEHICLE,
        default: GRAVITY,
        ..Parameter::new("gravity", "m/s^2", "g", Kind::Number(Positive), "Gravitational acceleration.")
    },
];

/// Mass properties of a vehicle, in the order of their parameters. Properties that are not set are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass (kg).
    pub mass: f64,
    /// Moments of inertia about the x, y and z axes through the centre of mass (kg·m²).
    pub inertia: [f64; 3],
    /// Product of inertia ∫ x z dm (kg·m²).
    pub product: f64,
    /// Gravitational acceleration (m/s²).
    pub gravity: f64,
}

const fn inertia(name: &'static str, doc: &'static str) -> Parameter<'static> {
    Parameter {
        group: VEHICLE,
        ..Parameter::new(name, "kg*m^2", "", Kind::Following(Positive, "not known"), doc)
    }
}

const fn about(name: &'static str, doc: &'static str) -> Parameter<'static> {
    Parameter { group: VEHICLE, default: 0.0, ..Parameter::new(name, "m", "", Kind::Number(Any), doc) }
}

/// A parameter of one wing, or of a difference between left and right wings.
struct Own {
    name: String,
    unit: &'static str,
    kind: Kind<'static>,
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
    /// All parameters of a vehicle. The field `owner` stores the names and descriptions of the parameters
    /// that the vehicle adds to the parameters of the model.
    struct Named {
        owner: Vec<Own>,
        #[covariant]
        dependent: Parameters,
    }
);

/// Parameter table of a vehicle.
pub(super) struct Table {
    named: Named,
    /// Parameters of the model, which are the first rows of the table.
    model: &'static [Parameter<'static>],
    /// Indices of the model's parameters that may differ between wings.
    own: Vec<usize>,
    /// Number of wings.
    wings: usize,
    mirrored: Vec<bool>,
    has_differences: bool,
    /// Indices of the parameters for velocity and rates of the body, if the model has these parameters.
    motion: Option<[usize; 6]>,
}

/// Returns true if the wings may have different values of a parameter of the model.
pub(super) fn may_differ(parameter: &Parameter<'_>) -> bool {
    let shared = parameter.name == "drive_frequency" || BodyParameters::MOTION.contains(&parameter.name);
    !matches!(parameter.kind, Kind::Choice(_)) && !shared
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
                    doc: format!("{doc}. This parameter belongs to the wing {wing}."),
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
                    doc: format!("Value of {} for the wing {wing} alone.", parameter.name),
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
                    "Left-right difference of {}: half of it is added for wings that are not mirrored, and \
                     subtracted for mirrored wings.",
                    parameter.name
                ),
                group: "left-right differences".to_owned(),
                default: 0.0,
            }));
        }
        let named = Named::new(owned, |owned| {
            model.iter().chain(&WHOLE).copied().chain(owned.iter().map(Own::parameter)).collect()
        });
        let motion = BodyParameters::MOTION.map(|name| Parameter::index(model, name));
        let motion = motion.iter().all(Option::is_some).then(|| motion.map(Option::unwrap_or_default));
        Ok(Table { named, model, own, wings: mounts.len(), mirrored, has_differences, motion })
    }

    /// Returns all parameters: the parameters of the model, of the vehicle, of single wings, and of
    /// differences between wings.
    pub(super) fn parameters(&self) -> &[Parameter<'_>] {
        self.named.borrow_dependent()
    }

    /// Returns the index of the first parameter of a wing.
    fn begin(&self, wing: usize) -> usize {
        self.model.len() + WHOLE.len() + wing * (PLACE.len() + self.own.len())
    }

    /// Returns the reference point of the torques (m).
    pub(super) fn about(&self, values: &[f64]) -> [f64; 3] {
        core::array::from_fn(|i| values[self.model.len() + i])
    }

    /// Returns the mass properties of the whole vehicle.
    pub(super) fn mass_properties(&self, values: &[f64]) -> MassProperties {
        let [mass, x, y, z, product, gravity] = core::array::from_fn(|i| values[self.model.len() + 3 + i]);
        MassProperties { mass, inertia: [x, y, z], product, gravity }
    }

    /// Returns the position of a wing.
    pub(super) fn place(&self, values: &[f64], wing: usize) -> Place {
        let begin = self.begin(wing);
        Place {
            position: core::array::from_fn(|i| values[begin + i]),
            plane: core::array::from_fn(|i| values[begin + 3 + i]),
        }
    }

    /// Returns the parameter values of the model for one wing.
    ///
    /// # Errors
    /// Returns an error if a difference shifts a value out of its range. Also returns an error if a
    /// difference changes a parameter that is not set and is computed from other parameters.
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
                    "{DIFFERENCE}_{0} requires a value of {0}, which is not set: set {0} too",
                    parameter.name
                )));
            }
            *value += share * difference;
            if let Kind::Number(range) | Kind::Following(range, _) = parameter.kind {
                Invalid::unless_within(parameter.name, *value, range)?;
            }
        }
        self.turn_motion(values, wing, &mut own_values);
        Ok(own_values)
    }

    /// Returns `values` with a forward velocity of the body of 1 m/s, so that the terms of body motion are not zero. If
    /// the model has no parameters for body motion, `values` does not change.
    pub(super) fn in_motion(&self, values: &[f64]) -> Vec<f64> {
        let mut moving = values.to_vec();
        if let Some(motion) = self.motion {
            for (index, component) in motion.into_iter().zip([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]) {
                moving[index] = component;
            }
        }
        moving
    }

    /// Replaces the motion of the body in the values of a wing by the motion of the wing's shoulder.
    fn turn_motion(&self, values: &[f64], wing: usize, own_values: &mut [f64]) {
        let Some(motion) = self.motion else { return };
        let body: [f64; 6] = core::array::from_fn(|i| values[motion[i]]);
        // A body at rest has no motion at any wing, not even one of -0.
        if body.iter().all(|component| *component == 0.0) {
            return;
        }
        let shoulder = self.place(values, wing).motion(&body, self.about(values), self.mirrored[wing]);
        for (index, component) in motion.into_iter().zip(shoulder) {
            // Adding zero turns -0 into 0, so that equal wings stay equal to the last bit.
            own_values[index] = component + 0.0;
        }
    }
}

/// For a parameter of one wing, returns the index of the parameter that sets the value for all wings. The
/// result is `None` if the parameter at `index` does not belong to one wing.
pub fn of_all_wings(parameters: &[Parameter<'_>], index: usize) -> Option<usize> {
    let Kind::Following(_, follows) = parameters[index].kind else { return None };
    let wing = parameters[index].name.strip_suffix(follows)?;
    if wing.ends_with('_') { Parameter::index(parameters, follows) } else { None }
}

/// Returns the value of a parameter at a point. If a parameter of one wing is not set, the result is the value for all
/// wings.
pub fn standing(parameters: &[Parameter<'_>], values: &[f64], index: usize) -> f64 {
    let shared = of_all_wings(parameters, index).filter(|_| values[index].is_nan());
    values[shared.unwrap_or(index)]
}
