//! Constants of the actuator, the wing and the drive.

use flap_core::drive::{Repeat, Samples};
use flap_core::model::bimorph::{
    ActuatorStiffness, Bimorph, Constants, FieldTransition, Params, secant_stiffness,
};
use flap_core::model::{ExperimentModel, Model};

use super::params;
use crate::data::{assert_close, table};

/// The gain of an actuator with this width ratio and extension ratio, relative to the force of a plate, Eq. (6).
fn taper_gain(actuator_width_ratio: f64, actuator_extension_ratio: f64) -> f64 {
    let p = Params { actuator_width_ratio, actuator_extension_ratio, ..Params::jafferis2016() };
    let (t_pzt, t_cf) = (p.piezo_thickness, p.shim_thickness);
    let per_gain = 0.75 * p.force_factor * p.actuator_width * t_pzt * (t_pzt + t_cf) / p.actuator_length;
    Constants::derive(&p).unwrap().force_per_stress[0] / per_gain
}

#[test]
fn gain_of_a_taper_equals_the_reference() {
    for record in table("bimorph/taper_gains.csv") {
        let gain = taper_gain(record.number("w_r"), record.number("l_r"));
        assert_close(gain, record.number("G"), 1e-14, &record.name);
    }
}

/// G = (1 + 2l)/3∫₀¹ (1 + l − s)²/(w + 2(1 − w)s) ds by Simpson's rule.
#[test]
fn gain_of_a_taper_is_the_compliance_integral() {
    for i in 0..=140 {
        let w = 0.3 + 0.01 * f64::from(i);
        for l in [0.0, 0.25, 1.0] {
            let integrand = |s: f64| (1.0 + l - s).powi(2) / (w + 2.0 * (1.0 - w) * s);
            let n = 2000;
            let h = 1.0 / f64::from(n);
            let inner: f64 =
                (1..n).map(|k| (if k % 2 == 1 { 4.0 } else { 2.0 }) * integrand(f64::from(k) * h)).sum();
            let integral = (integrand(0.0) + inner + integrand(1.0)) * h / 3.0;
            let expected = (1.0 + 2.0 * l) / (3.0 * integral);
            assert_close(taper_gain(w, l), expected, 1e-11, &format!("G({w}, {l})"));
        }
    }
}

#[test]
fn actuators_without_width_at_one_end_are_refused() {
    for width_ratio in [0.0, 2.0, 2.5, -0.5, f64::NAN] {
        let p = Params { actuator_width_ratio: width_ratio, ..Params::jafferis2016() };
        let error = Constants::derive(&p).unwrap_err();
        assert!(error.to_string().contains("between 0 and 2"), "{error}");
    }
}

/// Stiffness of the tip per modulus of the plates, and stiffness of the shim (N/m), Eq. (3).
fn stiffnesses(c: &Constants<f64>, p: &Params) -> [f64; 2] {
    let per_modulus = c.f_stiff * c.u_per_tip / (0.5 * (p.piezo_modulus_max - p.piezo_modulus_min));
    [per_modulus, c.k_soft - per_modulus * p.piezo_modulus_min]
}

/// Constants of Table I with ρ = 1.2 kg/m³.
#[test]
fn derived_constants_equal_the_reference() {
    let p = Params::jafferis2016();
    let c = Constants::derive(&p).unwrap();
    let [per_modulus, shim] = stiffnesses(&c, &p);
    let d_e = 8.160_75e-12;
    for (name, actual, expected, tolerance) in [
        ("s_eps", c.strain_per_tip, 1.522_633_744_855_967_3, 1e-14),
        ("K_pre D_E", per_modulus, 575.050_469_826_864_5 * d_e, 1e-13),
        ("K_pre D_c", shim, 575.050_469_826_864_5 * 0.010_625, 1e-13),
        ("F_pre", c.force_per_stress[0], 1.449_539_193_522_034e-9, 1e-13),
        ("surface strain", c.surface_strain_ratio, 320.0 / 185.0, 1e-14),
        ("m_e", 1.0 / c.inverse_m_e, 6.811_970_734_8e-4, 1e-11),
        ("b_1", c.b_1, 2.203, 1e-14),
        ("b_2", c.b_2, 2.047, 1e-14),
        ("C_A", c.c_a, 3.334_164_861_549_411_7, 1e-13),
        ("C_B", c.c_b, 3.098_064_217_699_340_3, 1e-13),
        ("C_C", c.c_c, 3.923_170_017_757_086_5e-13, 1e-13),
        ("force", c.force, 0.033_449_607_241_329_7, 1e-13),
        ("hinge torque", c.hinge_torque, 1.074_125_917_237_757_7e-4, 1e-13),
        ("mean width", c.hinge_torque / c.force, 3.211_176_470_588_235e-3, 1e-14),
        ("C_plate", c.c_p, 2.525e-9, 1e-14),
        ("K_act(0)", secant_stiffness(&c, 0.0), 189.053_461_025_263_3, 1e-13),
    ] {
        assert_close(actual, expected, tolerance, name);
    }
    assert_close((secant_stiffness(&c, 0.0) - shim) / per_modulus, 38.984e9, 2e-5, "E_e(0)");
}

