//! Computes the row of each design at the resonance of this design.

use flap_core::model::OverWings;
use flap_core::num::Backend;
use flap_core::simulate::{Column, Jobs, Point, PointRun, Row, Rows, Simulator, SolverSettings};

use super::search::{Peaks, Search};
use super::sequence::{self, Sequence, SequenceSource};
use super::target::{Objective, Range, Target, places};

/// A model whose rows are computed at the resonance of each design. The drive frequency of a point is ignored.
///
/// A row contains the measures of the model at the resonance. Only the columns `cycles` and `rhs_evals` count
/// the work of the whole search. After the model's measures, the row contains measures about the resonance.
#[derive(Clone)]
pub struct AtResonance {
    target: Target,
    columns: Vec<Column>,
}

/// Name of the column with the resonance frequency.
pub const RESONANCE_HZ: &str = "resonance_hz";

/// Name of the column with the distance between the resonance and the nearer end of the searched frequency
/// range.
pub const RESONANCE_MARGIN_HZ: &str = "resonance_margin_hz";

/// Returns all measures that rows of a simulator can have: first the measures of the simulator, then measures
/// about the resonance.
pub fn measures(simulator: &dyn Simulator) -> Vec<Column> {
    let of = Range::default().of;
    if places(simulator, of).is_some() { columns(simulator, of) } else { simulator.columns().to_vec() }
}

/// Returns the measures of rows at the resonance: first the measures of the model, then measures about the resonance.
fn columns(model: &dyn Simulator, of: Objective) -> Vec<Column> {
    let of = of.name();
    let margin = &*format!(
        "distance of resonance_hz from the nearer end of the searched range; zero if the {of} is largest at an end of \
        the range"
    );
    let gaps = "number of points without a periodic motion in the search for the resonance; a larger peak could lie at \
    one of these points";
    let added = [
        (RESONANCE_HZ, "Hz", &*format!("drive frequency at which the {of} is largest")),
        (
            "resonance_second_hz",
            "Hz",
            &*format!(
                "drive frequency of a second peak of the {of}, if the height of the second peak is within 5 % of the \
                largest peak"
            ),
        ),
        (RESONANCE_MARGIN_HZ, "Hz", margin),
        ("resonance_points", "", "number of points that flap computed in the search for the resonance"),
        ("resonance_gaps", "", gaps),
    ];
    let added = added.map(|(name, unit, doc)| Column {
        name: name.to_owned(),
        unit,
        doc: doc.to_owned(),
        over_wings: OverWings::Omitted,
    });
    model.columns().iter().cloned().chain(added).collect()
}

impl AtResonance {
    /// Returns an object that computes rows at the resonance of each design of `model`. If the model has no
    /// drive frequency or does not measure the objective, returns `None`.
    pub fn new(model: &'static dyn Simulator, range: Range) -> Option<AtResonance> {
        Some(AtResonance { target: Target::new(model, range)?, columns: columns(model, range.of) })
    }

    /// Returns the range and accuracy of the search for resonances.
    pub fn range(&self) -> &Range {
        &self.target.range
    }
}

impl Rows for AtResonance {
    fn columns(&self) -> &[Column] {
        &self.columns
    }

    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        sequence::run_all(self.target.model, backend, solver, &mut Designs { at: self, jobs });
    }

    /// Ignores the initial state `begin`, because the search for a resonance chooses its own initial states.
    fn run_point(&self, run: &PointRun<'_>, _begin: Option<&[f64]>) -> Row {
        let design = Point::at_rest(0, run.values.to_vec());
        let search = Search::new(&self.target, design, Peaks::HIGHEST);
        search.sequence().run_alone(self.target.model, run).into_row().1
    }
}

/// Source of the designs of a sweep, and receiver of the rows of the designs.
struct Designs<'a> {
    at: &'a AtResonance,
    jobs: &'a mut dyn Jobs,
}

impl<'a> SequenceSource<'a> for Designs<'a> {
    type Output = Search<'a>;

    fn next(&mut self, idle: bool) -> Option<Sequence<'a, Search<'a>>> {
        Some(Search::new(&self.at.target, self.jobs.next(idle)?, Peaks::HIGHEST).sequence())
    }

    fn done(&mut self, search: Search<'a>) {
        let (index, row) = search.into_row();
        self.jobs.done(index, row);
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
