//! Rotational circulation and added mass of the wing's sections, against sums over the chord, and in the equations of motion.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

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

/// A section: distance from the stroke axis, chord and width (m).
type Section = [f64; 3];

/// Sums over sections of the load of circulation (times `circulation`), added mass (times `added`), and rotational drag with the
/// coefficient `rotation`, in the directions of [`Load`]. The pitch axis is `axis` chords behind the leading edge.
fn summed(
    sections: &[Section],
    density: f64,
    axis: f64,
    [circulation, added, rotation]: [f64; 3],
    ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]): ([f64; 4], [f64; 2]),
) -> Load<f64> {
    let (sin, cos) = psi.sin_cos();
    let mut load =
        Load { stroke: phi, lift: 0.0, drag: 0.0, lift_moment: 0.0, drag_moment: 0.0, span_moment: 0.0 };
    for [r, c, width] in sections {
        // Γ = π (3/4 − x₀) c² ψ̇, with the force ρ u_C Γ along the normal (cos ψ e_t − sin ψ e_z).
        let vortex = circulation * PI * (0.75 - axis) * c * c * psi_dot;
        let lifting = density * (r * phi_dot * sin) * vortex * width;
        // The plate's mid-chord moves along its normal with r φ̇ cos ψ − d ψ̇.
        let depth = (0.5 - axis) * c;
        let acceleration = r * (phi_ddot * cos - phi_dot * psi_dot * sin) - depth * psi_ddot;
        let mass = added * FRAC_PI_4 * density * c * c * width;
        let inertial = -mass * acceleration;
        let rotational = -mass * c * c / 32.0 * psi_ddot;
        // Parts of the chord at the distance z behind the axis move with z ψ̇. Their moment is in the paper already.
        let parts = gauss_legendre(40);
        let drag = parts.iter().map(|node| {
            // Both sides of the axis, so that no part contains the kink of z|z|.
            let (before, behind) = (-axis * c * node.x, (1.0 - axis) * c * node.x);
            (behind * behind.abs() * (1.0 - axis) + before * before.abs() * axis) * c * node.weight
        });
        let dragging = 0.5 * density * rotation * psi_dot * psi_dot.abs() * drag.sum::<f64>() * width;
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
    for at in STATES {
        let load = |p: &bimorph::Params| {
            let c = bimorph::Constants::derive(p).unwrap();
            let model = Bimorph::SINE.variant(&p.to_values());
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
            let drag = factors[2] * plain.drag_coefficient_max;
            let expected = summed(&sections, plain.air_density, 0.1, [factors[0], factors[1], drag], at);
            assert_difference(&load(&with), &without, &expected, &format!("{factors:?}"));
        }
    }
}

/// The models `direct-drive` and `four-bar` already contain added mass.
#[test]
fn the_circulation_of_strips_is_the_sum_over_sections() {
    let direct = direct_drive::Params {
        flow_direction: direct_drive::FlowDirection::Blade,
        ..direct_drive::Params::ozaki2018_large()
    };
    let bar = four_bar::Params::arabagi2013_75hz();
    let root = 0.5 * direct.actuator_length;
    let rule = gauss_legendre(8);
    let direct_sections: Vec<Section> = rule
        .iter()
        .map(|node| {
            let z = 2.0 * node.x - 1.0;
            let chord = 1.0
                + direct.chord_legendre_1 * z
                + direct.chord_legendre_2 * 0.5 * (3.0 * z * z - 1.0)
                + direct.chord_legendre_3 * 0.5 * z * (5.0 * z * z - 3.0);
            [root + direct.wing_length * node.x, direct.mean_chord * chord, direct.wing_length * node.weight]
        })
        .collect();
    let rule = gauss_legendre(16);
    let bar_sections: Vec<Section> = rule
        .iter()
        .map(|node| {
            [bar.wing_offset + bar.wing_length * node.x, bar.chord(node.x), bar.wing_length * node.weight]
        })
        .collect();
    for at in STATES {
        let ([phi, psi, phi_dot, psi_dot], [phi_ddot, psi_ddot]) = at;
        let load = |factor: f64| {
            let p = direct_drive::Params {
                circulation_factor: factor,
                rotation_force_factor: 0.4 * factor,
                ..direct.clone()
            };
            let c = direct_drive::Constants::derive(&p).unwrap();
            let model = DirectDrive::SINE.variant(&p.to_values());
            let input = model.input(&c, 0.0);
            let dy = [phi_dot, psi_dot, phi_ddot, psi_ddot];
            model.load(&c, Instant { input: &input, side: 1.0, y: &[phi, psi, phi_dot, psi_dot], dy: &dy })
        };
        let expected =
            summed(&direct_sections, direct.air_density, 0.0, [0.7, 0.0, 0.28 * direct.rotation_drag], at);
        assert_difference(&load(0.7), &load(0.0), &expected, "direct-drive");
        // Its pitch has the opposite sign.
        let load = |factor: f64| {
            let p = four_bar::Params { circulation_factor: factor, ..bar.clone() };
            let c = four_bar::Constants::derive(&p).unwrap();
            let model = FourBar::SINE.variant(&p.to_values());
            let input = model.input(&c, 0.0);
            let dy = [phi_dot, -psi_dot, phi_ddot, -psi_ddot];
            model.load(&c, Instant { input: &input, side: 1.0, y: &[phi, -psi, phi_dot, -psi_dot], dy: &dy })
        };
        let expected = summed(&bar_sections, bar.air_density, bar.axis_position, [0.7, 0.0, 0.0], at);
        assert_difference(&load(0.7), &load(0.0), &expected, "four-bar");
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
