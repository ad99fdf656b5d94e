//! Settled orbits against the reference.

use flap_core::model::direct_drive::{AddedMass, Constants, FlowDirection, LiftSign, Params};
use flap_core::num::Backend;
use flap_core::simulate::{PointRun, Row, Simulator, SolverSettings, Status, by_name};

use super::{centre_of_pressure, params};
use crate::data::{Record, assert_close, table};

const STEADY: &str = "direct-drive/steady_cases.csv";

fn model() -> &'static dyn Simulator {
    by_name("direct-drive").unwrap()
}

fn run(params: &Params, rtol: f64, settle_tol: f64) -> Row {
    let solver = SolverSettings { rtol, atol: 1e-2 * rtol, settle_tol, ..SolverSettings::default() };
    model().run_point(&PointRun::new(Backend::best(), &solver, &params.to_values()), None)
}

fn measure(row: &Row, column: &str) -> f64 {
    let index = model().columns().iter().position(|c| c.name == column);
    row.measures[index.unwrap_or_else(|| panic!("no column {column}"))]
}

/// The operating point of a reference row.
fn operating_point(record: &Record) -> Params {
    Params {
        drive_voltage_pp: 2.0 * record.number("V0_V"),
        drive_frequency: record.number("f_Hz"),
        hinge_stiffness: record.number("k_w_Nm"),
        wing_offset: Some(record.number("x_r_m")),
        centre_of_pressure: centre_of_pressure(record.text("dcp")),
        ..params(record.text("type"))
    }
}

/// flap's column, the reference's column, and the factor from the reference's unit to the unit of flap.
const COLUMNS: [(&str, &str, f64); 22] = [
    ("stroke_amplitude_deg", "phi_amp_deg", 1.0),
    ("stroke_mean_deg", "phi_mean_deg", 1.0),
    ("stroke_max_deg", "phi_max_deg", 1.0),
    ("stroke_min_deg", "phi_min_deg", 1.0),
    ("stroke_first_deg", "phi1_amp_deg", 1.0),
    ("pitch_amplitude_deg", "psi_amp_deg", 1.0),
    ("pitch_max_deg", "psi_max_deg", 1.0),
    ("pitch_min_deg", "psi_min_deg", 1.0),
    ("pitch_first_deg", "psi1_amp_deg", 1.0),
    ("stroke_lag_deg", "phase_V_minus_phi_deg", 1.0),
    ("pitch_lag_deg", "phase_phi_minus_psi_deg", 1.0),
    ("lift_mean_mn", "lift_mean_N", 1e3),
    ("lift_mean_gf", "lift_mean_gf", 1.0),
    ("lift_translational_mean_mn", "lift_tr_mean_N", 1e3),
    ("power_mean_mw", "power_mean_W", 1e3),
    ("power_supply_mw", "power_pos_mean_W", 1e3),
    ("power_translational_mean_mw", "diss_trans_W", 1e3),
    ("power_rotational_mean_mw", "diss_rot_W", 1e3),
    ("efficiency_gf_per_w", "eff_gf_per_W", 1.0),
    ("current_peak_ma", "current_peak_A", 1e3),
    ("current_rms_ma", "current_rms_A", 1e3),
    ("mode_1_hz", "mode1_Hz", 1.0),
];

/// Runs the operating points of a reference table, as `adapt` changes them, and compares the measures. The electrical
/// power is the power that the air takes.
fn compare(path: &str, adapt: impl Fn(&Record, Params) -> Params, rtol: f64, tolerance: f64) {
    let mut largest = (0.0, String::new());
    for record in table(path) {
        let row = run(&adapt(&record, operating_point(&record)), rtol, rtol);
        assert_eq!(row.status, Status::Periodic, "{}", record.name);
        for (ours, theirs, factor) in COLUMNS {
            let (actual, expected) = (measure(&row, ours), factor * record.number(theirs));
            let what = format!("{ours} of {}", record.name);
            assert_close(actual, expected, tolerance, &what);
            let error = (actual - expected).abs() / expected.abs();
            if error > largest.0 {
                largest = (error, what);
            }
        }
        let peak = ["phi_max_deg", "phi_min_deg"].map(|column| record.number(column).abs().to_radians());
        let constants = Constants::derive(&operating_point(&record)).unwrap();
        let strain = constants.strain_per_stroke.abs() * peak[0].max(peak[1]);
        assert_close(measure(&row, "strain_surface_max"), strain, tolerance, &record.name);
        let audit = measure(&row, "energy_audit");
        assert!(audit.abs() < 100.0 * rtol, "{}: {audit:e}", record.name);
    }
    println!("{path}, rtol {rtol:.0e}: largest relative error {:.1e} ({})", largest.0, largest.1);
}

