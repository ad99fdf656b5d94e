//! Lift of a given motion, and drives given as samples.

use std::f64::consts::TAU;

use flap_core::drive::{Repeat, Samples};
use flap_core::model::direct_drive::Params;
use flap_core::num::Backend;
use flap_core::simulate::{ImposedMotion, PointRun, Simulator, SolverSettings, Status, by_name};

use crate::data::table;
use crate::rows;

fn model() -> &'static dyn Simulator {
    by_name("direct-drive").unwrap()
}

/// Lift from a measured motion, Eq. (35): the motion of the reference, sampled every 20 µs for two periods.
#[test]
fn lift_of_a_filmed_motion_equals_the_reference() {
    let records = table("direct-drive/traj_small_30V_209Hz_steady.csv");
    let column = |name: &str| records.iter().map(|record| record.number(name)).collect::<Vec<f64>>();
    let times = column("t_s");
    let record = |name: &str| Samples::new(&times, &column(name), Repeat::Once).unwrap();
    let intervals = u32::try_from(times.len() - 1).unwrap();
    let motion = ImposedMotion { stroke: record("phi_rad"), pitch: record("psi_rad"), samples: intervals };
    let (settings, values) = (SolverSettings::default(), Params::ozaki2018_small().to_values());
    let run = PointRun::new(Backend::best(), &settings, &values);
    let lift = model().experiments().unwrap().imposed(&run, &motion).unwrap();

    let at = |name: &str| lift.columns.iter().position(|column| column == name).unwrap();
    let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    for (ours, theirs) in [("lift_mn", "F_lift_N"), ("lift_translational_mn", "F_tr_lift_N")] {
        let expected = column(theirs);
        let size = peak(&expected);
        for (row, expected) in lift.rows.iter().zip(&expected) {
            // Second derivatives of samples 1/240 period apart, where the forces jump too.
            let error = (1e-3 * row[at(ours)] - expected).abs() / size;
            assert!(error < 1e-2, "{ours} at {} s: error {error:e}", row[0]);
        }
        let error: f64 = lift.rows.iter().zip(&expected).map(|(row, e)| 1e-3 * row[at(ours)] - e).sum();
        assert!((error / expected.len() as f64).abs() < 1e-4 * size, "{ours}: mean off by {error:e}");
    }
    assert!(lift.rows[7][at("power_mw")].is_nan(), "nobody measured the voltage");
    for (row, expected) in lift.rows.iter().zip(column("phidot_rad_s")) {
        assert!((row[at("stroke_rate_rad_s")] - expected).abs() < 1e-3 * 160.0);
    }
}

fn settings() -> SolverSettings {
    SolverSettings { rtol: 1e-8, atol: 1e-10, settle_tol: 1e-7, ..SolverSettings::default() }
}

/// A record with 400 samples of a sine drives the wing as a sine does, on scalars and in lanes.
#[test]
fn a_recorded_sine_drives_like_a_sine() {
    let frequency = 109.0;
    let times: Vec<f64> = (0..=400).map(|i| f64::from(i) / (400.0 * frequency)).collect();
    let wave: Vec<f64> = times.iter().map(|t| (TAU * frequency * t).sin()).collect();
    let sampled =
        model().experiments().unwrap().with_samples(Samples::new(&times, &wave, Repeat::Periodic).unwrap());
    let values = Params::ozaki2018_large().to_values();
    let set = Backend::best();
    let row = sampled.run_point(&PointRun::new(set, &settings(), &values), None);
    let sine = model().run_point(&PointRun::new(set, &settings(), &values), None);
    assert_eq!((row.status, sine.status), (Status::Periodic, Status::Periodic));
    for (i, column) in model().columns().iter().enumerate() {
        // The charge of a capacitor feels the wave's slope: a spline is third order there.
        let error = (row.measures[i] - sine.measures[i]).abs() / sine.measures[i].abs();
        let small = ["pitch_mean_deg", "energy_audit"].contains(&column.name.as_str());
        // Losses are zero, and the strain of a hinge of unknown size is not a number.
        let same = row.measures[i].to_bits() == sine.measures[i].to_bits();
        assert!(
            small || same || error < 1e-5,
            "{}: {} against {}",
            column.name,
            row.measures[i],
            sine.measures[i]
        );
    }
    rows::assert_lanes_equal_scalars(&*sampled, &vec![values; 3], &settings());
}
