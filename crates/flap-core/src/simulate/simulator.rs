//! The object-safe traits of a model: [`Simulator`] for rows and their descriptions, [`Gradients`] for derivatives of
//! rows, [`Motions`] and [`Experiments`] for single motions.

use core::iter::Enumerate;
use std::vec::IntoIter;

use super::gradient::{Change, Gradient};
use super::jobs::{Jobs, Point};
use super::moving_wing::MovingWing;
use super::request::{
    ChirpRequest, ChirpResponse, ImposedMotion, ImpulseRequest, Period, Trajectory, TrajectoryRequest,
    Unfinished,
};
use super::row::{Column, Row};
use super::settings::SolverSettings;
use super::single::PointRun;
use crate::drive::Samples;
use crate::model::{Description, Signal};
use crate::modes::Mode;
use crate::num::Backend;
use crate::ode::Interrupt;
use crate::parameter::{Invalid, Parameter, Preset};

/// Source of rows: it computes one row per design point.
pub trait Rows: Sync {
    /// Returns the measured columns of each row, in order.
    fn columns(&self) -> &[Column];

    /// Runs the points of `jobs` on the SIMD lanes of `backend` until none are left.
    ///
    /// Rows are returned in the order in which points finish. A row depends on its point and `solver` alone. It does
    /// not depend on other points, their order, or the `backend` within an arithmetic class.
    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs);

    /// Runs one point on scalars, from rest or from the state `begin` (see [`Point::begin`]).
    ///
    /// The result has the same bits as [`Rows::run`]. If the run is interrupted, the row is meaningless.
    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row;
}

/// Runs `points` on the lanes of `backend`. Returns their rows in the order of the points; point indices are ignored.
///
/// # Errors
/// [`Unfinished::Interrupted`] if `interrupted` returns true, or if `rows` leaves a point without a row.
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

/// A list of points, and rows by the position of their point.
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

/// A model that computes rows from design points, with the information that sweeps need.
pub trait Simulator: Rows {
    /// Returns name, parameters and properties.
    fn description(&self) -> Description<'_>;

    /// Returns the name in grid files, such as `direct-drive`.
    fn name(&self) -> &'static str {
        self.description().name
    }

    /// Returns the description in one line: the robot and the paper.
    fn doc(&self) -> &'static str {
        self.description().doc
    }

    /// Returns the parameter table. A point is one `f64` per entry, see [`Parameter`].
    fn parameters(&self) -> &[Parameter<'_>] {
        self.description().parameters
    }

    /// Returns the published parameter sets.
    fn presets(&self) -> &'static [Preset] {
        self.description().presets
    }

    /// Returns the trait object for derivatives of rows.
    ///
    /// # Errors
    /// An error if the model computes rows alone.
    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        Err(Unfinished::no_motions(self.name()))
    }

    /// Returns the trait object for motions of single points.
    ///
    /// # Errors
    /// An error if the model computes rows alone.
    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        Err(Unfinished::no_motions(self.name()))
    }

    /// Returns the trait object for experiments on single points.
    ///
    /// # Errors
    /// An error if the model does not support experiments.
    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        Err(Unfinished::no_experiments(self.name()))
    }
}

/// Derivatives of rows along changes of a point.
pub trait Gradients: Sync {
    /// Returns the names of the states with their units, in the order of a state.
    fn states(&self) -> Vec<String>;

    /// Returns the derivatives of the measures along each of `changes`, for the orbit that begins at `state`.
    ///
    /// `state` is for example [`Row::state`] of a periodic row. The cost is one period of the states and two measured
    /// periods for each change, and about six more periods. Each has 1.6 times the steps of a period at the solver's
    /// tolerances.
    ///
    /// # Errors
    /// See [`Motions`].
    fn gradient(&self, run: &PointRun<'_>, state: &[f64], changes: &[Change])
    -> Result<Gradient, Unfinished>;
}

/// Motions of single points with their own drive. The columns of a trajectory are `time_s`, the states, and signals.
///
/// Motions are computed on scalars. Each method returns these errors:
///
/// - [`Unfinished::Interrupted`] if the run is interrupted
/// - [`Unfinished::Invalid`] if the combination of values or the request is impossible, or if the motion fails
pub trait Motions: Gradients {
    /// Returns the names of the columns of a trajectory: time, states, and signals.
    fn trajectory_columns(&self) -> Vec<String>;

    /// Returns the description of each column of a trajectory in one line, in the order of the columns.
    fn meanings(&self) -> Vec<String>;

    /// Follows one point for one drive period from the state `begin`. The motion need not repeat.
    ///
    /// # Errors
    /// See [`Motions`].
    fn period(&self, run: &PointRun<'_>, begin: &[f64]) -> Result<Period, Unfinished>;

    /// Returns samples of the motion of one point, settled or from rest.
    ///
    /// # Errors
    /// See [`Motions`]. Also an error if a settled motion is requested, and the motion does not settle on an orbit of one
    /// drive period.
    fn trajectory(&self, run: &PointRun<'_>, request: &TrajectoryRequest) -> Result<Trajectory, Unfinished> {
        self.trajectory_from(run, None, request)
    }

    /// Returns samples of the motion of one point that begins in the state `begin` at the start of a drive period, or
    /// at rest.
    ///
    /// If a settled motion is requested, it is the motion that this one approaches.
    ///
    /// # Errors
    /// See [`Motions::trajectory`]. Also an error if `begin` is not one finite number for each state.
    fn trajectory_from(
        &self,
        run: &PointRun<'_>,
        begin: Option<&[f64]>,
        request: &TrajectoryRequest,
    ) -> Result<Trajectory, Unfinished>;

    /// Returns the equations of a wing with these values, for any motion of its shoulder.
    ///
    /// Velocity and rates of the body in `values` must not all be zero: they select the equations. Their size has no
    /// effect.
    ///
    /// # Errors
    /// An error if the combination of values is impossible.
    fn moving_wing(&self, values: &[f64]) -> Result<Box<dyn MovingWing>, Invalid>;
}

/// Experiments on single points: another drive or motion replaces the point's own.
///
/// For the errors see [`Motions`].
pub trait Experiments: Sync {
    /// Returns the response of one point to a chirp, which replaces its drive frequency.
    ///
    /// # Errors
    /// See [`Motions`].
    fn chirp(&self, run: &PointRun<'_>, request: &ChirpRequest) -> Result<ChirpResponse, Unfinished>;

    /// Returns the free motion of one point after an impulse on the stroke, at a constant drive voltage.
    ///
    /// # Errors
    /// See [`Motions`].
    fn free_response(&self, run: &PointRun<'_>, request: &ImpulseRequest) -> Result<Trajectory, Unfinished>;

    /// Returns states and signals along an imposed motion. Signals of the actuator are NaN.
    ///
    /// # Errors
    /// An error if the combination of values is impossible, or if stroke and pitch have different durations.
    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Invalid>;

    /// Returns the small undamped motions of one point. The first one is the motion that an impulse on the stroke
    /// excites.
    ///
    /// # Errors
    /// An error if the combination of values is impossible.
    fn modes(&self, values: &[f64]) -> Result<Vec<Mode>, Invalid>;

    /// Returns the signals whose frequencies describe a free motion. The first one is the signal that an impulse
    /// excites.
    fn free_signals(&self) -> &'static [Signal];

    /// Returns the same model with samples as its waveform. `samples` over a drive period replace `drive_shape`.
    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator>;
}
