//! Each design at its own resonance: the drive frequency at which its stroke, lift or efficiency is largest.
//!
//! - [`AtResonance`]: what is looked for; turns designs into rows as a model turns points
//! - `search`: the search of one design
//! - `maximum`: the top of one peak

mod maximum;
mod search;
pub mod study;

use flap_core::num::InstructionSet;
use flap_core::parameter::Invalid;
use flap_core::resonance::driven::has_prescribed_stroke;
use flap_core::simulate::{Column, Jobs, Point, Row, Rows, Simulator, SolverSettings, Unfinished};

use search::Search;
use study::Desk;

/// What is to be largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The stroke.
    Stroke,
    /// The mean lift.
    Lift,
    /// Mean lift over mean electrical power.
    Efficiency,
}

impl Objective {
    /// The objectives, in the order of [`Objective::NAMES`].
    pub const ALL: [Objective; 3] = [Objective::Stroke, Objective::Lift, Objective::Efficiency];

    /// Their names in grid files.
    pub const NAMES: [&'static str; 3] = ["stroke", "lift", "efficiency"];

    /// The name in grid files.
    pub fn name(self) -> &'static str {
        Objective::NAMES[self as usize]
    }

    /// The column that is to be largest.
    fn column(self) -> &'static str {
        match self {
            Objective::Stroke => "stroke_amplitude_deg",
            Objective::Lift => "lift_mean_mn",
            Objective::Efficiency => "efficiency_gf_per_w",
        }
    }
}

/// Where resonances are looked for, and how closely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// What is to be largest.
    pub of: Objective,
    /// Lowest drive frequency (Hz); half of the design's lower natural frequency if `None`.
    pub from: Option<f64>,
    /// Highest drive frequency (Hz); one and a half times the design's upper natural frequency if `None`.
    pub to: Option<f64>,
    /// How closely the frequency is located (Hz), more than zero.
    pub tolerance: f64,
}

impl Default for Range {
    fn default() -> Self {
        Range { of: Objective::Stroke, from: None, to: None, tolerance: 0.05 }
    }
}

/// The parameter that is searched for.
pub const DRIVE_FREQUENCY: &str = "drive_frequency";

/// A model whose rows are those of each design at its own resonance: the drive frequency of a point does not matter.
///
/// A row is the one that the model gives at [`RESONANCE_HZ`], but for `cycles` and `rhs_evals`, which count the whole
/// search; its measures are the model's, and behind them what was found out about the resonance.
pub struct AtResonance {
    model: &'static dyn Simulator,
    range: Range,
    /// Index of the drive frequency among the parameters, and of the objective among the columns.
    frequency: usize,
    objective: usize,
    columns: Vec<Column>,
}

/// The column with the resonance's frequency.
pub const RESONANCE_HZ: &str = "resonance_hz";

/// The column with the resonance's distance from the nearer end of the range.
pub const RESONANCE_MARGIN_HZ: &str = "resonance_margin_hz";

impl AtResonance {
    /// The resonances of designs of `model`; `None` if that has no drive frequency or does not measure the objective.
    pub fn new(model: &'static dyn Simulator, range: Range) -> Option<AtResonance> {
        let frequency = model.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY)?;
        let objective = model.columns().iter().position(|column| column.name == range.of.column())?;
        let mut columns = model.columns().to_vec();
        let of = range.of.name();
        let mut add = |name: &str, unit, doc: String| {
            columns.push(Column { name: name.to_owned(), unit, doc });
        };
        add(RESONANCE_HZ, "Hz", format!("drive frequency at which the {of} is largest"));
        add(
            "resonance_second_hz",
            "Hz",
            format!("another peak of the {of}, if it is within 5 % of the largest"),
        );
        add(
            RESONANCE_MARGIN_HZ,
            "Hz",
            "distance of the resonance from the nearer end of the range; zero if the largest value is there"
                .to_owned(),
        );
        add("resonance_points", "", "points run in the search".to_owned());
        add(
            "resonance_gaps",
            "",
            "those whose motion did not become periodic: a larger peak may hide there".to_owned(),
        );
        Some(AtResonance { model, range, frequency, objective, columns })
    }

    /// Where resonances are looked for.
    pub fn range(&self) -> &Range {
        &self.range
    }

    /// The frequencies (Hz) between which the resonance of a design is looked for.
    fn ends(&self, values: &[f64]) -> Result<[f64; 2], Unfinished> {
        let Range { of, from, to, .. } = self.range;
        if of == Objective::Stroke && has_prescribed_stroke(self.model.parameters(), values) {
            return Err(Invalid::new(
                "stroke_mode is \"prescribed\": such a stroke is the same at every frequency, and has no resonance",
            )
            .into());
        }
        let [from, to] = match (from, to) {
            (Some(from), Some(to)) => [from, to],
            (from, to) => {
                let mut values = values.to_vec();
                // Small motions do not depend on it, but it must be there.
                values[self.frequency] = from.or(to).unwrap_or(1.0);
                let natural = self.model.experiments()?.modes(&values)?.map(|mode| mode.frequency);
                let lowest = 0.5 * natural[0].min(natural[1]);
                let highest = 1.5 * natural[0].max(natural[1]);
                [from.unwrap_or(lowest), to.unwrap_or(highest)]
            }
        };
        if from > 0.0 && from < to && to.is_finite() {
            return Ok([from, to]);
        }
        Err(Invalid::new(format!(
            "there are no drive frequencies from {from} to {to} Hz to look for a resonance"
        ))
        .into())
    }
}

impl Rows for AtResonance {
    fn columns(&self) -> &[Column] {
        &self.columns
    }

    fn run(&self, set: InstructionSet, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        study::run_all(self.model, set, solver, &mut Designs { at: self, jobs });
    }

    /// A resonance is looked for from rest: `begin` does not matter.
    fn run_point(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        _begin: Option<&[f64]>,
    ) -> Row {
        let mut search = Search::new(self, Point::at_rest(0, values.to_vec()));
        study::run_one(self.model, set, solver, &mut search);
        search.finish().1
    }
}

/// Designs on their way from the jobs of a sweep to their rows.
struct Designs<'a> {
    at: &'a AtResonance,
    jobs: &'a mut dyn Jobs,
}

impl<'a> Desk for Designs<'a> {
    type Study = Search<'a>;

    fn next(&mut self, idle: bool) -> Option<Search<'a>> {
        Some(Search::new(self.at, self.jobs.next(idle)?))
    }

    fn done(&mut self, search: Search<'a>) {
        let (index, row) = search.finish();
        self.jobs.done(index, row);
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
