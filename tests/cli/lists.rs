//! `flap check`, `flap models` and help.

use std::fs;
use std::time::{Duration, Instant};

use flap_core::simulate::Status;

use crate::support::{Folder, frequencies};

/// The meanings of the statuses of rows, in the order of `Status::ALL`.
const STATUSES: [&str; 7] = [
    "the motion has settled on an orbit of one drive period; the row has measures",
    "an unstable orbit: nearby motions move away from the orbit; only `flap respond --unstable` writes such rows",
    "the motion has settled on an orbit of 2 to 8 drive periods, in which successive periods differ; the row has no measures",
    "the motion has not settled after max_cycles drive periods: the motion is quasi-periodic, chaotic or slow. `flap \
    results rerun --status unsettled --max-cycles N` runs unsettled points longer",
    "the state became infinite or not a number: check the parameters against their units",
    "one drive period needs more than max_steps integration steps: check the parameters against their units, or raise max_steps in [solver]",
    "the combination of parameter values is impossible, or a derived parameter is out of range; `flap run GRID --point N` prints the reason",
];

#[test]
fn check_shows_what_would_run() {
    let grid = r#"preset = "ozaki2018-large"

[axes]
drive_voltage_pp = ["100 V", "150 V"]
drive_frequency = { from = "60 Hz", to = "200 Hz", n = 15 }
"#;
    let folder = Folder::with_grid(grid);
    let ended = folder.ends(0, "check grid.toml");
    let (page, estimate) = ended.stdout.split_once("estimate: ").unwrap();
    let size = estimate.split_once(" and ").unwrap().1;
    let size = size.strip_suffix(" kB of CSV, from runs of 30 points spread over the grid\n").unwrap();
    let swept = folder.ends(0, "sweep grid.toml --out -").stdout;
    let (_header, rows) = swept.split_once('\n').unwrap();
    let bytes = rows.len() as f64;
    assert!((1e3 * size.parse::<f64>().unwrap() / bytes - 1.0).abs() < 0.05, "{size} kB of {bytes} bytes");
    assert_eq!(
        page,
        "\
30 points of direct-drive from ozaki2018-large

AXIS  PARAMETER         FROM   TO     COUNT  UNIT
1     drive_voltage_pp  100.0  150.0  2      V
2     drive_frequency   60.0   200.0  15     Hz

first point, 0: drive_voltage_pp = 100 V, drive_frequency = 60 Hz
last point, 29: drive_voltage_pp = 150 V, drive_frequency = 200 Hz

DIFFERS FROM THE PRESET  HERE             PRESET  RATIO
drive_voltage_pp         100 V to 150 V   100 V   1 to 1.5
drive_frequency          60 Hz to 200 Hz  109 Hz  0.55 to 1.83

rtol = 1e-6, atol = 1e-8, settle_tol = 1e-6, max_cycles = 1000, max_steps = 20000, accuracy = 0.001, newton = true, progressive = true, symmetry = true

"
    );
    assert_eq!(ended.stderr, "");
    let json: serde_json::Value =
        serde_json::from_str(&folder.ends(0, "check grid.toml --format json").stdout).unwrap();
    let value = |section: &str, name: &str, key: &str| {
        let is_named = |row: &&serde_json::Value| {
            row["section"] == section && row["key"] == key && row["name"].as_str().unwrap_or_default() == name
        };
        json.as_array().unwrap().iter().find(is_named).unwrap()["value"].clone()
    };
    assert_eq!(value("sweep", "", "points"), 30);
    assert_eq!(value("axes", "drive_frequency", "to"), 200.0);
    assert_eq!(value("solver", "rtol", "value"), 1e-6);
    let seconds = ["seconds_from", "seconds_to"].map(|key| value("estimate", "", key).as_f64().unwrap());
    assert!(0.0 < seconds[0] && seconds[0] < seconds[1], "{seconds:?}");
    assert_eq!(folder.names(), ["grid.toml"], "nothing is written");
}

