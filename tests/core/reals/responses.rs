//! Responses, multipliers and derivatives of each preset's orbit, against dual numbers.
//!
//! The test integrates a period with dual numbers, from the first state of the orbit that flap finds. Dual numbers have
//! derivatives along the four initial states and two parameters. The derivatives of the right-hand side along parameters are
//! two-sided differences, since models derive their constants on plain numbers.

use std::array;

use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::DirectDrive;
use flap_core::model::four_bar::FourBar;
use flap_core::model::{Instant, Model, SignalSet};
use flap_core::num::{Backend, PerLane, Real};
use flap_core::parameter::Parameter;
use flap_core::simulate::{Change, PointRun, SolverSettings, Status, by_name};
use nalgebra::{Matrix4, Vector4};

use super::dual::Dual;
use super::values;

/// Parameters along which derivatives are taken. No switching function depends on these parameters.
const PARAMETERS: [&str; 2] = ["drive_voltage_pp", "hinge_stiffness"];

/// The relative change of a parameter. Two-sided differences have errors of about 1e-12 from curvature and 1e-10 from
/// rounding.
const CHANGE: f64 = 1e-6;

/// The error of a step, in units of the states' typical sizes.
const TOLERANCE: f64 = 1e-11;

/// Number of equal steps per period, before the steps are halved.
const STEPS: u32 = 64;

/// The smallest step, relative to the period. At a kink of a force and at the switching surface, steps are halved until
/// this size.
const SMALLEST: f64 = 1e-13;

/// A number with its derivatives along the initial states, in units of their typical sizes, and along the relative
/// changes of parameters.
type Number = Dual<f64, 6>;

/// The states, and the integral of the lift (N·s).
type State<R> = [R; 5];

/// The motion of a model.
struct Motion<M: Model<4>> {
    model: M,
    constants: M::Constants<Number>,
    /// The constants with more and with less of each parameter.
    changed: [[M::Constants<f64>; 2]; 2],
    span: f64,
    scale: State<f64>,
}

/// The derivatives of a state at time `t`, and the switching function.
fn slopes<M: Model<4>, R: Real>(
    model: &M,
    c: &M::Constants<R>,
    t: f64,
    side: f64,
    y: &State<R>,
) -> (State<R>, [R; 2]) {
    let side = y[0].lit(side);
    let (u, y) = (model.input(c, side.lit(t)), array::from_fn(|i| y[i]));
    let dy = model.rhs(c, &u, side, &y);
    let signals = model.signals(c, Instant { input: &u, side, y: &y, dy: &dy });
    let (_, lift) = M::Signals::each(&signals).find(|(signal, _)| signal.name == "lift").unwrap();
    (array::from_fn(|i| if i < 4 { dy[i] } else { lift }), model.switch(c, &y, &dy))
}

impl<M: Model<4>> Motion<M> {
    fn new(model: &M, values: &[f64]) -> Motion<M> {
        let model = model.variant(values);
        let start = model.start(values).unwrap();
        let changed = PARAMETERS.map(|name| {
            [CHANGE, -CHANGE].map(|share| model.start(&moved::<M>(values, name, share)).unwrap().constants)
        });
        let [a, b, c, d] = start.scale;
        Motion {
            constants: M::Constants::fill(Number::constant(0.0), &start.constants),
            changed,
            span: start.span,
            // A lift of 1 mN.
            scale: [a, b, c, d, 1e-3 * start.span],
            model,
        }
    }

    /// The derivatives of a state at time `t`, also along the parameters.
    fn slopes(&self, t: f64, side: f64, y: &State<Number>) -> State<Number> {
        let (mut dy, _) = slopes(&self.model, &self.constants, t, side, y);
        let y = y.map(|y| y.value);
        for (direction, sides) in (4..).zip(&self.changed) {
            let [ahead, behind] = sides.each_ref().map(|c| slopes(&self.model, c, t, side, &y).0);
            for i in 0..5 {
                dy[i].slopes[direction] += (ahead[i] - behind[i]) / (2.0 * CHANGE);
            }
        }
        dy
    }

