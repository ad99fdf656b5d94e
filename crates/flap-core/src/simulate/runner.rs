//! Implementation of the object-safe traits [`Simulator`], [`Gradients`], [`Motions`] and [`Experiments`] for a
//! model.

use std::sync::OnceLock;

use super::gradient::{self, Change, Gradient};
use super::jobs::Jobs;
use super::lanes::LanesKernel;
use super::moving_wing::{MovingWing, moving_wing};
use super::request::{Period, Trajectory, TrajectoryRequest, Unfinished};
use super::row::{Column, Row, columns};
use super::sampler;
use super::settings::SolverSettings;
use super::simulator::{Experiments, Gradients, Motions, Rows, Simulator};
use super::single::{self, PointRun, on_scalars};
use crate::model::{self, Description, Model, Signal, SignalSet};
use crate::num::Backend;
use crate::parameter::Invalid;

/// Makes an object-safe [`Simulator`] of a model, so that sweeps can use a user-defined model.
///
/// The model has N states. At least one signal has a [principal measure](crate::model::Principal), which determines
/// the error estimate of a row.
///
/// Example: an oscillator driven at its resonance.
///
/// ```
/// use flap_core::drive::{DriveConstants, WaveformParameters};
/// use flap_core::model::{Derived, Description, Instant, Model, Unit};
/// use flap_core::num::{Backend, Real};
/// use flap_core::ode::{Ode, Start};
/// use flap_core::parameter::Kind::Number;
/// use flap_core::parameter::Range::Positive;
/// use flap_core::parameter::{Invalid, Preset};
/// use flap_core::simulate::{PointRun, Rows, Runner, Simulator, SolverSettings, Status};
///
/// flap_core::parameters! {
///     /// Parameters of an oscillator.
///     pub struct Params {
///         /// Torque per inertia.
///         drive_strength: f64 = ("rad/s^2", "", Number(Positive)),
///         /// Drive frequency.
///         drive_frequency: f64 = ("Hz", "f", Number(Positive)),
///         /// Natural frequency.
///         natural_frequency: f64 = ("Hz", "", Number(Positive)),
///         /// Decay rate of free oscillations.
///         decay: f64 = ("1/s", "", Number(Positive)),
///     }
/// }
///
/// flap_core::per_lane! {
///     /// Constants of a point.
///     pub struct Constants<R> {
///         /// The torque per inertia.
///         pub drive: DriveConstants<R>,
///         /// Stiffness per inertia (1/s²).
///         pub stiffness: R,
///         /// Damping per inertia (1/s).
///         pub damping: R,
///     }
/// }
///
/// flap_core::signals! {
///     /// Signals of an oscillator.
///     pub struct Signals {
///         stroke: (Unit::DEG, "stroke angle", [Amplitude, Mean]) principal First,
///     }
/// }
///
/// #[derive(Clone, PartialEq)]
/// struct Oscillator;
///
/// impl Ode<2> for Oscillator {
///     type Constants<R: Real> = Constants<R>;
///     type Input<R: Real> = R;
///
///     #[inline(always)]
///     fn input<R: Real>(&self, c: &Constants<R>, t: R) -> R {
///         c.drive.amplitude * c.drive.phase(t).sin()
///     }
///
///     #[inline(always)]
///     fn rhs<R: Real>(&self, c: &Constants<R>, torque: &R, _side: R, y: &[R; 2]) -> [R; 2] {
///         [y[1], *torque - c.stiffness * y[0] - c.damping * y[1]]
///     }
/// }
///
/// impl Model<2> for Oscillator {
///     type Signals = Signals;
///
///     const DESCRIPTION: Description<'static> = Description::new(
///         "oscillator",
///         "a wing on a spring",
///         Params::TABLE,
///         &[Preset { name: "example", doc: "", values: || EXAMPLE.to_values() }],
///     );
///     const STATES: [&'static str; 2] = ["stroke_rad", "stroke_rate_rad_s"];
///     const DERIVED: &'static [Derived<Self, Constants<f64>, Signals>] = &[];
///
///     fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 2>, Invalid> {
///         let params = Params::from_values(values);
///         let strength = [0.0, params.drive_strength];
///         let drive = DriveConstants::new(params.drive_frequency, &WaveformParameters::SINE, strength);
///         let natural = std::f64::consts::TAU * params.natural_frequency;
///         let constants = Constants { drive, stiffness: natural * natural, damping: 2.0 * params.decay };
///         Ok(Start::new(constants, [0.0; 2], drive.period(), [0.1, 0.1 * drive.rate]))
///     }
///
///     fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
///         &c.drive
///     }
///
///     #[inline(always)]
///     fn signals<R: Real>(&self, _c: &Constants<R>, at: Instant<'_, R, R, 2>) -> Signals<R> {
///         Signals { stroke: at.y[0] }
///     }
/// }
///
/// const EXAMPLE: Params = Params {
///     drive_strength: 1e3,
///     drive_frequency: 100.0,
///     natural_frequency: 100.0,
///     decay: 20.0,
/// };
///
/// static OSCILLATOR: Runner<Oscillator, 2> = Runner::new(Oscillator);
///
/// let model: &'static dyn Simulator = &OSCILLATOR;
/// let values = EXAMPLE.to_values();
/// let run = PointRun::new(Backend::best(), &SolverSettings::DEFAULT, &values);
/// let row = model.run_point(&run, None);
/// assert_eq!(row.status, Status::Periodic);
/// // At resonance the amplitude is the torque over damping times angular frequency.
/// let exact = (1e3 / (40.0 * std::f64::consts::TAU * 100.0_f64)).to_degrees();
/// let error = (row.measures[0] / exact - 1.0).abs();
/// assert!(error < row.error_estimate && row.error_estimate < 2e-4, "{error}, {}", row.error_estimate);
/// assert!(row.measures[1].abs() < 1e-4 * exact);
/// // A free oscillation decays by this factor per drive period.
/// assert!((row.floquet_max - (-0.2_f64).exp()).abs() < 1e-4);
/// ```
pub struct Runner<M, const N: usize> {
    pub(super) model: M,
    columns: OnceLock<Vec<Column>>,
    experiments: fn(&Self) -> Option<&dyn Experiments>,
}