#[test]
fn check_is_instant_for_any_number_of_points() {
    let axis = |name: &str| format!("{name} = {{ from = 60, to = 200, n = 1000000 }}\n");
    let many = "preset = \"ozaki2018-large\"\n[axes]\n".to_owned()
        + &axis("drive_frequency")
        + &axis("drive_voltage_pp")
        + &axis("hinge_stiffness");
    for (grid, points) in [(frequencies(1_000_000), 1_000_000), (many, 1_000_000_000_000_000_000_u64)] {
        let folder = Folder::with_grid(&grid);
        let start = Instant::now();
        let ended = folder.ends(0, "check grid.toml");
        assert!(ended.stdout.starts_with(&format!("{points} points of ")), "{}", ended.stdout);
        assert!(start.elapsed() < Duration::from_secs(5));
    }
}

#[test]
fn models_and_presets_are_listed() {
    let ended = Folder::new().ends(0, "models");
    for name in ["direct-drive", "  ozaki2018-small", "  ozaki2018-large"] {
        assert!(ended.stdout.lines().any(|line| line.starts_with(name)), "{name}: {}", ended.stdout);
    }
    for line in ended.stdout.lines().filter(|line| line.contains("kw-swapped")) {
        assert!(line.contains("HYPOTHESIS"), "{line}");
    }
}

#[test]
fn parameters_are_listed_with_units_and_values() {
    let folder = Folder::new();
    let model = folder.ends(0, "models direct-drive");
    let preset = folder.ends(0, "models ozaki2018-large");
    let line = |text: &str, name: &str| {
        let found = text.lines().find(|line| line.split_whitespace().next() == Some(name));
        found.unwrap_or_else(|| panic!("{name} is missing in\n{text}")).to_owned()
    };
    for text in [&model.stdout, &preset.stdout] {
        assert!(line(text, "drive_frequency").contains(" Hz "));
        assert!(line(text, "lift_mean_mn").contains(" mN "));
        assert!(line(text, "floquet_max").contains("factor by which a small change of the motion grows"));
        assert!(line(text, "resonance_hz").contains(" Hz "));
        for column in ["residual", "cycles", "error_estimate"] {
            line(text, column);
        }
        for title in ["hinge", "measures", "columns of every model"] {
            assert!(text.lines().any(|line| line == title), "{title} is missing in\n{text}");
        }
    }
    assert!(line(&model.stdout, "hinge_stiffness").contains(" N*m/rad "));
    assert!(line(&preset.stdout, "hinge_stiffness").contains(" 86.4 uN*m/rad "), "{}", preset.stdout);
    assert!(line(&model.stdout, "PARAMETER").contains("UNIT"));
    assert!(line(&preset.stdout, "PARAMETER").contains("VALUE"));
}

