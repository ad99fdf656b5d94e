//! Orbits of Newton shooting: their multipliers, and points for which marching would need hundreds of periods.

use flap_core::model::{bimorph, direct_drive};
use flap_core::num::Backend;
use flap_core::simulate::{PointRun, Row, SolverSettings, Status, by_name};

use crate::data::{assert_close, table};

fn run(model: &str, values: &[f64], rtol: f64, settle_tol: f64) -> Row {
    run_with(
        model,
        values,
        &SolverSettings { rtol, atol: 1e-2 * rtol, settle_tol, ..SolverSettings::default() },
    )
}

fn run_with(model: &str, values: &[f64], solver: &SolverSettings) -> Row {
    by_name(model).unwrap().run_point(&PointRun::new(Backend::best(), solver, values), None)
}

#[test]
fn multipliers_of_rows_equal_the_reference() {
    let full = SolverSettings { progressive: false, ..SolverSettings::default().with_rtol(1e-8) };
    let progressive = SolverSettings { progressive: true, ..full };
    for (solver, tolerance) in [(full, 1e-4), (progressive, 2e-4)] {
        let check = |model: &str, values: &[f64], expected: f64, name: &str| {
            let row = run_with(model, values, &solver);
            assert_eq!((row.status, row.period), (Status::Periodic, 1), "{name}");
            assert_close(row.floquet_max, expected, tolerance, name);
        };
        for record in table("direct-drive/steady_cases.csv") {
            let (drive_voltage_pp, drive_frequency) = (2.0 * record.number("V0_V"), record.number("f_Hz"));
            let p = direct_drive::Params {
                drive_voltage_pp,
                drive_frequency,
                ..crate::direct_drive::params(record.text("type"))
            };
            check("direct-drive", &p.to_values(), record.number("floquet_max"), &record.name);
        }
        for record in table("bimorph/steady_cases.csv") {
            let p = crate::bimorph::driven(&crate::bimorph::params(record.text("set")), &record);
            check("bimorph", &p.to_values(), record.number("floquet_abs_max"), &record.name);
        }
    }
}

/// Weakly damped points, for which marching needs from 100 to 15,000 periods to reach a tolerance of 1e-6.
#[test]
fn slow_points_are_found_in_few_periods() {
    let t1 = |drive_voltage_pp, drive_frequency| {
        bimorph::Params { drive_voltage_pp, drive_frequency, ..bimorph::Params::jafferis2016() }.to_values()
    };
    let small = direct_drive::Params {
        drive_voltage_pp: 30.0,
        drive_frequency: 220.0,
        ..direct_drive::Params::ozaki2018_small()
    };
    for (model, values, slowest) in [
        ("bimorph", t1(40.0, 60.0), 0.94),
        ("bimorph", t1(40.0, 20.0), 0.995),
        ("direct-drive", small.to_values(), 0.9),
    ] {
        let row = run(model, &values, 1e-10, 1e-8);
        // A march decays by the multiplier per period: from a residual of 1 to 1e-8.
        let march = -8.0 * std::f64::consts::LN_10 / row.floquet_max.ln();
        println!(
            "{model}: {} periods, residual {:.1e}, multiplier {:.5}: {march:.0} periods of marching",
            row.cycles, row.residual, row.floquet_max
        );
        assert_eq!(row.status, Status::Periodic);
        assert!(row.residual <= 1e-8 && row.cycles <= 120, "{row:?}");
        assert!(row.floquet_max > slowest && row.floquet_max < 1.0, "{}", row.floquet_max);
    }
}
