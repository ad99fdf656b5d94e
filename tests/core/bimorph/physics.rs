//! Symmetries, limits and conservation laws.

use std::ops::Range;

use flap_core::drive::Wave;
use flap_core::model::Model;
use flap_core::model::bimorph::{
    Bimorph, CentreOfPressure, Constants, Law, Params, Plate, Signals, secant_stiffness,
};
use flap_core::num::{Backend, Real};
use flap_core::ode::{Ode, Start};
use flap_core::simulate::{PointRun, SolverSettings, TrajectoryRequest};
use proptest::prelude::*;

use super::orbit::cycle;
use super::{model, params, plates_under};
use crate::by_name::scaled;
use crate::data::assert_close;
use crate::probe::{Probe, modes};
use crate::span::{self, tolerances};

/// The signals at a state under the voltages of the plates.
fn signals(model: &Bimorph, c: &Constants<f64>, plates: &[Plate<f64>; 2], y: &[f64; 4]) -> Signals<f64> {
    Probe { model, constants: c, input: plates, side: 1.0 }.signals(y, &[0.0; 4])
}

/// Elastic energy of actuator and transmission (J), by Simpson's rule.
fn elastic_energy(c: &Constants<f64>, x: f64) -> f64 {
    let n = 200;
    let h = x / f64::from(n);
    let weighted = |k: i32| {
        let weight = if k == 0 || k == n {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        };
        let x = f64::from(k) * h;
        weight * secant_stiffness(c, x) * x
    };
    (0..=n).map(weighted).sum::<f64>() * h / 3.0 + 0.5 * c.k_t * x * x
}

/// Kinetic energy at the tip and elastic energy (J).
fn tip_energy(c: &Constants<f64>, y: &[f64; 4]) -> f64 {
    let ratio = 1.0 + c.ratio_growth * y[0] * y[0];
    0.5 * (c.stroke_mass * ratio * ratio + c.tip_mass) * y[1] * y[1] + elastic_energy(c, y[0])
}

/// Energy from the plates' charges that is neither elastic nor kinetic energy (J).
///
/// ```text
/// U = ½C_p (V₁² + V₂²) + (g'V − g)₁ (x − ½bx²) − (g'V − g)₂ (x + ½bx²)
/// ```
fn electric_energy(c: &Constants<f64>, plates: &[Plate<f64>; 2], x: f64) -> f64 {
    let [one, two] = plates.map(|p| p.force_per_volt * p.voltage.value - p.force);
    let [v_1, v_2] = plates.map(|p| p.voltage.value);
    let bend = 0.5 * c.b * x * x;
    0.5 * c.c_p * (v_1 * v_1 + v_2 * v_2) + one * (x - bend) - two * (x + bend)
}

const STATES: [Range<f64>; 4] = [-4e-4..4e-4, -0.4..0.4, -1.5..1.5, -1500.0..1500.0];

/// Both presets with their parameters changed by up to 30 %.
fn any_params() -> impl Strategy<Value = Params> {
    let presets = vec![Params::jafferis2016().to_values(), Params::jafferis2016_improved().to_values()];
    let names = "transmission_ratio wing_area hinge_stiffness piezo_thickness \
                 actuator_width_ratio modulus_strain drag_coefficient_max stress_field";
    (scaled(Params::TABLE, presets, names, 0.7..1.3), 0.0..1e-5).prop_map(|(values, actuator_mass)| {
        let p = Params::from_values(&values);
        // An actuator has no width at one end if the ratio is 2.
        Params { actuator_width_ratio: 0.9 * p.actuator_width_ratio, actuator_mass, ..p }
    })
}

/// Random presets as in [`any_params`], with damping, unequal plates, and a transmission whose ratio grows or falls.
fn any_robot() -> impl Strategy<Value = Params> {
    (any_params(), -2e9..5e9, 0.7..1.3, 0.0..2e-8, 0.0..0.2).prop_map(
        |(p, transmission_growth, plate_ratio, stroke_damping, stroke_loss_factor)| Params {
            transmission_growth,
            plate_ratio,
            stroke_damping,
            stroke_loss_factor,
            ..p
        },
    )
}

fn any_voltages() -> impl Strategy<Value = [Wave<f64>; 2]> {
    let voltage = || (0.0..300.0, -1e5..1e5).prop_map(|(value, rate)| Wave::with_rate(value, rate));
    [voltage(), voltage()]
}