    /// A step of the classical Runge-Kutta method of order 4.
    fn step(&self, t: f64, h: f64, side: f64, y: &State<Number>) -> State<Number> {
        let ahead = |k: &State<Number>, h: f64| array::from_fn(|i| y[i] + k[i] * h);
        let k1 = self.slopes(t, side, y);
        let k2 = self.slopes(t + 0.5 * h, side, &ahead(&k1, 0.5 * h));
        let k3 = self.slopes(t + 0.5 * h, side, &ahead(&k2, 0.5 * h));
        let k4 = self.slopes(t + h, side, &ahead(&k3, h));
        ahead(&array::from_fn(|i| k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]), h / 6.0)
    }

    /// The state after `h`. The steps are halved until two half steps agree with the whole step and stay on one `side`.
    fn advance(&self, t: f64, h: f64, side: &mut f64, y: &State<Number>) -> State<Number> {
        let middle = self.step(t, 0.5 * h, *side, y);
        let end = self.step(t + 0.5 * h, 0.5 * h, *side, &middle);
        let leaves = M::SWITCHES && self.switch(t + h, *side, &end)[0].value * *side < 0.0;
        let agree = self.distance(&self.step(t, h, *side, y), &end) < TOLERANCE;
        if h < SMALLEST * self.span || (agree && !leaves) {
            return if leaves { self.crossed(t + h, side, &end) } else { end };
        }
        let middle = self.advance(t, 0.5 * h, side, y);
        self.advance(t + 0.5 * h, 0.5 * h, side, &middle)
    }

    /// The switching function and its rate.
    fn switch(&self, t: f64, side: f64, y: &State<Number>) -> [Number; 2] {
        slopes(&self.model, &self.constants, t, side, y).1
    }

    /// The state beyond the switching surface, with the slope of the new side since the crossing. The time of the
    /// crossing has derivatives.
    fn crossed(&self, t: f64, side: &mut f64, y: &State<Number>) -> State<Number> {
        let [value, rate] = self.switch(t, *side, y);
        let since = value / rate;
        let before = self.slopes(t, *side, y);
        *side = -*side;
        let after = self.slopes(t, *side, y);
        array::from_fn(|i| y[i] + (after[i] - before[i]) * since)
    }

    /// The largest difference of two states and their derivatives.
    fn distance(&self, one: &State<Number>, other: &State<Number>) -> f64 {
        let components = one.iter().zip(other).zip(&self.scale).flat_map(|((one, other), scale)| {
            let difference = *one - *other;
            [difference.value / scale].into_iter().chain(difference.slopes.map(|slope| slope / scale))
        });
        components.fold(0.0, |largest, difference| difference.abs().max(largest))
    }

    /// The end of the period that begins at `y`, and the number of crossings of the switching surface in the period.
    fn end(&self, y: &[f64]) -> (State<Number>, u32) {
        let mut state = [Number::constant(0.0); 5];
        for (i, &value) in y.iter().enumerate() {
            state[i] = Dual::along(value, i, self.scale[i]);
        }
        let [value, _] = self.switch(0.0, 1.0, &state);
        let (mut side, mut crossings) = (1.0_f64.copysign(value.value), 0);
        let h = self.span / f64::from(STEPS);
        for i in 0..STEPS {
            let before = side;
            state = self.advance(h * f64::from(i), h, &mut side, &state);
            crossings += u32::from(side != before);
        }
        (state, crossings)
    }
}

/// The values with a relative change of one parameter.
fn moved<M: Model<4>>(values: &[f64], name: &str, share: f64) -> Vec<f64> {
    let mut values = values.to_vec();
    values[Parameter::index(M::DESCRIPTION.parameters, name).unwrap()] *= 1.0 + share;
    values
}

