//! Rows of a model outside of flap: a driven oscillator, whose orbit and multipliers are known exactly.

use std::f64::consts::TAU;

use flap_core::drive::{DriveConstants, WaveformParameters};
use flap_core::model::{Derived, Description, Instant, Model, SignalSet, Symmetry, Totals, Unit};
use flap_core::num::{Backend, Real};
use flap_core::ode::{Ode, Start};
use flap_core::parameter::Invalid;
use flap_core::parameter::Kind::Number;
use flap_core::parameter::Range::{NonNegative, Positive};
use flap_core::simulate::{PointRun, Row, Rows, Runner, SolverSettings, Status};

use crate::data::assert_close;
use crate::rows;

flap_core::parameters! {
    /// Parameters of an oscillator.
    pub struct Params {
        /// Torque per inertia.
        drive_strength: f64 = ("rad/s^2", "", Number(NonNegative)),
        /// Constant torque per inertia.
        load: f64 = ("rad/s^2", "", Number(NonNegative)),
        /// Decay rate of free oscillations.
        decay: f64 = ("1/s", "", Number(Positive)),
    }
}

flap_core::per_lane! {
    /// Constants of a point.
    pub struct Constants<R> {
        /// The torque per inertia.
        pub drive: DriveConstants<R>,
        /// Constant torque per inertia (rad/s²).
        pub load: R,
        /// Stiffness per inertia (1/s²).
        pub stiffness: R,
        /// Damping per inertia (1/s).
        pub damping: R,
    }
}

flap_core::signals! {
    /// Signals of an oscillator. Without a load the mean of the stroke is zero by symmetry.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude]) principal First,
        torque: (Unit::DEG, "torque of the spring", [Mean]) principal Mean,
    }
}

/// Drive frequency and natural frequency (Hz).
const FREQUENCY: f64 = 100.0;

/// Angular frequency of the drive (rad/s).
pub(crate) const OMEGA: f64 = TAU * FREQUENCY;

#[derive(Clone, PartialEq)]
pub(crate) struct Oscillator;

impl Ode<2> for Oscillator {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = R;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        c.drive.amplitude * c.drive.phase(t).sin()
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, torque: &R, _side: R, y: &[R; 2]) -> [R; 2] {
        [y[1], *torque + c.load - c.stiffness * y[0] - c.damping * y[1]]
    }
}

impl Model<2> for Oscillator {
    type Signals = Signals;

    const DESCRIPTION: Description<'static> =
        Description::new("oscillator", "a wing on a spring", Params::TABLE, &[]);
    const STATES: [&'static str; 2] = ["stroke_rad", "stroke_rate_rad_s"];
    const DERIVED: &'static [Derived<Self, Constants<f64>, Signals>] = &[
        Derived::new("twice_load_per_load", "", "two, and a ratio of zeros without a load", |_, c, _| {
            2.0 * c.load / c.load
        }),
        Derived::new("stiffness_per_load", "", "infinite without a load", |_, c, _| c.stiffness / c.load),
    ];

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 2>, Invalid> {
        let Params { drive_strength, load, decay } = Params::from_values(values);
        let drive = DriveConstants::new(FREQUENCY, &WaveformParameters::SINE, [0.0, drive_strength]);
        let constants = Constants { drive, load, stiffness: OMEGA * OMEGA, damping: 2.0 * decay };
        Ok(Start::new(constants, [0.0; 2], drive.period(), [0.1, 0.1 * OMEGA]))
    }

    /// Returns a symmetry that a load breaks. The search must detect the missing symmetry.
    fn symmetry(&self, _c: &Constants<f64>) -> Option<Symmetry<Signals, 2>> {
        let second_half = |first: &Signals<Totals<f64>>| Signals::map(first, |_, totals| totals.negated());
        Some(Symmetry { centre: [0.0; 2], second_half: Some(second_half) })
    }

    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, _c: &Constants<R>, at: Instant<'_, R, R, 2>) -> Signals<R> {
        Signals { stroke: at.y[0], torque: at.y[0] }
    }
}

static OSCILLATOR: Runner<Oscillator, 2> = Runner::new(Oscillator);

fn row(params: &Params, solver: &SolverSettings) -> Row {
    let row = OSCILLATOR.run_point(&PointRun::new(Backend::best(), solver, &params.to_values()), None);
    assert_eq!(row.status, Status::Periodic, "{row:?}");
    row
}

