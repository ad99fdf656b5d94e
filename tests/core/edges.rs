//! Unusual motions: very small motions, no motion, large reactive power, and drives with edges.

use flap_core::num::Backend;
use flap_core::simulate::{PointRun, Row, Simulator, SolverSettings, Status, preset};

use crate::by_name::design;
use crate::data::assert_close;
use crate::rows;

fn run(design: &(&'static dyn Simulator, Vec<f64>), rtol: f64) -> Row {
    let solver = SolverSettings { settle_tol: rtol.max(1e-9), ..SolverSettings::default().with_rtol(rtol) };
    let row = design.0.run_point(&PointRun::new(Backend::best(), &solver, &design.1), None);
    assert_eq!(row.status, Status::Periodic, "{row:?}");
    row
}

fn measure(design: &(&'static dyn Simulator, Vec<f64>), row: &Row, name: &str) -> f64 {
    row.measures[design.0.columns().iter().position(|column| column.name == name).unwrap()]
}

/// Far above resonance, or at very small voltages, the reactive power is 10^3 to 10^6 times the lost power. The
/// smallest motions have 10^-5 degrees.
#[test]
fn power_of_small_motions_is_as_exact_as_their_stroke() {
    let cases: [(&str, &[(&str, f64)]); 7] = [
        ("ozaki2018-large", &[("drive_frequency", 1000.0)]),
        ("ozaki2018-large", &[("drive_frequency", 2000.0)]),
        ("ozaki2018-large", &[("drive_frequency", 50_000.0)]),
        ("ozaki2018-small", &[("drive_voltage_pp", 1e-3)]),
        ("jafferis2016", &[("drive_voltage_pp", 30.0), ("drive_frequency", 60.0)]),
        ("jafferis2016", &[("drive_voltage_pp", 0.01)]),
        ("arabagi2013-75hz", &[("drive_voltage_pp", 1e-3)]),
    ];
    for (name, changes) in cases {
        let design = design(name, changes);
        let exact = run(&design, 1e-11);
        for rtol in [1e-5, 1e-6, 1e-8] {
            let row = run(&design, rtol);
            for column in ["stroke_amplitude_deg", "pitch_amplitude_deg", "power_mean_mw"] {
                let [value, wanted] = [&row, &exact].map(|row| measure(&design, row, column));
                let what = format!("{name} {changes:?} at {rtol}: {column}");
                assert!(wanted > 0.0, "{what}");
                assert_close(value, wanted, 3.0 * row.error_estimate, &what);
            }
            assert!(
                measure(&design, &row, "energy_audit").abs() < (1000.0 * rtol).max(1e-3),
                "{name} {changes:?}"
            );
        }
    }
}

/// Without drive the wing does not move, and every motion would decay.
#[test]
fn a_wing_at_rest_is_stable() {
    for (name, still) in [
        ("jafferis2016", ("drive_voltage_pp", 0.0)),
        ("ozaki2018-large", ("drive_voltage_pp", 0.0)),
        ("arabagi2013-75hz", ("drive_voltage_pp", 0.0)),
    ] {
        let design = design(name, &[still]);
        let row = run(&design, 1e-6);
        assert_eq!((row.stable(), row.floquet_max.is_nan()), (Some(true), true), "{name}: {row:?}");
        for column in ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"] {
            assert_eq!(measure(&design, &row, column), 0.0, "{name}: {column}");
        }
        assert!(measure(&design, &row, "efficiency_gf_per_w").is_nan());
        assert!(row.error_estimate <= 1e-5, "{}", row.error_estimate);
    }
}

/// Plates without piezoelectric stress consume no power. flap spends no work on the energy audit of zero power.
#[test]
fn a_point_without_power_is_not_refined() {
    let still = design("jafferis2016", &[("drive_voltage_pp", 0.0)]);
    let dead = design("jafferis2016", &[("piezo_stress_min", 0.0), ("piezo_stress_max", 0.0)]);
    let [still, dead] = [still, dead].map(|design| run(&design, 1e-6));
    assert!(dead.rhs_evals < 2 * still.rhs_evals, "{} and {}", dead.rhs_evals, still.rhs_evals);
}

/// Peaks of signals that follow the drive, for every drive shape.
#[test]
fn peaks_are_exact_for_every_drive() {
    let shapes: [&[(&str, f64)]; 3] = [
        &[("drive_shape", 0.0)],
        &[
            ("drive_shape", 1.0),
            ("drive_second_harmonic", 0.2),
            ("drive_second_phase", 0.5),
            ("drive_third_harmonic", -0.15),
        ],
        &[("drive_shape", 2.0)],
    ];
    for name in ["jafferis2016", "jafferis2016-improved", "ozaki2018-large", "arabagi2013-75hz"] {
        for shape in shapes {
            let design = design(name, shape);
            let [row, exact] = [1e-6, 1e-11].map(|rtol| run(&design, rtol));
            for (i, column) in design.0.columns().iter().enumerate() {
                let is_peak = ["_peak_", "_pp_", "_amplitude_"].iter().any(|part| column.name.contains(part));
                let wanted = exact.measures[i];
                if is_peak && wanted != 0.0 {
                    assert_close(
                        row.measures[i],
                        wanted,
                        1e-4,
                        &format!("{name} {shape:?}: {}", column.name),
                    );
                }
            }
        }
    }
}

/// In a uniform flow the air can give energy to the wing. A wing that gains energy has no efficiency.
#[test]
fn efficiency_needs_power() {
    let (model, preset) = preset("ozaki2018-large").unwrap();
    let designs = crate::accuracy::designs(model, preset);
    let solver = SolverSettings { max_cycles: 50, ..SolverSettings::default() };
    let rows = rows::of(model, &designs[..600], Backend::best(), &solver);
    let position = |name: &str| model.columns().iter().position(|column| column.name == name).unwrap();
    let (power, efficiency) = (position("power_mean_mw"), position("efficiency_gf_per_w"));
    let periodic: Vec<&Row> = rows.iter().filter(|row| row.status == Status::Periodic).collect();
    let driven: Vec<_> = periodic.iter().filter(|row| row.measures[power] <= 0.0).collect();
    assert!(
        !driven.is_empty() && driven.len() * 50 < periodic.len(),
        "{} of {}",
        driven.len(),
        periodic.len()
    );
    for row in periodic {
        assert_eq!(row.measures[efficiency].is_nan(), row.measures[power] <= 0.0, "{row:?}");
    }
}

/// The map of a period jumps where the error of a step is almost equal to the tolerance. These jumps must not keep
/// points unsettled.
#[test]
fn no_point_of_a_preset_stays_unsettled_by_jumps_of_the_period_map() {
    for name in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let mut points = Vec::new();
        for i in 0..250 {
            for volts in [0.6, 0.8, 1.0] {
                let (model, preset) = preset(name).unwrap();
                let mut values = (preset.values)();
                for (parameter, value) in model.parameters().iter().zip(&mut values) {
                    match parameter.name {
                        "drive_frequency" => *value *= 0.7 + 0.002 * f64::from(i),
                        "drive_voltage_pp" => *value *= volts,
                        _ => {}
                    }
                }
                points.push(values);
            }
        }
        let solver = SolverSettings { settle_tol: 1e-7, ..SolverSettings::default().with_rtol(1e-6) };
        let rows = rows::of(preset(name).unwrap().0, &points, Backend::best(), &solver);
        let unsettled = rows.iter().filter(|row| row.status != Status::Periodic).count();
        assert_eq!(unsettled, 0, "{name}: of {} points", points.len());
    }
}
