//! Rotational circulation and added mass of the wing's sections, against sums over the chord, and in the equations of motion.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use flap_core::body::BodyParameters;
use flap_core::drive::Wave;
use flap_core::model::bimorph::{self, Bimorph};
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::model::four_bar::{self, FourBar};
use flap_core::model::{Instant, Load, Model};
use flap_core::num::Backend;
use flap_core::ode::Ode;
use flap_core::parameter::Parameter;
use flap_core::quadrature::gauss_legendre;
use flap_core::simulate::{PointRun, SolverSettings, Status, preset};

use crate::data::assert_close;
use crate::harmonics::HARMONICS;

/// States of stroke and pitch [φ, ψ, φ̇, ψ̇] and accelerations [φ̈, ψ̈].
pub(crate) const STATES: [([f64; 4], [f64; 2]); 3] = [
    ([0.3, 0.7, 600.0, -500.0], [-2e5, 4e5]),
    ([-0.4, -0.9, -350.0, 800.0], [3e5, -2e5]),
    ([0.1, 0.2, 700.0, 1200.0], [1e5, 7e5]),
];

/// Velocity (m/s) and rates (rad/s) of the shoulder: at rest and in motion.
const MOTIONS: [[f64; 6]; 2] = [[0.0; 6], [0.9, -0.4, 0.7, 30.0, -20.0, 45.0]];

/// Returns each motion of the shoulder with each state.
fn moving_states() -> impl Iterator<Item = ([f64; 6], ([f64; 4], [f64; 2]))> {
    MOTIONS.into_iter().flat_map(|motion| STATES.map(|at| (motion, at)))
}

/// Returns the parameters of a body with this motion.
fn body([forward, left, up, roll, pitch, yaw]: [f64; 6]) -> BodyParameters {
    BodyParameters {
        body_velocity_forward: forward,
        body_velocity_left: left,
        body_velocity_up: up,
        body_rate_roll: roll,
        body_rate_pitch: pitch,
        body_rate_yaw: yaw,
        ..BodyParameters::REST
    }
}

/// A section: distance from the stroke axis, chord and width (m).
type Section = [f64; 3];

