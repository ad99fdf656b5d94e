use flap_core::model::direct_drive::{Constants, DirectDrive, FlowDirection, Params};
use flap_core::piezo::Laminate;
use flap_core::simulate::preset;

use super::params;
use crate::by_name::layer;
use crate::data::{assert_close, table};
use crate::probe::modes;

fn laminate(p: &Params) -> Laminate<3> {
    Laminate::of(["piezo", "adhesive", "shim"].map(|name| layer(Params::TABLE, &p.to_values(), name)))
}

#[test]
fn equal_the_reference_to_1e_12() {
    for kind in ["small", "large"] {
        let p = params(kind);
        let laminate = laminate(&p);
        let z = laminate.mid_planes;
        let c = Constants::derive(&p).unwrap();
        let area = p.mean_chord * p.wing_length;
        let [mode_1, mode_2] = modes::<DirectDrive>(&c);
        let x_g = p.mass_centre_span + 0.5 * p.actuator_length;
        let wing = p.wing_mass * x_g * x_g + p.wing_inertia_chord;
        // A beam of length l that bends to an arc by φ has the curvature φ/l.
        let strain = laminate.neutral_axis / p.actuator_length;
        assert_close(c.strain_per_stroke, strain, 1e-12, kind);
        for row in table("direct-drive/derived_constants.csv") {
            let actual = match row.text("name") {
                "z0" => z[0],
                "z1" => z[1],
                "z2" => z[2],
                "zc" => laminate.neutral_axis,
                "SA" => laminate.bending_stiffness,
                "mu" => laminate.areal_density,
                "JA" => c.m11 - p.leading_edge_inertia - wing,
                "kphi" => c.k_phi,
                "Gamma" => c.gamma,
                "Cp" => c.c_p,
                "x_r" => c.mid_radius - 0.5 * p.wing_length,
                "m11" => c.m11,
                "ms" => c.m_s,
                "m12" => c.m12,
                "m22" => c.m22,
                "a11" => c.added.a11,
                "a12" => c.added.a12,
                "a22" => c.added.a22,
                "f1" => c.added.f1,
                "f2" => c.added.f2,
                "KL" => c.k_lift,
                "A_w" => area,
                "krot" => c.rotation,
                "mode1_Hz" => mode_1,
                "mode2_Hz" => mode_2,
                other => panic!("the reference has a constant {other} that is not compared"),
            };
            assert_close(actual, row.number(kind), 1e-12, &format!("{} of {kind}", row.text("name")));
        }
    }
}

/// Eq. (33): I_rd = c̄⁴ I_04 / 4, to the three digits of Table A1.
#[test]
fn printed_rotation_moment_is_that_of_the_shape() {
    for kind in ["small", "large"] {
        let p = params(kind);
        assert_close(p.rotation_moment, p.mean_chord.powi(4) * p.shape_moment_04 / 4.0, 3e-3, kind);
    }
}

/// Eq. (22) of a rectangular wing: I_ij = ((1 + x)^{i+1} − x^{i+1}) / (i + 1), x = x_r / R.
#[test]
fn shape_moments_of_a_rectangle() {
    let p = Params::ozaki2018_small();
    let rectangle = Params { chord_legendre_1: 0.0, chord_legendre_2: 0.0, chord_legendre_3: 0.0, ..p };
    let p = rectangle.with_chord_moments();
    let x = 0.5 * p.actuator_length / p.wing_length;
    let expected = |i: i32| ((1.0 + x).powi(i + 1) - x.powi(i + 1)) / f64::from(i + 1);
    for (i, actual) in [
        (0, p.shape_moment_03),
        (0, p.shape_moment_04),
        (1, p.shape_moment_12),
        (1, p.shape_moment_13),
        (2, p.shape_moment_21),
        (2, p.shape_moment_22),
        (3, p.shape_moment_31),
    ] {
        assert_close(actual, expected(i), 1e-14, &format!("I_{i}"));
    }
    assert_close(p.rotation_moment, 0.25 * p.mean_chord.powi(4), 1e-14, "I_rd");
    assert_close(p.midspan_chord.unwrap(), p.mean_chord, 1e-15, "midspan chord");
}

