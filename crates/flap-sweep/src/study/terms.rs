//! Computes how the measures of a design change if a term that the papers leave out is added to the
//! equations.

use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Row, Status};

use crate::plan::Plan;

const ALL: &[&str] = &["bimorph", "direct-drive", "four-bar"];
const BIMORPH: &[&str] = &["bimorph"];
const OTHERS: &[&str] = &["direct-drive", "four-bar"];

/// Terms of the equations in the order of the manual (`docs/models/terms.md`). Each entry contains the
/// parameter of the term, a typical value, and the models for which this value is typical.
const TERMS: [(&str, f64, &[&str]); 24] = [
    // The effect of this size is similar to the effect of the loss factor below.
    ("stroke_damping", 5e-9, BIMORPH),
    ("stroke_damping", 5e-7, OTHERS),
    ("stroke_loss_factor", 0.1, ALL),
    ("hinge_damping", 1e-9, ALL),
    ("hinge_loss_factor", 0.1, ALL),
    ("stroke_stiffening", 1e-5, BIMORPH),
    ("hinge_stiffening", 1e-6, BIMORPH),
    ("hinge_stiffening", 3e-5, OTHERS),
    ("hinge_stop_stiffness", 3e-5, ALL),
    ("drag_term_0", 0.3, ALL),
    ("drag_term_1", 0.3, ALL),
    ("lift_term_1", 0.3, ALL),
    ("lift_term_2", 0.3, ALL),
    ("pressure_term_0", 0.05, ALL),
    ("pressure_term_1", 0.05, ALL),
    ("circulation_factor", 1.0, ALL),
    ("rotation_force_factor", 1.0, ALL),
    ("added_mass_factor", 1.0, BIMORPH),
    ("modulus_decline", 1e-7, BIMORPH),
    ("transmission_growth", 4.4e9, BIMORPH),
    ("drive_offset", 20.0, BIMORPH),
    ("plate_ratio", 0.9, BIMORPH),
    ("dielectric_loss", 0.13, ALL),
    ("charge_recovery", 0.42, ALL),
];

/// The effect of one term of the equations, which is switched on or off for a design.
#[derive(Clone, Debug)]
pub struct Effect {
    /// Index of the term's parameter in the model's parameter table.
    pub parameter: usize,
    /// Value of the parameter in the unchanged design.
    pub before: f64,
    /// Value of the parameter after the term is switched on or off.
    pub after: f64,
    /// Row of the design after the term is switched on or off.
    pub row: Row,
}

impl Effect {
    /// Returns the measures of the changed design, or `None` if its motion is not periodic.
    pub fn measures(&self) -> Option<&[f64]> {
        (self.row.status == Status::Periodic).then_some(&self.row.measures)
    }
}

/// Returns the effect of each term on the design of `run`. For each effect, only one term is changed.
///
/// If the design does not contain a term, the parameter of the term is set to a typical value. If the design
/// contains a term, the term is switched off. After a term is switched on or off, derived parameters are
/// computed again, except the parameters in `fixed`.
pub fn effects(plan: &Plan, run: &PointRun<'_>, fixed: &[usize]) -> Vec<Effect> {
    let simulator = plan.robot().model();
    let known = TERMS.iter().filter(|(_, _, models)| models.contains(&simulator.name()));
    let changes = known.filter_map(|&(parameter, size, _)| {
        let parameter = Parameter::index(simulator.parameters(), parameter)?;
        let before = run.values[parameter];
        let off = simulator.parameters()[parameter].default;
        let off = if off.is_nan() { 0.0 } else { off };
        Some((parameter, before, if before == off { size } else { off }))
    });
    changes
        .map(|(parameter, before, after)| {
            let mut values = run.values.to_vec();
            values[parameter] = after;
            plan.derived().fill(&mut values, &[fixed, &[parameter]].concat());
            let row = simulator.run_point(&PointRun { values: &values, ..*run }, None);
            Effect { parameter, before, after, row }
        })
        .collect()
}
