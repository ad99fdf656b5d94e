//! The work whose instructions are counted: one point on scalars, or the same point in every lane, for about one drive
//! period.

use std::fmt;

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, PointRun, Row, Simulator, SolverSettings, preset};

/// A preset of each model, also if the model is not compiled in.
pub(crate) const PRESETS: [&str; 3] = ["ozaki2018-large", "jafferis2016", "arabagi2013-75hz"];

/// A piece of work; its name can be passed to another process.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work {
    /// The preset, one of [`PRESETS`].
    pub(crate) preset: &'static str,
    /// The SIMD instructions that the work uses.
    pub(crate) backend: Backend,
    /// The task.
    pub(crate) task: Task,
}

/// The kinds of computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Task {
    /// Marching a point for a period on scalars of the backend's arithmetic class.
    ScalarMarch,
    /// Marching a point per lane for a period.
    March,
    /// Continuing a settled point in each lane: a period with responses to changes, and a period with a measurement.
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
    /// The work with this name, in the format of [`Display`](fmt::Display).
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

    /// Runs the work, and calls `mark` at the beginning and at the end of the count.
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

    /// The number of right-hand sides within the count, for all lanes together.
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

/// One period. With the large tolerance the period has few steps; the length of a step does not change its number of
/// instructions.
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

/// Every change is within the tolerance, so that the motion settles after two periods. The third period is integrated
/// with responses to changes, and the fourth period is measured.
const SETTLE_AND_MEASURE: SolverSettings =
    SolverSettings { settle_tol: f64::INFINITY, max_cycles: 10, ..MARCH };

/// Only the first two periods of [`SETTLE_AND_MEASURE`].
const SETTLE: SolverSettings = SolverSettings { max_cycles: 2, ..MARCH };

/// The beginning of a count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Begin {
    /// The count begins when all lanes have their points and marching begins.
    WithTheLastPoint,
    /// The count begins when no further point follows and the settled points continue.
    AfterTheLastPoint,
}

/// The same point for every lane. All lanes do the same work and end together, so the count ends with the first lane.
struct Alike<'a> {
    values: Vec<f64>,
    left: usize,
    begin: Begin,
    marks: u32,
    rhs_evals: u64,
    mark: &'a mut dyn FnMut(),
}

impl Alike<'_> {
    /// Calls `mark`, unless the mark `number` was already made.
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