/// Sums over sections of the load of circulation (times `circulation`), added mass (times `added`), and
/// rotational drag with the coefficient `rotation`, in the directions of [`Load`]. The pitch axis lies behind
/// the leading edge at the distance `axis` times the chord. The shoulder has this velocity (m/s) and these
/// rates (rad/s).
fn summed(
    sections: &[Section],
    density: f64,
    axis: f64,
    [circulation, added, rotation]: [f64; 3],
    [v_x, v_y, v_z, r_x, r_y, r_z]: [f64; 6],
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> Load<f64> {
    let (sin, cos) = psi.sin_cos();
    // Velocity and rates of the shoulder along e_t and e_s.
    let (sin_phi, cos_phi) = phi.sin_cos();
    let (v_t, v_s) = (v_x * cos_phi - v_y * sin_phi, v_x * sin_phi + v_y * cos_phi);
    let (r_t, r_s) = (r_x * cos_phi - r_y * sin_phi, r_x * sin_phi + r_y * cos_phi);
    // Pitch rate relative to still air, and its change.
    let (rate, rate_change) = (psi_dot + r_s, psi_ddot + r_t * phi_dot);
    let mut load =
        Load { stroke: phi, lift: 0.0, drag: 0.0, lift_moment: 0.0, drag_moment: 0.0, span_moment: 0.0 };
    for [r, c, width] in sections {
        // Velocity of the pitch axis in the stroke plane and along the stroke axis.
        let (u, w) = (r * (phi_dot - r_z) + v_t, v_z + r * r_t);
        // Γ = π (3/4 − x₀) c² (ψ̇ + Ω_s), with the force ρ u_C Γ along the normal (cos ψ e_t − sin ψ e_z).
        let vortex = circulation * PI * (0.75 - axis) * c * c * rate;
        let lifting = density * (u * sin + w * cos) * vortex * width;
        // The plate's mid-chord moves along its normal with u cos ψ − w sin ψ − d (ψ̇ + Ω_s). The derivative of V_t is
        // −V_s φ̇, and the derivative of Ω_t is −Ω_s φ̇.
        let depth = (0.5 - axis) * c;
        let acceleration = (r * phi_ddot - v_s * phi_dot - w * psi_dot) * cos
            + (r * r_s * phi_dot - u * psi_dot) * sin
            - depth * rate_change;
        let mass = added * FRAC_PI_4 * density * c * c * width;
        let inertial = -mass * acceleration;
        let rotational = -mass * c * c / 32.0 * rate_change;
        // Parts of the chord at the distance z behind the axis move with z (ψ̇ + Ω_s). Their moment is in the paper already.
        let parts = gauss_legendre(40);
        let drag = parts.iter().map(|node| {
            // Both sides of the axis, so that no part contains the kink of z|z|.
            let (before, behind) = (-axis * c * node.x, (1.0 - axis) * c * node.x);
            (behind * behind.abs() * (1.0 - axis) + before * before.abs() * axis) * c * node.weight
        });
        let dragging = 0.5 * density * rotation * rate * rate.abs() * drag.sum::<f64>() * width;
        for (force, behind) in [(lifting, (0.25 - axis) * c), (inertial, depth), (dragging, 0.0)] {
            load.lift -= force * sin;
            load.drag -= force * cos;
            load.lift_moment -= r * force * sin;
            load.drag_moment -= r * force * cos;
            load.span_moment -= force * behind;
        }
        load.span_moment += rotational;
    }
    load
}

pub(crate) fn components(load: &Load<f64>) -> [f64; 5] {
    [load.lift, load.drag, load.lift_moment, load.drag_moment, load.span_moment]
}

/// Returns the load `one` minus the load `other`.
pub(crate) fn difference(one: &Load<f64>, other: &Load<f64>) -> Load<f64> {
    Load {
        stroke: one.stroke,
        lift: one.lift - other.lift,
        drag: one.drag - other.drag,
        lift_moment: one.lift_moment - other.lift_moment,
        drag_moment: one.drag_moment - other.drag_moment,
        span_moment: one.span_moment - other.span_moment,
    }
}

/// Asserts that two loads differ by the load `expected`. The error is relative to `expected`.
pub(crate) fn assert_difference(with: &Load<f64>, without: &Load<f64>, expected: &Load<f64>, subject: &str) {
    for ((with, without), expected) in
        components(with).into_iter().zip(components(without)).zip(components(expected))
    {
        let error = (with - without - expected).abs();
        assert!(
            error < 1e-10 * expected.abs() + 1e-13 * with.abs(),
            "{subject}: {with} - {without}, {expected}"
        );
    }
}

/// The chord of the bimorph: a beta distribution with the radii r̂₁ and r̂₂, cut where r̂ = sin²(½π x).
fn beta_sections(p: &bimorph::Params) -> Vec<Section> {
    let second = p.wing_radius_2;
    let first = (second / 0.929).powf(1.0 / 0.732);
    let k = first * (1.0 - first) / (second * second - first * first) - 1.0;
    let (a, b) = (first * k - 1.0, (1.0 - first) * k - 1.0);
    let rule = gauss_legendre(200);
    let cut = rule.iter().map(|node| {
        let (sin, cos) = (FRAC_PI_2 * node.x).sin_cos();
        [sin * sin, cos * cos, PI * sin * cos * node.weight]
    });
    let cut: Vec<[f64; 3]> = cut.collect();
    let shape = |near: f64, far: f64| near.powf(a) * far.powf(b);
    let whole: f64 = cut.iter().map(|[near, far, width]| shape(*near, *far) * width).sum();
    let mean = p.wing_area / p.wing_length;
    cut.iter()
        .map(|[near, far, width]| {
            [p.wing_length * near, mean * shape(*near, *far) / whole, p.wing_length * width]
        })
        .collect()
}

fn sectional() -> bimorph::Params {
    bimorph::Params {
        circulation_factor: 0.8,
        rotation_force_factor: 0.7,
        added_mass_factor: 0.6,
        axis_position: 0.1,
        ..bimorph::Params::jafferis2016()
    }
}

#[test]
fn the_load_of_the_bimorph_is_the_sum_over_sections() {
    let plain = bimorph::Params {
        circulation_factor: 0.0,
        rotation_force_factor: 0.0,
        added_mass_factor: 0.0,
        ..sectional()
    };
    let sections = beta_sections(&plain);
    for (motion, at) in moving_states() {
        let load = |p: &bimorph::Params| {
            let values = bimorph::Params { body: body(motion), ..p.clone() }.to_values();
            let model = Bimorph::SINE.variant(&values);
            let c = model.start(&values).unwrap().constants;
            let plates = model.input(&c, 0.0);
            let ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]) = at;
            let y = [phi / c.ratio, phi_dot / c.ratio, psi, psi_dot];
            let dy = [y[1], phi_ddot / c.ratio, psi_dot, psi_ddot];
            model.load(&c, Instant { input: &plates, side: 1.0, y: &y, dy: &dy })
        };
        let without = load(&plain);
        for factors in [[0.8, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 0.7], [0.8, 0.6, 0.7]] {
            let with = bimorph::Params {
                circulation_factor: factors[0],
                added_mass_factor: factors[1],
                rotation_force_factor: factors[2],
                ..plain.clone()
            };
            let factors = [factors[0], factors[1], factors[2] * plain.drag_coefficient_max];
            let expected = summed(&sections, plain.air_density, 0.1, factors, motion, at);
            assert_difference(&load(&with), &without, &expected, &format!("{factors:?} {motion:?}"));
        }
    }
    // Components of the sum on a moving body, computed with vectors in three dimensions.
    let sum = summed(&sections, 1.2, 0.1, [0.8, 0.6, 0.7 * 4.25], MOTIONS[1], STATES[0]);
    let expected = [
        6.209_194_282_402e-4,
        7.371_815_195_870e-4,
        6.078_760_052_093e-6,
        7.216_958_221_306e-6,
        4.931_989_865_111e-7,
    ];
    for (found, expected) in components(&sum).into_iter().zip(expected) {
        assert_close(found, expected, 1e-11, "sum");
    }
}

