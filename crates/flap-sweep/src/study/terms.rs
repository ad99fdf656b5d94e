//! Effects on the measures of a design, caused by terms that the papers leave out.

use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Row, Status};

use crate::plan::Plan;

/// A term: a parameter with a typical size, for the models that have this size.
struct Term {
    parameter: &'static str,
    size: f64,
    models: &'static [&'static str],
}

const ALL: &[&str] = &["bimorph", "direct-drive", "four-bar"];
const BIMORPH: &[&str] = &["bimorph"];
const OTHERS: &[&str] = &["direct-drive", "four-bar"];

const fn term(parameter: &'static str, size: f64, models: &'static [&'static str]) -> Term {
    Term { parameter, size, models }
}

/// Terms in the order of the manual (`docs/models/terms.md`).
const TERMS: [Term; 24] = [
    // The effect of this size is similar to the effect of the loss factor below.
    term("stroke_damping", 5e-9, BIMORPH),
    term("stroke_damping", 5e-7, OTHERS),
    term("stroke_loss_factor", 0.1, ALL),
    term("hinge_damping", 1e-9, ALL),
    term("hinge_loss_factor", 0.1, ALL),
    term("stroke_stiffening", 1e-5, BIMORPH),
    term("hinge_stiffening", 1e-6, BIMORPH),
    term("hinge_stiffening", 3e-5, OTHERS),
    term("hinge_stop_stiffness", 3e-5, ALL),
    term("drag_term_0", 0.3, ALL),
    term("drag_term_1", 0.3, ALL),
    term("lift_term_1", 0.3, ALL),
    term("lift_term_2", 0.3, ALL),
    term("pressure_term_0", 0.05, ALL),
    term("pressure_term_1", 0.05, ALL),
    term("circulation_factor", 1.0, ALL),
    term("rotation_force_factor", 1.0, ALL),
    term("added_mass_factor", 1.0, BIMORPH),
    term("modulus_decline", 1e-7, BIMORPH),
    term("transmission_growth", 4.4e9, BIMORPH),
    term("drive_offset", 20.0, BIMORPH),
    term("plate_ratio", 0.9, BIMORPH),
    term("dielectric_loss", 0.13, ALL),
    term("charge_recovery", 0.42, ALL),
];

/// A term of a design that is switched on or off.
#[derive(Clone, Debug)]
pub struct Effect {
    /// Index of the parameter.
    pub parameter: usize,
    /// Value of the parameter in the design.
    pub before: f64,
    /// Changed value of the parameter.
    pub after: f64,
    /// Row of the design with the changed value.
    pub row: Row,
}

impl Effect {
    /// Returns the measures of the row, or `None` if the motion is not periodic.
    pub fn measures(&self) -> Option<&[f64]> {
        (self.row.status == Status::Periodic).then_some(&self.row.measures)
    }
}

/// Returns the effect of each term on the design of `run`. Each effect is for a change of one term alone.
///
/// A term that the design leaves out is switched on with a typical size. A term that the design has is switched off.
/// Derived parameters of the plan are updated, except parameters in `fixed`, which have their own values.
pub fn effects(plan: &Plan, run: &PointRun<'_>, fixed: &[usize]) -> Vec<Effect> {
    let simulator = plan.robot().model();
    let known = TERMS.iter().filter(|term| term.models.contains(&simulator.name()));
    let changes = known.filter_map(|term| {
        let parameter = Parameter::index(simulator.parameters(), term.parameter)?;
        let before = run.values[parameter];
        let off = simulator.parameters()[parameter].default;
        let off = if off.is_nan() { 0.0 } else { off };
        Some((parameter, before, if before == off { term.size } else { off }))
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