/// The presets' chords have the moments of Table A1, if the wing's root is at the distance that follows from these
/// moments.
#[test]
fn shape_moments_of_the_presets_chords_are_the_printed_ones() {
    for (kind, offset) in [("small", 0.3528), ("large", 0.3613)] {
        let printed = params(kind);
        let wing_offset = Some(offset * printed.wing_length);
        let chord = Params { wing_offset, ..printed.clone() }.with_chord_moments();
        for (printed, actual) in [
            (printed.shape_moment_03, chord.shape_moment_03),
            (printed.shape_moment_04, chord.shape_moment_04),
            (printed.shape_moment_12, chord.shape_moment_12),
            (printed.shape_moment_13, chord.shape_moment_13),
            (printed.shape_moment_21, chord.shape_moment_21),
            (printed.shape_moment_22, chord.shape_moment_22),
            (printed.shape_moment_31, chord.shape_moment_31),
        ] {
            println!("{kind}: {actual:.4} against {printed}");
            assert!((actual - printed).abs() < 0.005, "{kind}: {actual} is not {printed}");
        }
    }
}

/// With blade elements, flap computes all moments from the chord and ignores given moments.
#[test]
fn given_moments_are_not_used_with_blade_elements() {
    let blade = Params { flow_direction: FlowDirection::Blade, ..Params::ozaki2018_large() };
    let other =
        Params { shape_moment_22: 9.0, rotation_moment: 1.0, midspan_chord: Some(1.0), ..blade.clone() };
    let constants = Constants::derive(&blade).unwrap();
    assert_eq!(constants, Constants::derive(&other).unwrap());
    let uniform = Params { flow_direction: FlowDirection::Uniform, ..blade.clone() }.with_chord_moments();
    let uniform = Constants::derive(&uniform).unwrap();
    assert_eq!(constants, Constants { blades: constants.blades, ..uniform });
    let negative = Params { chord_legendre_1: 1.2, ..blade };
    let error = Constants::derive(&negative).unwrap_err();
    assert!(error.to_string().contains("the chord is negative"), "{error}");
}

#[test]
fn following_parameters_follow_until_they_are_set() {
    let p = Params::ozaki2018_small();
    let derived = |p: Params| Constants::derive(&p).unwrap();
    assert_eq!(derived(p.clone()).drive.bias, 30.0);
    assert_eq!(derived(Params { drive_bias: Some(-5.0), ..p.clone() }).drive.bias, -5.0);
    let set = Params { wing_offset: Some(5.25e-3), midspan_chord: Some(6.51e-3), ..p.clone() };
    assert_eq!(derived(set), derived(p.clone()));
    let longer = Params { actuator_length: 2.0 * p.actuator_length, ..p };
    assert_eq!(derived(longer).mid_radius, 0.5 * 17.0e-3 + 10.5e-3);
}

#[test]
fn impossible_inertias_are_refused() {
    let p = Params::ozaki2018_small();
    let error = Constants::derive(&Params { wing_inertia_product: 1e-9, ..p.clone() }).unwrap_err();
    assert!(error.to_string().contains("not positive definite"), "{error}");
    let error = Constants::derive(&Params { wing_length: 1e200, ..p }).unwrap_err();
    assert!(error.to_string().contains("not finite"), "{error}");
}

/// The presets with swapped hinges differ from the published presets only in the hinges of Table A1.
#[test]
fn swapped_presets_swap_the_hinges() {
    let [small, large] = [Params::ozaki2018_small(), Params::ozaki2018_large()];
    let swapped = |name: &str| Params::from_values(&(preset(name).unwrap().1.values)());
    assert_eq!(swapped("ozaki2018-small-kw-swapped"), Params { hinge_stiffness: 8.64e-5, ..small });
    assert_eq!(swapped("ozaki2018-large-kw-swapped"), Params { hinge_stiffness: 1.48e-4, ..large });
}

#[test]
fn natural_frequencies_of_uncoupled_springs() {
    let square = (2.0 * std::f64::consts::PI).powi(2);
    let in_vacuum = Params { air_density: 0.0, ..Params::ozaki2018_small() };
    let mut c = Constants::derive(&in_vacuum).unwrap();
    let mut of = |mass: [f64; 3], stiffness: [f64; 2]| {
        [c.m11, c.m12, c.m22] = mass;
        [c.k_phi, c.k_w] = stiffness;
        modes::<DirectDrive>(&c)
    };
    let [low, high] = of([2.0, 0.0, 1.0], [2.0 * 9.0 * square, 4.0 * square]);
    assert_close(low, 2.0, 1e-14, "lower");
    assert_close(high, 3.0, 1e-14, "upper");
    assert!(of([1.0, 2.0, 1.0], [1.0, 1.0])[0].is_nan());
}
