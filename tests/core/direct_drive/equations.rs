//! Forces, moments and accelerations against reference vectors, on scalars and lanes.

use std::f64::consts::{FRAC_PI_2, PI};

use flap_core::drive::Wave;
use flap_core::model::direct_drive::{Constants, DirectDrive, FlowDirection, Params};
use flap_core::num::Real;
use flap_core::ode::Ode;
use flap_core::quadrature::gauss_legendre;

use super::{FLOWS, centre_of_pressure, params};
use crate::data::{assert_close, table};
use crate::probe::Probe;
use crate::slopes::{self, Driven};

const TOLERANCE: f64 = 1e-11;

type Case = slopes::Case<DirectDrive, 1>;

impl Driven<1> for DirectDrive {
    fn under<R: Real>(_c: &Constants<R>, [voltage]: &[Wave<R>; 1]) -> Wave<R> {
        *voltage
    }
}

/// The reference's states, with a direction of flow.
fn cases_with(flow: FlowDirection) -> Vec<Case> {
    table("direct-drive/rhs_vectors.csv")
        .into_iter()
        .map(|record| Case {
            model: DirectDrive { flow, ..DirectDrive::SINE },
            constants: Constants::derive(&Params {
                flow_direction: flow,
                centre_of_pressure: centre_of_pressure(record.text("dcp")),
                ..params(record.text("type"))
            })
            .unwrap(),
            voltages: [Wave::with_rate(record.number("V_V"), record.number("Vdot_V_s"))],
            side: record.number("ubar_m_s").signum(),
            y: ["phi", "psi", "phidot", "psidot"].map(|column| record.number(column)),
            record,
        })
        .collect()
}

/// The reference's cases.
fn cases() -> Vec<Case> {
    cases_with(FlowDirection::Uniform)
}

#[test]
fn accelerations_forces_and_moments_equal_the_reference() {
    for case in cases() {
        let Case { model, constants: c, voltages: [drive], side, y, record } = case;
        let dy = model.rhs(&c, &drive, side, &y);
        let probe = |constants| Probe { model: &model, constants, input: &drive, side };
        let signals = probe(&c).signals(&y, &dy);
        // Without accelerations, and with either moment about the span axis: the added mass does nothing.
        let still = [0.0; 4];
        let translation = Constants { rotation: 0.0, ..c };
        let translation = probe(&translation).load(&y, &still);
        let rotation = Constants { k_lift: 0.0, drag_mean: 0.0, drag_swing: 0.0, ..c };
        let rotation = probe(&rotation).load(&y, &still);
        // At rest, with the accelerations of the motion: the added mass alone, along the wing's normal.
        let added = probe(&c).load(&[y[0], y[1], 0.0, 0.0], &dy);
        let cos = Real::sin_cos(y[1]).1;
        for (column, actual) in [
            ("phidot", dy[0]),
            ("psidot", dy[1]),
            ("phiddot", dy[2]),
            ("psiddot", dy[3]),
            ("F_lift_N", signals.lift),
            ("F_tr_lift_N", signals.lift_translational),
            ("F_am_N", -added.drag / cos),
            ("M_tr_y_Nm", -translation.drag_moment),
            ("M_tr_x_Nm", translation.span_moment),
            ("M_rot_Nm", rotation.span_moment),
            ("M_am_y2_Nm", -added.drag_moment / cos),
            ("M_am_x_Nm", added.span_moment),
            ("ubar_m_s", model.switch(&c, &y, &dy)[0]),
            ("current_A", signals.current),
        ] {
            assert_close(actual, record.number(column), TOLERANCE, &format!("{column} of {}", record.name));
        }
    }
}

/// The rate of the switching function is the derivative of the switching function along the motion.
#[test]
fn rate_of_the_mean_velocity_is_its_derivative() {
    for Case { model, constants: c, voltages: [drive], side, y, record } in cases() {
        let dy = model.rhs(&c, &drive, side, &y);
        let [_, rate] = model.switch(&c, &y, &dy);
        let at = |dt: f64| model.switch(&c, &std::array::from_fn(|i| y[i] + dt * dy[i]), &dy)[0];
        let dt = 1e-8;
        assert_close((at(dt) - at(-dt)) / (2.0 * dt), rate, 1e-5, &record.name);
    }
}

/// Forces and moments of blade elements, computed element by element from the definition.
#[test]
fn blade_elements_add_up_to_the_wing() {
    for Case { model, constants: c, voltages: [drive], y, record, .. } in cases_with(FlowDirection::Blade) {
        let p = params(record.text("type"));
        let [_, psi, phi_dot, psi_dot] = y;
        let (sin, cos) = Real::sin_cos(psi);
        let c_lift = c.k_lift * (2.0 * psi).sin();
        let c_drag = c.drag_mean + c.drag_swing * (2.0 * psi).cos();
        let mut expected = [0.0; 4];
        for node in gauss_legendre(8).iter() {
            let x = 0.5 * p.actuator_length + node.x * p.wing_length;
            let z = 2.0 * node.x - 1.0;
            let chord = p.mean_chord
                * (1.0
                    + p.chord_legendre_1 * z
                    + p.chord_legendre_2 * (1.5 * z * z - 0.5)
                    + p.chord_legendre_3 * (2.5 * z * z * z - 1.5 * z));
            let u = x * phi_dot - 0.5 * chord * psi_dot * cos;
            let pressure = 0.5 * p.air_density * u * u.abs() * chord * node.weight * p.wing_length;
            let attack = match record.text("dcp") {
                "directional" => (FRAC_PI_2 - u.signum() * psi).abs(),
                "folded" => FRAC_PI_2 - psi.abs(),
                _ => (FRAC_PI_2 - psi).abs(),
            };
            let d_cp = 0.82 / PI * attack + 0.05;
            let parts = [
                c_lift * pressure,
                c_drag * pressure,
                -c_drag * pressure * x,
                (c_lift * sin + c_drag * cos) * pressure * chord * d_cp,
            ];
            expected = std::array::from_fn(|i| expected[i] + parts[i]);
        }
        // A side does not matter.
        for side in [1.0, -1.0] {
            let constants = &Constants { rotation: 0.0, ..c };
            let air = Probe { model: &model, constants, input: &drive, side }.load(&y, &[0.0; 4]);
            let actual = [air.lift, air.drag, -air.drag_moment, air.span_moment];
            for (actual, expected) in actual.into_iter().zip(expected) {
                assert_close(actual, expected, TOLERANCE, &record.name);
            }
        }
        assert_eq!(model.switch(&c, &y, &y), [1.0, 0.0]);
    }
}

#[test]
fn every_lane_equals_the_scalar_bit_for_bit() {
    for flow in FLOWS {
        slopes::assert_lanes_equal_scalars(&cases_with(flow));
    }
}

#[test]
fn arithmetic_classes_agree_to_rounding() {
    for flow in FLOWS {
        slopes::assert_classes_agree(&cases_with(flow), 0.0);
    }
}