proptest! {
    /// d(U + E)/dt = V₁i₁ + V₂i₂ − drag − damping, for any state and any change of the voltages.
    #[test]
    fn energy_changes_by_electrical_work_and_losses_alone(p in any_robot(), y in STATES, v in any_voltages()) {
        let c = Constants::derive(&p).unwrap();
        let driven = plates_under(&c, v);
        let model = Bimorph { law: Law::Square, ..Bimorph::SINE };
        let dy = model.rhs(&c, &driven, 1.0, &y);
        let Signals { current_1, current_2, .. } = signals(&model, &c, &driven, &y);
        let (_, cos_2psi) = Real::sin_cos(2.0 * y[2]);
        // φ̇ over the ratio at rest.
        let rate = (1.0 + c.ratio_growth * y[0] * y[0]) * y[1];
        let drag = (c.c_a + c.c_b * cos_2psi) * rate * rate * rate.abs();
        let damping = c.tip_damping * y[1] * y[1] + c.stroke_damping * rate * rate;
        let work = v[0].value * current_1 + v[1].value * current_2 - drag - damping;

        let at = |dt: f64| {
            let y: [f64; 4] = std::array::from_fn(|i| y[i] + dt * dy[i]);
            let plates = plates_under(&c, v.map(|v| Wave { value: v.value + dt * v.rate, ..v }));
            electric_energy(&c, &plates, y[0]) + tip_energy(&c, &y)
        };
        let dt = 1e-8;
        let rate = (at(dt) - at(-dt)) / (2.0 * dt);
        let size = drag.abs() + at(0.0) * 1e4;
        prop_assert!((rate - work).abs() < 1e-7 * size, "{} against {}", rate, work);
    }

    /// (x, ψ) → −(x, ψ) with swapped plates mirrors the motion and does not change lift and power.
    #[test]
    fn half_strokes_are_mirror_images(p in any_params(), y in STATES, v in any_voltages(), folded in prop::bool::ANY) {
        let reading = if folded { CentreOfPressure::Folded } else { CentreOfPressure::Directional };
        let model = Bimorph { centre_of_pressure: reading, ..Bimorph::SINE };
        let c = Constants::derive(&p).unwrap();
        let plates = plates_under(&c, v);
        let swapped = [plates[1], plates[0]];
        let mirror = y.map(|y| -y);
        let dy = model.rhs(&c, &plates, 1.0, &y);
        prop_assert_eq!(model.rhs(&c, &swapped, 1.0, &mirror), dy.map(|d| -d));
        let one = signals(&model, &c, &plates, &y);
        let other = signals(&model, &c, &swapped, &mirror);
        prop_assert_eq!([other.force_1, other.force_2], [one.force_2, one.force_1]);
        prop_assert_eq!([other.current_1, other.current_2], [one.current_2, one.current_1]);
        prop_assert_eq!([other.lift, other.drag], [one.lift, -one.drag]);
    }
}

/// As printed, Eq. (11) treats the two half strokes differently.
#[test]
fn the_literal_reading_breaks_the_mirror_symmetry() {
    let model = Bimorph { centre_of_pressure: CentreOfPressure::Literal, ..Bimorph::SINE };
    let c = Constants::derive(&params("T1")).unwrap();
    let plates = plates_under(&c, [Wave::with_rate(100.0, 0.0); 2]);
    let y = [0.0, 0.2, 1.0, 0.0];
    let [dy, mirrored] = [1.0, -1.0].map(|m| model.rhs(&c, &plates, 1.0, &y.map(|y| m * y)));
    assert!((dy[3] + mirrored[3]).abs() > 0.05 * dy[3].abs());
}

/// Half a period later the settled motion is its own mirror image.
#[test]
fn settled_motions_are_antisymmetric() {
    for set in ["T1", "T3", "RD"] {
        let values = params(set).to_values();
        let solver =
            SolverSettings { rtol: 1e-9, atol: 1e-11, settle_tol: 1e-6, ..SolverSettings::default() };
        let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 100, settled: true };
        let motion = model()
            .motions()
            .unwrap()
            .trajectory(&PointRun::new(Backend::best(), &solver, &values), &request)
            .unwrap();
        let scale = model_scale(&values);
        for k in 0..50 {
            for i in 0..4 {
                let sum = motion.rows[k][i + 1] + motion.rows[k + 50][i + 1];
                assert!(sum.abs() < 1e-5 * scale[i], "{set}, sample {k}, state {i}: {sum:e}");
            }
        }
    }
}