/// The sections of the blade of `direct-drive`.
fn blade_sections(p: &direct_drive::Params) -> Vec<Section> {
    let root = 0.5 * p.actuator_length;
    let rule = gauss_legendre(8);
    rule.iter()
        .map(|node| {
            let z = 2.0 * node.x - 1.0;
            let chord = 1.0
                + p.chord_legendre_1 * z
                + p.chord_legendre_2 * 0.5 * (3.0 * z * z - 1.0)
                + p.chord_legendre_3 * 0.5 * z * (5.0 * z * z - 3.0);
            [root + p.wing_length * node.x, p.mean_chord * chord, p.wing_length * node.weight]
        })
        .collect()
}

/// The sections of the strips of `four-bar`.
fn strip_sections(p: &four_bar::Params) -> Vec<Section> {
    let rule = gauss_legendre(16);
    rule.iter()
        .map(|node| [p.wing_offset + p.wing_length * node.x, p.chord(node.x), p.wing_length * node.weight])
        .collect()
}

/// Returns the load of `direct-drive` in a state, with this motion of the shoulder.
fn load_of_direct_drive(
    p: &direct_drive::Params,
    motion: [f64; 6],
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> Load<f64> {
    let values = direct_drive::Params { body: body(motion), ..p.clone() }.to_values();
    let model = DirectDrive::SINE.variant(&values);
    let c = model.start(&values).unwrap().constants;
    let input = model.input(&c, 0.0);
    let (y, dy) = ([phi, psi, phi_dot, psi_dot], [phi_dot, psi_dot, phi_ddot, psi_ddot]);
    model.load(&c, Instant { input: &input, side: 1.0, y: &y, dy: &dy })
}

/// Returns the load of `four-bar` in a state, with this motion of the shoulder. Its pitch has the opposite sign.
fn load_of_four_bar(
    p: &four_bar::Params,
    motion: [f64; 6],
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> Load<f64> {
    let values = four_bar::Params { body: body(motion), ..p.clone() }.to_values();
    let model = FourBar::SINE.variant(&values);
    let c = model.start(&values).unwrap().constants;
    let input = model.input(&c, 0.0);
    let (y, dy) = ([phi, -psi, phi_dot, -psi_dot], [phi_dot, -psi_dot, phi_ddot, -psi_ddot]);
    model.load(&c, Instant { input: &input, side: 1.0, y: &y, dy: &dy })
}

/// The models `direct-drive` and `four-bar` already contain added mass.
#[test]
fn the_circulation_of_strips_is_the_sum_over_sections() {
    let direct = direct_drive::Params {
        flow_direction: direct_drive::FlowDirection::Blade,
        ..direct_drive::Params::ozaki2018_large()
    };
    let bar = four_bar::Params::arabagi2013_75hz();
    let (blades, strips) = (blade_sections(&direct), strip_sections(&bar));
    for (motion, at) in moving_states() {
        let load = |factor: f64| {
            let p = direct_drive::Params {
                circulation_factor: factor,
                rotation_force_factor: 0.4 * factor,
                ..direct.clone()
            };
            load_of_direct_drive(&p, motion, at)
        };
        let factors = [0.7, 0.0, 0.28 * direct.rotation_drag];
        let expected = summed(&blades, direct.air_density, 0.0, factors, motion, at);
        assert_difference(&load(0.7), &load(0.0), &expected, "direct-drive");
        let load = |factor: f64| {
            let p = four_bar::Params { circulation_factor: factor, ..bar.clone() };
            load_of_four_bar(&p, motion, at)
        };
        let expected = summed(&strips, bar.air_density, bar.axis_position, [0.7, 0.0, 0.0], motion, at);
        assert_difference(&load(0.7), &load(0.0), &expected, "four-bar");
    }
}

/// The printed sign of Eq. (35) mirrors the lift of the added mass of `direct-drive`. The printed sign of Eq. (7) puts
/// the mid-chord of `four-bar` on the other side of the pitch axis.
#[test]
fn printed_signs_change_the_load_of_the_added_mass() {
    let direct = direct_drive::Params {
        flow_direction: direct_drive::FlowDirection::Blade,
        ..direct_drive::Params::ozaki2018_large()
    };
    let bar = four_bar::Params::arabagi2013_75hz();
    let (blades, strips) = (blade_sections(&direct), strip_sections(&bar));
    let added = [0.0, 1.0, 0.0];
    for (motion, at) in moving_states() {
        let sum = summed(&blades, direct.air_density, 0.0, added, motion, at);
        let expected = Load {
            lift: -2.0 * sum.lift,
            lift_moment: -2.0 * sum.lift_moment,
            drag: 0.0,
            drag_moment: 0.0,
            span_moment: 0.0,
            ..sum
        };
        let [printed, corrected] =
            [direct_drive::LiftSign::Printed, direct_drive::LiftSign::Corrected].map(|lift_sign| {
                load_of_direct_drive(&direct_drive::Params { lift_sign, ..direct.clone() }, motion, at)
            });
        assert_difference(&printed, &corrected, &expected, "direct-drive");

        let [printed, corrected] = [four_bar::AddedMassSign::Printed, four_bar::AddedMassSign::Corrected]
            .map(|am_sign| load_of_four_bar(&four_bar::Params { am_sign, ..bar.clone() }, motion, at));
        // An axis at 1 − χ has the mid-chord at the same distance on the other side.
        let [mirrored, sum] = [1.0 - bar.axis_position, bar.axis_position]
            .map(|axis| summed(&strips, bar.air_density, axis, added, motion, at));
        assert_difference(&printed, &corrected, &difference(&mirrored, &sum), "four-bar");
    }
}

/// Eqs. (3) to (18) with the load of the air at the accelerations of the solution.
#[test]
fn the_load_is_in_the_equations_of_motion_of_the_direct_drive() {
    for added_mass in [direct_drive::AddedMass::Paper, direct_drive::AddedMass::Lagrangian] {
        let p = direct_drive::Params { added_mass, ..direct_drive::Params::ozaki2018_large() };
        let c = direct_drive::Constants::derive(&p).unwrap();
        let model = DirectDrive::SINE.variant(&p.to_values());
        let voltage = 40.0;
        let input = Wave::with_rate(voltage, 0.0);
        let radius = p.mass_centre_span + 0.5 * p.actuator_length;
        let m_s = p.wing_inertia_span + p.wing_mass * p.mass_centre_chord * p.mass_centre_chord;
        let m_12 = p.wing_mass * radius * p.mass_centre_chord + p.wing_inertia_product;
        for y in [[0.3, 0.7, 60.0, -90.0], [-0.2, -0.9, -35.0, 120.0], [0.1, 0.2, 70.0, 200.0]] {
            let side = model.switch(&c, &y, &[0.0; 4])[0].signum();
            let dy = model.rhs(&c, &input, side, &y);
            let load = model.load(&c, Instant { input: &input, side, y: &y, dy: &dy });
            let [phi, psi, phi_dot, psi_dot] = y;
            let [_, _, phi_ddot, psi_ddot] = dy;
            let (sin, cos) = psi.sin_cos();
            let stroke = [
                (c.m11 + m_s * sin * sin) * phi_ddot,
                m_12 * cos * psi_ddot,
                2.0 * m_s * phi_dot * psi_dot * sin * cos,
                -m_12 * psi_dot * psi_dot * sin,
                c.k_phi * phi,
                load.drag_moment,
                -c.gamma * voltage,
            ];
            let hinge = [
                m_12 * cos * phi_ddot,
                m_s * psi_ddot,
                -m_s * phi_dot * phi_dot * sin * cos,
                p.hinge_stiffness * psi,
                -load.span_moment,
            ];
            for terms in [&stroke[..], &hinge[..]] {
                let size: f64 = terms.iter().map(|term| term.abs()).sum();
                assert!(terms.iter().sum::<f64>().abs() < 1e-12 * size, "{added_mass:?}: {terms:?}");
            }
        }
    }
}

/// Without air, the rotation of the body adds the moments g ψ̇ and g θ̇, with J_d instead of J_φ.
#[test]
fn a_turning_body_moves_the_wing_of_the_four_bar_with_its_inertia() {
    let (roll, pitch, yaw) = (30.0, -20.0, 45.0);
    let at_rest = four_bar::Params {
        air_density: 0.0,
        wing_inertia_normal: 2.0 * 4.269e-10,
        ..four_bar::Params::arabagi2013_75hz()
    };
    let turning = four_bar::Params { body: body([0.0, 0.0, 0.0, roll, pitch, yaw]), ..at_rest.clone() };
    let (m, depth) = (at_rest.wing_mass, at_rest.mass_centre_depth);
    let radius = at_rest.mass_centre_radius;
    let [j_sin, j_cos] = [m * depth * depth + at_rest.wing_inertia_normal, at_rest.wing_inertia_chord];
    let product = m * radius * depth + at_rest.wing_inertia_product;
    let j_pitch = m * depth * depth + at_rest.wing_inertia_span;
    for (y, moments) in [
        ([0.3, -0.7, 600.0, 500.0], [-2.094_704_721_760_6e-5, 2.513_645_666_112_7e-5]),
        ([-0.4, 0.9, -350.0, -800.0], [-1.662_725_017_230_4e-5, 7.274_421_950_382_8e-6]),
    ] {
        let accelerations = |p: &four_bar::Params| {
            let model = FourBar::SINE.variant(&p.to_values());
            let c = model.start(&p.to_values()).unwrap().constants;
            let side = model.switch(&c, &y, &[0.0; 4])[0].signum();
            model.rhs(&c, &Wave::with_rate(50.0, 0.0), side, &y)
        };
        let (before, after) = (accelerations(&at_rest), accelerations(&turning));
        let (theta, phi) = (after[2] - before[2], after[3] - before[3]);
        let c = four_bar::Constants::derive(&at_rest).unwrap();
        let (sin, cos) = f64::sin_cos(y[1]);
        let inertia = four_bar::transmission(&c, y[0]).inertia;
        let m_11 = m * radius * radius + j_sin * sin * sin + j_cos * cos * cos + inertia;
        assert_close(m_11 * theta + product * cos * phi, moments[0], 1e-8, "stroke");
        assert_close(product * cos * theta + j_pitch * phi, moments[1], 1e-8, "pitch");
    }
}

/// Eqs. (1) and (2) with the load of the air at the accelerations of the solution.
#[test]
fn the_load_is_in_the_equations_of_motion_of_the_bimorph() {
    let springs = |p: bimorph::Params| {
        let mut p = bimorph::Params { stroke_stiffening: 2e-5, transmission_growth: 2e9, ..p };
        p.hinge.hinge_stiffening = 1e-6;
        p.hinge.hinge_stop_stiffness = 4e-6;
        p.hinge.hinge_stop_angle = 0.5;
        p
    };
    for p in [sectional(), springs(sectional()), springs(bimorph::Params::jafferis2016())] {
        let c = bimorph::Constants::derive(&p).unwrap();
        let model = Bimorph::SINE.variant(&p.to_values());
        let plates = model.input(&c, 1e-3);
        for y in [[2e-4, -0.3, 0.7, 900.0], [-3e-4, 0.1, -1.2, -400.0], [1e-4, 0.2, 0.1, 50.0]] {
            let dy = model.rhs(&c, &plates, 1.0, &y);
            let load = model.load(&c, Instant { input: &plates, side: 1.0, y: &y, dy: &dy });
            let [x, x_dot, psi, _] = y;
            let growth = p.transmission_growth;
            let (ratio, slope) = (p.transmission_ratio + growth * x * x, 2.0 * growth * x);
            let phi = p.transmission_ratio * x + growth * x * x * x / 3.0;
            let (rate, acceleration) = (ratio * x_dot, ratio * dy[1] + slope * x_dot * x_dot);
            let inertia = p.wing_inertia_stroke + p.added_inertia_stroke;
            let spring = p.stroke_stiffening * phi * phi * phi;
            let moment = -inertia * acceleration - load.drag_moment - spring;
            let [g_1, g_2] = [plates[0].force, plates[1].force];
            let plates_force = g_1 * (1.0 - c.b * x) - g_2 * (1.0 + c.b * x);
            let elastic = (bimorph::secant_stiffness(&c, x) + p.transmission_stiffness) * x;
            let scale = elastic.abs() + plates_force.abs() + (ratio * moment).abs();
            assert!((plates_force - elastic + ratio * moment).abs() < 1e-12 * scale, "{p:?}");
            let beyond = (psi.abs() - p.hinge.hinge_stop_angle).max(0.0).copysign(psi);
            let hinge = p.hinge_stiffness * psi
                + p.hinge.hinge_stiffening * psi * psi * psi
                + p.hinge.hinge_stop_stiffness * beyond;
            let inertial = p.wing_inertia_product * acceleration * psi.cos()
                + 0.5 * p.wing_inertia_hinge * rate * rate * (2.0 * psi).sin();
            let terms = [load.span_moment, inertial, -hinge, -p.wing_inertia_hinge * dy[3]];
            let scale: f64 = terms.iter().map(|term| term.abs()).sum();
            assert!(terms.iter().sum::<f64>().abs() < 1e-12 * scale, "{terms:?}");
        }
    }
}

/// A hinge with half of its stiffness and a stop with the other half from zero pitch equals the linear hinge.
#[test]
fn stiffening_adds_moments_to_stroke_and_hinge() {
    for (name, stroke, hinge) in [("ozaki2018-large", 1e-2, 2e-5), ("arabagi2013-75hz", 1e-4, 1e-5)] {
        let (model, preset) = preset(name).unwrap();
        let values = (preset.values)();
        let set = |changes: &[(&str, f64)]| {
            let mut values = values.clone();
            for (name, value) in changes {
                values[Parameter::index(model.parameters(), name).unwrap()] = *value;
            }
            values
        };
        let solver = SolverSettings { rtol: 1e-9, settle_tol: 1e-9, ..SolverSettings::DEFAULT };
        let rows = |values: &[f64]| {
            let row = model.run_point(&PointRun::new(Backend::best(), &solver, values), None);
            assert_eq!(row.status, Status::Periodic, "{name}");
            let at =
                |column: &str| row.measures[model.columns().iter().position(|c| c.name == column).unwrap()];
            [at("stroke_amplitude_deg"), at("pitch_amplitude_deg"), at("energy_audit")]
        };
        let [stroke_before, pitch_before, _] = rows(&values);
        let [stroke_after, _, audit] = rows(&set(&[("stroke_stiffening", stroke)]));
        assert!((stroke_after / stroke_before - 1.0).abs() > 1e-3 && audit.abs() < 1e-6, "{name}");
        // A cubic hinge with the stop at 0 and half of the stiffness: k ψ = ½ k ψ + ½ k ψ.
        let stiffness = values[Parameter::index(model.parameters(), "hinge_stiffness").unwrap()];
        let damping = values[Parameter::index(model.parameters(), "hinge_damping").unwrap()];
        let split = rows(&set(&[
            ("hinge_stiffness", 0.5 * stiffness),
            ("hinge_stop_angle", 0.0),
            ("hinge_stop_stiffness", 0.5 * stiffness),
            ("hinge_damping", damping),
        ]));
        assert_close(split[0], stroke_before, 1e-7, name);
        assert_close(split[1], pitch_before, 1e-7, name);
        let [_, stiffer, audit] = rows(&set(&[("hinge_stiffening", hinge)]));
        assert!((stiffer / pitch_before - 1.0).abs() > 1e-3 && audit.abs() < 1e-6, "{name}");
    }
}

/// The derivative of `state` under a constant voltage, for a preset with changed parameters.
fn derivative<M: Model<4, Input<f64> = Wave<f64>>>(
    model: &M,
    name: &str,
    changes: &[(&str, f64)],
    voltage: f64,
    state: &[f64; 4],
) -> [f64; 4] {
    let (simulator, preset) = preset(name).unwrap();
    let mut values = (preset.values)();
    for (name, value) in changes {
        values[Parameter::index(simulator.parameters(), name).unwrap()] = *value;
    }
    let constants = model.start(&values).unwrap().constants;
    model.variant(&values).rhs(&constants, &Wave::with_rate(voltage, 0.0), 1.0, state)
}

/// The moment −k₃ φ³ accelerates the wing as a voltage does whose moment per volt is known. The moment −κ₃ ψ³ equals the
/// moment of a hinge whose linear stiffness is larger by κ₃ ψ².
fn assert_stiffening<M: Model<4, Input<f64> = Wave<f64>>>(
    model: &M,
    name: &str,
    moment_per_volt: f64,
    phi: f64,
) {
    let state = [phi, 0.6, 40.0, -50.0];
    let at = |changes: &[(&str, f64)], voltage| derivative(model, name, changes, voltage, &state);
    let (before, driven, stiffened) =
        (at(&[], 10.0), at(&[], 11.0), at(&[("stroke_stiffening", 2e-3)], 10.0));
    for i in 2..4 {
        let expected = -2e-3 * phi.powi(3) / moment_per_volt * (driven[i] - before[i]);
        assert_close(stiffened[i] - before[i], expected, 1e-8, name);
    }
    let (simulator, preset) = preset(name).unwrap();
    let linear = (preset.values)()[Parameter::index(simulator.parameters(), "hinge_stiffness").unwrap()];
    let stiffer = at(&[("hinge_stiffness", linear + 1e-5 * 0.36)], 10.0);
    let cubic = at(&[("hinge_stiffening", 1e-5)], 10.0);
    for i in 2..4 {
        assert_close(cubic[i] - before[i], stiffer[i] - before[i], 1e-8, name);
    }
}

#[test]
fn cubic_springs_have_their_moments() {
    let c = direct_drive::Constants::derive(&direct_drive::Params::ozaki2018_large()).unwrap();
    assert_stiffening(&DirectDrive::SINE, "ozaki2018-large", c.gamma, 0.4);
    let c = four_bar::Constants::derive(&four_bar::Params::arabagi2013_75hz()).unwrap();
    let per_volt = c.actuator.stiffness * c.actuator.deflection * four_bar::transmission(&c, 0.4).slope;
    assert_stiffening(&FourBar::SINE, "arabagi2013-75hz", per_volt, 0.4);
}

/// A field that softens the plates acts as a smaller modulus. The mean field of both plates is half of V_pp divided by
/// the thickness.
#[test]
fn a_field_softens_the_plates() {
    let (model, _) = preset("jafferis2016").unwrap();
    let p = bimorph::Params { drive_voltage_pp: 160.0, ..bimorph::Params::jafferis2016() };
    let decline = 0.4e-6;
    let soft = 1.0 - decline * 0.5 * p.drive_voltage_pp / p.piezo_thickness;
    let softened = bimorph::Params { modulus_decline: decline, ..p.clone() };
    let scaled = bimorph::Params {
        piezo_modulus_min: soft * p.piezo_modulus_min,
        piezo_modulus_max: soft * p.piezo_modulus_max,
        ..p.clone()
    };
    let solver = SolverSettings::default().with_rtol(1e-9);
    let row = |p: &bimorph::Params| {
        let row = model.run_point(&PointRun::new(Backend::best(), &solver, &p.to_values()), None);
        let columns = ["stroke_pp_deg", "pitch_pp_deg", "power_mean_mw", "energy_audit"];
        columns.map(|name| row.measures[model.columns().iter().position(|c| c.name == name).unwrap()])
    };
    let (found, expected, before) = (row(&softened), row(&scaled), row(&p));
    for i in 0..3 {
        assert_close(found[i], expected[i], 1e-7, "measure");
    }
    assert!((found[0] / before[0] - 1.0).abs() > 0.01 && found[3].abs() < 1e-7, "{found:?}, {before:?}");
    // A stiff shim does not replace plates without stiffness.
    let none = bimorph::Params { modulus_decline: 1e-5, shim_modulus: 5e12, ..p };
    assert!(bimorph::Constants::derive(&none).unwrap_err().to_string().contains("no stiffness"));
}

/// With all terms together the energy is balanced, on lanes and on scalars.
#[test]
fn energy_is_balanced_with_all_terms() {
    for name in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let (model, preset) = preset(name).unwrap();
        let mut values = (preset.values)();
        let mut set = |name: &str, value: f64| {
            if let Some(index) = Parameter::index(model.parameters(), name) {
                values[index] = value;
            }
        };
        set("circulation_factor", 0.7);
        set("rotation_force_factor", 0.6);
        set("added_mass_factor", 0.5);
        set("hinge_stop_angle", 0.8);
        let stiffness = if name == "jafferis2016" { 1e-6 } else { 1e-5 };
        set("hinge_stop_stiffness", stiffness);
        set("hinge_stiffening", stiffness);
        set("stroke_stiffening", stiffness);
        set("modulus_decline", 1e-8);
        for (term, value) in HARMONICS {
            set(term, value);
        }
        let solver = SolverSettings::default().with_rtol(1e-8);
        let row = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
        assert_eq!(row.status, Status::Periodic, "{name}");
        let audit = model.columns().iter().position(|c| c.name == "energy_audit").unwrap();
        assert!(row.measures[audit].abs() < 1e-6, "{name}: {}", row.measures[audit]);
    }
}
