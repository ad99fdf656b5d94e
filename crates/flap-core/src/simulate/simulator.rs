//! The object-safe face of a model: all that sweeps, the command line and Python use.

use crate::drive::Samples;
use crate::modes::Mode;
use crate::num::InstructionSet;
use crate::ode::ensemble::Occupancy;
use crate::ode::{Interrupt, Tolerances};
use crate::parameter::{Invalid, Parameter, Preset};

/// What turns design points into rows.
pub trait Rows: Sync {
    /// What each row measures, in column order.
    fn columns(&self) -> &[Column];

    /// Runs the points of `jobs` on the SIMD lanes of `set` until there are none left.
    ///
    /// Rows are handed back in the order in which points finish. A row depends on its point and `solver`
    /// alone: not on its neighbours, nor on the order of the points, nor on `set` within an arithmetic class.
    fn run(&self, set: InstructionSet, solver: &SolverSettings, jobs: &mut dyn Jobs);

    /// Runs one point on scalars, in the arithmetic class of `set`, from rest or from the state `begin` (see
    /// [`Point::begin`]). Gives the same bits as [`Rows::run`].
    fn run_point(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: Option<&[f64]>,
    ) -> Row;
}

/// A model that turns design points into rows, and can be asked more about each.
pub trait Simulator: Rows {
    /// Name in grid files, such as `direct-drive`.
    fn name(&self) -> &'static str;

    /// One line: what it models and the paper.
    fn doc(&self) -> &'static str;

    /// The parameter table. A point is one `f64` per entry, see [`Parameter`].
    fn parameters(&self) -> &'static [Parameter];

    /// Published parameter sets.
    fn presets(&self) -> &'static [Preset];

    /// Runs one point on scalars from rest, as [`Rows::run_point`] does.
    ///
    /// # Errors
    /// [`Unfinished::Interrupted`]: there is no row then.
    fn row(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Row, Unfinished>;

    /// Follows one point for one drive period from the state `begin`, whether the motion repeats or not.
    ///
    /// # Errors
    /// [`Unfinished`] if it is interrupted, the values are impossible together, `begin` is not a state, or the motion
    /// fails on the way.
    fn period(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Period, Unfinished>;

    /// Samples the motion of one point, settled or from rest.
    ///
    /// # Errors
    /// [`Unfinished`] if it is interrupted, the values are impossible together, or the motion does not get as far as
    /// requested.
    fn trajectory(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &TrajectoryRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished>;

    /// The response of one point to a chirp in place of its drive frequency.
    ///
    /// # Errors
    /// [`Unfinished`] if it is interrupted, the values are impossible together, the chirp is, or the motion fails on the
    /// way.
    fn chirp(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ChirpRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<ChirpResponse, Unfinished>;

    /// States and signals along a given motion. What the actuator would do is not a number.
    ///
    /// # Errors
    /// [`Invalid`] if the values are impossible together, or stroke and pitch do not last equally long.
    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Invalid>;

    /// The same model with samples for a waveform: `samples` over a drive period replaces `drive_shape`.
    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator>;

    /// Small undamped motions of one point; first the one that an impulse on the stroke is to excite.
    ///
    /// # Errors
    /// [`Invalid`] if the values are impossible together.
    fn modes(&self, values: &[f64]) -> Result<[Mode; 2], Invalid>;

    /// The free motion of one point after an impulse on the stroke, with the drive held still.
    ///
    /// # Errors
    /// [`Unfinished`] if it is interrupted, the values are impossible together, the request is, or the motion fails on
    /// the way.
    fn free_response(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ImpulseRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished>;
}

/// Why a motion was not followed as far as requested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unfinished {
    /// The values or the request are impossible, or the motion fails on the way.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// The caller has interrupted it.
    #[error("interrupted")]
    Interrupted,
}

/// A drive period.
#[derive(Clone, Debug, PartialEq)]
pub struct Period {
    /// The state at its end.
    pub end: Vec<f64>,
    /// Derivatives of the end, one vector for each component of the state at the beginning.
    pub responses: Vec<Vec<f64>>,
    /// Typical sizes of the state's components.
    pub scale: Vec<f64>,
    /// One value per column of the model, meaningful if the period repeats.
    pub measures: Vec<f64>,
    /// Right-hand sides evaluated.
    pub rhs_evals: u64,
}

/// A motion of the wing that is given, as one that was filmed.
#[derive(Clone, Debug, PartialEq)]
pub struct ImposedMotion {
    /// Stroke angle (rad).
    pub stroke: Samples,
    /// Pitch angle (rad), over the same time.
    pub pitch: Samples,
    /// Intervals in which forces are evaluated, one more time than that.
    pub samples: u32,
}

/// An impulse on the stroke, and how long the motion that follows is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseRequest {
    /// Rate of the stroke right after the impulse (rad/s).
    pub stroke_rate: f64,
    /// How long the motion is sampled (s).
    pub duration: f64,
    /// Intervals between samples, all of the same length; both ends are sampled.
    pub intervals: u32,
}

/// A drive whose frequency changes steadily, from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChirpRequest {
    /// Frequency at the beginning (Hz).
    pub from: f64,
    /// Frequency at which the chirp ends, after a whole number of cycles (Hz).
    pub to: f64,
    /// Rate of change of the frequency (Hz/s); negative for a falling chirp.
    pub rate: f64,
    /// Samples of the motion per cycle; none if 0.
    pub samples_per_cycle: u32,
}

/// The response to a chirp.
#[derive(Clone, Debug, PartialEq)]
pub struct ChirpResponse {
    /// One row per cycle: `begin_s`, `end_s`, `frequency_hz` (cycles per second), and the signals' measures.
    pub envelope: Trajectory,
    /// The sampled motion.
    pub motion: Trajectory,
}

/// One design point: its index in the plan and one value per parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Index in the plan.
    pub index: u64,
    /// One value per parameter of the model.
    pub values: Vec<f64>,
    /// The state at the beginning of a drive period from which the motion is followed, such as [`Row::state`] of
    /// a neighbour; at rest if `None`.
    pub begin: Option<Vec<f64>>,
}

impl Point {
    /// A point whose motion begins at rest.
    pub fn at_rest(index: u64, values: Vec<f64>) -> Point {
        Point { index, values, begin: None }
    }
}

/// Where a run takes its points from and leaves its rows.
pub trait Jobs {
    /// The next point, or `None` if there is none for now.
    ///
    /// With `idle`, nothing else is running: the call may wait, and `None` ends the run.
    fn next(&mut self, idle: bool) -> Option<Point>;

