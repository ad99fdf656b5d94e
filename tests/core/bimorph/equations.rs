//! Forces, accelerations, charges and currents against reference vectors, on scalars and lanes.

use flap_core::drive::{Shape, Wave, WaveformParameters};
use flap_core::model::bimorph::{Bimorph, CentreOfPressure, Constants, Params, Plate, secant_stiffness};
use flap_core::model::{ExperimentModel, Model};
use flap_core::num::Real;
use flap_core::ode::Ode;

use super::{params, plates_under};
use crate::data::{assert_close, table};
use crate::probe::Probe;
use crate::slopes::{self, Driven};
use crate::waveforms::third_harmonic;

const TOLERANCE: f64 = 1e-11;

type Case = slopes::Case<Bimorph, 2>;

impl Driven<2> for Bimorph {
    fn under<R: Real>(c: &Constants<R>, voltages: &[Wave<R>; 2]) -> [Plate<R>; 2] {
        plates_under(c, *voltages)
    }
}

fn constants() -> Constants<f64> {
    Constants::derive(&params("T1")).unwrap()
}

/// The model with the voltages of its plates as input.
fn probe<'a>(constants: &'a Constants<f64>, plates: &'a [Plate<f64>; 2]) -> Probe<'a, Bimorph> {
    const MODEL: &Bimorph = &Bimorph::SINE;
    Probe { model: MODEL, constants, input: plates, side: 1.0 }
}

/// Charges of the two plates (C), which follow from Eq. (6) by reciprocity.
///
/// ```text
/// q₁ = C_p V₁ + g'(V₁) (x − ½ b x²)     q₂ = C_p V₂ − g'(V₂) (x + ½ b x²)
/// ```
fn charges(c: &Constants<f64>, [p_1, p_2]: &[Plate<f64>; 2], x: f64) -> [f64; 2] {
    let bend = c.b * x * x * 0.5;
    [
        c.c_p * p_1.voltage.value + p_1.force_per_volt * (x - bend),
        c.c_p * p_2.voltage.value - p_2.force_per_volt * (x + bend),
    ]
}

fn cases() -> Vec<Case> {
    table("bimorph/rhs_vectors.csv")
        .into_iter()
        .map(|record| Case {
            model: Bimorph::SINE,
            constants: constants(),
            voltages: [("V1_V", "dV1_V_per_s"), ("V2_V", "dV2_V_per_s")]
                .map(|(value, rate)| Wave::with_rate(record.number(value), record.number(rate))),
            side: 1.0,
            y: ["x_m", "v_m_per_s", "psi_rad", "psidot_rad_per_s"].map(|column| record.number(column)),
            record,
        })
        .collect()
}

#[test]
fn accelerations_forces_and_currents_equal_the_reference() {
    let c = constants();
    let mut largest = (0.0, String::new());
    for Case { voltages, y, record, .. } in cases() {
        let plates = plates_under(&c, voltages);
        let dy = Bimorph::SINE.rhs(&c, &plates, 1.0, &y);
        let [_, x_ddot, _, psi_ddot] = dy;
        let signals = probe(&c, &plates).signals(&y, &dy);
        let [q_1, q_2] = charges(&c, &plates, y[0]);
        let stiffness = secant_stiffness(&c, y[0]);
        let shim = 575.050_469_826_864_5 * 0.010_625;
        let modulus = (stiffness - shim) / (575.050_469_826_864_5 * 8.160_75e-12);
        for (column, actual) in [
            ("F1_N", signals.force_1),
            ("F2_N", signals.force_2),
            ("K_act_N_per_m", stiffness),
            ("E_e_Pa", modulus),
            ("xdd_m_s2", x_ddot),
            ("psidd_rad_s2", psi_ddot),
            ("lift_N", signals.lift),
            ("drag_N", signals.drag),
            ("q1_C", q_1),
            ("q2_C", q_2),
            ("i1_A", signals.current_1),
            ("i2_A", signals.current_2),
        ] {
            let expected = record.number(column);
            if expected == 0.0 {
                assert_eq!(actual, 0.0, "{column} of {}", record.name);
                continue;
            }
            let what = format!("{column} of {}", record.name);
            assert_close(actual, expected, TOLERANCE, &what);
            let error = (actual / expected - 1.0).abs();
            if error > largest.0 {
                largest = (error, what);
            }
        }
    }
    println!("largest relative error {:.1e} ({})", largest.0, largest.1);
}

