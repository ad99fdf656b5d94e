//! The lines of curves.

use flap_core::parameter::Parameter;
use flap_core::simulate::Point;
use flap_sweep::notation::text;
use flap_sweep::plan::Plan;
use flap_sweep::study::response::{Curve, Verdict};

/// The lines of curves.
pub(crate) struct Verdicts<'a> {
    plan: &'a Plan,
    parameter: &'static Parameter,
    /// Index of the stroke's amplitude among the measures.
    stroke: usize,
}

impl<'a> Verdicts<'a> {
    /// For a plan that follows a parameter, of a model that measures its stroke; `None` of any other.
    pub(crate) fn of(plan: &'a Plan) -> Option<Verdicts<'a>> {
        let parameter = plan.followed()?.parameter(plan);
        let mut columns = plan.rows().columns().iter();
        let stroke = columns.position(|column| column.name == "stroke_amplitude_deg")?;
        Some(Verdicts { plan, parameter, stroke })
    }

    /// The line of a curve.
    pub(crate) fn line(&self, curve: &Curve) -> String {
        let verdict = Verdict::new(curve, self.parameter, self.stroke);
        let design = self.design(&curve.design);
        if design.is_empty() { verdict.to_string() } else { format!("{design}: {verdict}") }
    }

    /// The parameters that tell a design from others.
    fn design(&self, design: &Point) -> String {
        let assignment = |index: usize| {
            let parameter = &self.plan.parameters()[index];
            let value = text::value(parameter, design.values[index]);
            format!("{} = {value} {}", parameter.name, parameter.unit).trim_end().to_owned()
        };
        self.plan.axes().varied().map(assignment).collect::<Vec<_>>().join(", ")
    }
}