/// Compares the orbit, its responses, its largest multiplier and the derivatives of its mean lift.
fn compare<M: Model<4>>(model: &M, preset: &str, backend: Backend, crossings: u32) {
    let values = &values(preset);
    let solver = SolverSettings { settle_tol: 1e-10, ..SolverSettings::DEFAULT }.with_rtol(1e-10);
    let simulator = by_name(M::DESCRIPTION.name).unwrap();
    let run = PointRun::new(backend, &solver, values);
    let row = simulator.run_point(&run, None);
    assert_eq!((row.status, row.period), (Status::Periodic, 1));
    let motions = simulator.motions().unwrap();
    let period = motions.period(&run, &row.state).unwrap();
    let changes = PARAMETERS.map(|name| {
        let [ahead, behind] = [1.0, -1.0].map(|sign| moved::<M>(values, name, sign * Change::SHARE));
        Change { ahead, behind, size: Change::SHARE }
    });
    let gradient = motions.gradient(&run, &row.state, &changes).unwrap();
    let column = simulator.columns().iter().position(|column| column.name == "lift_mean_mn").unwrap();

    let motion = Motion::new(model, values);
    let (end, crossed) = motion.end(&row.state);
    assert_eq!(crossed, crossings, "{preset}");
    let scale = motion.scale;
    let monodromy = Matrix4::from_fn(|i, j| end[i].slopes[j] / scale[i]);
    let responses = Matrix4::from_fn(|i, j| period.responses[j][i] * scale[j] / scale[i]);
    let multipliers = monodromy.complex_eigenvalues();
    let multiplier = multipliers.iter().fold(0.0_f64, |largest, multiplier| multiplier.norm().max(largest));
    let states = Vector4::from_fn(|i, _| (end[i].value - period.end[i]) / scale[i]);
    // The orbit moves along a parameter p by (1 − M)⁻¹ ∂Φ/∂p.
    let response = (Matrix4::identity() - monodromy).try_inverse().unwrap();
    let mean = 1e3 / motion.span;
    let lift = end[4].value * mean;
    let slope_errors = (4..).zip(&gradient.slopes).map(|(direction, found)| {
        let moves = response * Vector4::from_fn(|i, _| end[i].slopes[direction] / scale[i]);
        let along: f64 = (0..4).map(|i| end[4].slopes[i] * moves[i]).sum();
        let slope = (end[4].slopes[direction] + along) * mean;
        (found[column].unwrap() - slope).abs() / slope.abs().max(lift.abs())
    });
    let errors = [
        // A few times the tolerance; the lift jumps at crossings, which are located less accurately.
        ("state", states.amax(), 2e-9),
        ("mean lift", (row.measures[column] / lift - 1.0).abs(), 3e-8),
        // Forward differences with changes of 1e-7 err by about this share.
        ("responses", (responses - monodromy).amax() / monodromy.amax(), 3e-7),
        ("multiplier of the period", (period.floquet_max - multiplier).abs(), 5e-8),
        // The row's matrix is computed at a tolerance of 1.25e-3 times the root of the row's: 1.25e-8.
        ("multiplier of the row", (row.floquet_max - multiplier).abs(), 5e-6),
        // Differences with changes of 1e-8, whose rounding a response of some ten magnifies near a resonance.
        ("derivatives of the mean lift", slope_errors.fold(0.0, f64::max), 3e-5),
    ];
    for (what, error, bound) in errors {
        println!("{preset}, {backend}: {what}: {error:.1e}");
        assert!(error < bound, "{preset}, {backend}: {what}: {error:e}");
    }
}

/// Backends with the same arithmetic give the same bits, see `ensemble` and `gradient`.
#[test]
fn responses_multipliers_and_derivatives_are_those_of_dual_numbers() {
    let mut backends = Backend::available();
    backends.dedup_by_key(|backend| backend.arithmetic());
    for backend in backends {
        compare(&Bimorph::SINE, "jafferis2016", backend, 0);
        compare(&Bimorph::SINE, "jafferis2016-improved", backend, 0);
        compare(&DirectDrive::SINE, "ozaki2018-small", backend, 2);
        compare(&DirectDrive::SINE, "ozaki2018-large", backend, 2);
        compare(&FourBar::SINE, "arabagi2013-75hz", backend, 2);
        compare(&FourBar::SINE, "arabagi2013-30hz", backend, 2);
    }
}
