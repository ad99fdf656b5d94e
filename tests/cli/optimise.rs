//! `flap optimise`: the best design within the axes of a grid.

use std::fs;

use crate::support::Folder;

const GRID: &str = r#"
preset = "ozaki2018-large"

[axes]
drive_voltage_pp = { from = "60 V", to = "100 V", n = 3 }
drive_frequency = { from = "95 Hz", to = "120 Hz", n = 4 }

[derived]
air_density = "preset.air_density * (drive_voltage_pp / preset.drive_voltage_pp)^0.1"

[measure]
lift_per_power = "lift_mean_mn / power_mean_mw"
"#;

const CONDITION: [&str; 2] = ["--where", "stroke_pp_deg < 60 deg and power_mean_mw < 30 mW"];

/// The value in a row of the result.
fn value(csv: &str, section: &str, name: &str) -> String {
    let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let row = rows.find(|row| row[0] == section && row[1] == name).unwrap_or_else(|| panic!("{name}\n{csv}"));
    row[2].to_owned()
}

#[test]
fn a_device_has_the_row_of_the_optimum_to_the_last_digit() {
    let folder = Folder::with_grid(GRID);
    let goal = ["optimise", "grid.toml", "--maximise", "lift_mean_mn"];
    let csv = [&goal[..], &CONDITION, &["--format", "csv", "--threads"]].concat();
    let one = folder.ends_with(0, &[&csv[..], &["1", "--out", "best.toml"]].concat());
    one.says("the design is in best.toml: `flap run best.toml` computes its row");
    let four = folder.ends_with(0, &[&csv[..], &["4"]].concat());
    assert!(one.stdout == four.stdout, "{}{}", one.stdout, four.stdout);
    assert_eq!(value(&one.stdout, "answer", "status"), "optimal");
    let row = folder.ends(0, "run best.toml --format csv").stdout;
    for line in row.lines().skip(9) {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(value(&one.stdout, "measure", cells[0]), cells[1], "{line}");
    }
    assert!(value(&one.stdout, "measure", "lift_per_power").parse::<f64>().unwrap() > 0.0);
    assert_ne!(value(&one.stdout, "parameter", "air_density"), "");

    let again = [&goal[..], &["--out", "best.toml"]].concat();
    folder.ends_with(2, &again).says("use --force to overwrite the file");
    let forced = [&again[..], &["--force", "--rtol", "1e-8"]].concat();
    folder.ends_with(0, &forced).says("`flap run best.toml --rtol 1e-8");
    let solver = "[solver]\nrtol = 1e-5\naccuracy = 1e-3\nmax_steps = 10000\n";
    fs::write(folder.path("solver.toml"), format!("{GRID}{solver}")).unwrap();
    folder
        .ends(0, "optimise solver.toml --maximise lift_mean_mn --out solved.toml --starts 1 --sample 8")
        .says("`flap run solved.toml --rtol 1e-5 --accuracy 0.001` computes its row")
        .says("a device has no [solver], so this row is computed with the default of max_steps\n");
    folder.refuses(
        "optimise grid.toml --maximise lift_mean_mn --out grid.toml --force",
        "inputs are never overwritten",
    );
}

#[test]
fn the_answer_names_what_holds_the_design_back() {
    let folder = Folder::with_grid(GRID);
    let ended = folder
        .ends_with(0, &[&["optimise", "grid.toml", "--maximize", "lift_mean_mn"], &CONDITION[..]].concat());
    for text in [
        "optimal: the largest lift_mean_mn is ",
        "MEASURE",
        "stroke_pp_deg < 60 deg",
        "bounds and conditions that limit the design:\n  1 % more of the ",
        " end at this design",
    ] {
        assert!(ended.stdout.contains(text), "{text}:\n{}", ended.stdout);
    }
    ended.says(" of them with derivatives, in ");
    let wide = folder.ends(0, "optimise grid.toml --maximise lift_mean_mn");
    wide.says("warning: drive_voltage_pp = 100 V is at an end of its axis (60 V to 100 V): a wider axis may have a better design");
}

#[test]
fn without_a_feasible_design_the_exit_code_is_1() {
    let folder = Folder::with_grid(GRID);
    let ended =
        folder.ends(1, "optimise grid.toml --maximise lift_mean_mn --where power_mean_mw<0.1 --format csv");
    assert_eq!(value(&ended.stdout, "answer", "status"), "infeasible");
    let page = folder.ends(1, "optimise grid.toml --maximise lift_mean_mn --where power_mean_mw<0.1").stdout;
    assert!(
        page.starts_with("infeasible: no design satisfies all conditions; this design has the smallest violation of the conditions"),
        "{page}"
    );
    assert!(page.contains("no, by "), "{page}");
}

