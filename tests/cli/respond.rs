//! `flap respond`, and designs at their own resonances.

use crate::support::Folder;
#[cfg(unix)]
use crate::support::{send, start, wait};

const SOFT: &str = "\
preset = \"jafferis2016\"
[params]
hinge_stiffness = \"0.7486 uN*m/rad\"
[axes]
drive_voltage_pp = [\"80 V\", \"160 V\"]
drive_frequency = { from = \"120 Hz\", to = \"130 Hz\", step = \"1 Hz\" }
";

#[test]
fn a_line_per_design_says_where_it_is_bistable() {
    let folder = Folder::with_grid(SOFT);
    let ended = folder.flap("respond grid.toml --out curves.csv");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", ended.stdout);
    assert!(lines[0].starts_with("drive_voltage_pp = 80 V: no hysteresis from "), "{}", lines[0]);
    assert!(lines[1].starts_with("drive_voltage_pp = 160 V: bistable from 124.25 to 127.625 Hz, jump of 5"));
    assert!(ended.stderr.contains("2 curves in curves.csv"), "{}", ended.stderr);

    let text = folder.read("curves.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["curve", "drive_voltage_pp", "branch", "drive_frequency", "status"]);
    assert_eq!(rows[1][..5], ["0", "80.0", "up", "120.0", "periodic"]);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    // Eleven steps each way, and the halvings of steep steps: 14 of the first curve, and of the second 4 below its band and 4 at
    // each of its ends.
    assert_eq!(rows[1..].iter().filter(|row| row[0] == "0").count(), 2 * (11 + 14));
    let second: Vec<&Vec<&str>> = rows[1..].iter().filter(|row| row[0] == "1").collect();
    assert_eq!(second.len(), 2 * (11 + 4 + 2 * 4));
    let way = |branch: &str| -> Vec<f64> {
        second.iter().filter(|row| row[2] == branch).map(|row| row[3].parse().unwrap()).collect()
    };
    let (up, mut down) = (way("up"), way("down"));
    down.reverse();
    assert_eq!(up, down, "rising, then falling");

    folder.ends(2, "respond grid.toml --out curves.csv --rtol 1e-5").says("exists already, with other rows");
    folder.ends(0, "respond grid.toml --out curves.csv").says("nothing is left to run");
    assert_eq!(folder.read("curves.csv"), text, "never overwritten unasked");
    let piped = folder.flap("respond grid.toml --out - --threads 1");
    assert_eq!(piped.stdout, text);
    assert_eq!(piped.stderr.lines().collect::<Vec<_>>(), lines);
}

/// Many designs with short curves.
#[cfg(unix)]
const MANY: &str = "\
preset = \"ozaki2018-large\"
[axes]
hinge_stiffness = { from = \"60 uN*m/rad\", to = \"160 uN*m/rad\", n = 500 }
drive_frequency = [100, 110]
[solver]
newton = false
max_cycles = 20
";

#[test]
#[cfg(unix)]
fn an_interrupted_response_goes_on() {
    let folder = Folder::with_grid(MANY);
    assert_eq!(folder.flap("respond grid.toml --out whole.csv").code, 0);
    let whole = folder.read("whole.csv");
    for (name, signal) in [("curves.csv", "INT"), ("curves.csv.zst", "TERM"), ("curves.parquet", "INT")] {
        let arguments = ["respond", "grid.toml", "--out", name, "--checkpoint", "20 ms", "--threads", "1"];
        let mut child = start(&folder, &arguments);
        // A line for each curve, which somebody must read.
        let mut lines = child.stdout.take().unwrap();
        std::thread::spawn(move || std::io::copy(&mut lines, &mut std::io::sink()));
        let rows = if name.ends_with("parquet") { format!("{name}.part") } else { name.to_owned() };
        let begun = std::time::Instant::now();
        while std::fs::metadata(folder.path(&rows)).map_or(0, |file| file.len()) < 10_000 {
            assert!(begun.elapsed().as_secs() < 60, "no rows");
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        send(signal, &child);
        assert_eq!(wait(&mut child), Some(130), "{name}");
        if name == "curves.csv" {
            let text = folder.read(name);
            assert!(whole.starts_with(&text) && text.len() < whole.len(), "the first curves");
            let curve = |line: Option<&str>| line.and_then(|line| line.split(',').next()).map(str::to_owned);
            let next = whole[text.len()..].lines().next();
            assert_ne!(curve(text.lines().last()), curve(next), "each with all of its rows");
        }
        let verified = folder.flap(&format!("results verify {name}"));
        assert!(verified.stdout.contains("unfinished: sound so far"), "{}", verified.stdout);

        let resumed = folder.flap(&format!("results resume {name}"));
        assert_eq!(resumed.code, 0, "{}", resumed.stderr);
        assert!(resumed.stderr.contains(&format!("500 curves in {name}")), "{}", resumed.stderr);
        let rows = whole.lines().count() - 1;
        assert_eq!(
            folder.flap(&format!("results verify {name}")).stdout,
            format!("{name}: sound: {rows} rows\n")
        );
        assert_eq!(folder.flap(&format!("results convert {name} -")).stdout, whole, "{name}");
        let complete = folder.flap(&format!("respond grid.toml --out {name}"));
        assert!(complete.stderr.contains("is complete: nothing is left to run"), "{}", complete.stderr);
    }
}

#[test]
fn options_are_those_of_the_sidecar() {
    let folder = Folder::new();
    let respond = "respond ozaki2018-large --from 100 --to 110 --step 5 --set drive_voltage_pp=70 \
                   --set lift_sign=printed --rtol 1e-5 --out rows.csv";
    assert_eq!(folder.flap(respond).code, 0);
    let rows = folder.read("rows.csv");
    let again = folder.flap("sweep rows.csv.meta.toml --out again.csv");
    assert_eq!(again.code, 0, "{}", again.stderr);
    assert_eq!(folder.read("again.csv"), rows);
    let others = folder.flap(&format!("{respond} --set drive_frequency=3"));
    assert_eq!(others.code, 2, "{}", others.stderr);
    let others = folder.flap(&respond.replace("=70", "=71"));
    assert_eq!(others.code, 2, "{}", others.stderr);
    assert!(others.stderr.contains("the followed parameter"), "{}", others.stderr);
    let rerun = folder.flap("results rerun rows.csv --status periodic --out rerun.csv");
    assert_eq!(rerun.code, 2);
    assert!(rerun.stderr.contains("holds curves"), "{}", rerun.stderr);
}

/// If the reader of the summaries closes its pipe, flap still writes all rows.
#[test]
#[cfg(target_os = "linux")]
fn a_closed_stdout_does_not_end_a_run_into_a_file() {
    let folder = Folder::new();
    let flap = env!("CARGO_BIN_EXE_flap");
    let line = format!("{flap} respond ozaki2018-large --from 100 --to 110 --step 5 --out rows.csv | true");
    assert_eq!(folder.shell(&format!("set -o pipefail; {line}")).code, 0);
    folder.ends(0, "results verify rows.csv").prints("rows.csv: sound: ");
}

/// A bistable band of 0.28 Hz between two steps of 0.5 Hz.
#[test]
fn a_band_between_two_steps_is_found() {
    let folder = Folder::new();
    let soft = ["--set", "hinge_stiffness=0.7486 uN*m/rad", "--set", "drive_voltage_pp=90 V"];
    let steps = ["--from", "110 Hz", "--to", "130 Hz", "--step", "0.5 Hz", "--out", "narrow.csv"];
    let ended = folder.ends_with(0, &[&["respond", "jafferis2016"], &soft[..], &steps[..]].concat());
    let band = ended.stdout.strip_prefix("bistable from ").and_then(|rest| rest.split_once(" Hz, jump of "));
    let (from, to) = band.unwrap_or_else(|| panic!("{}", ended.stdout)).0.split_once(" to ").unwrap();
    let [from, to]: [f64; 2] = [from, to].map(|end| end.parse().unwrap());
    assert!((from - 119.153).abs() <= 0.032 && (to - 119.434).abs() <= 0.032, "{}", ended.stdout);
    // The rows say the same.
    let text = folder.read("narrow.csv");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = rows.next().unwrap();
    let [frequency, bistable] =
        ["drive_frequency", "bistable"].map(|name| names.iter().position(|known| *known == name).unwrap());
    let within: Vec<f64> =
        rows.filter(|row| row[bistable] == "true").map(|row| row[frequency].parse().unwrap()).collect();
    let ends =
        [within.iter().copied().fold(f64::INFINITY, f64::min), within.iter().copied().fold(0.0, f64::max)];
    // The line has six digits.
    assert!((ends[0] - from).abs() < 1e-3 && (ends[1] - to).abs() < 1e-3, "{ends:?}: {}", ended.stdout);
    // Programs read the band as a row, with all digits.
    let steps = ["--from", "110 Hz", "--to", "130 Hz", "--step", "0.5 Hz", "--format", "json"];
    let json = folder.ends_with(0, &[&["respond", "jafferis2016"], &soft[..], &steps[..]].concat()).stdout;
    let bands: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (&bands[0]["kind"], &bands[0]["unit"], bands.as_array().unwrap().len()),
        (&"bistable".into(), &"Hz".into(), 1)
    );
    assert_eq!([&bands[0]["from"], &bands[0]["to"]].map(|end| end.as_f64().unwrap()), ends);
    assert_eq!(bands[0]["resolution"], 0.03125);
    folder.ends(0, "plot narrow.csv --out narrow.svg");
    assert!(folder.read("narrow.svg").contains(&format!("shaded: bistable, {from} to {to} Hz")));
}

#[test]
fn a_preset_follows_any_number() {
    let folder = Folder::new();
    let ended = folder.flap_with(&[
        "respond",
        "ozaki2018-large",
        "--along",
        "drive_voltage_pp",
        "--from",
        "60 V",
        "--to",
        "80",
        "--step",
        "10 V",
        "--set",
        "drive_frequency=105 Hz",
    ]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(
        ended.stdout.starts_with(
            "no hysteresis from 60 to 80 V wider than 5 V (0.625 V where the motion changes by a tenth; branches agree to "
        ),
        "{}",
        ended.stdout
    );
}

#[test]
fn mistakes_are_told() {
    let folder = Folder::with_grid(SOFT);
    let range = "--from 120 --to 130 --step 1";
    for (arguments, message) in [
        ("jafferis2016".to_owned(), "the values of `drive_frequency` are not given"),
        ("grid.toml --from 120".to_owned(), "the values of `drive_frequency` are incomplete"),
        (format!("jafferis2016 {range} --along drive_frequncy"), "did you mean `drive_frequency`?"),
        (format!("jafferis2016 {range} --along arms"), "`arms`"),
        (format!("jafferis2016 {range} --tolerance 0"), "--tolerance 0: must be more than zero\n"),
        (
            "jafferis2016 --from 1 --to 2 --step 0".to_owned(),
            "--step 0: must be more than zero\nhelp: values rise",
        ),
        (
            "jafferis2016 --from 1 --to 2 --step 1V".to_owned(),
            "--step 1V: `V` is a voltage, but the value is in Hz",
        ),
        (
            "jafferis2016 --from 1 --to 2 --step 5%".to_owned(),
            "--step 5%: `%` is a pure number, but the value is in Hz",
        ),
        ("jafferis2016 --from 45deg --to 60 --step 1".to_owned(), "`deg` is an angle, but"),
        ("jafferis2016 --from 1 --to 2 --step 1e999".to_owned(), "`1e999` is too large for "),
        (
            "jafferis2016 --from 130 --to 120 --step 1".to_owned(),
            "`drive_frequency` cannot rise from 130 to 120 in steps of 1",
        ),
        ("jafferis2016 --from 1m --to 120 --step 1".to_owned(), "--from 1m"),
        ("grid.toml --set drive_voltage_pp=100".to_owned(), "is set with --set and varied"),
        ("grid.toml --set drive_frequency=100".to_owned(), "is set with --set and varied"),
        ("nothing.toml".to_owned(), "there is no such file"),
    ] {
        let ended = folder.flap(&format!("respond {arguments}"));
        assert_eq!(ended.code, 2, "{arguments}: {}", ended.stderr);
        assert!(ended.stderr.contains(message), "{arguments}: {}", ended.stderr);
        assert!(ended.stdout.is_empty());
    }
}

const AT_RESONANCE: &str = "\
preset = \"ozaki2018-large\"
[params]
drive_frequency = \"resonance\"
[resonance]
of = \"lift\"
from = \"80 Hz\"
to = \"140 Hz\"
[axes]
drive_voltage_pp = [\"50 V\", \"80 V\"]
[output]
columns = [\"lift_mean_mn\", \"resonance_hz\", \"resonance_second_hz\"]
";

#[test]
fn each_design_is_run_at_its_own_resonance() {
    let folder = Folder::with_grid(AT_RESONANCE);
    let check = folder.flap("check grid.toml");
    assert!(
        check.stdout.contains("at the largest lift, searched from 80 Hz to 140 Hz, within 0.05 Hz"),
        "{}",
        check.stdout
    );
    assert_eq!(folder.flap("sweep --grid grid.toml").code, 0);
    let text = folder.read("grid.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[0][..6],
        ["point", "drive_voltage_pp", "status", "lift_mean_mn", "resonance_hz", "resonance_second_hz"]
    );
    assert_eq!(rows.len(), 3);
    for (index, row) in rows[1..].iter().enumerate() {
        assert_eq!((row[2], row[5]), ("periodic", ""), "{row:?}");
        // A single point is run at its resonance too, and is the same.
        let one = folder.flap(&format!("run grid.toml --point {index}"));
        assert_eq!(one.code, 0, "{}", one.stderr);
        let said = one.stderr.lines().find_map(|line| {
            line.strip_prefix("drive_frequency = ")?.strip_suffix(" Hz, the resonance")?.parse::<f64>().ok()
        });
        let resonance: f64 = row[4].parse().unwrap();
        assert!(said.is_some_and(|said| (said / resonance - 1.0).abs() < 1e-5), "{}", one.stderr);
        let lift: f64 = row[3].parse().unwrap();
        let line = one.stdout.lines().find(|line| line.starts_with("lift_mean_mn")).unwrap();
        let printed: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
        assert!((printed / lift - 1.0).abs() < 1e-5, "{line}");
    }
    let refused = folder.flap("respond grid.toml --along drive_voltage_pp --from 50 --to 60 --step 1");
    assert_eq!(refused.code, 2);
    assert!(
        refused.stderr.contains("sets drive_frequency to the resonance of each design"),
        "{}",
        refused.stderr
    );
}

const EDGES: &str = "\
preset = \"jafferis2016\"
[params]
drive_voltage_pp = \"160 V\"
[axes]
hinge_stiffness = [\"0.7486 uN*m/rad\", \"1.5 uN*m/rad\"]
drive_frequency = { from = \"116 Hz\", to = \"132 Hz\", step = \"2 Hz\" }
";

#[test]
fn edges_have_a_row_per_point() {
    let folder = Folder::with_grid(EDGES);
    let options = "respond grid.toml --edge drive_voltage_pp --edge-from 75 --edge-to 200 --edge-step 40";
    let ended = folder.flap(options);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let soft = "hinge_stiffness = 748.6 nN*m/rad: fold from 200 V, 130.908 Hz to 200 V, 125.639 Hz; \
                hysteresis begins at 80.4053 V, 117.66 Hz (cusp)\n\n";
    assert!(ended.stdout.starts_with(soft), "{}", ended.stdout);
    let table = "drive_voltage_pp  drive_frequency  stroke_pp_deg\n200 V             130.908 Hz       101";
    assert!(ended.stdout.contains(table), "{}", ended.stdout);
    let published = "hinge_stiffness = 1.5 uN*m/rad: no edge: with drive_voltage_pp = 160 V, no band of drive_frequency \
                     ends between 116 Hz and 132 Hz; set drive_voltage_pp to a value with hysteresis, such as a larger one\n";
    assert!(ended.stdout.ends_with(published), "{}", ended.stdout);

    let ended = folder.flap(&format!("{options} --format csv"));
    assert_eq!((ended.code, &*ended.stderr), (0, published));
    let rows: Vec<Vec<&str>> = ended.stdout.lines().map(|line| line.split(',').collect()).collect();
    let names =
        ["hinge_stiffness", "edge", "kind", "mark", "drive_voltage_pp", "drive_frequency", "floquet_max"];
    assert_eq!(rows[0][..7], names);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    let points: Vec<[&str; 2]> = rows[1..].iter().map(|row| [row[3], row[4]]).collect();
    let ends = [["", "200.0"], ["", "195.0"], ["", "155.0"], ["", "115.0"]];
    assert_eq!(points[..4], ends);
    assert!(points[4][0] == "cusp" && points[4][1].starts_with("80.40"), "{points:?}");
    assert!(points[5..].iter().eq(ends.iter().rev()), "{points:?}");
    assert_eq!(folder.flap(&format!("{options} --format csv --threads 1")).stdout, ended.stdout);
}

#[test]
fn edges_that_mean_nothing_are_refused() {
    let folder = Folder::with_grid(EDGES);
    let edges = |edge: &str| format!("respond grid.toml --edge {edge}");
    folder
        .ends(2, &edges("drive_voltage_pp --edge-from 170 --edge-to 200"))
        .says("`drive_voltage_pp` is 160 V, and its range is 170 V to 200 V");
    folder
        .ends(2, &edges("drive_frequency --edge-from 100 --edge-to 200"))
        .says("`drive_frequency` is the followed parameter");
    folder
        .ends(2, &edges("hinge_stiffness --edge-from 1e-6 --edge-to 2e-6"))
        .says("`hinge_stiffness` has no value of its own");
    folder.ends(2, &edges("drive_voltage_pp --edge-from 170")).says("--edge-to");
    folder
        .ends(2, &edges("drive_voltage_pp --edge-from 100 --edge-to 200 --edge-step 0"))
        .says("--edge-step 0: must be more than zero");
    folder
        .ends(2, &edges("drive_voltage_pp --edge-from 100 --edge-to 200 --unstable"))
        .says("cannot be used with");
}

#[test]
fn basins_have_a_row_per_value_of_a_band() {
    let folder = Folder::with_grid(EDGES);
    let ended = folder.ends(0, "respond grid.toml --basins 50");
    assert!(
        ended.stdout.starts_with("hinge_stiffness = 748.6 nN*m/rad:\ndrive_frequency  up "),
        "{}",
        ended.stdout
    );
    let none = "hinge_stiffness = 1.5 uN*m/rad: no value of drive_frequency with two stable orbits\n";
    assert!(ended.stdout.ends_with(none), "{}", ended.stdout);
    let ended = folder.ends(0, "respond grid.toml --basins 50 --format csv");
    ended.says(none);
    let rows = ended.stdout;
    let rows: Vec<Vec<&str>> = rows.lines().map(|line| line.split(',').collect()).collect();
    let names = ["hinge_stiffness", "drive_frequency", "starts", "share_up", "error_up", "share_down"];
    assert_eq!(rows[0][..6], names);
    assert!(rows.len() > 3);
    for row in &rows[1..] {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        assert_eq!((row[2], number(3) + number(5) + number(7)), ("50", 1.0));
    }
    folder.ends(2, "respond grid.toml --basins 0").says("--basins");
    folder.ends(2, "respond grid.toml --seed 1").says("--basins");
    folder.ends(2, "respond grid.toml --basins 5 --strict").says("cannot be used with");
}
