//! Rows with reduced accuracy or reliability: the report at the end of a sweep, and the commands that improve the rows.

use crate::support::Folder;

#[test]
fn rows_that_miss_the_accuracy_are_counted_and_can_be_run_again() {
    let grid =
        "preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = [100, 110]\n[solver]\naccuracy = 1e-14\n";
    let folder = Folder::with_grid(grid);
    let said = "2 rows miss the accuracy of [solver] (see the column error_estimate). To run them again: \
                flap results rerun rows.csv --inaccurate --rtol 1e-10 --out rows.accurate.csv\n";
    folder.ends(0, "sweep --grid grid.toml --out rows.csv").says(said);
    assert!(folder.read("rows.csv.meta.toml").contains("[summary.warnings]\ninaccurate = 2\n"));

    let again =
        folder.ends(0, "results rerun rows.csv --inaccurate --rtol 1e-8 --accuracy 1e-2 --out again.csv");
    assert!(again.stderr.contains("2 periodic") && !again.stderr.contains("miss"), "{}", again.stderr);
    assert_eq!(folder.read("again.csv").lines().count(), 3);

    let none = folder.flap("results rerun again.csv --inaccurate --out third.csv");
    none.says("no point in again.csv is inaccurate");
    folder.ends(2, "results rerun again.csv --out third.csv");
}

/// The rows have no column that shows which rows are inaccurate.
#[test]
fn rows_without_their_estimate_cannot_be_chosen_by_it() {
    let grid =
        "preset = \"ozaki2018-large\"\n[solver]\naccuracy = 1e-14\n[output]\ncolumns = [\"lift_mean_mn\"]\n";
    let folder = Folder::with_grid(grid);
    folder.ends(0, "sweep grid.toml --out rows.csv").says(
        "1 row misses the accuracy of [solver]: use a smaller rtol, or add `error_estimate` to `columns`\n",
    );
    assert_eq!(folder.read("rows.csv").lines().next(), Some("point,status,lift_mean_mn"));
    folder.refuses(
        "results rerun rows.csv --inaccurate --rtol 1e-10 --out again.csv",
        "error: rows.csv: the rows have no column `error_estimate`: their grid leaves it out of `columns` in [output]\n\
         help: add the column to `columns` and sweep again, or choose points with --status\n",
    );
    // Everything else reads such rows.
    folder.ends(0, "results rerun rows.csv --status periodic --out again.csv");
    folder.ends(0, "sweep grid.toml --out rows.csv").says("nothing is left to run");
    folder.ends(0, "results convert rows.csv rows.parquet");
    folder.ends(0, "results verify rows.csv rows.parquet again.csv");
    folder.ends(0, "top rows.parquet --by lift_mean_mn").prints("lift_mean_mn");
    folder.ends(2, "top rows.csv --by cycles").says("there is no column `cycles`");
}

#[test]
fn resonances_at_an_end_of_their_range_are_counted() {
    let grid = "preset = \"ozaki2018-large\"\n[params]\ndrive_frequency = \"resonance\"\n\
                [resonance]\nfrom = \"60 Hz\"\nto = \"70 Hz\"\n";
    let folder = Folder::with_grid(grid);
    folder.ends(0, "sweep --grid grid.toml --out rows.csv").says("1 resonance is at an end of its range");
}

/// A wide wing on a soft hinge, whose pitch is fast compared with its stroke.
const GAINING: &str = r#"
preset = "ozaki2018-large"

[params]
drive_frequency = 131.36334572941365
wing_length = 0.046815541503120006
mean_chord = 0.011357436260586174
hinge_stiffness = 4.083303093082505e-5
shape_moment_13 = 1.178361517868167
shape_moment_31 = 0.8137032474454492
shim_thickness = 7.537287347476463e-5
drag_coefficient_max = 5.5167793985664275
rotation_drag = 3.9433014244420006
"#;

#[test]
fn rows_to_which_the_air_gives_energy_are_counted() {
    let folder = Folder::with_grid(GAINING);
    folder.ends(0, "sweep --grid grid.toml --out rows.csv").says("1 row has negative mean power");
}
