//! Forces, moments and accelerations against reference vectors, on scalars and lanes.

use std::f64::consts::PI;

use flap_core::drive::Wave;
use flap_core::model::four_bar::{Arms, Constants, FourBar, Params, Quadrature, transmission};
use flap_core::num::Real;
use flap_core::ode::Ode;

use super::{Moments, arms, assert_close_to, mass_matrix, moments, params, side};
use crate::data::table;
use crate::probe::Probe;
use crate::slopes::{self, Driven};

type Case = slopes::Case<FourBar, 1>;

impl Driven<1> for FourBar {
    fn under<R: Real>(_c: &Constants<R>, [voltage]: &[Wave<R>; 1]) -> Wave<R> {
        *voltage
    }
}

fn cases() -> Vec<Case> {
    table("four-bar/rhs_vectors.csv")
        .into_iter()
        .map(|record| {
            assert_eq!(record.text("quad"), "gauss");
            let p = Params {
                arms: arms(record.text("arms")),
                strips: record.number("N"),
                ..params(record.text("system"))
            };
            let constants = Constants::derive(&p).unwrap();
            let y = ["theta", "phi", "theta_dot", "phi_dot"].map(|column| record.number(column));
            let model = FourBar::SINE;
            let voltages = [model.input(&constants, record.number("t"))];
            let side = side(&constants, &y);
            Case { model, constants, voltages, side, y, record }
        })
        .collect()
}

#[test]
fn accelerations_forces_and_moments_equal_the_reference() {
    let mut largest = (0.0, String::new());
    for Case { constants: c, voltages: [drive], side, y, record, .. } in cases() {
        let [theta, phi, theta_dot, phi_dot] = y;
        let dy = FourBar::SINE.rhs(&c, &drive, side, &y);
        let probe = Probe { model: &FourBar::SINE, constants: &c, input: &drive, side };
        let signals = probe.signals(&y, &dy);
        let Moments { stroke, pitch, rotation_stroke, rotation_pitch } = moments(&c, side, &y);
        let links = transmission(&c, theta);
        let [m11, m12, m22] = mass_matrix(&c, theta, phi);
        let elastic = c.wing.hinge_stiffness * phi * phi
            + c.actuator.stiffness * links.displacement * links.displacement;
        let kinetic = m11 * theta_dot * theta_dot + 2.0 * m12 * theta_dot * phi_dot + m22 * phi_dot * phi_dot;
        for (column, actual) in [
            ("theta_dot", dy[0]),
            ("phi_dot", dy[1]),
            ("theta_ddot", dy[2]),
            ("phi_ddot", dy[3]),
            ("M_drive", probe.signals(&[theta, phi, 1.0, phi_dot], &dy).power_drive),
            ("Qth_trans", stroke),
            ("Qphi_trans", pitch),
            ("Qth_rot", rotation_stroke),
            ("Qphi_rot", rotation_pitch),
            ("lift_trans", signals.lift_translational),
            ("lift_rot", signals.lift_rotational),
            ("lift_addmass", signals.lift_added_mass),
            ("M11", m11),
            ("M12", m12),
            ("M22", m22),
            ("energy", 0.5 * (kinetic + elastic)),
        ] {
            let expected = record.number(column);
            let what = format!("{column} of {}", record.name);
            let size = if expected == 0.0 { 1e-12 } else { expected.abs() };
            let error = (actual - expected).abs() / size;
            if error > largest.0 {
                largest = (error, what.clone());
            }
            assert_close_to(actual, expected, size, 1e-11, &what);
        }
    }
    println!("largest relative error {:.1e} ({})", largest.0, largest.1);
}

/// The cases of the table with different kinds and numbers of strips in neighbouring lanes, and with pitches beyond
/// 90°.
fn mixed_cases() -> Vec<Case> {
    let mut cases = cases();
    for (i, case) in cases.iter_mut().enumerate() {
        let p = Params {
            quadrature: if i % 3 == 0 { Quadrature::Midpoint } else { Quadrature::Gauss },
            strips: [16.0, 8.0, 64.0, 1.0, 33.0][i % 5],
            ..params(case.record.text("system"))
        };
        case.constants = Constants::derive(&p).unwrap();
        if i % 4 == 0 {
            case.y[1] += 1.3;
            case.side = side(&case.constants, &case.y);
        }
    }
    cases
}

#[test]
fn every_lane_equals_the_scalar_bit_for_bit() {
    slopes::assert_lanes_equal_scalars(&mixed_cases());
}

#[test]
fn arithmetic_classes_agree_to_rounding() {
    slopes::assert_classes_agree(&cases(), 1e-9);
}