/// g' and g'' are the derivatives of g, and the currents are the derivatives of the charges.
#[test]
fn derivatives_of_force_and_charge_are_their_rates() {
    let c = constants();
    for Case { voltages, y, record, .. } in cases() {
        for voltage in voltages {
            let at = |dv: f64| plates_under(&c, [Wave { value: voltage.value + dv, ..voltage }; 2])[0];
            let (low, mid, high) = (at(-1e-3), at(0.0), at(1e-3));
            let per_volt = (high.force - low.force) / 2e-3;
            let bend = (high.force_per_volt - low.force_per_volt) / 2e-3;
            assert_close(per_volt, mid.force_per_volt, 1e-8, &record.name);
            assert!((bend - mid.force_bend).abs() < 1e-7 * mid.force_per_volt, "{}", record.name);
        }
        let at = |dt: f64| {
            let moved = voltages.map(|v| Wave { value: v.value + dt * v.rate, ..v });
            charges(&c, &plates_under(&c, moved), y[0] + dt * y[1])
        };
        let signals = probe(&c, &plates_under(&c, voltages)).signals(&y, &[0.0; 4]);
        let currents = [signals.current_1, signals.current_2];
        let (before, after) = (at(-1e-7), at(1e-7));
        for i in 0..2 {
            let rate = (after[i] - before[i]) / 2e-7;
            assert!((rate - currents[i]).abs() < 1e-6 * currents[i].abs() + 1e-11, "{}", record.name);
        }
    }
}

/// The two plates are driven in antiphase and their voltages add up to V_pp, (7).
#[test]
fn voltages_are_those_of_eq_7() {
    let c = constants();
    for i in 0..50 {
        let t = f64::from(i) / 50.0 / 120.0;
        let [p_1, p_2] = Bimorph::SINE.input(&c, t);
        let (sin, cos) = (2.0 * std::f64::consts::PI * 120.0 * t).sin_cos();
        assert!((p_1.voltage.value - 100.0 * (1.0 - sin)).abs() < 1e-11);
        assert!((p_1.voltage.value + p_2.voltage.value - 200.0).abs() < 1e-11);
        assert!((p_1.voltage.rate + 100.0 * 2.0 * std::f64::consts::PI * 120.0 * cos).abs() < 1e-8);
        assert_eq!(p_1.voltage.rate, -p_2.voltage.rate);
    }
}

/// For every drive, the forces of the plates depend only on the voltages of the plates.
#[test]
fn the_drive_acts_through_its_voltages() {
    let p = params("T1");
    let waveform = WaveformParameters {
        drive_shape: Shape::Harmonics,
        drive_third_harmonic: 0.3,
        drive_third_phase: 0.4,
        ..WaveformParameters::SINE
    };
    let designs = [
        Params { drive_offset: 30.0, waveform, ..p.clone() },
        Params { drive_voltage_pp: 90.0, ..p.clone() },
        // Exponents of up to 586, and powers whose product is infinite.
        Params { drive_voltage_pp: 3900.0, stress_steepness: 20e-6, ..p.clone() },
        Params { drive_voltage_pp: 100.0, stress_field: 50e6, ..p },
    ];
    for p in designs {
        let model = Bimorph::SINE.variant(&p.to_values());
        let c = Constants::derive(&p).unwrap();
        let (chirp, chirped) = model.chirped(&c, 40.0, 5.0);
        let (still, held, _) = model.released(&c, 1.0);
        for (model, c) in [(&model, &c), (&chirp, &chirped), (&still, &held)] {
            for i in 0..20 {
                let driven = model.input(c, f64::from(i) * 4e-4);
                for (plate, f_pre) in driven.into_iter().zip(c.force_per_stress) {
                    let field = plate.voltage.value * c.field_per_volt;
                    let s = 1.0 / (1.0 + (c.a_3 * (c.field_0 - field)).exp());
                    let force = f_pre * field * (c.f_min + (c.f_rise - c.f_decline * field) * s);
                    assert!((plate.force - force).abs() <= 1e-11 * force.abs(), "{}: {force}", plate.force);
                }
                // `plates_under` has the whole field in one exponent.
                if c.a_3 * c.field_per_volt * p.drive_voltage_pp > 100.0 || c.field_0 > 1e6 {
                    continue;
                }
                let alone = plates_under(c, driven.map(|plate| plate.voltage));
                for (one, other) in driven.into_iter().zip(alone) {
                    assert_close(one.force_per_volt, other.force_per_volt, 1e-12, "force per volt");
                    assert!((one.force_bend - other.force_bend).abs() < 1e-12 * other.force_per_volt);
                }
            }
        }
    }
}

#[test]
fn every_lane_equals_the_scalar_bit_for_bit() {
    slopes::assert_lanes_equal_scalars(&cases());
}