#[test]
fn rtol_1e_8_gives_the_reference_to_1e_5() {
    compare(STEADY, |_, p| p, 1e-8, 1e-5);
}

#[test]
fn rtol_1e_6_gives_the_reference_to_2e_4() {
    compare(STEADY, |_, p| p, 1e-6, 2e-4);
}

/// The reference has 64 blade elements.
#[test]
fn directions_of_flow_give_the_reference() {
    let adapt = |record: &Record, p: Params| match record.text("sgn") {
        "uniform" => p.with_chord_moments(),
        "blade" => Params { flow_direction: FlowDirection::Blade, ..p },
        other => panic!("direction {other} is not compared"),
    };
    compare("direct-drive/blade_cases.csv", adapt, 1e-8, 1e-5);
}

/// Forces of blade elements do not jump, so flap does not locate crossings and takes fewer steps.
#[test]
fn blade_elements_take_fewer_steps() {
    let evals = |direction: FlowDirection| {
        let per_cycle = [95.0, 100.0, 105.0, 110.0, 115.0, 120.0].map(|drive_frequency| {
            let p = Params { drive_frequency, ..Params::ozaki2018_large() }.with_chord_moments();
            let p = Params { flow_direction: direction, ..p };
            // Of marched periods alone: those with responses have steps of their own.
            let solver = SolverSettings { newton: false, ..SolverSettings::default() };
            let row = model().run_point(&PointRun::new(Backend::best(), &solver, &p.to_values()), None);
            row.rhs_evals as f64 / f64::from(row.cycles)
        });
        per_cycle.iter().sum::<f64>() / per_cycle.len() as f64
    };
    let uniform = evals(FlowDirection::Uniform);
    let blade = evals(FlowDirection::Blade);
    println!("right-hand sides per cycle: {uniform:.0} uniform, {blade:.0} blade");
    assert!(blade < 0.97 * uniform, "{blade} against {uniform}");
}

/// φ_mean = Γ V_0 / k_φ exactly, because the model is symmetric.
#[test]
fn mean_stroke_is_the_static_one() {
    for record in table(STEADY) {
        let p = operating_point(&record);
        let c = flap_core::model::direct_drive::Constants::derive(&p).unwrap();
        let expected = (c.gamma * c.drive.bias / c.k_phi).to_degrees();
        assert_close(measure(&run(&p, 1e-8, 1e-9), "stroke_mean_deg"), expected, 1e-7, &record.name);
    }
}

#[test]
fn readings_of_the_paper_give_the_reference() {
    for record in table("direct-drive/variants.csv") {
        let mut p = operating_point(&record);
        match record.text("case") {
            "base" | "dcp_folded" => {}
            "am_lagrangian" => p.added_mass = AddedMass::Lagrangian,
            "jxy_negative" => p.wing_inertia_product = -p.wing_inertia_product,
            "lift_eq35_printed_sign" => p.lift_sign = LiftSign::Printed,
            other => panic!("reading {other} is not compared"),
        }
        let row = run(&p, 1e-8, 1e-8);
        for (ours, theirs, factor) in COLUMNS {
            let what = format!("{ours} of {} ({})", record.name, record.text("case"));
            assert_close(measure(&row, ours), factor * record.number(theirs), 1e-5, &what);
        }
    }
}

/// The tolerance of the tables is 1e-5, because a wrong digit in a coefficient changes the lift by more than 1e-5.
#[test]
fn a_coefficient_changed_in_its_last_printed_digit_is_noticed() {
    let base = run(&Params::ozaki2018_large(), 1e-8, 1e-8);
    let p = Params::ozaki2018_large;
    for (name, changed) in [
        ("hinge_stiffness", Params { hinge_stiffness: 8.65e-5, ..p() }),
        ("shape_moment_31", Params { shape_moment_31: 0.75, ..p() }),
        ("rotation_drag", Params { rotation_drag: 3.6, ..p() }),
        ("pressure_offset", Params { pressure_offset: 0.06, ..p() }),
        ("wing_inertia_product", Params { wing_inertia_product: 7.2e-12, ..p() }),
    ] {
        let lift = measure(&run(&changed, 1e-8, 1e-8), "lift_mean_mn");
        let change = (lift / measure(&base, "lift_mean_mn") - 1.0).abs();
        assert!(change > 2e-5, "{name}: lift changes by {change:e} only");
    }
}