fn model_scale(values: &[f64]) -> [f64; 4] {
    Bimorph::SINE.start(values).unwrap().scale
}

/// The place at which the tip rests under constant voltages: K(x) x = F₁ − F₂.
pub(super) fn static_tip(c: &Constants<f64>, voltages: [f64; 2]) -> f64 {
    let plates = plates_under(c, voltages.map(|value| Wave::with_rate(value, 0.0)));
    let (mut low, mut high) = (-2e-3, 2e-3);
    for _ in 0..80 {
        let x = 0.5 * (low + high);
        let Signals { force_1, force_2, .. } = signals(&Bimorph::SINE, c, &plates, &[x, 0.0, 0.0, 0.0]);
        if (secant_stiffness(c, x) + c.k_t) * x < force_1 - force_2 { low = x } else { high = x }
    }
    0.5 * (low + high)
}

/// At 1 Hz, a hundredth of the resonance frequency, the tip follows its position under constant voltages.
#[test]
fn slow_motions_are_quasi_static() {
    for (set, voltage) in [("T1", 50.0), ("T1", 200.0), ("T3", 150.0)] {
        let p = Params { drive_voltage_pp: voltage, drive_frequency: 1.0, ..params(set) };
        let c = Constants::derive(&p).unwrap();
        let expected = static_tip(&c, [voltage, 0.0]);
        assert_close(static_tip(&c, [0.0, voltage]), -expected, 1e-12, set);
        // Begin with the velocity of the quasi-static motion, so as not to ring.
        let later = 1e-4;
        let swing = 0.5 * voltage * (2.0 * std::f64::consts::PI * later).sin();
        let velocity = static_tip(&c, [0.5 * voltage - swing, 0.5 * voltage + swing]) / later;
        let stroke = cycle(&p, [0.0, velocity, 0.0, 0.0], 1e-8).0.stroke;
        assert_close(stroke.max / c.ratio, expected, 1e-3, set);
        assert_close(-stroke.min / c.ratio, expected, 1e-3, set);
    }
}

/// Without air and without voltage the tip is an undamped oscillator.
#[test]
fn a_tip_in_vacuum_keeps_its_energy() {
    for set in ["T1", "T3", "RD"] {
        let p = Params { air_density: 0.0, drive_voltage_pp: 0.0, actuator_mass: 3e-6, ..params(set) };
        let c = Constants::derive(&p).unwrap();
        let start =
            Start { span: 0.05, y: [3e-4, 0.2, 0.5, -80.0], ..Bimorph::SINE.start(&p.to_values()).unwrap() };
        let total = |y: &[f64; 4]| tip_energy(&c, y);
        span::assert_conserved(&Bimorph::SINE, &tolerances(1e-10), &start, 1e-8, total, set);
    }
}

/// Small motions have the frequencies in the columns of natural frequencies.
#[test]
fn small_motions_repeat_with_their_natural_frequencies() {
    for set in ["T1", "T2", "RD"] {
        let p = Params { air_density: 0.0, drive_voltage_pp: 0.0, ..params(set) };
        let c = Constants::derive(&p).unwrap();
        let modes = modes::<Bimorph>(&c);
        for (frequency, y) in [(modes[0], [1e-8, 0.0, 0.0, 0.0]), (modes[1], [0.0, 0.0, 1e-3, 0.0])] {
            let start = Start { y, span: 1.0 / frequency, ..Bimorph::SINE.start(&p.to_values()).unwrap() };
            let end = span::end(&Bimorph::SINE, &tolerances(1e-11), &start);
            let i = if y[0] > 0.0 { 0 } else { 2 };
            assert_close(end[i], y[i], 1e-6, set);
            assert!(end[i + 1].abs() < 1e-4 * y[i] * frequency, "{set}: {end:?}");
        }
    }
}

/// No charge is left on the plates after a cycle.
#[test]
fn currents_have_no_mean() {
    let p = params("T1");
    let row = super::settled(&p, 1e-8);
    assert!(super::measure(&row, "current_1_rms_ma") > 0.05);
    let y = super::orbit::march(&p, [0.0; 4], 60, 1e-8);
    let signals = cycle(&p, y, 1e-8).0;
    for signal in [signals.current_1, signals.current_2] {
        assert!(signal.mean.abs() < 1e-6 * signal.mean_square.sqrt(), "{signal:?}");
    }
}