#[test]
fn arithmetic_classes_agree_to_rounding() {
    slopes::assert_classes_agree(&cases(), 0.0);
}

/// The sign function in the reading `directional` is the sign of the velocity.
#[test]
fn sign_of_the_velocity_directs_the_attack_angle() {
    let c = constants();
    let plates = plates_under(&c, [Wave::with_rate(0.0, 0.0); 2]);
    let torque = |centre_of_pressure, psi: f64, x_dot: f64| {
        let model = &Bimorph { centre_of_pressure, ..Bimorph::SINE };
        let probe = Probe { model, constants: &c, input: &plates, side: 1.0 };
        probe.load(&[0.0, x_dot, psi, 0.0], &[0.0; 4]).span_moment / (x_dot * x_dot.abs())
    };
    let [folded, directional, literal] =
        [CentreOfPressure::Folded, CentreOfPressure::Directional, CentreOfPressure::Literal];
    for psi in [0.3_f64, 1.2] {
        for reading in [folded, directional, literal] {
            assert_eq!(torque(reading, psi, 0.2), torque(folded, psi, 0.2));
        }
        assert_eq!(torque(directional, -psi, -0.2), torque(folded, psi, 0.2));
        assert_eq!(torque(directional, psi, -0.2), torque(literal, -psi, 0.2));
        assert!(torque(literal, -psi, 0.2) > torque(folded, psi, 0.2));
        assert_eq!(torque(literal, psi, 0.2), torque(literal, psi, -0.2));
    }
}

/// With harmonics, the voltages leave the range from 0 to V_pp, and the columns of field and capacitive power change.
#[test]
fn harmonics_widen_the_voltages() {
    let third = |h: f64| Params { waveform: third_harmonic(h), drive_voltage_pp: 100.0, ..params("T1") };
    // sin θ − h sin 3θ has its extremes ±(1 + h) at 90° and 270°.
    let [plain, wide] = [third(0.0), third(-0.25)].map(|p| super::settled(&p, 1e-6));
    let field = |row| super::measure(row, "field_max_v_per_um");
    assert_close(field(&plain), 100.0 / 135.0, 1e-5, "field");
    assert_close(field(&wide), 50.0 * 2.25 / 135.0, 1e-5, "field");
    let power = |row| super::measure(row, "power_capacitive_mw");
    assert_close(power(&wide) / power(&plain), 1.25 * 1.25, 1e-5, "capacitive power");
}

/// Half of the bias between the plates is added to the first voltage and subtracted from the second. The forces of two
/// plates at the same voltage have the plate ratio.
#[test]
fn a_bias_and_unequal_plates_change_voltages_and_forces() {
    let p = Params { drive_offset: 40.0, plate_ratio: 0.8, drive_voltage_pp: 200.0, ..params("T1") };
    let c = Constants::derive(&p).unwrap();
    let [first, second] = Bimorph::SINE.input(&c, 0.0);
    assert_close(first.voltage.value, 120.0, 1e-14, "first voltage");
    assert_close(second.voltage.value, 80.0, 1e-14, "second voltage");
    let [first, second] = plates_under(&c, [Wave::with_rate(90.0, 0.0); 2]);
    assert_close(second.force / first.force, 0.8, 1e-14, "force");
    let field = super::measure(&super::settled(&p, 1e-6), "field_max_v_per_um");
    assert_close(field, 220.0 / 135.0, 1e-5, "field");
}

/// The power lost in the hinge's damping is the moment of this damping times the pitch rate.
#[test]
fn losses_of_the_hinge_are_moments_times_rates() {
    let p = Params { hinge_damping: 2e-9, ..params("T1") };
    let damped = Constants::derive(&p).unwrap();
    // The smallest further term selects the equations with all terms.
    let general = Params { circulation_factor: 1e-300, ..p };
    let model = Bimorph::SINE.variant(&general.to_values());
    for Case { voltages, y, record, .. } in cases().into_iter().filter(|case| case.y[3] != 0.0) {
        let plates = plates_under(&damped, voltages);
        let plain = probe(&damped, &plates).signals(&y, &[0.0; 4]);
        assert_close(plain.power_hinge_damping, 2e-9 * y[3] * y[3], 1e-13, &record.name);
        let general = Probe { model: &model, ..probe(&damped, &plates) }.signals(&y, &[0.0; 4]);
        assert_close(general.power_hinge_damping, plain.power_hinge_damping, 1e-13, &record.name);
        assert_close(general.power_rotational, plain.power_rotational, 1e-12, &record.name);
        assert!(plain.power_rotational > 0.0);
    }
}