    /// Takes the row of the point with this index.
    fn done(&mut self, index: u64, row: Row);

    /// Whether to end at once. Points that have no row yet get none, and `next` is to give no more. See [`Interrupt`].
    fn interrupted(&self) -> bool {
        false
    }

    /// Told at the end how full the lanes were.
    fn occupied(&mut self, lanes: &LaneUse) {
        let _ = lanes;
    }
}

/// How full the lanes of the three ensembles were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneUse {
    /// Marching towards an orbit.
    pub marching: Occupancy,
    /// Periods with responses to changes, for Newton's iteration.
    pub varying: Occupancy,
    /// Periods that are measured.
    pub measuring: Occupancy,
}

/// How points are integrated and when they count as settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// Relative tolerance of the integrator, per step and component.
    pub rtol: f64,
    /// Absolute tolerance, in units of each state's typical size in the model.
    pub atol: f64,
    /// A point is settled when its state, strobed once per drive period, changes by less than this
    /// (in units of each state's typical size).
    pub settle_tol: f64,
    /// Drive periods after which a point counts as unsettled.
    pub max_cycles: u32,
    /// Integration steps within one drive period after which a point is given up.
    pub max_steps: u32,
    /// Largest [`Row::error_estimate`] and energy audit of a row. A point whose row exceeds it is integrated again with
    /// tighter tolerances, up to a limit.
    pub accuracy: f64,
    /// Whether Newton's iteration on the period map looks for the orbit to which a motion is on its way. Without it, points
    /// settle by marching alone: to the same orbits, in more periods.
    pub newton: bool,
}

impl SolverSettings {
    /// These settings with another relative tolerance, and what follows it by default: `atol`, a hundredth of it, and
    /// `accuracy`, a thousand times as much but at least 1e-3.
    pub fn with_rtol(self, rtol: f64) -> SolverSettings {
        SolverSettings { rtol, atol: rtol / 100.0, accuracy: (1000.0 * rtol).max(1e-3), ..self }
    }

