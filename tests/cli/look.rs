//! `flap top` and `flap describe`.

use std::fs;

use serde_json::Value;

use crate::support::{Folder, frequencies, numbers, quick, start, wait, wait_for_rows};

/// A grid with two axes. Some of its points do not settle within `max_cycles` drive periods.
const GRID: &str = "\
preset = \"ozaki2018-large\"
[axes]
hinge_stiffness = [\"60 uN*m/rad\", \"100 uN*m/rad\", \"160 uN*m/rad\"]
drive_frequency = { from = 95, to = 122, n = 10 }
[solver]
max_cycles = 20
newton = false
";

/// A folder with the results `rows.csv` of a grid.
fn swept(grid: &str) -> Folder {
    let folder = Folder::with_grid(grid);
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder
}

/// A folder with results whose rows are all periodic.
fn periodic() -> Folder {
    swept(&GRID.replace("max_cycles = 20\nnewton = false\n", ""))
}

/// Lines of comma-separated values: names, then rows.
fn cells(text: &str) -> Vec<Vec<String>> {
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The command's JSON.
fn json(folder: &Folder, arguments: &str) -> Value {
    serde_json::from_str(&folder.ends(0, &format!("{arguments} --format json")).stdout).unwrap()
}

#[test]
fn the_best_rows_come_first() {
    let folder = periodic();
    let file = folder.read("rows.csv");
    let mut lift = numbers(&file, "lift_mean_mn");
    let top = folder.ends(0, "top rows.csv --by lift_mean_mn -n 4 --format csv --columns cycles");
    top.says("4 rows with the largest lift_mean_mn of 30 periodic rows\n");
    let best = cells(&top.stdout);
    assert_eq!(best[0], ["point", "hinge_stiffness", "drive_frequency", "lift_mean_mn", "cycles", "status"]);
    lift.sort_by(|a, b| b.total_cmp(a));
    assert_eq!(numbers(&top.stdout, "lift_mean_mn"), lift[..4]);
    // Cells are those of the file.
    let (rows, point) = (cells(&file), best[1][0].parse::<usize>().unwrap());
    assert!(best[1].iter().all(|cell| rows[point + 1].contains(cell)), "{best:?}");

    // Of power, less is better, unless it is asked for otherwise.
    let mut power = numbers(&file, "power_mean_mw");
    power.sort_by(f64::total_cmp);
    let least = folder.ends(0, "top rows.csv --by power_mean_mw -n 2 --format csv");
    least.says("2 rows with the smallest power_mean_mw");
    assert_eq!(numbers(&least.stdout, "power_mean_mw"), power[..2]);
    let most = folder.ends(0, "top rows.csv --by power_mean_mw -n 1 --aim max --format csv");
    assert_eq!(numbers(&most.stdout, "power_mean_mw"), power[29..]);
    assert_eq!(cells(&folder.ends(0, "top rows.csv --by cycles --format csv").stdout).len(), 11, "ten rows");
    folder.ends_with(0, &["top", "rows.csv", "--by", " cycles"]);
    assert_eq!(cells(&folder.ends(0, "top rows.csv --by cycles -n 99 --format csv").stdout).len(), 31);
}

#[test]
fn a_table_is_for_people_and_json_for_programs() {
    let folder = periodic();
    let table = folder.ends(0, "top rows.csv --by lift_mean_mn -n 3").stdout;
    let words = |line: &str| -> Vec<String> {
        line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
    };
    let lines: Vec<Vec<String>> = table.lines().map(words).collect();
    let headings = ["point", "hinge_stiffness (µN·m/rad)", "drive_frequency (Hz)", "lift_mean_mn", "status"];
    assert_eq!(lines[0], headings);
    assert_eq!(lines.len(), 4);
    assert!(["60.0", "100.0", "160.0"].contains(&lines[1][1].as_str()), "{table}");
    assert_eq!(lines[1][4], "periodic");
    assert!(lines[1][3].len() <= 8, "six digits: {table}");

    let objects = json(&folder, "top rows.csv --by lift_mean_mn -n 3 --columns stable");
    let rows = cells(&folder.ends(0, "top rows.csv --by lift_mean_mn -n 3 --format csv").stdout);
    let objects = objects.as_array().unwrap();
    assert_eq!(objects.len(), 3);
    for (object, row) in objects.iter().zip(&rows[1..]) {
        assert_eq!(object["point"].as_u64().unwrap().to_string(), row[0]);
        assert_eq!(object["lift_mean_mn"].as_f64(), row[3].parse().ok());
        assert_eq!((object["status"].as_str(), object["stable"].as_bool()), (Some("periodic"), Some(true)));
    }
}

#[test]
fn only_periodic_rows_are_ranked_unless_all_are_asked_for() {
    let folder = swept(GRID);
    let unsettled = folder.read("rows.csv").matches(",unsettled,").count();
    assert!((2..30).contains(&unsettled), "{unsettled}");
    let top = folder.ends(0, "top rows.csv --by cycles -n 30 --format csv");
    top.says(&format!("; {unsettled} rows of other statuses not ranked (--all ranks them)\n"));
    assert_eq!(cells(&top.stdout).len(), 31 - unsettled);
    let all = folder.ends(0, "top rows.csv --by cycles -n 30 --all --format csv");
    all.says("30 rows with the largest cycles of 30 rows\n");
    assert!(all.stdout.contains(",unsettled\n"));
    let lift = folder.ends(0, "top rows.csv --by lift_mean_mn -n 30 --all --format csv");
    lift.says(&format!("; {unsettled} rows without a value\n"));

    let described = json(&folder, "describe rows.csv");
    assert_eq!(described["rows"], 30);
    let statuses = described["statuses"].as_array().unwrap();
    let count =
        |name: &str| statuses.iter().find(|status| status["status"] == name).unwrap()["rows"].as_u64();
    assert_eq!(count("unsettled"), Some(unsettled as u64));
    assert_eq!(count("periodic"), Some(30 - unsettled as u64));
    let columns = described["columns"].as_array().unwrap();
    let lift = columns.iter().find(|spread| spread["column"] == "lift_mean_mn").unwrap();
    assert_eq!(lift["count"], 30 - unsettled);
}

#[test]
fn conditions_choose_rows() {
    let folder = periodic();
    let file = folder.read("rows.csv");
    let (stiffness, power) = (numbers(&file, "hinge_stiffness"), numbers(&file, "power_mean_mw"));
    let mut sorted = power.clone();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted[15];
    let kept = |arguments: &[&str]| {
        let begin = ["top", "rows.csv", "--by", "cycles", "-n", "99", "--format", "csv"];
        cells(&folder.ends_with(0, &[&begin, arguments].concat()).stdout).len() - 1
    };
    assert_eq!(kept(&["--where", "hinge_stiffness=100 uN*m/rad"]), 10);
    assert_eq!(kept(&["--where", "hinge_stiffness=1e-4"]), 10);
    assert_eq!(kept(&["--where", "status=periodic"]), 30);
    assert_eq!(kept(&["--where", "status == 'periodic' and stable"]), 30);
    let comparison = format!("power_mean_mw < {middle}");
    assert_eq!(kept(&["--where", &comparison]), power.iter().filter(|power| **power < middle).count());
    let both = power.iter().zip(&stiffness).filter(|(power, k)| **power < middle && **k > 7e-5).count();
    assert_eq!(kept(&["--where", &comparison, "--where", "hinge_stiffness>7e-5"]), both);
    assert_eq!(kept(&["--where", &format!("{comparison} and hinge_stiffness > 7e-5")]), both);

    for (condition, message, help) in [
        ("drive_frequency=95 V", "`V` is a voltage, but drive_frequency is in Hz\n", "help: use Hz"),
        ("drive_frequency>95V", "`V` is a voltage, but drive_frequency is in Hz\n", "help: use Hz"),
        ("cycles>1.2.3", "`1.2.3` is not a number\n", "help: compare a number with a column"),
        (
            "drive_frequency",
            "this is a number, not a condition\n",
            "help: write COLUMN=VALUE, or a comparison",
        ),
        ("drive_frequenzy>1", "unknown name `drive_frequenzy`\n", "did you mean `drive_frequency`?"),
        ("zzz>1", "unknown name `zzz`\n", "the columns are point, hinge_stiffness, "),
        ("a=1", "there is no column `a`\n", "the columns are point, hinge_stiffness, "),
        ("status=='periodc'", "`status` has no option `periodc`\n", "did you mean `periodic`?"),
        ("status==periodic", "expected the name of an option in quotes\n", "help: write COLUMN=WORD"),
        ("lift_mean_mn>1 and cycles=3", "`=` is not an operator\n", "help: write == to compare"),
        ("lift_mean_mn>1e9", "no row of rows.csv satisfies --where\n", "`flap describe` shows the range"),
    ] {
        for begin in [&["top", "rows.csv", "--by", "cycles"][..], &["describe", "rows.csv"]] {
            let ended = folder.ends_with(2, &[begin, &["--where", condition]].concat());
            ended.says(message).says(help);
            assert_eq!(ended.stdout, "", "{condition}");
        }
    }
}

#[test]
fn every_format_is_read() {
    let folder = periodic();
    let top = "--by efficiency_gf_per_w -n 5 --format csv";
    let expected = folder.ends(0, &format!("top rows.csv {top}")).stdout;
    let described = folder.ends(0, "describe rows.csv --format csv").stdout;
    for ending in ["csv.zst", "parquet"] {
        folder.ends(0, &format!("results convert rows.csv rows.{ending}"));
        assert_eq!(folder.ends(0, &format!("top rows.{ending} {top}")).stdout, expected);
        assert_eq!(folder.ends(0, &format!("describe rows.{ending} --format csv")).stdout, described);
    }
    fs::remove_file(folder.path("rows.csv.meta.toml")).unwrap();
    let alone = folder.ends(0, &format!("top rows.csv {top}"));
    assert_eq!(alone.says("could not be verified").stdout, expected);
    fs::write(folder.path("rows.csv.zst"), "rubbish").unwrap();
    folder.ends(3, &format!("top rows.csv.zst {top}")).says("rows.csv.zst is damaged");
    folder.ends(2, &format!("top grid.toml {top}")).says("grid.toml");
}

/// flap reads the existing rows of unfinished results.
#[test]
#[cfg(unix)]
fn unfinished_results_are_read() {
    let folder = Folder::with_grid(&frequencies(1_000_000));
    let mut child = start(&folder, &["sweep", "grid.toml", "--checkpoint", "5 ms"]);
    wait_for_rows(&folder, 300);
    child.kill().unwrap();
    wait(&mut child);
    let described = folder.ends(0, "describe grid.csv --columns lift_mean_mn");
    described.says("grid.csv is unfinished: ").prints("periodic");
    folder.ends(0, "top grid.csv --by lift_mean_mn -n 2").says("grid.csv is unfinished: ").prints("periodic");
}

#[test]
fn columns_that_cannot_be_ranked_are_named() {
    let folder = swept(&quick(3));
    folder.ends(2, "top rows.csv --by lift_mean_mn").says(
        "error: no periodic row of rows.csv has a value of lift_mean_mn\nhelp: --all uses rows of every status\n",
    );
    folder
        .refuses("top rows.csv --by lift_mean_mn --all", "no row of rows.csv has a value of lift_mean_mn\n");
    folder.refuses("describe rows.csv --by lift_mean_mn", "no periodic row of rows.csv has a value of lift");
    folder.refuses("top rows.csv --by status --all", "column `status` contains text such as `unsettled`");
    folder.refuses("top rows.csv --by lift_men_mn", "did you mean `lift_mean_mn`?");
    folder.refuses("describe rows.csv --by status --all", "column `status` contains text, not numbers");
    folder.refuses("top rows.csv --by residual -n 0", "expected a whole number of 1 or more");
    folder.refuses("top rows.csv", "--by <COLUMN>");
    // Nothing is periodic, and that is told.
    folder.ends(0, "describe rows.csv").prints("unsettled  3     100.0 %\n");
    fs::write(folder.path("empty.csv"), "point,status,lift_mean_mn\n").unwrap();
    folder.refuses("top empty.csv --by lift_mean_mn", "error: empty.csv has no rows\n");
    folder.refuses("describe empty.csv", "error: empty.csv has no rows\n");
    fs::write(folder.path("twice.csv"), "point,lift_mean_mn,lift_mean_mn\n0,1,2\n").unwrap();
    folder.ends(3, "top twice.csv --by lift_mean_mn").says("two columns are named lift_mean_mn: rename one");
}

#[test]
fn percentiles_are_those_of_the_rows() {
    let folder = swept(&frequencies(41));
    let mut lift = numbers(&folder.read("rows.csv"), "lift_mean_mn");
    lift.sort_by(f64::total_cmp);
    let described = folder.ends(0, "describe rows.csv --columns lift_mean_mn --format csv").stdout;
    let rows = cells(&described);
    assert_eq!(rows[0], ["table", "column", "axis", "name", "value"]);
    let value = |name: &str| {
        let row = rows.iter().find(|row| row[0] == "columns" && row[3] == name).unwrap();
        row[4].parse::<f64>().unwrap()
    };
    // Of 41 rows, each of these percentiles is one row.
    let names = ["min", "p5", "median", "p95", "max"];
    assert_eq!(names.map(value), [0, 2, 20, 38, 40].map(|place| lift[place]));
    assert_eq!(value("count"), 41.0);
    let mean = lift.iter().sum::<f64>() / 41.0;
    let sd = (lift.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 40.0).sqrt();
    for (name, expected) in [("mean", mean), ("sd", sd), ("se", sd / 41.0_f64.sqrt())] {
        assert!((value(name) - expected).abs() < 1e-12, "{name}: {} and {expected}", value(name));
    }
    assert!(described.contains("statuses,status,,periodic,41\n"), "{described}");
}

/// The lift is largest at the end of the voltage axis. The best frequency lies inside its axis.
#[test]
fn the_best_row_at_the_end_of_an_axis_is_told() {
    let folder = swept(
        "preset = \"jafferis2016\"\n[axes]\ndrive_voltage_pp = [100, 150, 200]\n\
         drive_frequency = { from = 100, to = 160, n = 7 }\n\
         [derived]\nair_density = \"preset.air_density * (drive_voltage_pp / 200)^0.01\"\n",
    );
    let ended = folder.ends(0, "top rows.csv --by lift_mean_mn -n 2");
    assert!(!ended.stderr.contains("air_density"), "{}", ended.stderr);
    ended.says(
        "the best row is at the end of drive_voltage_pp (V), 200.0: rows beyond this value may be better",
    );
    assert!(!ended.stderr.contains("drive_frequency"), "{}", ended.stderr);
    let ended = folder.ends(0, "top rows.csv --by lift_mean_mn --where drive_voltage_pp=150");
    assert!(!ended.stderr.contains("at the end"), "one value is no axis: {}", ended.stderr);
}

/// A measure that is a condition is a column with true and false, and such a column is a condition of `--where`.
#[test]
fn columns_with_true_and_false_are_conditions() {
    let folder = swept(&format!("{GRID}[measure]\nhigh = \"drive_frequency > 110\"\n"));
    let rows = |condition: &str| {
        let look = ["top", "rows.csv", "--by", "cycles", "-n", "99", "--all", "--format", "csv", "--where"];
        folder.ends_with(0, &[&look[..], &[condition]].concat()).stdout.lines().count() - 1
    };
    // The grid has 10 frequencies from 95 to 122 Hz, and rows that are not periodic have no measures.
    let [high, equal, low, both] =
        ["high", "high=true", "not high and status == 'periodic'", "high and drive_frequency < 115"]
            .map(rows);
    let periodic = rows("status == 'periodic'");
    assert!(0 < both && both < high && high < periodic, "{both} {high} {periodic}");
    assert_eq!((equal, low, rows("high == 1")), (high, periodic - high, high));
    folder.refuses("top rows.csv --by cycles --where lift_mean_mn", "this is a number, not a condition");
}

/// A row without a periodic motion belongs to the axis too.
#[test]
fn rows_of_every_status_belong_to_an_axis() {
    let folder = Folder::new();
    let rows = "point,drive_frequency,status,lift_mean_mn\n\
                0,1,periodic,1\n1,2,periodic,2\n2,3,periodic,3\n3,4,unsettled,\n";
    fs::write(folder.path("rows.csv"), rows).unwrap();
    for (options, is_end) in [("", false), ("--where drive_frequency<3.5", true)] {
        let top = folder.ends(0, &format!("top rows.csv --by lift_mean_mn {options}"));
        let described = folder.ends(0, &format!("describe rows.csv {options}"));
        assert_eq!(top.stderr.contains("at the end of drive_frequency"), is_end, "{options}: {}", top.stderr);
        assert_eq!(described.stdout.contains("at the end"), is_end, "{options}: {}", described.stdout);
    }
}

#[test]
fn the_best_value_of_each_axis_is_told() {
    let folder = periodic();
    let file = folder.read("rows.csv");
    let lift = numbers(&file, "lift_mean_mn");
    let mut order: Vec<usize> = (0..30).collect();
    order.sort_by(|a, b| lift[*b].total_cmp(&lift[*a]));
    let best = order[0];
    let described = &json(&folder, "describe rows.csv --by lift_mean_mn")["best"][0];
    assert_eq!((&described["column"], &described["aim"]), (&"lift_mean_mn".into(), &"max".into()));
    assert_eq!(
        (described["point"].as_u64(), described["value"].as_f64()),
        (Some(best as u64), Some(lift[best]))
    );
    let axes = described["axes"].as_array().unwrap();
    assert_eq!(axes.len(), 2);
    for axis in axes {
        let values = numbers(&file, axis["axis"].as_str().unwrap());
        assert_eq!(axis["best"].as_f64(), Some(values[best]));
        let tenth: Vec<f64> = order[..3].iter().map(|row| values[*row]).collect();
        let ends = [f64::min, f64::max].map(|choose| tenth.iter().copied().reduce(choose));
        assert_eq!([axis["best_tenth"][0].as_f64(), axis["best_tenth"][1].as_f64()], ends);
        let is_end = [values[0], values[29]].contains(&values[best]);
        assert_eq!(axis["at_the_end"].as_bool(), Some(is_end));
    }
    let page = folder.ends(0, "describe rows.csv --by power_mean_mw").stdout;
    assert!(page.contains("smallest power_mean_mw: "), "{page}");
    assert!(page.contains("AXIS             UNIT      FROM"), "{page}");
    folder
        .ends(0, "describe rows.csv")
        .prints("largest lift_mean_mn: ")
        .prints("largest efficiency_gf_per_w: ");
}

/// In a sample, every parameter distinguishes the rows, and each parameter has its best values.
#[test]
fn all_parameters_of_a_sample_are_described() {
    let folder = swept(
        "preset = \"ozaki2018-large\"\n[sample]\nmethod = \"sobol\"\nn = 20\n[sample.parameters]\n\
         hinge_stiffness = { from = 8e-5, to = 1e-4 }\nair_density = { from = 1.1, to = 1.3 }\n\
         [derived]\nstroke_damping = \"1e-6 * hinge_stiffness\"\n",
    );
    let axes = |description: &Value| {
        let axes = description["best"][0]["axes"].as_array().unwrap();
        axes.iter().map(|axis| axis["axis"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let with_sidecar = json(&folder, "describe rows.csv");
    let mut names = axes(&with_sidecar);
    names.sort();
    assert_eq!(names, ["air_density", "hinge_stiffness"], "a derived parameter is not of the sample");
    assert!(with_sidecar["best"][0]["axes"].as_array().unwrap().iter().all(|axis| axis["values"] == 20));
    fs::remove_file(folder.path("rows.csv.meta.toml")).unwrap();
    assert!(axes(&json(&folder, "describe rows.csv")).len() >= 2);
}

/// In a file without the index of the point, the best row has its number in the file, also among selected rows.
#[test]
fn the_best_row_has_its_number_in_the_file() {
    let folder = Folder::new();
    fs::write(folder.path("rows.csv"), "mass,lift_mean_mn\n1,9\n2,4\n3,5\n4,7\n").unwrap();
    for (options, point) in [("", 0), ("--where mass>1.5", 3), ("--where mass=3", 2)] {
        let described = json(&folder, &format!("describe rows.csv --by lift_mean_mn {options}"));
        assert_eq!(described["best"][0]["point"], point, "{options}");
    }
}

/// An axis that is crossed with a sample has ends, the parameters of the sample have none.
#[test]
fn axes_crossed_with_a_sample_have_ends() {
    let folder = swept(
        "preset = \"ozaki2018-large\"\n[axes]\ndrive_voltage_pp = [20, 30, 40]\n[sample]\nmethod = \"sobol\"\nn = 4\n\
         [sample.parameters]\nhinge_stiffness = { from = 8e-5, to = 1e-4 }\n\
         air_density = { from = 1.1, to = 1.3 }\n",
    );
    let axes = json(&folder, "describe rows.csv --by power_mean_mw --aim max")["best"][0]["axes"].clone();
    let ends =
        axes.as_array().unwrap().iter().map(|axis| (axis["axis"].as_str(), axis["at_the_end"] == true));
    let mut ends: Vec<_> = ends.collect();
    ends.sort_unstable();
    let wanted = [("air_density", false), ("drive_voltage_pp", true), ("hinge_stiffness", false)];
    assert_eq!(ends, wanted.map(|(name, is_end)| (Some(name), is_end)));
}

#[test]
fn words_are_counted() {
    let grid =
        GRID.replace("max_cycles = 20\nnewton = false\n", "") + "[measure]\nstrong = \"lift_mean_mn > 2\"\n";
    let folder = swept(&grid);
    let lift = numbers(&folder.read("rows.csv"), "lift_mean_mn");
    let strong = lift.iter().filter(|lift| **lift > 2.0).count();
    assert!(strong > 0 && strong < 30);
    let counts = &json(&folder, "describe rows.csv --columns strong")["words"][0]["counts"];
    let rows = |value: &str| {
        counts.as_array().unwrap().iter().find(|count| count["value"] == value).unwrap()["rows"].clone()
    };
    assert_eq!((rows("true"), rows("false")), (Value::from(strong), Value::from(30 - strong)));
    folder.ends(0, "describe rows.csv --columns strong").prints("COLUMN  VALUE  ROWS  SHARE\n");
    folder.ends(0, "describe rows.csv --columns strong --format csv").prints("words,strong,,true,");
}

#[test]
fn a_file_without_numbers_is_told() {
    let folder = Folder::new();
    fs::write(folder.path("words.csv"), "a,b\nx,y\n").unwrap();
    folder.ends(2, "describe words.csv").says("error: words.csv has no column of numbers\n");
    for (mark, named) in [(";", ";"), ("\t", "\\t"), ("|", "|")] {
        fs::write(folder.path("marks.csv"), format!("a{mark}b\n1{mark}2\n")).unwrap();
        folder.refuses("describe marks.csv", &format!("the first line contains `{named}` instead of commas"));
    }
}

#[test]
fn comparisons_take_units() {
    let folder = periodic();
    let count = |condition: &str| {
        let arguments =
            ["top", "rows.csv", "--by", "lift_mean_mn", "-n", "99", "--format", "csv", "--where", condition];
        folder.ends_with(0, &arguments).stdout.lines().count() - 1
    };
    assert_eq!(count("drive_frequency > 0.11 kHz"), count("drive_frequency > 110"));
    // The cells of measures are not in SI units.
    let above = count("lift_mean_mn > 3");
    assert!(above > 0 && above < count("lift_mean_mn > 0"), "{above} rows");
    assert_eq!([count("lift_mean_mn > 3 mN"), count("lift_mean_mn > 3000 uN")], [above; 2]);
    assert_eq!(count("stroke_pp_deg > 0.4 rad"), count("stroke_pp_deg > 22.918311805232932"));
    assert_eq!(count("hinge_stiffness < 90 uN*m/rad"), 10);
    assert_eq!(count("90 uN*m/rad < hinge_stiffness and drive_frequency < 100 Hz"), 4);
    let refused = |condition: &str, message: &str| {
        folder.ends_with(2, &["top", "rows.csv", "--by", "lift_mean_mn", "--where", condition]).says(message);
    };
    refused("drive_frequency > 95 V", "`V` is a voltage, but drive_frequency is in Hz");
    refused("95 Hz + 1 < drive_frequency", "`95 Hz` is not compared with a column");
    refused(
        "hinge_stiffness=90",
        "help: a number without a unit is in N*m/rad: did you mean --where hinge_stiffness='90 uN*m/rad'?",
    );
    refused(
        "drive_frequency > 1 kHz",
        "help: drive_frequency is in Hz, such as 95 Hz; a number may have its unit",
    );
    // The unit of a measure has a prefix already, and the example can be typed.
    let ended =
        folder.ends_with(2, &["top", "rows.csv", "--by", "lift_mean_mn", "--where", "lift_mean_mn > 1e3"]);
    let example =
        ended.stderr.split("lift_mean_mn is in mN, such as ").nth(1).unwrap().split(';').next().unwrap();
    assert!(example.ends_with(" mN"), "{example}");
    assert!(count(&format!("lift_mean_mn < {example} or lift_mean_mn >= {example}")) > 0);
}

#[test]
fn responses_and_motions_are_described_too() {
    let folder = Folder::new();
    folder.ends(0, "respond ozaki2018-large --from 100 --to 110 --step 5 --out loop.csv");
    let top = folder.ends(0, "top loop.csv --by stroke_amplitude_deg -n 1 --format csv");
    assert!(top.stdout.starts_with("curve,branch,drive_frequency,stroke_amplitude_deg,status\n"));
    folder.ends(0, "describe loop.csv").prints("branch").prints("up     down");
    folder.ends(0, "run ozaki2018-large --trajectory motion.csv");
    folder.ends(0, "describe motion.csv --columns stroke_deg").prints("stroke_deg  °     401");
    folder.ends(0, "describe motion.csv --columns stroke_rad").prints("stroke_rad  rad   401");
    let top = folder.ends(0, "top motion.csv --by stroke_deg -n 1 --format csv");
    assert!(top.stdout.starts_with("time_s,stroke_deg\n"), "{}", top.stdout);
    top.says("1 row with the largest stroke_deg of 401 rows\n");
}

/// Tables of other programs with words, shares and names of any length.
fn table_of_words() -> Folder {
    let folder = Folder::new();
    let rows = "0,square,0.0007,1\n1,sine,0.0009,2\n2,square,0.0011,3\n";
    fs::write(folder.path("t.csv"), format!("n,drive_shape,strain_surface_max,lift_mean_mn\n{rows}"))
        .unwrap();
    folder
}

#[test]
fn conditions_take_per_cent_and_quoted_words() {
    let folder = table_of_words();
    for (condition, rows) in [
        ("strain_surface_max<0.08 %", 1),
        ("strain_surface_max < 0.1% and lift_mean_mn > 1", 1),
        ("strain_surface_max=0.09 %", 1),
        ("drive_shape='square'", 2),
        ("drive_shape=\"square\"", 2),
        ("drive_shape=square", 2),
        ("drive_shape == 'square'", 2),
        ("drive_shape != 'square'", 1),
        ("drive_shape == 'sine' or drive_shape == \"square\" and lift_mean_mn > 2", 2),
        ("not (drive_shape=='sine') and lift_mean_mn<2", 1),
    ] {
        let arguments = ["top", "t.csv", "--by", "lift_mean_mn", "--format", "csv", "--where", condition];
        let ended = folder.ends_with(0, &arguments);
        assert_eq!(ended.stdout.lines().count(), 1 + rows, "{condition}: {}", ended.stdout);
    }
    for condition in ["drive_shape='squre'", "drive_shape == 'squre'"] {
        let arguments = ["top", "t.csv", "--by", "lift_mean_mn", "--where", condition];
        let ended = folder.ends_with(2, &arguments);
        ended
            .says("no row of t.csv satisfies --where\n")
            .says("help: the values of drive_shape are sine, square\n");
    }
    let condition = "drive_shape == 'sine' and drive_shape > 2";
    folder
        .ends_with(2, &["top", "t.csv", "--by", "lift_mean_mn", "--where", condition])
        .says("`drive_shape` is a choice between options, not a number\nhelp: compare it with an option: drive_shape == 'sine'\n");
}

/// A part of a name selects the first column that contains it. flap does not list all columns of a table with many
/// columns.
#[test]
#[cfg(target_os = "linux")]
fn names_that_are_near_come_first_and_lists_are_short() {
    let folder = periodic();
    folder.ends(2, "top rows.csv --by lift").says("help: did you mean `lift_mean_mn`?\n");
    folder.ends(2, "run ozaki2018-large --gradient lift").says("help: did you mean `lift_mean_mn`?\n");
    let names: Vec<String> = (0..1_000_000).map(|column| format!("c{column}")).collect();
    fs::write(folder.path("wide.csv"), format!("{}\n{}1\n", names.join(","), "1,".repeat(999_999))).unwrap();
    let ended = folder.ends(2, "describe wide.csv --columns zebra");
    ended.says("c19 and 999980 more columns\n");
    assert!(ended.stderr.len() < 1000, "{} bytes", ended.stderr.len());
    let ended = folder.ends(2, "test lift ozaki2018-small wide.csv");
    assert!(ended.stderr.len() < 1000, "{} bytes", ended.stderr.len());
    let flap = env!("CARGO_BIN_EXE_flap");
    let ended = folder.shell(&format!("ulimit -t 20; exec {flap} describe wide.csv --format csv"));
    assert_eq!((ended.code, ended.stdout.lines().count()), (0, 1 + 9_000_000), "{}", ended.stderr);
}

/// Names and words that are longer than the largest width of a format.
#[test]
fn names_of_any_length_are_shown() {
    let folder = Folder::new();
    let long = "n".repeat(70_000);
    fs::write(folder.path("t.csv"), format!("a,{long},w\n1,2,{long}\n")).unwrap();
    let short = format!("{}…(70000 characters)…{}", "n".repeat(60), "n".repeat(20));
    folder.ends(0, "describe t.csv").prints(&short);
    folder.ends(0, "top t.csv --by a --columns w").prints(&short);
    folder.ends(0, "describe t.csv --columns w").prints(&short);
    let json = folder.ends(0, "describe t.csv --format json").stdout;
    assert!(json.contains(&long), "programs get the whole name");

    let measure = format!("preset = \"ozaki2018-large\"\n[measure]\n{long} = \"2 * lift_mean_mn\"\n");
    fs::write(folder.path("measure.toml"), measure).unwrap();
    folder.ends(0, "run measure.toml").prints(&short);
    let wings =
        format!("[[vehicle.wings]]\nname = \"{long}\"\n[[vehicle.wings]]\nname = \"b\"\nmirrored = true\n");
    let vehicle = format!("preset = \"jafferis2016\"\n[vehicle]\n{wings}");
    fs::write(folder.path("vehicle.toml"), vehicle).unwrap();
    for command in ["run", "models", "check"] {
        let ended = folder.flap(&format!("{command} vehicle.toml"));
        assert!(ended.code == 0 || ended.code == 2, "{command}: {}", ended.stderr);
    }
}