impl<M: model::ExperimentModel<N>, const N: usize> Runner<M, N> {
    /// Returns a simulator that also supports experiments. As for [`Runner::new`], a signal of the model must
    /// have a principal measure, otherwise the code does not compile.
    pub const fn with_experiments(model: M) -> Self {
        const { Self::CHECKED }
        Runner { model, columns: OnceLock::new(), experiments: |runner| Some(runner) }
    }
}

impl<M: Model<N>, const N: usize> Runner<M, N> {
    /// A check at compile time: the code compiles only if a signal of the model has a principal measure.
    const CHECKED: () = {
        assert!(
            has_principal(M::Signals::TABLE),
            "no signal has a principal measure: mark one in signals!, such as the stroke with `principal First`"
        );
    };

    /// Returns a simulator for rows and motions. The code compiles only if a signal of the model has a
    /// [principal measure](crate::model::Principal).
    pub const fn new(model: M) -> Self {
        const { Self::CHECKED }
        Runner { model, columns: OnceLock::new(), experiments: |_| None }
    }
}

/// Returns true if one of the signals has a principal measure.
const fn has_principal(signals: &[Signal]) -> bool {
    let mut i = 0;
    while i < signals.len() {
        if signals[i].principal.is_some() {
            return true;
        }
        i += 1;
    }
    false
}

impl<M: Model<N>, const N: usize> Rows for Runner<M, N> {
    fn columns(&self) -> &[Column] {
        self.columns.get_or_init(columns::<M, N>)
    }

    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        backend.dispatch(LanesKernel::<M, N> { model: &self.model, solver, jobs });
    }

    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row {
        on_scalars!(run, R => single::row::<M, R, N>(&self.model, run, begin))
    }
}

impl<M: Model<N>, const N: usize> Simulator for Runner<M, N> {
    fn description(&self) -> Description<'_> {
        M::DESCRIPTION
    }

    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        Ok(self)
    }

    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        Ok(self)
    }

    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        (self.experiments)(self).ok_or_else(|| Unfinished::no_experiments(self.name()))
    }
}

impl<M: Model<N>, const N: usize> Gradients for Runner<M, N> {
    fn states(&self) -> Vec<String> {
        M::STATES.map(str::to_owned).to_vec()
    }

    fn gradient(
        &self,
        run: &PointRun<'_>,
        state: &[f64],
        changes: &[Change],
    ) -> Result<Gradient, Unfinished> {
        on_scalars!(run, R => gradient::gradient::<M, R, N>(&self.model, run, state, changes))
    }
}

impl<M: Model<N>, const N: usize> Motions for Runner<M, N> {
    fn period(&self, run: &PointRun<'_>, begin: &[f64]) -> Result<Period, Unfinished> {
        on_scalars!(run, R => single::period::<M, R, N>(&self.model, run, begin))
    }

    fn trajectory_columns(&self) -> Vec<String> {
        sampler::columns::<M, N>()
    }

    fn meanings(&self) -> Vec<String> {
        sampler::meanings::<M, N>()
    }

    fn trajectory_from(
        &self,
        run: &PointRun<'_>,
        begin: Option<&[f64]>,
        request: &TrajectoryRequest,
    ) -> Result<Trajectory, Unfinished> {
        on_scalars!(run, R => single::trajectory::<M, R, N>(&self.model, run, begin, request))
    }

    fn moving_wing(&self, values: &[f64]) -> Result<Box<dyn MovingWing>, Invalid> {
        moving_wing(&self.model, values)
    }
}