/// The output of `flap models` in a terminal of 80 characters.
fn narrow(arguments: &str) -> String {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_flap"));
    let output = command.env("COLUMNS", "80").args(arguments.split(' ')).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn tables_fit_the_terminal() {
    let folder = Folder::with_grid(
        "preset = \"ozaki2018-large\"\n[axes]\nhinge_stiffness = [6e-5, 9e-5]\ndrive_frequency = [95, 110]\n",
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let [grid, rows] = ["grid.toml", "rows.csv"].map(|name| folder.path(name).display().to_string());
    for arguments in [
        "run ozaki2018-large",
        "test resonance ozaki2018-large",
        "models",
        &format!("check {grid}"),
        &format!("describe {rows}"),
        &format!("top {rows} --by lift_mean_mn --columns power_mean_mw,stroke_pp_deg,pitch_pp_deg"),
    ] {
        let text = narrow(arguments);
        // A path of the user's is as long as it is.
        for line in text.lines().filter(|line| !line.contains('/')) {
            assert!(line.chars().count() <= 80, "{arguments}: {line}");
        }
        assert!(
            folder.ends(0, arguments).stdout.lines().any(|line| line.chars().count() > 80),
            "{arguments} in a pipe"
        );
    }
}

#[test]
fn parameters_fit_the_terminal() {
    for model in flap_core::simulate::all() {
        for what in model.presets().iter().map(|preset| preset.name).chain([model.name()]) {
            let short = narrow(&format!("models {what}"));
            let long = narrow(&format!("models {what} --long"));
            for line in short.lines().chain(long.lines()) {
                assert!(line.chars().count() <= 80, "{what}: {line}");
            }
            // The words of every meaning stand there, whatever line they are in.
            let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
            for parameter in model.parameters() {
                let end = parameter.doc.trim_end_matches('.').split(' ').next_back().unwrap();
                assert!(words(&long).contains(end), "{what}: {} in\n{long}", parameter.doc);
            }
            assert!(short.len() < long.len());
        }
    }
    for line in narrow("models drag_coefficient_max mode_stroke_hz").lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn long_lists_have_symbols_and_allowed_values() {
    let folder = Folder::new();
    let long = folder.ends(0, "models jafferis2016 --long").stdout;
    let line = long.lines().find(|line| line.starts_with("hinge_stiffness ")).unwrap();
    assert!(line.contains(". Symbol: kappa_wh. Allowed: more than zero"), "{line}");
}

/// The short list has a mark. The long list describes the mark in words, and the formats for programs contain only
/// numbers.
#[test]
fn lists_mark_fits_to_one_vehicle() {
    let folder = Folder::with_grid("preset = \"jafferis2016\"\n[params]\npressure_min = 0.2\n");
    let below = "\n* This value was fitted to one vehicle. Measure or fit it for other vehicles.\n";
    let line = |text: &str, name: &str| {
        let found = text.lines().find(|line| line.starts_with(&format!("{name} ")));
        found.unwrap_or_else(|| panic!("{name} is missing in\n{text}")).to_owned()
    };
    let short = folder.ends(0, "models jafferis2016").stdout;
    assert_eq!(short.matches(below).count(), 1, "{short}");
    for name in ["pressure_min", "pressure_max", "drag_coefficient_max", "lift_coefficient_max"] {
        let marked = line(&short, name);
        assert_eq!(marked.split_whitespace().nth(2), Some("*"), "{marked}");
    }
    assert!(line(&short, "hinge_stiffness").contains(" uN*m/rad * "), "{short}");
    assert!(!line(&short, "wing_area").contains('*'), "{short}");

    let own = folder.ends(0, "models grid.toml").stdout;
    assert!(!line(&own, "pressure_min").contains('*') && line(&own, "pressure_max").contains(" * "), "{own}");
    for other in ["models jafferis2016 --long", "models bimorph", "models ozaki2018-large"] {
        assert!(!folder.ends(0, other).stdout.contains(below), "{other}");
    }
    let csv = folder.ends(0, "models jafferis2016 --format csv").stdout;
    assert!(csv.contains(",pressure_min,0.132,"), "{csv}");
}

#[test]
fn programs_read_parameters_and_columns() {
    let folder = Folder::new();
    let csv = folder.ends(0, "models jafferis2016 --format csv").stdout;
    assert!(csv.starts_with("kind,group,name,value,unit,symbol,allowed,meaning\n"), "{csv}");
    assert!(csv.contains("\nparameter,hinge,hinge_stiffness,1.4972"), "{csv}");
    let json = folder.ends(0, "models jafferis2016 --format json").stdout;
    let list: serde_json::Value = serde_json::from_str(&json).unwrap();
    let list = list.as_array().unwrap();
    assert_eq!(list.len(), csv.lines().count() - 1);
    let find = |name: &str| list.iter().find(|entry| entry["name"] == name).unwrap();
    let model = flap_core::simulate::all().iter().find(|model| model.name() == "bimorph").unwrap();
    let values = (model.presets()[0].values)();
    for (parameter, value) in model.parameters().iter().zip(values) {
        let entry = find(parameter.name);
        assert_eq!((&entry["kind"], &entry["meaning"]), (&"parameter".into(), &parameter.doc.into()));
        if let Some(number) = entry["value"].as_f64() {
            assert_eq!(number.to_bits(), value.to_bits(), "{entry}");
        }
    }
    assert_eq!(find("floquet_max")["kind"], "run");
    assert_eq!(find("resonance_hz")["kind"], "resonance");
    assert_eq!(find("lift_mean_mn")["unit"], "mN");
    assert!(find("lift_mean_mn")["value"].is_null());
}

/// Every command that prints a summary has the three formats.
#[test]
fn summaries_are_read_by_programs() {
    let folder = Folder::new();
    let json = |arguments: &str| -> Vec<serde_json::Value> {
        let text = folder.ends(0, &format!("{arguments} --format json")).stdout;
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments}: {error}\n{text}"))
    };
    let row = json("run ozaki2018-large");
    let find = |name: &str| row.iter().find(|entry| entry["column"] == name).unwrap();
    assert_eq!(find("status")["value"], "periodic");
    let lift = find("lift_mean_mn");
    assert_eq!(lift["unit"], "mN");
    let page = folder.ends(0, "run ozaki2018-large").stdout;
    let shown = page.lines().find(|line| line.starts_with("lift_mean_mn ")).unwrap();
    let shown: f64 = shown.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((lift["value"].as_f64().unwrap() / shown - 1.0).abs() < 1e-5, "{lift} {shown}");
    let csv = folder.ends(0, "run ozaki2018-large --format csv").stdout;
    assert!(csv.starts_with("column,value,unit,meaning\nstatus,periodic,,"), "{csv}");

    let slopes = json("run ozaki2018-large --gradient lift_mean_mn");
    assert!(slopes.len() > 20 && slopes[0]["change_per_pct"].is_number(), "{slopes:?}");
    let models = json("models");
    assert_eq!((&models[0]["kind"], &models[0]["name"]), (&"model".into(), &"bimorph".into()));
    let meanings = json("models hinge_stiffness");
    assert!(meanings.len() > 1 && meanings.iter().all(|entry| entry["name"] == "hinge_stiffness"));
    folder.ends(2, "models hinge_stiffness jafferis2016 --format csv").says("one table");
    let chirp = json("test chirp jafferis2016 --from 100 --to 101 --rate 50");
    assert_eq!(chirp[0]["begin_s"], 0.0);
    folder
        .ends(0, "test chirp jafferis2016 --from 100 --to 101 --rate 50 --format table")
        .prints("frequency_hz");
    assert!(json("test resonance ozaki2018-large --from 100 --to 120").len() > 3);

    let folder = Folder::with_grid(&frequencies(2));
    folder.ends(0, "sweep grid.toml");
    let verdict = folder.ends(3, "results verify grid.csv other.csv --format csv").stdout;
    assert!(verdict.starts_with("file,verdict,detail\ngrid.csv,sound,2 rows\n"), "{verdict}");
}

#[test]
fn help_lists_the_groups_of_commands() {
    let help = Folder::new().flap("--help").stdout;
    for title in ["Compute:", "Results:", "Your robot:", "Reference:"] {
        assert!(help.contains(title), "{title}: {help}");
    }
    // The groups have all commands.
    let listed = |name: &str| help.lines().any(|line| line.trim_start().starts_with(&format!("{name} ")));
    for name in [
        "sweep", "run", "respond", "vehicle", "optimise", "check", "top", "describe", "results", "test",
        "device", "models", "generate",
    ] {
        assert!(listed(name), "{name}: {help}");
    }
    let sweep = Folder::new().flap("sweep --help").stdout;
    assert!(sweep.starts_with("Run every point of a grid file and write one row per point\n\nExample: flap sweep grid.toml\n\nUsage: flap sweep"), "{sweep}");
}

#[test]
fn names_are_explained_in_one_model() {
    let folder = Folder::new();
    let one = folder.ends(0, "models hinge_stiffness cycles --model ozaki2018-large").stdout;
    assert!(one.starts_with("hinge_stiffness: a parameter of direct-drive\n"), "{one}");
    assert!(
        !one.contains("four-bar") && one.contains("cycles: a column of the rows of every model"),
        "{one}"
    );
    let other = folder.ends(2, "models transmission_ratio --model four-bar");
    other.says("the model four-bar has no `transmission_ratio`");
    other.says("other models have this name: `flap models transmission_ratio`");
    folder.ends(2, "models cycles --model four-baar").says("did you mean `four-bar`?");
}

#[test]
fn help_has_examples_and_exit_codes() {
    let folder = Folder::new();
    assert!(folder.flap("--help").stdout.contains("Exit codes:"));
    for command in ["sweep", "run", "check", "models", "test chirp", "results merge"] {
        folder.ends(0, &format!("{command} --help")).prints(&format!("  flap {command} "));
    }
    let (version, build) = (env!("CARGO_PKG_VERSION"), flap_sweep::run::identity::build());
    assert_eq!(folder.flap("-V").stdout, format!("flap {version}\n"));
    let long = folder.flap("--version").stdout;
    assert!(long.starts_with(&format!("flap {version}\nbuild {build} (")), "{long}");
}

/// Every column of every kind of table has its meaning.
#[test]
fn all_columns_are_explained() {
    let folder = Folder::with_grid(
        "preset = \"jafferis2016\"\n[axes]\nhinge_stiffness = [1.5e-6]\n[gradient]\nof = [\"lift_mean_mn\"]\n\
         with_respect_to = [\"piezo_thickness\"]\n",
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "run jafferis2016 --trajectory motion.csv");
    folder.ends(0, "respond jafferis2016 --from 100 --to 104 --step 2 --out loop.csv");
    folder.ends(0, "test chirp jafferis2016 --from 100 --to 101 --rate 50 --out chirp.csv");
    fs::write(
        folder.path("resonance.csv"),
        folder.ends(0, "test resonance jafferis2016 --format csv").stdout,
    )
    .unwrap();
    let vehicle =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/vehicle.toml")).unwrap();
    fs::write(folder.path("vehicle.toml"), vehicle).unwrap();
    folder.ends(0, "sweep vehicle.toml --out vehicle.csv");
    for file in ["rows.csv", "motion.csv", "loop.csv", "chirp.csv", "resonance.csv", "vehicle.csv"] {
        let header = folder.read(file).lines().next().unwrap().to_owned();
        let own = ["meaning"];
        let names: Vec<&str> = header.split(',').filter(|name| !own.contains(name)).collect();
        folder.ends(0, &format!("models {}", names.join(" ")));
    }
    let told = folder.ends(0, "models d_lift_mean_mn_per_pct_piezo_thickness").stdout;
    assert!(told.contains("  change of lift_mean_mn (mN) per 1 % of piezo_thickness\n"), "{told}");
    for name in [
        "rtol",
        "max_cycles",
        "about_x",
        "difference_drive_offset",
        "left_drive_voltage_pp",
        "left_stroke_pp_deg",
    ] {
        folder.ends(0, &format!("models {name}"));
    }
}

#[test]
fn one_unknown_name_does_not_hide_others() {
    let folder = Folder::new();
    let ended = folder.ends(2, "models branch foo rtol bar");
    assert!(
        ended.stdout.starts_with("branch: ") && ended.stdout.contains("\nrtol: a setting of [solver]"),
        "{}",
        ended.stdout
    );
    ended.says("status `foo`").says("status `bar`");
}

#[test]
fn names_are_explained() {
    let folder = Folder::new();
    let parameter = folder.ends(0, "models hinge_stiffness").stdout;
    for model in ["bimorph", "direct-drive", "four-bar"] {
        assert!(parameter.contains(&format!("hinge_stiffness: a parameter of {model}\n")), "{parameter}");
    }
    assert!(
        parameter.contains("  unit      N*m/rad\n  symbol    k_w\n  allowed   more than zero"),
        "{parameter}"
    );
    assert!(parameter.contains("  86.4 uN*m/rad in ozaki2018-large\n"), "{parameter}");

    let measure = folder.ends(0, "models lift_mean_mn resonance_hz").stdout;
    assert!(
        measure.contains("lift_mean_mn: a measure of bimorph\n  mean lift of the wing\n  unit      mN\n"),
        "{measure}"
    );
    let several = folder.ends(0, "models left_wing_mass").stdout;
    let kind = "a parameter of vehicles of the models direct-drive and four-bar with a wing called left";
    assert!(several.starts_with(&format!("left_wing_mass: {kind}\n")), "{several}");
    let resonance = "resonance_hz: a measure of the models bimorph, direct-drive and four-bar with drive_frequency = \"resonance\"\n";
    assert!(measure.contains(resonance), "{measure}");
    let gaps = folder.ends(0, "models resonance_gaps").stdout;
    let meaning = "number of points without a periodic motion in the search for the resonance; a larger peak could lie \
    at one of these points";
    assert_eq!(gaps, resonance.replace("_hz", "_gaps") + "  " + meaning + "\n", "once for all models");

    let fixed = folder.ends(0, "models floquet_max").stdout;
    assert!(
        fixed.starts_with("floquet_max: a column of the rows of every model\n  factor by which"),
        "{fixed}"
    );
    assert!(fixed.contains("below 1 the motion is stable, near 1 the motion settles slowly"), "{fixed}");
    for (status, meaning) in Status::ALL.into_iter().zip(STATUSES) {
        let told = folder.ends(0, &format!("models {}", status.name())).stdout;
        assert_eq!(told, format!("{}: a status of rows\n  {meaning}\n", status.name()));
    }

    let unknown = folder.ends(2, "models lift_meen_mn").stderr;
    assert!(
        unknown.contains("there is no model, preset, parameter, column, setting or status `lift_meen_mn`"),
        "{unknown}"
    );
    assert!(unknown.contains("did you mean `lift_mean_mn`?"), "{unknown}");
}

#[test]
fn manuals_know_every_command() {
    let folder = Folder::new();
    folder.ends(0, "generate man manual/man1");
    let pages = folder.path("manual/man1");
    for page in ["flap.1", "flap-sweep.1", "flap-top.1", "flap-run.1", "flap-results-merge.1"] {
        let text = std::fs::read_to_string(pages.join(page)).unwrap();
        assert!(text.contains(".SH SYNOPSIS"), "{page}");
    }
    // Equal pages are no obstacle, but a file with another text is.
    folder.ends(0, "generate man manual/man1");
    let page = "manual/man1/flap.1";
    std::fs::write(folder.path(page), "mine").unwrap();
    folder.refuses("generate man manual/man1", &format!("{page} exists and has another text"));
    assert_eq!(folder.read(page), "mine");
    folder.ends(0, "generate man manual/man1 --force");
    assert!(folder.read(page).contains(".SH SYNOPSIS"));
}

#[test]
fn no_color_turns_colours_off() {
    let stderr = |variables: &[(&str, &str)]| {
        let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_flap"));
        command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").envs(variables.iter().copied());
        String::from_utf8(command.args(["models", "nothing"]).output().unwrap().stderr).unwrap()
    };
    let is_coloured = |text: &str| text.contains('\u{1b}');
    assert!(is_coloured(&stderr(&[("CLICOLOR_FORCE", "1")])), "a terminal shows colours");
    assert!(!is_coloured(&stderr(&[("NO_COLOR", "1")])));
    assert!(!is_coloured(&stderr(&[])), "a file has none");
}

/// The values of a device or a grid file replace the values of the preset.
#[test]
fn parameters_of_a_file_have_its_values() {
    let folder = Folder::with_grid("preset = \"jafferis2016\"\n[params]\nwing_area = \"50 mm^2\"\n");
    let ended = folder.ends(0, "models grid.toml");
    ended.prints("grid.toml: based on jafferis2016").prints("50 mm^2");
    folder.refuses("models nothing.toml", "nothing.toml: there is no such file");
}