/// Translational forces and moments as in the paper: strip by strip, each strip with its own attack angle.
fn strip_by_strip(p: &Params, y: &[f64; 4], strips: usize) -> [f64; 4] {
    let [_, phi, theta_dot, phi_dot] = *y;
    let [kappa, origin] = match p.arms {
        Arms::Printed => [0.5, 0.0],
        Arms::Axis => [0.5 - p.axis_position, p.axis_position],
    };
    let mut sums = [0.0; 4];
    for i in 0..strips {
        let x = (i as f64 + 0.5) / strips as f64;
        let r = p.wing_offset + p.wing_length * x;
        let chord = p.root_chord * (p.chord_term_0 + p.chord_term_1 * x + p.chord_term_4 * x.powi(4));
        let u = r * theta_dot + kappa * chord * phi_dot * phi.cos();
        let q = 0.5 * p.air_density * chord * u * u * p.wing_length / strips as f64;

        // α = 90° − φ for U < 0 and 90° + φ for U > 0, in (−180°, 180°].
        let attack = 180.0 - (90.0 - u.signum() * phi.to_degrees()).rem_euclid(360.0);
        let folded = if attack.abs() > 90.0 { 180.0 - attack.abs() } else { attack.abs() };
        let mut c_l = 0.225 + 1.58 * (2.13 * folded - 7.2).to_radians().sin();
        let c_d = 1.92 - 1.55 * (2.04 * folded - 9.82).to_radians().cos();
        if attack.abs() > 90.0 {
            c_l = -c_l;
        }
        if attack < 0.0 {
            c_l = -c_l;
        }
        let arm = (0.82 * attack.abs().to_radians() / PI + 0.05 - origin) * chord;
        let (lift, push) = (q * c_l, -u.signum() * q * c_d);
        for (sum, part) in
            sums.iter_mut().zip([lift, -push, r * push, arm * (push * phi.cos() + lift * phi.sin())])
        {
            *sum += part;
        }
    }
    sums
}

/// For any pitch, flap's sums over directed strips equal the paper's sums over strips. 64 strips agree term by term,
/// and 16 Gauss nodes are as accurate as 256 strips.
#[test]
fn directed_sums_are_the_sums_of_the_strips() {
    for case in cases() {
        for turn in -4..=4 {
            let p = Params {
                arms: arms(case.record.text("arms")),
                quadrature: Quadrature::Midpoint,
                strips: 64.0,
                ..params(case.record.text("system"))
            };
            let mut y = case.y;
            y[1] += 0.9 * f64::from(turn);
            let side = side(&case.constants, &y);
            let translation = |p: &Params| {
                let c = Constants::derive(p).unwrap();
                let input = &Wave::with_rate(0.0, 0.0);
                let probe = Probe { model: &FourBar::SINE, constants: &c, input, side };
                let signals = probe.signals(&y, &[0.0; 4]);
                let Moments { stroke, pitch, .. } = moments(&c, side, &y);
                [signals.lift_translational, signals.drag, stroke, pitch]
            };
            let sizes = [1e-3, 1e-3, 1e-5, 5e-6];
            let gauss = Params { quadrature: Quadrature::Gauss, strips: 16.0, ..p.clone() };
            for (p, strips, tolerance) in [(&p, 64, 1e-11), (&gauss, 256, 1e-3)] {
                let expected = strip_by_strip(p, &y, strips);
                for (i, actual) in translation(p).into_iter().enumerate() {
                    let size = expected[i].abs() + sizes[i];
                    let what = format!("number {i} of {}, φ = {}, {strips} strips", case.record.name, y[1]);
                    assert_close_to(actual, expected[i], size, tolerance, &what);
                }
            }
        }
    }
}

/// The rate of the side is the derivative of the switching function along the motion.
#[test]
fn rate_of_the_side_is_its_derivative() {
    for case in cases() {
        let [_, phi, _, phi_dot] = case.y;
        let switch = |phi: f64| case.model.switch(&case.constants, &[0.0, phi, 0.0, phi_dot], &[0.0; 4]);
        let at = |dt: f64| switch(phi + dt * phi_dot)[0];
        let dt = 1e-8;
        let expected = (at(dt) - at(-dt)) / (2.0 * dt);
        assert_close_to(switch(phi)[1], expected, phi_dot.abs().max(1.0), 1e-6, &case.record.name);
    }
}

/// On both sides of φ = 0 the equations of motion are the same, but the lift changes its sign.
#[test]
fn equations_go_on_smoothly_past_the_vertical() {
    let c = Constants::derive(&params("sys75")).unwrap();
    let drive = Wave::with_rate(80.0, 0.0);
    let y = [0.1, 0.0, 80.0, -100.0];
    let [up, down] = [1.0, -1.0].map(|side| FourBar::SINE.rhs(&c, &drive, side, &y));
    assert_eq!(up, down);
    let [up, down] = [1.0, -1.0].map(|side| {
        let probe = Probe { model: &FourBar::SINE, constants: &c, input: &drive, side };
        probe.signals(&y, &[0.0; 4]).lift_translational
    });
    assert!(up < 0.0);
    assert_eq!(up, -down);
    // With the side held, they go on as a smooth function does.
    let at = |phi: f64| FourBar::SINE.rhs(&c, &drive, 1.0, &[0.1, phi, 80.0, -100.0])[3];
    let third = (at(0.02) - 3.0 * at(0.01) + 3.0 * at(0.0) - at(-0.01)) / at(0.0);
    assert!(third.abs() < 1e-4, "{third}");
}
