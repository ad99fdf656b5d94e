//! The lines of curves.

use flap_core::parameter::Parameter;
use flap_core::simulate::Point;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::study::response::{Curve, Verdict};

use crate::table::assignment;

/// The lines of curves.
pub(crate) struct Verdicts<'a> {
    plan: &'a Plan,
    along: &'a Along,
    parameter: &'a Parameter<'a>,
    /// Index of the stroke's amplitude among the measures.
    stroke: usize,
}

impl<'a> Verdicts<'a> {
    /// For a plan that follows a parameter, of a model that measures its stroke; `None` of any other.
    pub(crate) fn of(plan: &'a Plan) -> Option<Verdicts<'a>> {
        let along = plan.followed()?;
        let parameter = along.parameter(plan);
        let mut columns = plan.rows().columns().iter();
        let stroke = columns.position(|column| column.name == "stroke_amplitude_deg")?;
        Some(Verdicts { plan, along, parameter, stroke })
    }

    /// The line of a curve.
    pub(crate) fn line(&self, curve: &Curve) -> String {
        let verdict = Verdict::new(curve, self.along, self.parameter, self.stroke);
        let design = self.design(&curve.design);
        if design.is_empty() { verdict.to_string() } else { format!("{design}: {verdict}") }
    }

    /// The parameters that tell a design from others.
    fn design(&self, design: &Point) -> String {
        let assignment = |index: usize| assignment(&self.plan.parameters()[index], design.values[index]);
        self.plan.axes().varied().map(assignment).collect::<Vec<_>>().join(", ")
    }
}
