//! The object-safe faces of a model: [`Simulator`] for sweeps, with rows and their description; [`Gradients`] for
//! their derivatives; [`Motions`] and [`Experiments`] for single motions.

use core::iter::Enumerate;
use std::vec::IntoIter;

use super::gradient::{Change, Gradient};
use super::jobs::{Jobs, Point};
use super::request::{
    ChirpRequest, ChirpResponse, ImposedMotion, ImpulseRequest, Period, Trajectory, TrajectoryRequest,
    Unfinished,
};
use super::row::{Column, Row};
use super::settings::SolverSettings;
use super::single::PointRun;
use crate::aero::Wing;
use crate::drive::Samples;
use crate::model::Signal;
use crate::modes::Mode;
use crate::num::Backend;
use crate::ode::Interrupt;
use crate::parameter::{Parameter, Preset};

/// A source of rows: turns design points into rows.
pub trait Rows: Sync {
    /// The measured columns of each row, in order.
    fn columns(&self) -> &[Column];

    /// Runs the points of `jobs` on the SIMD lanes of `backend` until there are none left.
    ///
    /// Rows are handed back in the order in which points finish. A row depends on its point and `solver`
    /// alone: not on its neighbours, nor on the order of the points, nor on `backend` within an arithmetic class.
    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs);

    /// Runs one point on scalars, from rest or from the state `begin` (see [`Point::begin`]). Gives the
    /// same bits as [`Rows::run`]. Interrupted, the row means nothing.
    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row;
}

/// Runs `points` on the lanes of `backend`. Returns their rows in the order of the points, whose indices do not matter.
///
/// # Errors
/// [`Unfinished::Interrupted`] if `interrupted` says so, or if `rows` leaves a point without a row.
pub fn run_list(
    rows: &dyn Rows,
    backend: Backend,
    solver: &SolverSettings,
    points: Vec<Point>,
    interrupted: Interrupt<'_>,
) -> Result<Vec<Row>, Unfinished> {
    let mut list =
        List { rows: vec![None; points.len()], points: points.into_iter().enumerate(), interrupted };
    rows.run(backend, solver, &mut list);
    let rows = if interrupted() { None } else { list.rows.into_iter().collect() };
    rows.ok_or(Unfinished::Interrupted)
}

/// Points in order, and rows by the position of their point.
struct List<'a> {
    points: Enumerate<IntoIter<Point>>,
    rows: Vec<Option<Row>>,
    interrupted: Interrupt<'a>,
}

impl Jobs for List<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let (position, point) = self.points.next()?;
        Some(Point { index: position as u64, ..point })
    }

    fn done(&mut self, index: u64, row: Row) {
        if let Some(place) = usize::try_from(index).ok().and_then(|index| self.rows.get_mut(index)) {
            *place = Some(row);
        }
    }

    fn interrupted(&self) -> bool {
        (self.interrupted)()
    }
}

/// A model that turns design points into rows, with all that sweeps need to know of it.
pub trait Simulator: Rows {
    /// Name in grid files, such as `direct-drive`.
    fn name(&self) -> &'static str;

    /// One line: the robot that it models, and the paper.
    fn doc(&self) -> &'static str;

    /// The parameter table. A point is one `f64` per entry, see [`Parameter`].
    fn parameters(&self) -> &[Parameter<'_>];

    /// Published parameter sets.
    fn presets(&self) -> &'static [Preset];

    /// 1 if the trailing edge lags a wing that moves to positive stroke at a positive pitch, -1 if it leads.
    fn pitch_sign(&self) -> i8 {
        1
    }

    /// The parameters that a wing of one's own decides, by name, in SI units; none if the model has no such wing.
    fn wing(&self, wing: &Wing) -> Vec<(&'static str, f64)> {
        let _ = wing;
        Vec::new()
    }

    /// True if rows have the load of the air on the wing if [`SolverSettings::loads`] asks for it.
    fn has_loads(&self) -> bool {
        false
    }

    /// The row of a point from rest, see [`Rows::run_point`].
    ///
    /// # Errors
    /// [`Unfinished::Interrupted`]: there is no row then.
    fn row(&self, run: &PointRun<'_>) -> Result<Row, Unfinished> {
        let row = self.run_point(run, None);
        if (run.interrupted)() { Err(Unfinished::Interrupted) } else { Ok(row) }
    }

    /// The face for derivatives of rows.
    ///
    /// # Errors
    /// [`Unfinished::NoMotions`] if the model computes rows alone.
    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        Err(Unfinished::NoMotions { model: self.name() })
    }

