//! The work that is counted: one point on scalars, or the same point in every lane, for about one drive period.

use std::fmt;

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, PointRun, Row, Simulator, SolverSettings, preset};

/// A point of each model, whether or not it is compiled in.
pub(crate) const PRESETS: [&str; 3] = ["ozaki2018-large", "jafferis2016", "arabagi2013-75hz"];

/// Some work with a name, so that another process can be asked for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work {
    /// The point, one of [`PRESETS`].
    pub(crate) preset: &'static str,
    /// The instructions it is done with.
    pub(crate) backend: Backend,
    /// The task.
    pub(crate) task: Task,
}

/// A task for the instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Task {
    /// Marching a point for a period on scalars of the backend's arithmetic class.
    ScalarMarch,
    /// Marching a point per lane for a period.
    March,
    /// Going on with a point per lane that has settled: a period with responses to changes, and one that is measured.
    Measure,
}

impl Task {
    fn name(self) -> &'static str {
        match self {
            Task::ScalarMarch => "scalar-march",
            Task::March => "march",
            Task::Measure => "measure",
        }
    }
}

impl fmt::Display for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.preset, self.backend, self.task.name())
    }
}

impl Work {
    /// The work that is displayed like this.
    pub(crate) fn by_name(name: &str) -> Option<Work> {
        let mut words = name.split(' ');
        let preset = words.next()?;
        let preset = PRESETS.into_iter().find(|&one| one == preset)?;
        let backend = Backend::by_name(words.next()?)?;
        let task = words.next()?;
        let task =
            [Task::ScalarMarch, Task::March, Task::Measure].into_iter().find(|one| one.name() == task)?;
        Some(Work { preset, backend, task })
    }

    /// Does the work, calling `mark` where the count is to begin and where it is to end.
    pub(crate) fn run(self, mark: &mut dyn FnMut()) {
        match self.task {
            Task::ScalarMarch => {
                let (simulator, values) = self.point();
                mark();
                simulator.run_point(&PointRun::new(self.backend, &MARCH, &values), None);
                mark();
            }
            Task::March => {
                self.run_lanes(&MARCH, Begin::WithTheLastPoint, mark);
            }
            Task::Measure => {
                self.run_lanes(&SETTLE_AND_MEASURE, Begin::AfterTheLastPoint, mark);
            }
        }
    }

    /// The right-hand sides evaluated in what is counted, for all lanes together.
    pub(crate) fn rhs_evals(self) -> u64 {
        let evals = |settings| self.run_lanes(settings, Begin::WithTheLastPoint, &mut || ());
        match self.task {
            Task::ScalarMarch => {
                let (simulator, values) = self.point();
                simulator.run_point(&PointRun::new(self.backend, &MARCH, &values), None).rhs_evals
            }
            Task::March => evals(&MARCH),
            Task::Measure => evals(&SETTLE_AND_MEASURE) - evals(&SETTLE),
        }
    }

    fn run_lanes(self, settings: &SolverSettings, begin: Begin, mark: &mut dyn FnMut()) -> u64 {
        let (simulator, values) = self.point();
        let mut jobs = Alike { values, left: self.backend.lanes(), begin, marks: 0, rhs_evals: 0, mark };
        simulator.run(self.backend, settings, &mut jobs);
        jobs.rhs_evals
    }

    fn point(self) -> (&'static dyn Simulator, Vec<f64>) {
        let (simulator, preset) = preset(self.preset).expect("one of the presets");
        (simulator, (preset.values)())
    }
}

/// One period. The tolerance is loose to make it short: what a step costs does not depend on its length.
const MARCH: SolverSettings = SolverSettings {
    rtol: 1e-2,
    atol: 1e-4,
    settle_tol: 0.0,
    max_cycles: 1,
    max_steps: 20_000,
    accuracy: f64::INFINITY,
    newton: true,
    progressive: true,
    // In half periods of so few steps, beginnings and ends of runs would outweigh what is counted.
    symmetry: false,
    loads: false,
};

/// Any change counts as none, so that the motion has settled after two periods; a third is integrated with responses to
/// changes, a fourth is measured.
const SETTLE_AND_MEASURE: SolverSettings =
    SolverSettings { settle_tol: f64::INFINITY, max_cycles: 10, ..MARCH };

/// The same two periods and no more.
const SETTLE: SolverSettings = SolverSettings { max_cycles: 2, ..MARCH };

/// The beginning of a count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Begin {
    /// All lanes have their points and marching begins.
    WithTheLastPoint,
    /// There is no further point and what has settled goes on.
    AfterTheLastPoint,
}

/// The same point for every lane. The lanes then do the same and end together: the count ends with the first.
struct Alike<'a> {
    values: Vec<f64>,
    left: usize,
    begin: Begin,
    marks: u32,
    rhs_evals: u64,
    mark: &'a mut dyn FnMut(),
}

impl Alike<'_> {
    /// Marks, unless there has been a mark of this number.
    fn mark(&mut self, number: u32) {
        if self.marks < number {
            self.marks = number;
            (self.mark)();
        }
    }
}

impl Jobs for Alike<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        if self.left == 0 {
            self.mark(1);
            return None;
        }
        self.left -= 1;
        if self.left == 0 && self.begin == Begin::WithTheLastPoint {
            self.mark(1);
        }
        Some(Point::at_rest(self.left as u64, self.values.clone()))
    }

    fn done(&mut self, _index: u64, row: Row) {
        self.mark(2);
        self.rhs_evals += row.rhs_evals;
    }
}