const DRIVEN: Params = Params { drive_strength: 1e3, load: 5e3, decay: 20.0 };

#[test]
fn rows_of_an_oscillator_are_exact() {
    let Params { drive_strength, load, decay } = DRIVEN;
    let row = row(&DRIVEN, &SolverSettings::DEFAULT);
    let amplitude = (drive_strength / (2.0 * decay * OMEGA)).to_degrees();
    let mean = (load / (OMEGA * OMEGA)).to_degrees();
    assert_close(row.measures[0], amplitude, 1e-4, "amplitude");
    assert_close(row.measures[1], mean, 1e-4, "mean");
    assert_close(row.measures[2], 2.0, 1e-15, "twice_load_per_load");
    assert_close(row.measures[3], OMEGA * OMEGA / load, 1e-15, "stiffness_per_load");
    assert_close(row.floquet_max, (-decay / FREQUENCY).exp(), 1e-4, "floquet_max");
    assert!(row.error_estimate < 1e-4, "{}", row.error_estimate);
    assert_eq!(row.stable(), Some(true));
}

/// The mean of the spring's torque is zero, so a finer integration does not reduce its relative error.
#[test]
fn a_measure_that_is_zero_by_symmetry_costs_nothing() {
    for rtol in [1e-5, 1e-6, 1e-8] {
        let solver = SolverSettings { settle_tol: rtol, ..SolverSettings::DEFAULT }.with_rtol(rtol);
        let [symmetric, loaded] = [0.0, 5e3].map(|load| row(&Params { load, ..DRIVEN }, &solver));
        println!(
            "rtol {rtol}: mean {:e} deg, error estimates {:e} and {:e}, right-hand sides {} and {}",
            symmetric.measures[1],
            symmetric.error_estimate,
            loaded.error_estimate,
            symmetric.rhs_evals,
            loaded.rhs_evals
        );
        assert!(symmetric.measures[1].abs() < 10.0 * rtol * symmetric.measures[0], "{symmetric:?}");
        assert!(symmetric.error_estimate < 1e3 * rtol, "{symmetric:?}");
        assert!((symmetric.rhs_evals as f64) < 1.3 * loaded.rhs_evals as f64, "{symmetric:?} {loaded:?}");
    }
}

#[test]
fn a_derived_column_without_a_finite_value_is_empty_and_the_others_stay() {
    let row = row(&Params { load: 0.0, ..DRIVEN }, &SolverSettings::DEFAULT);
    assert_close(row.measures[0], (1e3 / (40.0 * OMEGA)).to_degrees(), 1e-4, "amplitude");
    assert!(row.measures[2].is_nan() && row.measures[3].is_nan(), "{:?}", row.measures);
    assert_eq!(row.period, 1);
}

/// At rest the drag has no linear part, so the state has no multiplier. Every small motion has a multiplier.
#[test]
fn rest_is_a_state_that_does_not_change() {
    let solver = SolverSettings { settle_tol: 1e-9, ..SolverSettings::DEFAULT }.with_rtol(1e-9);
    for load in [0.0, 5e3] {
        let at_rest = row(&Params { drive_strength: 0.0, load, ..DRIVEN }, &solver);
        assert!(at_rest.floquet_max.is_nan(), "{at_rest:?}");
        assert_eq!(at_rest.stable(), Some(true));
        for drive_strength in [1e-9, 1e-3, 1e3] {
            // Beside the load a motion of 1e-12 of it cannot be told from rest.
            if drive_strength < 1e-6 * load {
                continue;
            }
            let moving = row(&Params { drive_strength, load, ..DRIVEN }, &solver);
            assert_close(moving.floquet_max, (-0.2_f64).exp(), 1e-4, "floquet_max");
        }
    }
}

#[test]
fn lanes_equal_scalars() {
    let points: Vec<Vec<f64>> = [0.0, 1.0, 1e3]
        .into_iter()
        .flat_map(|drive_strength| {
            [0.0, 5e3].map(|load| Params { drive_strength, load, ..DRIVEN }.to_values())
        })
        .collect();
    let rows = rows::assert_lanes_equal_scalars(&OSCILLATOR, &points, &SolverSettings::DEFAULT);
    assert!(rows.iter().all(|row| row.status == Status::Periodic));
}
