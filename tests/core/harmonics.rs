//! Further terms of the force coefficients and of the centre of pressure, against sums over strips.

use std::f64::consts::{FRAC_PI_2, PI};

use flap_core::body::BodyParameters;
use flap_core::model::bimorph::{self, Bimorph};
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::model::four_bar::{self, FourBar};
use flap_core::model::{ExperimentModel, Instant, Load};
use flap_core::parameter::Parameter;
use flap_core::quadrature::gauss_legendre;

use crate::data::assert_close;
use crate::sections::{STATES, assert_difference, components, difference};

/// Velocity (m/s) and rates (rad/s) of the shoulder. The first motion is rest.
const MOTIONS: [[f64; 6]; 4] = [
    [0.0; 6],
    [0.0, 0.0, 0.8, 0.0, 0.0, 0.0],
    [0.0, 0.0, -3.0, 0.0, 0.0, 0.0],
    [0.9, -0.4, 0.7, 30.0, -20.0, 45.0],
];

/// A state in which the trailing edge leads, so that attack angles exceed 90°.
const LEADING: ([f64; 4], [f64; 2]) = ([-0.2, -0.5, 500.0, 300.0], [1e5, 2e5]);

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
/// The shoulder has this velocity (m/s) and these rates (rad/s). The state is [φ, ψ, φ̇, ψ̇].
fn translational(
    strips: &[Strip],
    density: f64,
    law: impl Fn(f64) -> [f64; 3],
    [v_x, v_y, v_z, r_x, r_y, r_z]: [f64; 6],
    [phi, psi, phi_dot, psi_dot]: [f64; 4],
) -> Load<f64> {
    let (sin, cos) = psi.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let v_t = v_x * cos_phi - v_y * sin_phi;
    let (r_t, r_s) = (r_x * cos_phi - r_y * sin_phi, r_x * sin_phi + r_y * cos_phi);
    let mut load =
        Load { stroke: phi, lift: 0.0, drag: 0.0, lift_moment: 0.0, drag_moment: 0.0, span_moment: 0.0 };
    for &[area, radius, lever, behind, chord] in strips {
        let u = radius * (phi_dot - r_z) + v_t - behind * (psi_dot + r_s) * cos;
        let w = v_z + radius * r_t;
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

/// Returns the load of a model at stroke and pitch with their rates and accelerations, for this motion of the shoulder.
fn load<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    motion: [f64; 6],
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> Load<f64> {
    let mut values = values.to_vec();
    for (name, value) in BodyParameters::MOTION.into_iter().zip(motion) {
        values[index::<M>(name)] = value;
    }
    let pitch = [psi, psi_dot, psi_ddot].map(|value| f64::from(M::DESCRIPTION.pitch_sign) * value);
    let model = model.variant(&values);
    let c = model.start(&values).unwrap().constants;
    let (y, dy, input) = M::placed(&c, [phi, phi_dot, phi_ddot], pitch);
    let side = model.switch(&c, &y, &dy)[0].signum();
    model.load(&c, Instant { input: &input, side, y: &y, dy: &dy })
}

fn index<M: ExperimentModel<4>>(name: &str) -> usize {
    Parameter::index(M::DESCRIPTION.parameters, name).unwrap()
}

/// Returns the load of a model without and with the terms, in a state and a motion of the shoulder.
fn loads<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    motion: [f64; 6],
    state: ([f64; 4], [f64; 2]),
) -> [Load<f64>; 2] {
    let mut with = values.to_vec();
    for (name, value) in HARMONICS {
        with[index::<M>(name)] = value;
    }
    [values, &with].map(|values| load(model, values, motion, state))
}

/// Asserts that the terms change the loads and the sums over strips equally, at these motions of the shoulder. `law`
/// returns drag coefficient, lift coefficient and centre of pressure at an attack angle, with `share` times the terms.
fn assert_terms<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    (strips, density): (&[Strip], f64),
    law: impl Fn(f64, f64) -> [f64; 3],
    motions: &[[f64; 6]],
) {
    for state in STATES {
        for &motion in motions {
            let [without, with] = loads(model, values, motion, state);
            let sum =
                |share: f64| translational(strips, density, |attack| law(attack, share), motion, state.0);
            let expected = difference(&sum(1.0), &sum(0.0));
            assert_difference(&with, &without, &expected, &format!("{} at {motion:?}", M::DESCRIPTION.name));
        }
    }
}