    /// The part that the integrator sees.
    pub(super) fn tolerances(&self) -> Tolerances {
        Tolerances { rtol: self.rtol, atol: self.atol, max_steps: self.max_steps }
    }
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings {
            rtol: 1e-6,
            atol: 1e-8,
            settle_tol: 1e-6,
            max_cycles: 1000,
            max_steps: 20_000,
            accuracy: 1e-3,
            newton: true,
        }
    }
}

/// What became of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Settled on an orbit with the period of the drive.
    Periodic,
    /// On an orbit with the period of the drive that motions leave. No motion settles there: it is found where a branch of
    /// orbits is continued, and has measures.
    Unstable,
    /// Settled on an orbit of two or more drive periods.
    Subharmonic,
    /// Not settled within `max_cycles`.
    Unsettled,
    /// The state became infinite or not a number.
    Diverged,
    /// More than `max_steps` integration steps in one drive period, or steps too small to advance time.
    StepLimit,
    /// The parameters are impossible together.
    Invalid,
}

impl Status {
    /// All statuses, in the order of reports.
    pub const ALL: [Status; 7] = [
        Status::Periodic,
        Status::Unstable,
        Status::Subharmonic,
        Status::Unsettled,
        Status::Diverged,
        Status::StepLimit,
        Status::Invalid,
    ];

    /// The word in the `status` column.
    pub fn name(self) -> &'static str {
        match self {
            Status::Periodic => "periodic",
            Status::Unstable => "unstable",
            Status::Subharmonic => "subharmonic",
            Status::Unsettled => "unsettled",
            Status::Diverged => "diverged",
            Status::StepLimit => "step_limit",
            Status::Invalid => "invalid",
        }
    }
}

/// What a run found out about one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What became of the point.
    pub status: Status,
    /// One value per column of the model if the point is on an orbit of one drive period, otherwise empty.
    pub measures: Vec<f64>,
    /// Drive periods integrated, measuring included.
    pub cycles: u32,
    /// Change of the strobed state over the last orbit period, in units of each state's typical size.
    /// NaN if no period was completed.
    pub residual: f64,
    /// Drive periods per orbit: 1, or more for a subharmonic; 0 if no orbit was found.
    pub period: u32,
    /// Largest modulus of the orbit's Floquet multipliers: a change of the state grows or decays by this factor per
    /// orbit in the end. NaN without an orbit, and for a wing at rest: forces that go with the square of a speed have
    /// no linear part there.
    pub floquet_max: f64,
    /// Estimate of the largest relative error that the integration makes in stroke, pitch, lift and power: see
    /// `docs/numerics.md`. Infinite if it cannot be estimated, NaN without measures.
    pub error_estimate: f64,
    /// The state at the end of the last drive period, on the orbit if there is one. Empty if no period was completed.
    pub state: Vec<f64>,
    /// Right-hand sides evaluated by the integrator.
    pub rhs_evals: u64,
    /// Why the parameters are invalid.
    pub reason: Option<String>,
}

impl Row {
    /// Whether motions near the orbit approach it. `None` without an orbit.
    pub fn stable(&self) -> Option<bool> {
        match (self.period, self.floquet_max.is_nan()) {
            (0, _) => None,
            // At rest: without drive every motion dies away.
            (_, true) => Some(true),
            (_, false) => Some(self.floquet_max < 1.0),
        }
    }
}

/// One measured column.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name with its unit, such as `lift_mean_mn`.
    pub name: String,
    /// Unit in words as printed by `flap params`, such as `mN`.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: String,
}

/// Which part of a motion to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryRequest {
    /// Drive periods to sample.
    pub cycles: u32,
    /// Samples per drive period; the end of the last period is sampled too.
    pub samples_per_cycle: u32,
    /// Start on the settled orbit rather than at rest.
    pub settled: bool,
}

/// A sampled motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Column names with units; the first is `time_s`.
    pub columns: Vec<String>,
    /// One row per sample, one value per column.
    pub rows: Vec<Vec<f64>>,
}