    /// The face for motions of single points.
    ///
    /// # Errors
    /// [`Unfinished::NoMotions`] if the model computes rows alone.
    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        Err(Unfinished::NoMotions { model: self.name() })
    }

    /// The face for experiments on single points.
    ///
    /// # Errors
    /// [`Unfinished::NoExperiments`] if the model knows none.
    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        Err(Unfinished::NoExperiments { model: self.name() })
    }
}

/// Derivatives of rows, along changes of a point.
pub trait Gradients: Sync {
    /// Names of the states with their units, in the order of a state.
    fn states(&self) -> Vec<String>;

    /// Derivatives of the measures of the orbit that begins at `state`, such as [`Row::state`] of a periodic row, along each
    /// of `changes`. Takes a period of the states for each change, two measured ones, and some six more in all, each with 1.6
    /// times the steps of a period at the solver's tolerances.
    ///
    /// # Errors
    /// As [`Motions`] says.
    fn gradient(&self, run: &PointRun<'_>, state: &[f64], changes: &[Change])
    -> Result<Gradient, Unfinished>;
}

/// Motions of single points under their own drive. The columns of a trajectory are `time_s`, the states, and signals.
///
/// Motions are computed on scalars. Each method fails with [`Unfinished::Interrupted`] if the run is interrupted, with [`Unfinished::Invalid`] if the values are impossible
/// together, with [`Unfinished::Request`] if the request is impossible, and with [`Unfinished::Diverged`] or
/// [`Unfinished::StepLimit`] if the motion fails on the way.
pub trait Motions: Gradients {
    /// The names of the columns of a trajectory: time, states, and what else is seen over time.
    fn trajectory_columns(&self) -> Vec<String>;

    /// The meaning of each column of a trajectory in one line, in the order of the columns.
    fn meanings(&self) -> Vec<String>;

    /// Follows one point for one drive period from the state `begin`, whether the motion repeats or not.
    ///
    /// # Errors
    /// As [`Motions`] says.
    fn period(&self, run: &PointRun<'_>, begin: &[f64]) -> Result<Period, Unfinished>;

    /// Samples the motion of one point, settled or from rest.
    ///
    /// # Errors
    /// As [`Motions`] says; [`Unfinished::NotPeriodic`] if a settled motion is asked for and there is none of one drive
    /// period.
    fn trajectory(&self, run: &PointRun<'_>, request: &TrajectoryRequest) -> Result<Trajectory, Unfinished> {
        self.trajectory_from(run, None, request)
    }

    /// Samples the motion of one point that begins in the state `begin` at the start of a drive period, or at rest. A settled
    /// motion is the one that it approaches from there.
    ///
    /// # Errors
    /// As [`Motions::trajectory`]; [`Unfinished::Request`] if `begin` is not one finite number for each state.
    fn trajectory_from(
        &self,
        run: &PointRun<'_>,
        begin: Option<&[f64]>,
        request: &TrajectoryRequest,
    ) -> Result<Trajectory, Unfinished>;
}

/// Experiments on single points, with another drive or motion in place of the point's own.
///
/// Methods fail as those of [`Motions`] do.
pub trait Experiments: Sync {
    /// The response of one point to a chirp in place of its drive frequency.
    ///
    /// # Errors
    /// As [`Motions`] says.
    fn chirp(&self, run: &PointRun<'_>, request: &ChirpRequest) -> Result<ChirpResponse, Unfinished>;

    /// The free motion of one point after an impulse on the stroke, with the drive held still.
    ///
    /// # Errors
    /// As [`Motions`] says.
    fn free_response(&self, run: &PointRun<'_>, request: &ImpulseRequest) -> Result<Trajectory, Unfinished>;

    /// States and signals along a given motion. Signals of the actuator are not numbers.
    ///
    /// # Errors
    /// [`Unfinished::Invalid`] if the values are impossible together, [`Unfinished::Request`] if stroke and pitch do not
    /// last equally long.
    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Unfinished>;

    /// Small undamped motions of one point; first the one that an impulse on the stroke is to excite.
    ///
    /// # Errors
    /// [`Unfinished::Invalid`] if the values are impossible together.
    fn modes(&self, values: &[f64]) -> Result<Vec<Mode>, Unfinished>;

    /// The signals whose frequencies describe a free motion; first the one that an impulse excites.
    fn free_signals(&self) -> &'static [Signal];

    /// The same model with samples for a waveform: `samples` over a drive period replaces `drive_shape`.
    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator>;
}
