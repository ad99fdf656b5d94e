use flap_core::model::four_bar::{AddedMassSign, Arms, Constants, FourBar, Params, Quadrature, transmission};
use flap_core::quadrature::gauss_legendre;

use super::{mass_matrix, params};
use crate::data::assert_close;
use crate::probe::modes;

/// The reference's constants of the two systems, as many digits as the reference prints.
#[test]
fn equal_the_reference_to_the_printed_digits() {
    let [p75, p30] = [params("sys75"), params("sys30")];
    let [c75, c30] = [&p75, &p30].map(|p| Constants::derive(p).unwrap());
    let [tip75, tip30] = [c75.actuator, c30.actuator];
    // The tip's stiffness is that of tip and spring without the spring.
    let [k_a75, k_a30] = [tip75, tip30].map(|tip| 1.0 / (1.0 / tip.stiffness - tip.series_compliance));
    let added = |c: &Constants<f64>, p: &Params| c.wing.upright / p.mass_centre_radius.powi(2) - p.wing_mass;
    let inertia = |c: &Constants<f64>| transmission(c, 0.0).inertia;
    let m11 = |c: &Constants<f64>| mass_matrix(c, 0.0, 0.0)[0];
    let slope = |c: &Constants<f64>| transmission(c, 0.0).slope;
    let [modes75, modes30] = [modes::<FourBar>(&c75), modes::<FourBar>(&c30)];
    // With ½C_rot = 1 and axis at χ = ¼: F1, F1r, F2 of the reference times ρ.
    let rho = p75.air_density;
    for (name, actual, expected) in [
        ("k_a", [k_a75, k_a30], [928.493_526_8, 652.110_680_0]),
        ("gamma", [tip75.deflection, tip30.deflection], [2.381_502_639e-6, 3.014_089_278e-6]),
        ("Gamma", [tip75.coupling, tip30.coupling], [2.211_209_784e-3, 1.965_519_808e-3]),
        ("m_eff", [tip75.mass, tip30.mass], [1.080_061_714e-4, 1.215_069_429e-4]),
        ("k_eff", [c75.actuator.stiffness, c30.actuator.stiffness], [558.254_048_2, 444.885_824_6]),
        ("added mass", [added(&c75, &p75), added(&c30, &p30)], [2.043_045_561e-6, 3.954_217_953e-6]),
        ("P", [c75.wing.coupling, c30.wing.coupling], [2.691_087_796e-10, 4.959_287_498e-10]),
        ("J_phi", [c75.wing.j_pitch, c30.wing.j_pitch], [1.119_357_75e-10, 2.304_809_536e-10]),
        ("J_d", [c75.wing.j_difference, c30.wing.j_difference], [1.119_057_75e-10, 2.304_809_536e-10]),
        (
            "F1",
            [c75.air.rotation_force / rho, c30.air.rotation_force / rho],
            [2.993_373_015e-9, 6.980_158_730e-9],
        ),
        (
            "F1r",
            [c75.air.rotation_stroke / rho, c30.air.rotation_stroke / rho],
            [4.342_474_738e-11, 1.326_878_066e-10],
        ),
        (
            "F2",
            [c75.air.rotation_pitch / rho, c30.air.rotation_pitch / rho],
            [1.836_799_928e-11, 5.160_457_680e-11],
        ),
        ("AM1", [c75.air.added_stroke, c30.air.added_stroke], [2.980_966_719e-8, 7.560_885_999e-8]),
        ("AM2", [c75.air.added_pitch, c30.air.added_pitch], [5.208_346_342e-9, 1.214_519_006e-8]),
        ("M11(0)", [m11(&c75), m11(&c30)], [3.619_487_845e-9, 7.986_675_685e-9]),
        ("delta'(0)", [slope(&c75), slope(&c30)], [1.371_447_851e-3, 8.767_246_538e-4]),
        ("G(0)", [inertia(&c75), inertia(&c30)], [5.841_228_826e-10, 4.743_732_404e-10]),
        // S22, 2κS13, κ²S04 with κ = ½, times ½ρ.
        (
            "S22",
            [c75.air.chord[0] * 2.0 / rho, c30.air.chord[0] * 2.0 / rho],
            [5.283_728_202e-10, 1.764_079_192e-9],
        ),
        (
            "S13",
            [c75.air.chord[1] * 2.0 / rho, c30.air.chord[1] * 2.0 / rho],
            [3.206_750_576e-10, 9.798_484_182e-10],
        ),
        (
            "S04",
            [c75.air.chord[2] * 8.0 / rho, c30.air.chord[2] * 8.0 / rho],
            [2.293_759_910e-10, 6.444_278_858e-10],
        ),
    ] {
        assert_close(actual[0], expected[0], 6e-10, &format!("{name} of sys75"));
        assert_close(actual[1], expected[1], 6e-10, &format!("{name} of sys30"));
    }
    // Fewer digits are printed of these.
    for (name, actual, expected) in [
        ("C_b of sys75", tip75.capacitance, 6.868_647e-8),
        ("C_b of sys30", tip30.capacitance, 7.727_228e-8),
        ("mode 1 of sys75", modes75[0], 77.997_40),
        ("mode 2 of sys75", modes75[1], 129.001_27),
        ("mode 1 of sys30", modes30[0], 31.295_14),
        ("mode 2 of sys30", modes30[1], 53.003_99),
        ("J_L1", c75.links.input - 0.25 * p75.input_link_mass * p75.input_link.powi(2), 1.417_248_8e-10),
        ("J_L2", c75.links.coupler, 8e-11),
        ("J_L3", c75.links.output - 0.25 * p75.output_link_mass * p75.output_link.powi(2), 1e-11),
    ] {
        assert_close(actual, expected, 1e-7, name);
    }
}

