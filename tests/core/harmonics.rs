//! Further terms of the force coefficients and of the centre of pressure, against sums over strips.

use std::f64::consts::{FRAC_PI_2, PI};

use flap_core::model::bimorph::{self, Bimorph};
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::model::four_bar::{self, FourBar};
use flap_core::model::{ExperimentModel, Instant, Load};
use flap_core::parameter::Parameter;
use flap_core::quadrature::gauss_legendre;

use crate::data::assert_close;
use crate::sections::{STATES, assert_difference, components};

/// Values of the terms.
pub(crate) const HARMONICS: [(&str, f64); 6] = [
    ("drag_term_0", 0.3),
    ("drag_term_1", -0.4),
    ("lift_term_1", 0.35),
    ("lift_term_2", -0.25),
    ("pressure_term_0", 0.04),
    ("pressure_term_1", -0.03),
];

/// Returns the terms of drag coefficient, lift coefficient and centre of pressure at an attack angle (rad), as Fourier series.
fn terms(attack: f64) -> [f64; 3] {
    let [d_0, d_1, l_1, l_2, p_0, p_1] = HARMONICS.map(|(_, value)| value);
    let sin = |harmonic: f64| (2.0 * harmonic * attack).sin();
    let cos = |harmonic: f64| (2.0 * harmonic * attack).cos();
    [
        0.5 * d_0 * (1.0 - cos(2.0)) + 0.25 * d_1 * (cos(1.0) - cos(3.0)),
        0.5 * l_1 * sin(2.0) + 0.25 * l_2 * (sin(1.0) + sin(3.0)),
        p_0 * sin(1.0) + 0.5 * p_1 * sin(2.0),
    ]
}

/// A strip: area (m^2), distance from the stroke axis, and lever of its forces. The last two elements are the distance
/// `behind` the pitch axis and the reference length of the centre of pressure (m). The velocity of a strip is the
/// velocity at the distance `behind`.
type Strip = [f64; 5];

/// Returns the load of translational forces on strips, for a law of C_D, C_L and centre of pressure behind the pitch axis.
///
/// The body moves upwards with the velocity `up` (m/s). The state is [φ, ψ, φ̇, ψ̇].
fn translational(
    strips: &[Strip],
    density: f64,
    law: impl Fn(f64) -> [f64; 3],
    up: f64,
    [phi, psi, phi_dot, psi_dot]: [f64; 4],
) -> Load<f64> {
    let (sin, cos) = psi.sin_cos();
    let mut load =
        Load { stroke: phi, lift: 0.0, drag: 0.0, lift_moment: 0.0, drag_moment: 0.0, span_moment: 0.0 };
    for &[area, radius, lever, behind, chord] in strips {
        let (u, w) = (radius * phi_dot - behind * psi_dot * cos, up);
        let (along_normal, along_chord) = (u * cos - w * sin, u * sin + w * cos);
        let [c_d, c_l, place] = law(f64::atan2(along_normal.abs(), along_chord));
        let dynamic = 0.5 * density * area * u.hypot(w);
        // Drag is opposite to the velocity (u, w), and lift perpendicular to it.
        let lifting = c_l * along_normal.signum();
        let (across, upwards) = (dynamic * (-c_d * u - lifting * w), dynamic * (-c_d * w + lifting * u));
        load.lift += upwards;
        load.drag -= across;
        load.lift_moment += lever * upwards;
        load.drag_moment -= lever * across;
        load.span_moment -= (across * cos - upwards * sin) * chord * place;
    }
    load
}

/// Returns the load of a model without and with the terms, at stroke and pitch with their rates and accelerations.
fn loads<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    up: f64,
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> [Load<f64>; 2] {
    let index = |name: &str| Parameter::index(M::DESCRIPTION.parameters, name).unwrap();
    let mut without = values.to_vec();
    without[index("body_velocity_up")] = up;
    let mut with = without.clone();
    for (name, value) in HARMONICS {
        with[index(name)] = value;
    }
    let pitch = [psi, psi_dot, psi_ddot].map(|value| f64::from(M::PITCH_SIGN) * value);
    [without, with].map(|values| {
        let model = model.variant(&values);
        let c = model.start(&values).unwrap().constants;
        let (y, dy, input) = M::placed(&c, [phi, phi_dot, phi_ddot], pitch);
        let side = model.switch(&c, &y, &dy)[0].signum();
        model.load(&c, Instant { input: &input, side, y: &y, dy: &dy })
    })
}

