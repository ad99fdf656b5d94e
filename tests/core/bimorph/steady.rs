//! Settled orbits against the reference.

use flap_core::model::bimorph::Params;
use flap_core::simulate::{Row, SolverSettings};

use super::{driven, measure, params, settled, settled_with};
use crate::data::{Record, assert_close, table};
use crate::rows::worse;

/// The operating point of a reference row; the table also contains the constants that follow from the set.
fn operating_point(record: &Record) -> Params {
    let p = driven(&params(record.text("set")), record);
    assert_close(p.transmission_ratio, record.number("T_rad_per_m"), 1e-14, &record.name);
    assert_close(p.transmission_stiffness, record.number("K_t_N_per_m"), 1e-14, &record.name);
    assert_close(p.hinge_stiffness, record.number("k_wh_Nm_per_rad"), 1e-14, &record.name);
    assert_close(p.air_density, record.number("rho_kg_per_m3"), 1e-14, &record.name);
    p
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// flap's column, the reference's column, and the factor from the reference's unit and sign to the unit and sign of
/// flap.
#[rustfmt::skip]
const COLUMNS: [(&str, &str, f64); 20] = [
    ("stroke_pp_deg", "stroke_pp_deg", 1.0),
    ("tip_pp_um", "x_amp_m", 2e6),
    ("pitch_max_deg", "psi_pos_rad", DEGREES),
    ("pitch_min_deg", "psi_neg_rad", DEGREES),
    ("pitch_peak_deg", "psi_max_deg", 1.0),
    ("pitch_first_deg", "psi_fund_rad", DEGREES),
    ("stroke_lag_deg", "phase_x_drive_deg", -1.0),
    ("pitch_lag_deg", "phase_psi_x_deg", -1.0),
    ("lift_mean_mn", "lift_mean_N", 1e3),
    ("drag_magnitude_mn", "drag_abs_mean_N", 1e3),
    ("strain_mid_max", "strain_mid_max", 1.0),
    ("strain_surface_max", "strain_surf_max", 1.0),
    ("power_mechanical_mean_mw", "P_mech_W", 1e3),
    ("power_drag_mean_mw", "P_drag_W", 1e3),
    ("power_mean_mw", "P_elec_W", 1e3),
    ("power_supply_mw", "P_elec_pos_W", 1e3),
    ("power_rotational_mean_mw", "P_hinge_damp_W", 1e3),
    ("current_1_rms_ma", "i1_rms_A", 1e3),
    ("current_2_rms_ma", "i2_rms_A", 1e3),
    ("power_capacitive_mw", "P_cap_actuator_W", 1e3),
];

/// Relative errors of a row.
fn errors(row: &Row, record: &Record) -> Vec<(f64, &'static str)> {
    let mut errors: Vec<_> = COLUMNS
        .iter()
        .map(|&(ours, theirs, factor)| {
            let expected = factor * record.number(theirs);
            ((measure(row, ours) / expected - 1.0).abs(), ours)
        })
        .collect();
    let first = record.number("x_fund_m") * record.number("T_rad_per_m") * DEGREES;
    errors.push(((measure(row, "stroke_first_deg") / first - 1.0).abs(), "stroke_first_deg"));
    errors
}

/// Compares every case with the reference and prints the largest error of each case.
///
/// The mean electrical power of the plates equals the mean power of their forces and the mean power of the stroke's
/// drag.
fn compare(rtol: f64, tolerance: f64) {
    let (mut worst, mut audit) = (0.0_f64, 0.0_f64);
    for record in table("bimorph/steady_cases.csv") {
        let p = operating_point(&record);
        let row = settled(&p, rtol);
        let (largest, column) =
            errors(&row, &record).into_iter().fold((0.0, ""), |a, b| if a.0 >= b.0 { a } else { b });
        println!(
            "rtol {rtol:.0e}, {} {} V {} Hz: {largest:.1e} ({column}), {} cycles, {:.0} evaluations each",
            record.text("set"),
            p.drive_voltage_pp,
            p.drive_frequency,
            row.cycles,
            row.rhs_evals as f64 / f64::from(row.cycles),
        );
        worst = worse(worst, largest);
        let [electrical, mechanical] =
            ["power_mean_mw", "power_mechanical_mean_mw"].map(|column| measure(&row, column));
        audit = worse(audit, measure(&row, "energy_audit").abs());
        audit = worse(audit, (electrical / mechanical - 1.0).abs());
    }
    println!("rtol {rtol:.0e}: largest relative error {worst:.1e}, energy audit {audit:.1e}");
    assert!(worst < tolerance, "{worst:e}");
    assert!(audit < 100.0 * rtol, "{audit:e}");
}

#[test]
fn rtol_1e_8_gives_the_reference_to_1e_5() {
    compare(1e-8, 1e-5);
}

/// The steep flank of the resonance (Floquet multipliers up to 0.8) amplifies the integration's error five times. In a
/// small measure, a wing that hardly pitches also amplifies the integration's error.
#[test]
fn rtol_1e_6_gives_the_reference_to_3e_4() {
    compare(1e-6, 3e-4);
}

/// The two half strokes are mirror images, also if flap does not compute the second from the first.
#[test]
fn orbits_are_symmetric() {
    let solver = SolverSettings { symmetry: false, ..SolverSettings::default().with_rtol(1e-8) };
    for record in table("bimorph/steady_cases.csv") {
        let row = settled_with(&operating_point(&record), &solver);
        let column = |name| measure(&row, name);
        assert!(column("stroke_mean_deg").abs() < 1e-6 * column("stroke_amplitude_deg"), "{}", record.name);
        assert!(column("pitch_mean_deg").abs() < 1e-6 * column("pitch_amplitude_deg"), "{}", record.name);
        assert!(column("drag_mean_mn").abs() < 1e-6 * column("drag_magnitude_mn"), "{}", record.name);
        assert_close(column("current_1_peak_ma"), column("current_2_peak_ma"), 1e-3, &record.name);
        assert_close(column("force_1_peak_mn"), column("force_2_peak_mn"), 1e-4, &record.name);
    }
}

/// The tolerance of the table is 1e-5, because a wrong digit in a coefficient changes the lift by more than 1e-5.
#[test]
fn a_coefficient_changed_in_its_last_printed_digit_is_noticed() {
    let p = || Params { drive_voltage_pp: 160.0, drive_frequency: 128.0, ..params("T1") };
    let base = settled(&p(), 1e-8);
    for (name, changed) in [
        ("hinge_stiffness", Params { hinge_stiffness: 0.985 * 1.521e-6, ..p() }),
        ("stress_decline", Params { stress_decline: 70e-9, ..p() }),
        ("force_strain_slope", Params { force_strain_slope: -231.0, ..p() }),
        ("modulus_strain", Params { modulus_strain: -0.048e-2, ..p() }),
        ("pressure_min", Params { pressure_min: 0.133, ..p() }),
        ("rotation_pressure_width", Params { rotation_pressure_width: 0.39 * 1.94e-3, ..p() }),
        ("wing_inertia_product", Params { wing_inertia_product: 0.29 * 2.81e-12, ..p() }),
        ("actuator_width_ratio", Params { actuator_width_ratio: 1.557, ..p() }),
    ] {
        let lift = measure(&settled(&changed, 1e-8), "lift_mean_mn");
        let change = (lift / measure(&base, "lift_mean_mn") - 1.0).abs();
        println!("{name}: lift changes by {change:.1e}");
        assert!(change > 2e-5, "{name}: lift changes by {change:e} only");
    }
}