/// Sums over strips at unit rates are the wing's shape moments.
#[test]
fn strip_sums_are_shape_moments() {
    let p = params("sys75");
    let c = Constants::derive(&p).unwrap();
    let dynamic = 0.5 * p.air_density;
    let stroke = c.strips.sums(1.0, 0.0);
    for (name, actual, expected) in [
        ("S21", stroke.force, 5.677_769_143e-8),
        ("S31", stroke.radius, 1.089_293_897e-9),
        ("S22", stroke.chord, 5.283_728_202e-10),
        ("S03", 4.0 * c.strips.sums(0.0, 1.0).force, 2.210_490_842e-8),
        ("S13", 4.0 * c.strips.sums(0.0, 1.0).radius, 3.206_750_576e-10),
        ("S04", 4.0 * c.strips.sums(0.0, 1.0).chord, 2.293_759_910e-10),
        // Backwards, the sums change their signs.
        ("−S21", -c.strips.sums(-1.0, 0.0).force, 5.677_769_143e-8),
    ] {
        assert_close(actual / dynamic, expected, 6e-10, name);
    }
}

#[test]
fn following_parameters_follow_until_they_are_set() {
    let p = Params::arabagi2013_75hz();
    let derived = |p: Params| Constants::derive(&p).unwrap();
    assert_eq!(derived(p.clone()).actuator.rest_voltage, 50.0);
    assert_eq!(derived(Params { rest_voltage: Some(0.0), ..p.clone() }).actuator.rest_voltage, 0.0);
    let set = Params {
        input_link_inertia: Some(p.input_link_mass * p.input_link * p.input_link / 12.0),
        neutral_angle: Some(derived(p.clone()).four_bar.neutral),
        ..p.clone()
    };
    assert_eq!(derived(set), derived(p.clone()));
    let turned = derived(Params { neutral_angle: Some(1.0), ..p });
    assert!(transmission(&turned, 0.0).displacement.abs() < 1e-18);
    assert!(transmission(&turned, 0.0).bend.abs() > 1e-6);
}

#[test]
fn impossible_parameters_are_refused() {
    let p = Params::arabagi2013_75hz();
    for (changed, reason) in [
        (Params { wing_inertia_product: 1e-8, ..p.clone() }, "not positive definite"),
        (Params { wing_length: 1e200, ..p.clone() }, "not finite"),
        (Params { coupler_link: 1.0, ..p.clone() }, "set neutral_angle"),
        (Params { coupler_link: 1.0, neutral_angle: Some(1.0), ..p.clone() }, "cannot be assembled"),
        (Params { chord_term_4: -2.5, ..p.clone() }, "chord is negative"),
        (Params { strips: 65.0, ..p.clone() }, "whole number from 1 to 64"),
        (Params { strips: 7.5, ..p.clone() }, "whole number from 1 to 64"),
    ] {
        let error = Constants::derive(&changed).unwrap_err();
        assert!(error.to_string().contains(reason), "{error}");
    }
    assert!(Constants::derive(&Params { strips: 64.0, ..p }).is_ok());
}

/// With the rotation axis at the leading edge both readings of the arms are the same.
#[test]
fn readings_of_the_arms_agree_without_an_offset() {
    for system in ["sys75", "sys30"] {
        let at = |arms| Params { arms, axis_position: 0.0, ..params(system) };
        let [printed, axis] = [Arms::Printed, Arms::Axis].map(|arms| Constants::derive(&at(arms)).unwrap());
        assert_eq!(printed, axis);
    }
}