/// Transmission ratios in section 3 of the text and in the caption of Fig. 5.
#[test]
fn transmissions_scale_as_in_figure_5() {
    let [t_2, t_3] = [params("T2"), params("T3")];
    assert_close(t_2.transmission_ratio, 2666.4, 1e-14, "T of T2");
    assert_close(t_2.transmission_stiffness, 203.973_651_739_026_96, 1e-14, "K_t of T2");
    assert_close(t_2.hinge_stiffness, 2.078_440_218_563_571e-6, 1e-14, "kappa_wh of T2");
    assert_close(t_3.transmission_stiffness, 212.356_468_437_617_1, 1e-14, "K_t of T3");
    assert_close(t_3.hinge_stiffness, 3.172_469_681_760_742_5e-6, 1e-14, "kappa_wh of T3");
}

/// ln((1 + e^(z₀+u))/(1 + e^z₀)): for small u as a series, for large u with the factor eᵘ outside the logarithm.
fn expected_stiffening(z_0: f64, u: f64) -> f64 {
    let sigma = 1.0 / (1.0 + (-z_0).exp());
    if u < 1e-5 {
        let rest = 1.0 - sigma;
        u * (sigma + sigma * rest * u / 2.0 + sigma * rest * (1.0 - 2.0 * sigma) * u * u / 6.0)
    } else if u < 500.0 {
        (sigma * u.exp_m1()).ln_1p()
    } else {
        u + sigma.ln()
    }
}

#[test]
fn stiffening_is_accurate_for_any_strain() {
    for modulus_strain in [-0.047e-2, -0.2e-2, 0.0, 0.03e-2] {
        // Without a stiffness that does not change with strain.
        let p =
            Params { modulus_strain, piezo_modulus_min: 1e-300, shim_modulus: 0.0, ..Params::jafferis2016() };
        let c = Constants::derive(&p).unwrap();
        let stiffening = |x: f64| secant_stiffness(&c, x) * x.abs() / c.f_stiff;
        for i in -300..=60 {
            let u = 10.0_f64.powf(0.1 * f64::from(i));
            let expected = expected_stiffening(8000.0 * modulus_strain, u);
            for x in [u / c.u_per_tip, -u / c.u_per_tip] {
                assert_close(stiffening(x), expected, 2e-14, &format!("u = {u}, {modulus_strain}"));
            }
        }
        assert_eq!(stiffening(0.0), 0.0);
    }
}

/// K_act rises from K(E_min + ½(E_max − E_min) σ₀) towards K(½(E_min + E_max)).
#[test]
fn stiffness_grows_between_its_limits() {
    let p = Params::jafferis2016();
    let c = Constants::derive(&p).unwrap();
    let [per_modulus, shim] = stiffnesses(&c, &p);
    let upper = per_modulus * 0.5 * (38.5e9 + 81e9) + shim;
    let mut last = 0.0;
    for i in -10..=10 {
        let stiffness = secant_stiffness(&c, 1e-4 * 2.0_f64.powi(i));
        assert!(stiffness > last && stiffness < upper, "{stiffness}");
        last = stiffness;
    }
    assert_close(secant_stiffness(&c, 1e3), upper, 1e-5, "limit");
    let constant = Params { actuator_stiffness: ActuatorStiffness::Constant, ..p };
    let constant = Constants::derive(&constant).unwrap();
    for x in [0.0, 1e-5, 3e-4, -3e-4] {
        assert_close(secant_stiffness(&constant, x), secant_stiffness(&c, 0.0), 1e-14, "constant stiffness");
    }
}

#[test]
fn transitions_too_steep_to_compute_are_refused() {
    let p = Params::jafferis2016;
    for steep in [
        Params { stress_steepness: 1e-3, ..p() },
        Params { drive_voltage_pp: 1e5, ..p() },
        Params { modulus_steepness: 1e7, ..p() },
    ] {
        assert!(Bimorph::SINE.start(&steep.to_values()).unwrap_err().to_string().contains("too steep"));
    }
    // Plates at 95 times the voltage of a sine.
    let times = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| share / p().drive_frequency);
    let start = |largest: f64| {
        let samples = Samples::new(&times, &[0.0, largest, 0.0, -largest, 0.0], Repeat::Periodic).unwrap();
        Bimorph::SINE.sampled(samples).start(&p().to_values())
    };
    assert!(start(2.0).is_ok());
    assert!(start(95.0).unwrap_err().to_string().contains("too steep"));
    let huge = Constants::derive(&Params { wing_length: 1e200, ..p() }).unwrap_err();
    assert!(huge.to_string().contains("not finite"), "{huge}");
}

#[test]
fn an_actuator_mass_adds_to_that_of_the_wing() {
    let p = Params { actuator_mass: 7e-6, ..Params::jafferis2016() };
    let c = Constants::derive(&p).unwrap();
    assert_close(1.0 / c.inverse_m_e, 6.811_970_734_8e-4 + 7e-6, 1e-11, "m_e");
}

#[test]
fn presets_differ_as_the_text_says() {
    let [table_1, improved] = [Params::jafferis2016(), Params::jafferis2016_improved()];
    let changed = Params {
        drive_frequency: 155.0,
        transmission_ratio: 2666.0,
        transmission_stiffness: 215.0,
        hinge_stiffness: 2.29e-6,
        vehicle_mass: 87e-6,
        ..table_1.clone()
    };
    assert_eq!(improved, changed);
    let printed = Params { field_transition: FieldTransition::Printed, ..table_1 };
    assert_eq!(Params::from_values(&printed.to_values()), printed);
    assert_eq!(Bimorph::modes(&Constants::derive(&improved).unwrap()).len(), 2);
}