/// Asserts that a parameter changes the load on a moving body as it changes the sum over strips. `sum` returns the sum
/// with (true) or without the change.
fn assert_change<M: ExperimentModel<4>>(
    model: &M,
    values: &[f64],
    (name, value): (&str, f64),
    sum: impl Fn(bool, [f64; 6], [f64; 4]) -> Load<f64>,
) {
    let mut changed = values.to_vec();
    changed[index::<M>(name)] = value;
    for state in STATES.into_iter().chain([LEADING]) {
        for motion in &MOTIONS[1..] {
            let (before, after) =
                (load(model, values, *motion, state), load(model, &changed, *motion, state));
            let expected = difference(&sum(true, *motion, state.0), &sum(false, *motion, state.0));
            assert_difference(&after, &before, &expected, &format!("{name} at {motion:?}"));
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
    assert_terms(&Bimorph::SINE, &p.to_values(), (&[strip], p.air_density), law, &MOTIONS[..1]);
    // On a moving body, the wing is cut into strips, which are exact at rest.
    for state in STATES {
        let [_, rest] = loads(&Bimorph::SINE, &p.to_values(), MOTIONS[0], state);
        let slow = [0.0, 0.0, 1e-13, 0.0, 0.0, 0.0];
        let [_, moving] = loads(&Bimorph::SINE, &p.to_values(), slow, state);
        for (moving, rest) in components(&moving).into_iter().zip(components(&rest)) {
            assert_close(moving, rest, 1e-10, "load");
        }
    }
}

/// Nodes r̂ and weights of the strips of `jafferis2016`, and the ratio λ of their lever arms to their radii: with the
/// default of `wing_radius_1`, and with 0.5.
const BETA_STRIPS: [([[f64; 2]; 4], f64); 2] = [
    (
        [
            [0.097_148_566_025_711_54, 0.134_584_576_913_686_64],
            [0.348_021_337_564_673, 0.359_274_562_414_493_1],
            [0.656_776_822_583_088_3, 0.364_769_759_509_166_3],
            [0.905_698_779_134_361_5, 0.141_371_101_162_653_94],
        ],
        1.135_820_593_249_570_9,
    ),
    (
        [
            [0.087_428_916_591_347_1, 0.147_611_850_385_037_24],
            [0.340_879_226_007_387_2, 0.352_388_149_614_962_8],
            [0.659_120_773_992_612_8, 0.352_388_149_614_962_8],
            [0.912_571_083_408_652_9, 0.147_611_850_385_037_24],
        ],
        1.118_289_517_093_070_2,
    ),
];

#[test]
fn readings_and_radii_of_the_bimorph_are_those_of_its_strips() {
    let p = bimorph::Params::jafferis2016();
    let strips = BETA_STRIPS.map(|(nodes, ratio)| {
        let strip = |[node, weight]: [f64; 2]| {
            let radius = p.wing_length * node;
            [p.wing_area * weight, radius, ratio * radius, 0.0, p.wing_area / p.wing_length]
        };
        nodes.map(strip)
    });
    let law = |attack: f64, is_directional: bool| {
        let [drag, lift] =
            harmonic(attack, p.drag_coefficient_max, p.drag_coefficient_min, p.lift_coefficient_max);
        let angle = if is_directional { attack } else { attack.min(PI - attack) };
        [drag, lift, p.pressure_min + (p.pressure_max - p.pressure_min) * angle / FRAC_PI_2]
    };
    let values = p.to_values();
    let sum = |strips: &[Strip], is_directional, motion, state| {
        translational(strips, p.air_density, |attack| law(attack, is_directional), motion, state)
    };
    let directional = f64::from(bimorph::CentreOfPressure::Directional as u8);
    assert_change(&Bimorph::SINE, &values, ("centre_of_pressure", directional), |changed, motion, state| {
        sum(&strips[0], changed, motion, state)
    });
    assert_change(&Bimorph::SINE, &values, ("wing_radius_1", 0.5), |changed, motion, state| {
        sum(&strips[usize::from(changed)], false, motion, state)
    });
    // The load depends on the stroke, not on the displacement of the actuator that belongs to it.
    assert_change(&Bimorph::SINE, &values, ("transmission_growth", 2e9), |_, motion, state| {
        sum(&strips[0], false, motion, state)
    });
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
    assert_terms(&DirectDrive::SINE, &p.to_values(), (&strips, p.air_density), law, &MOTIONS);
    let folded = f64::from(direct_drive::CentreOfPressure::Folded as u8);
    let reading = |attack: f64, is_folded: bool| {
        let [drag, lift, _] = law(attack, 0.0);
        let angle = if is_folded { attack.min(PI - attack) } else { attack };
        [drag, lift, p.pressure_slope * angle + p.pressure_offset]
    };
    let values = p.to_values();
    assert_change(&DirectDrive::SINE, &values, ("centre_of_pressure", folded), |changed, motion, state| {
        translational(&strips, p.air_density, |attack| reading(attack, changed), motion, state)
    });
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
    assert_terms(&FourBar::SINE, &p.to_values(), (&strips, p.air_density), law, &MOTIONS);
    let axis = f64::from(four_bar::Arms::Axis as u8);
    let values = p.to_values();
    assert_change(&FourBar::SINE, &values, ("arms", axis), |changed, motion, state| {
        let (behind, origin) = if changed { (0.5 - p.axis_position, p.axis_position) } else { (0.5, 0.0) };
        let strips: Vec<Strip> = strips
            .iter()
            .map(|&[area, radius, lever, _, chord]| [area, radius, lever, behind * chord, chord])
            .collect();
        let law = |attack: f64| {
            let [drag, lift, place] = law(attack, 0.0);
            [drag, lift, place - origin]
        };
        translational(&strips, p.air_density, law, motion, state)
    });
}
