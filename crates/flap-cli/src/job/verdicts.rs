//! Summaries of response curves: one line for each curve, or rows for csv and json.

use std::io;

use flap_core::parameter::Parameter;
use flap_core::simulate::Point;
use flap_sweep::notation::text;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::study::response::{BandKind, Curve, Verdict};

use crate::args::OutputFormat;
use crate::console;
use crate::table::assignment;

/// The output stream for the lines that summarize response curves.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lines {
    /// The lines go to stdout. If the program that reads stdout closes stdout, the run ends.
    Stdout,
    /// The lines go to stdout, and the rows go to a file. If the program that reads stdout closes stdout, the
    /// run continues.
    StdoutBesideFile,
    /// The lines go to stderr, because the rows go to stdout.
    Stderr,
}

/// Summaries of response curves.
pub(crate) struct Verdicts<'a> {
    format: OutputFormat,
    stream: Lines,
    /// Rows for csv and json, in the columns [`Verdicts::names`].
    pub(crate) rows: Vec<Vec<String>>,
    plan: &'a Plan,
    along: &'a Along,
    parameter: &'a Parameter<'a>,
    /// Index of the measure `stroke_amplitude_deg` among the measures of the model.
    stroke: usize,
}

impl<'a> Verdicts<'a> {
    /// Returns an empty list of summaries. The result is `None` if the plan computes no response curves, or
    /// if its model has no measure `stroke_amplitude_deg`.
    pub(crate) fn of(plan: &'a Plan, format: OutputFormat, stream: Lines) -> Option<Verdicts<'a>> {
        let along = plan.followed()?;
        let parameter = along.parameter(plan);
        let mut columns = plan.rows().columns().iter();
        let stroke = columns.position(|column| column.name == "stroke_amplitude_deg")?;
        Some(Verdicts { format, stream, rows: Vec::new(), plan, along, parameter, stroke })
    }

    /// Prints the summary line of a response curve, or stores the summary as rows for csv and json.
    pub(crate) fn add(&mut self, curve: &Curve) -> io::Result<()> {
        let verdict = Verdict::new(curve, self.along, self.parameter, self.stroke);
        if self.format != OutputFormat::Table {
            self.rows.extend(self.cells(&curve.design, &verdict));
            return Ok(());
        }
        let design = self.design(&curve.design);
        let line = if design.is_empty() { verdict.to_string() } else { format!("{design}: {verdict}") };
        match self.stream {
            Lines::Stdout => console::results(&(line + "\n")),
            Lines::StdoutBesideFile => match console::results(&(line + "\n")) {
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
                printed => printed,
            },
            Lines::Stderr => {
                console::say(&line);
                Ok(())
            }
        }
    }

    /// Returns the column names for csv and json: the varied parameters, and then the columns that describe a
    /// band of the followed parameter.
    pub(crate) fn names(&self) -> Vec<&str> {
        let varied = self.plan.axes().varied().map(|index| self.plan.parameters()[index].name);
        varied.chain(["kind", "from", "to", "unit", "resolution", "jump_deg", "motions"]).collect()
    }

    /// Returns the summary of a response curve as one row for each bistable or irregular band. In an
    /// irregular band, motions do not repeat after one drive period. A curve without bistable and irregular
    /// bands has one row for the whole range of the followed parameter.
    fn cells(&self, design: &Point, verdict: &Verdict) -> Vec<Vec<String>> {
        let row = |kind: &str, [from, to]: [f64; 2], jump: Option<f64>, motions: String| {
            let values = self.plan.axes().varied();
            let values =
                values.map(|index| text::value(&self.plan.parameters()[index], design.values[index]));
            let number = |value: f64| if value.is_nan() { String::new() } else { text::float(value) };
            let band = [
                kind.to_owned(),
                number(from),
                number(to),
                verdict.unit.to_owned(),
                number(verdict.steep_step),
                jump.map_or_else(String::new, text::float),
                motions,
            ];
            values.chain(band).collect()
        };
        if let Some(reason) = &verdict.invalid {
            return vec![row("invalid", verdict.range, None, reason.clone())];
        }
        if verdict.bands.is_empty() {
            return vec![row("none", verdict.range, None, String::new())];
        }
        let bands = verdict.bands.iter().map(|band| match &band.kind {
            BandKind::Bistable { jump } => row("bistable", band.range, *jump, String::new()),
            BandKind::Irregular { what } => {
                let motions = what.iter().map(|(status, period)| format!("{} {period}", status.name()));
                row("irregular", band.range, None, motions.collect::<Vec<_>>().join(", "))
            }
        });
        bands.collect()
    }

    /// Returns the values of the varied parameters in a design as text.
    fn design(&self, design: &Point) -> String {
        let assignment = |index: usize| assignment(&self.plan.parameters()[index], design.values[index]);
        self.plan.axes().varied().map(assignment).collect::<Vec<_>>().join(", ")
    }
}
