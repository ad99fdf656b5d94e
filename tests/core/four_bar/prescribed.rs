//! Passive pitch of a wing whose stroke is prescribed, against reference orbits.

use flap_core::drive::{Shape, StrokeParameters, WaveformParameters};
use flap_core::model::four_bar::Params;
use flap_core::num::Backend;
use flap_core::simulate::{PointRun, SolverSettings, Status, TrajectoryRequest};

use super::steady::{measure, model, run, wrapped};
use super::{arms, assert_close_to, params};
use crate::data::{Record, assert_close, table};
use crate::waveforms::third_harmonic;

fn operating_point(record: &Record) -> Params {
    assert_eq!(record.text("quad"), "gauss");
    Params {
        stroke: StrokeParameters::prescribed(record.number("Theta_rad")),
        drive_frequency: record.number("f_Hz"),
        hinge_stiffness: record.number("krot_Nm"),
        hinge_damping: record.number("d_Nms"),
        arms: arms(record.text("arms")),
        strips: record.number("N"),
        ..params(record.text("system"))
    }
}

#[test]
fn pitch_and_lift_equal_the_reference() {
    for (rtol, bound) in [(1e-8, 1e-5), (1e-6, 1e-4)] {
        for record in table("four-bar/rotation_only.csv") {
            let row = run(&operating_point(&record), rtol, 10.0 * rtol);
            let name = format!("{} at rtol {rtol:e}", record.text("id"));
            assert_eq!(row.status, Status::Periodic, "{name}");
            let close = |column: &str, expected: f64, size: f64| {
                assert_close_to(measure(&row, column), expected, size, bound, &format!("{name}: {column}"));
            };
            let stroke = record.number("Theta_rad").to_degrees();
            close("stroke_amplitude_deg", stroke, stroke);
            close("stroke_first_deg", stroke, stroke);
            let pitch_pp = record.number("phi_pp_rad").to_degrees();
            close("pitch_pp_deg", pitch_pp, pitch_pp);
            let pitch = record.number("phi1_rad").to_degrees();
            close("pitch_first_deg", pitch, pitch);
            close("pitch_mean_deg", record.number("phi_mean_rad").to_degrees(), pitch);
            let parts = ["lift_trans_N", "lift_rot_N", "lift_addmass_N"];
            let lift: f64 = parts.iter().map(|part| 1e3 * record.number(part).abs()).sum();
            close("lift_mean_mn", 1e3 * record.number("lift_mean_N"), lift);
            close("lift_translational_mean_mn", 1e3 * record.number("lift_trans_N"), lift);
            close("lift_rotational_mean_mn", 1e3 * record.number("lift_rot_N"), lift);
            close("lift_added_mass_mean_mn", 1e3 * record.number("lift_addmass_N"), lift);
            let lag = measure(&row, "pitch_lag_deg") - record.number("phase_lag_deg");
            assert!(wrapped(lag).abs().to_radians() < bound, "{name}: lag off by {lag} deg");
        }
    }
}

/// The pitch at the beginning of a period also equals the pitch of the reference.
#[test]
fn the_orbit_begins_where_the_reference_does() {
    let solver = SolverSettings { rtol: 1e-8, atol: 1e-10, settle_tol: 1e-7, ..SolverSettings::default() };
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 8, settled: true };
    for record in table("four-bar/rotation_only.csv") {
        let values = operating_point(&record).to_values();
        let motion = model()
            .motions()
            .unwrap()
            .trajectory(&PointRun::new(Backend::best(), &solver, &values), &request)
            .unwrap();
        let [_, stroke, pitch, stroke_rate, pitch_rate] = [0, 1, 2, 3, 4].map(|i| motion.rows[0][i]);
        assert!(stroke.abs() < 1e-6, "{stroke}");
        let speed = record.number("Theta_rad") * std::f64::consts::TAU * record.number("f_Hz");
        assert_close(stroke_rate, speed, 1e-6, "stroke rate");
        assert_close(pitch, record.number("phi0"), 1e-5, "pitch");
        // Relative to the rate of a harmonic motion.
        let fastest = record.number("phi1_rad") * std::f64::consts::TAU * record.number("f_Hz");
        assert_close_to(pitch_rate, record.number("phidot0"), fastest, 1e-5, "pitch rate");
    }
}

/// With a prescribed stroke, measures of the actuator are missing.
#[test]
fn the_actuator_of_a_prescribed_stroke_is_unknown() {
    let mut p =
        Params { stroke: StrokeParameters::prescribed(10.0_f64.to_radians()), ..Params::arabagi2013_75hz() };
    p.electrical.dielectric_loss = 0.15;
    let row = run(&p, 1e-6, 1e-5);
    for column in [
        "power_mean_mw",
        "power_supply_mw",
        "power_drive_mean_mw",
        "power_dielectric_mean_mw",
        "current_rms_ma",
        "tip_peak_um",
        "field_max_v_per_um",
        "energy_audit",
    ] {
        assert!(measure(&row, column).is_nan(), "{column}");
    }
    assert!(measure(&row, "power_translational_mean_mw") > 0.0);
}

#[test]
fn a_stroke_may_have_harmonics_but_no_jumps() {
    let p =
        Params { stroke: StrokeParameters::prescribed(10.0_f64.to_radians()), ..Params::arabagi2013_75hz() };
    let harmonic = Params { waveform: third_harmonic(0.1), ..p.clone() };
    let row = run(&harmonic, 1e-8, 1e-7);
    assert_eq!(row.status, Status::Periodic);
    // θ = Θ (sin + 0.1 sin 3): its first harmonic is Θ, its extremes are 0.9 Θ at 90° and 1.0062 Θ beside it.
    assert_close(measure(&row, "stroke_first_deg"), 10.0, 1e-6, "first harmonic");
    let samples = (0..100_000).map(|i| f64::from(i) * 1e-5 * std::f64::consts::TAU);
    let peak = samples.map(|x| x.sin() + 0.1 * (3.0 * x).sin()).fold(0.0, f64::max);
    assert_close(measure(&row, "stroke_amplitude_deg"), 10.0 * peak, 1e-5, "peak");
    let square = run(&Params { waveform: WaveformParameters::new(Shape::Square), ..p }, 1e-6, 1e-5);
    assert_eq!(square.status, Status::Invalid);
    assert!(square.reason.unwrap().contains("stroke_mode"));
}
