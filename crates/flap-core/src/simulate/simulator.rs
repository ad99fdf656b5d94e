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
    /// Returns the columns of the measures, in the order of [`Row::measures`].
    fn columns(&self) -> &[Column];

    /// Computes the rows of all points from `jobs` on the SIMD lanes of `backend`.
    ///
    /// [`Jobs::done`] receives the rows in the order in which their computations end. A row depends only on
    /// its point and on `solver`. Other points and the order of the points have no effect on a row. Two
    /// backends compute the same row if they have the same [`Arithmetic`](crate::num::Arithmetic).
    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs);

    /// Computes the row of one point with scalars, from rest or from the state `begin` (see
    /// [`Point::begin`]).
    ///
    /// The row has the same bits as the row from [`Rows::run`]. If the computation is interrupted, the row is
    /// meaningless.
    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row;
}

/// Computes the rows of `points` on the SIMD lanes of `backend`. The rows are in the order of `points`, and
/// [`Point::index`] has no effect.
///
/// # Errors
/// [`Unfinished::Interrupted`] if `interrupted` returns true, or if `rows` computes no row for a point.
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

/// A list of points, and the list of their rows in the same order.
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

/// A model that computes rows from design points, and describes its parameters and presets.
pub trait Simulator: Rows {
    /// Returns the name, the parameters and the properties of the model.
    fn description(&self) -> Description<'_>;

    /// Returns the name of the model in grid files, such as `direct-drive`.
    fn name(&self) -> &'static str {
        self.description().name
    }

    /// Returns the description of the model in one line: the robot and the paper.
    fn doc(&self) -> &'static str {
        self.description().doc
    }

    /// Returns the parameter table. The values of a point are one `f64` for each entry of this table, see
    /// [`Parameter`].
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
    /// An error if the model computes only rows.
    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        Err(Unfinished::no_motions(self.name()))
    }

    /// Returns the trait object for motions of single points.
    ///
    /// # Errors
    /// An error if the model computes only rows.
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

/// Derivatives of the measures of a row with respect to changes of the parameter values.
pub trait Gradients: Sync {
    /// Returns the names of the states with their units, in the order of [`Row::state`].
    fn states(&self) -> Vec<String>;

    /// Returns the derivatives of the measures in the direction of each change in `changes`, for the orbit
    /// that begins at `state`.
    ///
    /// `state` is for example [`Row::state`] of a periodic row. For each change, flap integrates three
    /// periods. In addition, flap integrates N + 3 periods, where N is the number of states. Each integrated
    /// period has about 1.6 times as many steps as a period at the solver's tolerances.
    ///
    /// # Errors
    /// See [`Motions`].
    fn gradient(&self, run: &PointRun<'_>, state: &[f64], changes: &[Change])
    -> Result<Gradient, Unfinished>;
}

/// Motions of single points with the drive that the parameters of the point describe. The columns of a
/// trajectory are `time_s`, the states, and signals.
///
/// Motions are computed with scalars, not in SIMD lanes. Each method returns these errors:
///
/// - [`Unfinished::Interrupted`] if the run is interrupted
/// - [`Unfinished::Invalid`] if the combination of values or the request is impossible, or if the motion fails
pub trait Motions: Gradients {
    /// Returns the names of the columns of a trajectory: time, states, and signals.
    fn trajectory_columns(&self) -> Vec<String>;

    /// Returns the description of each column of a trajectory in one line, in the order of the columns.
    fn meanings(&self) -> Vec<String>;

    /// Integrates the motion of one point over one drive period, from the state `begin`. The state at the end
    /// of the period may differ from `begin`.
    ///
    /// # Errors
    /// See [`Motions`].
    fn period(&self, run: &PointRun<'_>, begin: &[f64]) -> Result<Period, Unfinished>;

    /// Returns samples of the motion of one point: of the settled motion, or of the motion that begins at
    /// rest.
    ///
    /// # Errors
    /// See [`Motions`]. Also an error if a settled motion is requested, and the motion does not settle on an orbit of one
    /// drive period.
    fn trajectory(&self, run: &PointRun<'_>, request: &TrajectoryRequest) -> Result<Trajectory, Unfinished> {
        self.trajectory_from(run, None, request)
    }

    /// Returns samples of the motion of one point. The motion begins at the start of a drive period, in the
    /// state `begin` or at rest.
    ///
    /// If a settled motion is requested, the samples are samples of the settled motion that the motion from
    /// `begin` approaches.
    ///
    /// # Errors
    /// See [`Motions::trajectory`]. Also an error if `begin` is not one finite number for each state.
    fn trajectory_from(
        &self,
        run: &PointRun<'_>,
        begin: Option<&[f64]>,
        request: &TrajectoryRequest,
    ) -> Result<Trajectory, Unfinished>;

    /// Returns the equations of a wing with the given parameter values, for any motion of the wing's
    /// shoulder.
    ///
    /// One or more of the velocities and rates of the body in `values` must be nonzero, to select the
    /// equations with body motion. The sizes of the velocities and rates of the body have no effect.
    ///
    /// # Errors
    /// An error if the combination of values is impossible.
    fn moving_wing(&self, values: &[f64]) -> Result<Box<dyn MovingWing>, Invalid>;
}

/// Experiments on single points: the drive or the motion of the experiment replaces the drive of the point.
///
/// For the errors see [`Motions`].
pub trait Experiments: Sync {
    /// Returns the response of one point to a chirp. The frequency of the chirp replaces the drive frequency
    /// of the point.
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
    /// An error if the combination of values is impossible, if stroke and pitch have different durations, or if
    /// the run is interrupted.
    fn imposed(&self, run: &PointRun<'_>, motion: &ImposedMotion) -> Result<Trajectory, Unfinished>;

    /// Returns the natural modes of one point, which are small motions without damping. The first mode is the
    /// motion that an impulse on the stroke excites.
    ///
    /// # Errors
    /// An error if the combination of values is impossible.
    fn modes(&self, values: &[f64]) -> Result<Vec<Mode>, Invalid>;

    /// Returns the signals whose frequencies describe a free motion. The first signal is the signal that an
    /// impulse on the stroke excites.
    fn free_signals(&self) -> &'static [Signal];

    /// Returns a copy of the model whose waveform is given by samples. The `samples` over one drive period
    /// replace the parameter `drive_shape`.
    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator>;
}
