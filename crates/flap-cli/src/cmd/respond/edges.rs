//! Edges of hysteresis in the plane of two parameters, for `flap respond --edge`.

use flap_core::parameter::Parameter;
use flap_core::simulate::never;
use flap_sweep::notation::text;
use flap_sweep::notation::units::prefixed;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::run::{Outcome, RunOptions};
use flap_sweep::study::response::{Curve, Edge, EdgeMark, EdgeRange, Edges, Responses};
use flap_sweep::table::layout::Cell;

use super::basins::design;
use crate::args::{OutputFormat, RespondArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, assignment, six_digits};

/// The measure that the table for a terminal shows at each point of an edge.
const STROKE: &str = "stroke_pp_deg";

/// Prints the edges of hysteresis of each design in the plan of `flap respond`.
pub(super) fn run(plan: &Plan, second: &EdgeRange, args: &RespondArgs) -> Result<Exit, Failure> {
    let Some((along, responses)) = plan.followed().zip(Responses::of(plan)) else {
        return Err(Failure::Bug("the plan follows no parameter".to_owned()));
    };
    let options = RunOptions::with_threads(args.begin.work.threads);
    let output = Output { plan, along, second };
    let mut rows = Vec::new();
    for outcome in responses.curves(&options, 0) {
        let Outcome::Ran(curve) = outcome? else { continue };
        let edges = responses.edges(&curve, second, &never);
        for value in &edges.missed {
            let place = output.value(along.parameter, *value);
            let design = design(plan, &curve);
            console::say(&format!("{design}no edge was found at {place}, where a band ends"));
        }
        let none = output.no_edge(&curve, &edges);
        match (args.format, none) {
            (OutputFormat::Table, Some(none)) => console::results(&(none + "\n"))?,
            (OutputFormat::Table, None) => console::results(&output.text(&curve, &edges.edges))?,
            (_, Some(none)) => console::say(&none),
            (_, None) => {
                let cells = edges.rows(plan, &curve.design);
                rows.extend(cells.iter().map(|row| row.iter().map(cell_text).collect::<Vec<String>>()));
            }
        }
    }
    if args.format != OutputFormat::Table {
        let columns = Edges::columns(plan, along, second);
        let names: Vec<String> = columns.into_iter().map(|column| column.name).collect();
        print::table(args.format, &names, &rows, String::new)?;
    }
    Ok(Exit::Done)
}

/// Formats the edges of the designs of a plan as text.
struct Output<'a> {
    plan: &'a Plan,
    along: &'a Along,
    second: &'a EdgeRange,
}

impl Output<'_> {
    /// Returns the parameter of `--edge` and the followed parameter.
    fn parameters(&self) -> [&Parameter<'_>; 2] {
        [self.second.parameter, self.along.parameter].map(|index| &self.plan.parameters()[index])
    }

    /// Returns a value of a parameter as text with its unit.
    fn value(&self, parameter: usize, value: f64) -> String {
        prefixed(value, self.plan.parameters()[parameter].unit)
    }

    /// If a design has no edges, returns a line with the reason.
    fn no_edge(&self, curve: &Curve, edges: &Edges) -> Option<String> {
        let design = design(self.plan, curve);
        if let Some(reason) = curve.invalid() {
            return Some(format!("{design}no response: {reason}"));
        }
        if !edges.edges.is_empty() || !edges.missed.is_empty() {
            return None;
        }
        let [second, first] = self.parameters();
        let value = assignment(second, curve.design.values[self.second.parameter]);
        let values = &self.along.values;
        let ends = [values[0], values[values.len() - 1]].map(|end| self.value(self.along.parameter, end));
        Some(format!(
            "{design}no edge: with {value}, no band of {} ends between {} and {}; set {} to a value with hysteresis, \
             such as a larger one",
            first.name, ends[0], ends[1], second.name
        ))
    }

    /// Returns the edges of a design as text for a terminal, with a line and a table for each edge.
    fn text(&self, curve: &Curve, edges: &[Edge]) -> String {
        let design = design(self.plan, curve);
        let edge = |edge| {
            let verdict = Edge::verdict(edge, self.plan, self.along, self.second);
            format!("{design}{verdict}\n\n{}", self.table(edge))
        };
        edges.iter().map(edge).collect::<Vec<_>>().join("\n")
    }

    /// Returns the points of an edge as a table for a terminal.
    fn table(&self, edge: &Edge) -> String {
        let [second, first] = self.parameters().map(|parameter| parameter.name);
        let stroke = self.plan.rows().columns().iter().position(|column| column.name == STROKE);
        let stroke_name = if stroke.is_some() { STROKE } else { "" };
        let mut table = Table::with_names([second, first, stroke_name, ""].map(str::to_owned).into());
        for point in &edge.points {
            let stroke = stroke.and_then(|index| point.measures.get(index));
            table.row([
                self.value(self.second.parameter, point.values[1]),
                self.value(self.along.parameter, point.values[0]),
                stroke.map_or_else(String::new, |&stroke| six_digits(stroke)),
                point.mark.map_or("", EdgeMark::name).to_owned(),
            ]);
        }
        table.text_within(console::width())
    }
}

/// Returns the value of a cell as text. The text is empty for an unknown value.
fn cell_text(cell: &Cell) -> String {
    match *cell {
        Cell::Whole(number) => number.to_string(),
        Cell::Number(number) if number.is_nan() => String::new(),
        Cell::Number(number) => text::float(number),
        Cell::Flag(flag) => flag.map_or_else(String::new, |flag| flag.to_string()),
        Cell::Text(word) => word.to_owned(),
    }
}
