//! Each design at its own resonance.

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, PointRun, Row, SolverSettings, Status, never};
use flap_sweep::plan::Plan;

use crate::support::{bits, column, mistakes, parameter, plan, rows};

/// The rows of a plan whose points are at their resonances.
fn at_resonance(plan: &Plan) -> Vec<Row> {
    rows(plan.rows(), plan.solver(), (0..plan.len()).map(|i| plan.point(i).values).collect())
}

/// A grid of designs at the resonance of the measure `of`. Peaks are flat: with a larger `rtol`, the integration errors
/// would move the peaks by more than the tolerance of the search.
fn grid(preset: &str, of: &str, range: [u32; 2], axes: &str) -> Plan {
    let [from, to] = range;
    plan(&format!(
        "preset = \"{preset}\"\n[params]\ndrive_frequency = \"resonance\"\n\
         [resonance]\nof = \"{of}\"\nfrom = \"{from} Hz\"\nto = \"{to} Hz\"\ntolerance = \"0.05 Hz\"\n\
         [solver]\nrtol = 1e-8\n[axes]\n{axes}\n"
    ))
}

/// The largest value in a fine sweep of the drive frequency, its frequency, and the number of right-hand sides. The
/// sweep has steps of 0.5 Hz, and of 0.05 Hz within 1 Hz of the largest value. The number of right-hand sides is an
/// estimate for steps of 0.05 Hz everywhere: ten times the number of the coarse sweep.
fn fine_sweep(plan: &Plan, values: &[f64], objective: usize, range: [u32; 2]) -> (f64, f64, f64) {
    let frequency = parameter(plan, "drive_frequency");
    let at = |f: f64| {
        let mut values = values.to_vec();
        values[frequency] = f;
        values
    };
    let highest = |frequencies: Vec<f64>| {
        let rows = rows(plan.simulator(), plan.solver(), frequencies.iter().map(|&f| at(f)).collect());
        let evals: u64 = rows.iter().map(|row| row.rhs_evals).sum();
        let value = |row: &Row| row.measures.get(objective).copied().unwrap_or(f64::NEG_INFINITY);
        let best = rows.iter().zip(frequencies).map(|(row, f)| (value(row), f));
        (best.max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are points"), evals)
    };
    let coarse = (2 * range[0]..=2 * range[1]).map(|half| 0.5 * f64::from(half));
    let ((_, top), evals) = highest(coarse.collect());
    let fine = (0..=40)
        .map(|i| top - 1.0 + 0.05 * f64::from(i))
        .filter(|f| (f64::from(range[0])..=f64::from(range[1])).contains(f));
    let ((value, top), _) = highest(fine.collect());
    (value, top, 10.0 * evals as f64)
}

#[test]
fn rows_are_at_the_peak_of_a_fine_sweep_for_a_tenth_of_its_cost() {
    let mut designs = 0;
    for (preset, of, name, range, axes) in [
        (
            "jafferis2016",
            "stroke",
            "stroke_amplitude_deg",
            [60, 200],
            "drive_voltage_pp = { from = \"40 V\", to = \"240 V\", n = 10 }",
        ),
        (
            "jafferis2016-improved",
            "lift",
            "lift_mean_mn",
            [60, 200],
            "drive_voltage_pp = [\"120 V\", \"200 V\"]",
        ),
        (
            "ozaki2018-large",
            "efficiency",
            "efficiency_gf_per_w",
            [60, 160],
            "hinge_stiffness = { from = \"60 uN*m/rad\", to = \"160 uN*m/rad\", n = 4 }",
        ),
        ("ozaki2018-small", "lift", "lift_mean_mn", [150, 260], "drive_voltage_pp = [\"30 V\", \"50 V\"]"),
        (
            "arabagi2013-75hz",
            "stroke",
            "stroke_amplitude_deg",
            [50, 150],
            "drive_voltage_pp = [\"100 V\", \"200 V\"]",
        ),
    ] {
        let plan = grid(preset, of, range, axes);
        let resonance = plan.rows();
        let found = column(resonance, "resonance_hz");
        let objective = column(resonance, name);
        for (index, row) in (0..).zip(at_resonance(&plan)) {
            let design = format!("{preset}, design {index}");
            assert_eq!(row.status, Status::Periodic, "{design}");
            let (value, top, evals) = fine_sweep(&plan, &plan.point(index).values, objective, range);
            let (there, frequency) = (row.measures[objective], row.measures[found]);
            println!(
                "{design}: {frequency:.3} Hz, sweep {top:.3} Hz, cost 1/{:.0}",
                evals / row.rhs_evals as f64
            );
            assert!((there - value).abs() <= 1e-4 * value.abs(), "{design}: {there} is not {value}");
            assert!((frequency - top).abs() <= 0.06, "{design}: {frequency} Hz is not {top} Hz");
            assert!(10.0 * row.rhs_evals as f64 <= evals, "{design}: {} of {evals}", row.rhs_evals);
            designs += 1;
        }
    }
    assert_eq!(designs, 20);
}

#[test]
fn a_row_is_that_of_a_sweep_at_its_frequency() {
    let plan = grid("jafferis2016", "stroke", [90, 150], "drive_voltage_pp = [\"60 V\", \"150 V\"]");
    let found = column(plan.rows(), "resonance_hz");
    let count = plan.simulator().columns().len();
    for (index, row) in (0..).zip(at_resonance(&plan)) {
        let mut values = plan.point(index).values;
        assert!(values[parameter(&plan, "drive_frequency")].is_nan(), "it is looked for");
        let alone = plan.rows().run_point(&PointRun::new(Backend::best(), plan.solver(), &values), None);
        assert_eq!(bits(&row.measures), bits(&alone.measures), "lanes and scalars");
        assert_eq!((row.cycles, row.rhs_evals), (alone.cycles, alone.rhs_evals));
        values[parameter(&plan, "drive_frequency")] = row.measures[found];
        let there = plan.simulator().run_point(&PointRun::new(Backend::best(), plan.solver(), &values), None);
        assert_eq!(bits(&row.measures[..count]), bits(&there.measures));
        assert_eq!(row.floquet_max.to_bits(), there.floquet_max.to_bits());
        assert!(row.rhs_evals > there.rhs_evals, "all of the search counts");
    }
}

/// An interruption ends the points of a search, not only the caller's wait for the search.
#[test]
fn an_interrupted_search_runs_no_points() {
    let plan = grid("jafferis2016", "stroke", [60, 200], "drive_voltage_pp = [\"160 V\"]");
    let values = plan.point(0).values;
    let run = PointRun::new(Backend::best(), plan.solver(), &values);
    let evaluations =
        |interrupted: Interrupt<'_>| plan.rows().run_point(&run.until(interrupted), None).rhs_evals;
    assert!(100 * evaluations(&|| true) < evaluations(&never));
}

#[test]
fn a_second_peak_within_five_percent_is_told() {
    // Between 130 and 140 V the peak at 83 Hz, on the way to slow flapping, and that at 135 Hz are equally high.
    let plan =
        grid("jafferis2016", "stroke", [60, 200], "drive_voltage_pp = [\"100 V\", \"134.7 V\", \"180 V\"]");
    let [found, second] = ["resonance_hz", "resonance_second_hz"].map(|name| column(plan.rows(), name));
    let rows = at_resonance(&plan);
    let peaks: Vec<[f64; 2]> = rows.iter().map(|row| [row.measures[found], row.measures[second]]).collect();
    assert!((peaks[0][0] - 89.9).abs() < 1.0 && peaks[0][1].is_nan(), "{peaks:?}");
    assert!((peaks[1][0] - 83.1).abs() < 1.0 && (peaks[1][1] - 134.6).abs() < 1.0, "{peaks:?}");
    assert!((peaks[2][0] - 123.0).abs() < 1.0 && peaks[2][1].is_nan(), "{peaks:?}");
}

#[test]
fn a_range_without_a_peak_says_so() {
    let plan = grid("jafferis2016", "stroke", [150, 200], "drive_voltage_pp = [\"160 V\"]");
    let [found, margin] = ["resonance_hz", "resonance_margin_hz"].map(|name| column(plan.rows(), name));
    let row = &at_resonance(&plan)[0];
    assert_eq!(row.measures[margin], 0.0);
    assert!(row.measures[found] < 150.1);
}

#[test]
fn the_range_follows_the_natural_frequencies() {
    let plan = plan("preset = \"ozaki2018-large\"\n[params]\ndrive_frequency = \"resonance\"\n");
    let row = &at_resonance(&plan)[0];
    let found = row.measures[column(plan.rows(), "resonance_hz")];
    assert!((found - 110.66).abs() < 0.1, "{found}");
}

#[test]
fn motions_that_do_not_repeat_have_no_resonance() {
    let plan = grid("jafferis2016", "stroke", [66, 74], "drive_voltage_pp = [\"280 V\"]");
    let hinge = parameter(&plan, "hinge_stiffness");
    let solver = SolverSettings { max_cycles: 60, ..*plan.solver() };
    let plan = plan.with_parameter(hinge, 0.7486e-6).unwrap().with_solver(solver).unwrap();
    let row = &at_resonance(&plan)[0];
    assert_eq!(row.status, Status::Unsettled);
    assert!(row.measures.is_empty() && row.cycles >= 9 * 60, "{row:?}");
}

#[test]
fn a_prescribed_stroke_has_no_resonance_but_its_lift_may() {
    for (of, status) in [("stroke", Status::Invalid), ("lift", Status::Periodic)] {
        let plan = grid("ozaki2018-small", of, [150, 250], "stroke_mode = [\"prescribed\"]");
        let row = &at_resonance(&plan)[0];
        assert_eq!(row.status, status, "{of}");
        let reason = row.reason.clone().unwrap_or_default();
        assert_eq!(reason.contains("has no resonance"), status == Status::Invalid, "{reason}");
    }
}

#[test]
fn mistakes_are_told() {
    let start = "preset = \"jafferis2016\"\n";
    let asked = "[params]\ndrive_frequency = \"resonance\"\n";
    for (rest, expected) in [
        ("[resonance]\nof = \"lift\"\n".to_owned(), "[resonance] has no effect"),
        (format!("{asked}[resonance]\nof = \"drag\"\n"), "`of` has no option `drag`"),
        (format!("{asked}[resonance]\nfrom = \"90 Hz\"\nto = 80\n"), "`to` must be more than `from`, 90 Hz"),
        (format!("{asked}[resonance]\ntolerance = 0\n"), "`tolerance` must be more than zero, not 0 Hz"),
        (format!("{asked}[resonance]\nfrom = \"1 m\"\n"), "`from`"),
        (format!("{asked}[resonance]\nat = 1\n"), "unknown key `at`"),
        (format!("{asked}[axes]\ndrive_frequency = [100]\n"), "set under [params] and varied by an axis"),
        (format!("{asked}[output]\ncolumns = [\"resonance\"]\n"), "has no column `resonance`"),
        ("[params]\ndrive_voltage_pp = \"resonance\"\n".to_owned(), "`drive_voltage_pp`"),
    ] {
        let found = mistakes(&format!("{start}{rest}"));
        assert!(found.len() == 1 && found[0].contains(expected), "{rest}: {found:?}");
    }
}

/// Without a drive voltage, the power is zero and the efficiency is undefined at every frequency.
#[test]
fn a_design_without_efficiency_is_invalid() {
    let plan = grid("jafferis2016", "efficiency", [100, 140], "drive_voltage_pp = [\"0 V\", \"160 V\"]");
    let statuses = at_resonance(&plan).iter().map(|row| row.status).collect::<Vec<_>>();
    assert_eq!(statuses, [Status::Invalid, Status::Periodic]);
}