/// Eqs. (6) and (18) hold for each element of a chord, for any position of the rotation axis. The force on an element
/// is opposite to its motion.
#[test]
fn rotation_is_that_of_the_elements_of_a_chord_for_an_axis_off_the_wing() {
    let p = params("sys75");
    let air = |axis_position| Constants::derive(&Params { axis_position, ..p.clone() }).unwrap().air;
    let at_edge = air(0.0);
    for axis in [-0.4, 0.0, 0.25, 0.7, 1.0, 1.3] {
        let middles = (0..4000).map(|i| (f64::from(i) + 0.5) / 4000.0);
        let moments = middles.map(|x| x - axis).fold([0.0, 0.0], |[one, two], z| {
            [one + z * z.abs() / 4000.0, two + z.abs() * z.abs() * z.abs() / 4000.0]
        });
        let air = air(axis);
        // At the leading edge the integrals over a chord of 1 are 1/3 and 1/4.
        let [force, stroke] = [
            air.rotation_force / at_edge.rotation_force / 3.0,
            air.rotation_stroke / at_edge.rotation_stroke / 3.0,
        ];
        let pitch = air.rotation_pitch / at_edge.rotation_pitch / 4.0;
        assert!((force - moments[0]).abs() < 1e-6, "force, axis at {axis}: {force}, {}", moments[0]);
        assert!((stroke - moments[0]).abs() < 1e-6, "stroke, axis at {axis}: {stroke}, {}", moments[0]);
        assert!((pitch - moments[1]).abs() < 1e-6, "pitch, axis at {axis}: {pitch}, {}", moments[1]);
    }
}

#[test]
fn the_printed_sign_turns_the_added_mass_of_the_pitch() {
    let p = params("sys75");
    let sign = |am_sign| Constants::derive(&Params { am_sign, ..p.clone() }).unwrap().air.added_pitch;
    assert_eq!(sign(AddedMassSign::Corrected), -sign(AddedMassSign::Printed));
}

#[test]
fn gauss_rules_integrate_polynomials_exactly() {
    for n in 1..=64 {
        let rule = gauss_legendre(n);
        assert!(rule.is_sorted_by(|a, b| a.x < b.x));
        for degree in 0..2 * n {
            let integral: f64 = rule.iter().map(|node| node.weight * node.x.powi(degree as i32)).sum();
            assert_close(integral, 1.0 / (degree as f64 + 1.0), 1e-13, &format!("x^{degree}, {n} nodes"));
        }
    }
}

#[test]
fn midpoints_are_the_middles() {
    let p = Params { quadrature: Quadrature::Midpoint, strips: 2.0, ..params("sys75") };
    let sums = Constants::derive(&p).unwrap().strips.sums(1.0, 0.0);
    let strips = [0.25, 0.75].map(|x| {
        let r = p.wing_offset + p.wing_length * x;
        0.5 * p.air_density * p.chord(x) * r * r * 0.5 * p.wing_length
    });
    assert_close(sums.force, strips[0] + strips[1], 1e-15, "force of two strips");
    // The wing's area converges with the square of the number of strips.
    let force = |quadrature, strips| {
        let p = Params { quadrature, strips, ..params("sys75") };
        Constants::derive(&p).unwrap().strips.sums(1.0, 0.0).force
    };
    let exact = force(Quadrature::Gauss, 16.0);
    let error = |strips| force(Quadrature::Midpoint, strips) / exact - 1.0;
    assert_close(error(16.0) / error(32.0), 4.0, 1e-2, "order");
}

#[test]
fn a_long_rod_makes_the_slider_follow_the_sine() {
    let p = Params { crank_radius: 2e-3, connecting_rod: 1e3, ..params("sys75") };
    let c = Constants::derive(&p).unwrap();
    for theta in [-0.5, 0.2, 0.7] {
        let links = c.four_bar.motion(theta);
        let [sin, cos] = links.turned;
        let [input_p, input_pp] = links.input;
        let motion = transmission(&c, theta);
        assert_close(motion.displacement, 2e-3 * sin, 1e-6, "displacement");
        assert_close(motion.slope, 2e-3 * cos * input_p, 1e-5, "slope");
        let bend = 2e-3 * (cos * input_pp - sin * input_p * input_p);
        assert!((motion.bend - bend).abs() < 1e-5 * 2e-3 * input_p * input_p, "{} {bend}", motion.bend);
    }
}