/// A condition on a choice excludes designs.
#[test]
fn a_condition_chooses_the_device() {
    let folder = Folder::new();
    for (name, volts) in [("short", 60), ("long", 100)] {
        let device = format!("preset = \"ozaki2018-large\"\n[params]\ndrive_voltage_pp = \"{volts} V\"\n");
        fs::write(folder.path(&format!("{name}.toml")), device).unwrap();
    }
    let grid =
        "device = [\"short.toml\", \"long.toml\"]\n[axes]\ndrive_frequency = [\"100 Hz\", \"110 Hz\"]\n";
    fs::write(folder.path("grid.toml"), grid).unwrap();
    let best = |options: &str| {
        let command = format!("optimise grid.toml --maximise lift_mean_mn --format csv{options}");
        value(&folder.ends(0, &command).stdout, "parameter", "device")
    };
    assert_eq!(
        ["", " --where device=='short'", " --where device!='long'"].map(best),
        ["long", "short", "short"]
    );
    folder.refuses(
        "optimise grid.toml --maximise lift_mean_mn --where device=='shrt'",
        "--where device=='shrt': `device` has no option `shrt`",
    );
    let condition = ["--where", "device=='short' or lift_mean_mn > 1"];
    folder
        .ends_with(2, &[&["optimise", "grid.toml", "--maximise", "lift_mean_mn"], &condition[..]].concat())
        .says("a condition on measures consists of comparisons with <, <=, > or >=, joined with `and`\n")
        .says("help: only conditions on parameters alone can contain `or`, `not`, == or !=\n");
}

#[test]
fn mistakes_have_their_place_and_help() {
    let folder = Folder::with_grid(GRID);
    for (arguments, message, help) in [
        (
            "--maximise lift_mean",
            "--maximise lift_mean: unknown name `lift_mean`",
            "did you mean `lift_mean_mn`?",
        ),
        ("--minimise lift_mean_mn>1", "--minimise lift_mean_mn>1: a condition, not a number", ""),
        (
            "--maximise lift_mean_mn --where stroke_pp_deg<100V",
            "--where stroke_pp_deg<100V: `V` is a voltage",
            "use deg",
        ),
        ("--maximise lift_mean_mn --where stroke_pp_deg", "a number, not a condition", "write a comparison"),
        (
            "--maximise lift_mean_mn --minimise cycles",
            "give a front of designs, not one best design",
            "add --points N",
        ),
        ("--maximise lift_mean_mn --points 3", "--points needs both --maximise and --minimise", ""),
        ("", "required arguments were not provided", "--maximise"),
    ] {
        let command = format!("optimise grid.toml {arguments}");
        folder.refuses(&command, message);
        folder.ends(2, &command).says(help);
    }
    fs::write(folder.path("preset.toml"), "preset = \"ozaki2018-large\"\n").unwrap();
    folder
        .refuses("optimise preset.toml --maximise lift_mean_mn", "preset.toml: the grid varies no parameter");
    fs::write(folder.path("fast.toml"), GRID.replace("[axes]", "[solver]\nmax_cycles = 2\n[axes]")).unwrap();
    folder.refuses("optimise fast.toml --maximise lift_mean_mn", "has a periodic motion");
    folder.refuses("optimise grid.toml --maximise 1/0", "has a periodic motion with a finite goal");
}

#[test]
fn a_front_is_a_table_of_designs() {
    let folder = Folder::with_grid(GRID);
    let goals = "optimise grid.toml --maximise lift_mean_mn --minimise power_mean_mw --points 5";
    let ended = folder.ends(0, &format!("{goals} --format csv"));
    fs::write(folder.path("front.csv"), &ended.stdout).unwrap();
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert!(
        lines[0].starts_with("point,drive_voltage_pp,drive_frequency,air_density,status,stroke"),
        "{}",
        lines[0]
    );
    assert_eq!(lines.len(), 6);
    folder.ends(0, "plot front.csv --x power_mean_mw --y lift_mean_mn --out front.svg");
    let page = folder.ends(0, goals).stdout;
    assert!(page.starts_with("lift_mean_mn  power_mean_mw  drive_voltage_pp (V)"), "{page}");
    assert_eq!(page.lines().count(), 6);
}

#[test]
fn a_front_has_each_design_once() {
    let folder = Folder::with_grid(GRID);
    let goals = "optimise grid.toml --maximise lift_mean_mn --minimise=-2*lift_mean_mn --points 4";
    let page = folder.ends(0, goals).stdout;
    assert_eq!(page.lines().count(), 2, "one design is the best for both goals: {page}");
}