/// Asserts that the terms change the loads and the sums over strips equally, at these velocities of the body. `law`
/// returns drag coefficient, lift coefficient and centre of pressure at an attack angle, with `share` times the terms.
fn assert_terms<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    (strips, density): (&[Strip], f64),
    law: impl Fn(f64, f64) -> [f64; 3],
    velocities: &[f64],
) {
    for state in STATES {
        for &up in velocities {
            let [without, with] = loads(model, values, up, state);
            let sum = |share: f64| translational(strips, density, |attack| law(attack, share), up, state.0);
            let (before, after) = (sum(0.0), sum(1.0));
            let expected = Load {
                stroke: before.stroke,
                lift: after.lift - before.lift,
                drag: after.drag - before.drag,
                lift_moment: after.lift_moment - before.lift_moment,
                drag_moment: after.drag_moment - before.drag_moment,
                span_moment: after.span_moment - before.span_moment,
            };
            assert_difference(&with, &without, &expected, &format!("{} at {up} m/s", M::DESCRIPTION.name));
        }
    }
}

/// Returns drag and lift coefficient without the terms.
fn harmonic(attack: f64, drag_max: f64, drag_min: f64, lift: f64) -> [f64; 2] {
    let (sin, cos) = (2.0 * attack).sin_cos();
    [0.5 * (drag_max + drag_min) - 0.5 * (drag_max - drag_min) * cos, lift * sin]
}

#[test]
fn the_load_of_the_bimorph_has_the_terms() {
    let p = bimorph::Params::jafferis2016();
    let law = |attack: f64, share: f64| {
        let [drag, lift] =
            harmonic(attack, p.drag_coefficient_max, p.drag_coefficient_min, p.lift_coefficient_max);
        let [more_drag, more_lift, _] = terms(attack);
        // The centre of pressure depends on the attack angle folded to at most 90°.
        let folded = attack.min(PI - attack);
        let place = p.pressure_min + (p.pressure_max - p.pressure_min) * folded / FRAC_PI_2;
        [drag + share * more_drag, lift + share * more_lift, place + share * terms(folded)[2]]
    };
    let radius = p.wing_radius_2 * p.wing_length;
    let strip = [p.wing_area, radius, p.pressure_radius, 0.0, p.wing_area / p.wing_length];
    assert_terms(&Bimorph::SINE, &p.to_values(), (&[strip], p.air_density), law, &[0.0]);
    // On a moving body, the wing is cut into strips, which are exact at rest.
    for state in STATES {
        let [_, rest] = loads(&Bimorph::SINE, &p.to_values(), 0.0, state);
        let [_, moving] = loads(&Bimorph::SINE, &p.to_values(), 1e-13, state);
        for (moving, rest) in components(&moving).into_iter().zip(components(&rest)) {
            assert_close(moving, rest, 1e-10, "load");
        }
    }
}

#[test]
fn the_load_of_blade_elements_has_the_terms() {
    let p = direct_drive::Params {
        flow_direction: direct_drive::FlowDirection::Blade,
        lift_coefficient_max: Some(1.7),
        ..direct_drive::Params::ozaki2018_large()
    };
    let rule = gauss_legendre(8);
    let strips = rule.iter().map(|node| {
        let z = 2.0 * node.x - 1.0;
        let shape = 1.0
            + p.chord_legendre_1 * z
            + p.chord_legendre_2 * 0.5 * (3.0 * z * z - 1.0)
            + p.chord_legendre_3 * 0.5 * z * (5.0 * z * z - 3.0);
        let (radius, chord) = (0.5 * p.actuator_length + p.wing_length * node.x, p.mean_chord * shape);
        [chord * p.wing_length * node.weight, radius, radius, 0.5 * chord, chord]
    });
    let strips: Vec<Strip> = strips.collect();
    let law = |attack: f64, share: f64| {
        let [drag, lift] = harmonic(attack, p.drag_coefficient_max, p.drag_coefficient_min, 1.7);
        let more = terms(attack).map(|term| share * term);
        [drag + more[0], lift + more[1], p.pressure_slope * attack + p.pressure_offset + more[2]]
    };
    assert_terms(&DirectDrive::SINE, &p.to_values(), (&strips, p.air_density), law, &[0.0, 0.8, -3.0]);
}

#[test]
fn the_load_of_the_strips_of_the_four_bar_has_the_terms() {
    let p = four_bar::Params::arabagi2013_75hz();
    let rule = gauss_legendre(16);
    let strips = rule.iter().map(|node| {
        let (radius, chord) = (p.wing_offset + p.wing_length * node.x, p.chord(node.x));
        [chord * p.wing_length * node.weight, radius, radius, 0.5 * chord, chord]
    });
    let strips: Vec<Strip> = strips.collect();
    let law = |attack: f64, share: f64| {
        let folded = attack.min(PI - attack);
        let lift = p.lift_offset + p.lift_amplitude * (p.lift_slope * folded - p.lift_phase).sin();
        let drag = p.drag_offset - p.drag_amplitude * (p.drag_slope * folded - p.drag_phase).cos();
        let more = terms(attack).map(|term| share * term);
        let lift = lift * (FRAC_PI_2 - attack).signum();
        [drag + more[0], lift + more[1], p.pressure_slope * attack + p.pressure_offset + more[2]]
    };
    assert_terms(&FourBar::SINE, &p.to_values(), (&strips, p.air_density), law, &[0.0, 0.8, -3.0]);
}
