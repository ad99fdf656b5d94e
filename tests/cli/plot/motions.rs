//! Motions of several designs: `flap run` writes them, and `flap plot` draws them over time.

use super::drawn::drawn;
use crate::support::Folder;

/// The cells of a CSV table without its header, and its header.
fn table(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<String>>());
    (lines.next().unwrap(), lines.collect())
}

#[test]
fn motions_of_several_values_are_drawn_with_a_legend() {
    let folder = Folder::new();
    let each = "--each drive_voltage_pp=60,100V,0.14kV --samples 50 --cycles 1";
    let ended = folder.ends(0, &format!("run ozaki2018-large {each} --trajectory motions.csv"));
    ended.says("153 samples in motions.csv");
    for voltage in ["60 V", "100 V", "140 V"] {
        ended.prints(&format!("direct-drive from ozaki2018-large, drive_voltage_pp = {voltage}\n"));
    }
    // Each part is the motion of one design.
    let (header, rows) = table(&folder.read("motions.csv"));
    assert_eq!(header[..2], ["drive_voltage_pp", "time_s"]);
    for voltage in ["60.0", "100.0", "140.0"] {
        let one = format!("run ozaki2018-large --set drive_voltage_pp={voltage} --samples 50 --cycles 1");
        folder.ends(0, &format!("{one} --trajectory one.csv --force"));
        let part = rows.iter().filter(|row| row[0] == voltage).map(|row| row[1..].to_vec());
        assert_eq!(part.collect::<Vec<_>>(), table(&folder.read("one.csv")).1, "{voltage}");
    }
    let picture = drawn(&folder, "motions.csv");
    picture
        .says("trajectory in out.svg")
        .has(&["60 V", "100 V", "140 V", "Stroke (°)", "Pitch (°)", "Time (ms)"])
        // A line for each design in each panel; the legend names each design once.
        .counts("stroke-width=\"1.8\" fill=\"none\"", 6);
    assert_eq!(picture.texts().iter().filter(|text| *text == "60 V").count(), 1);
    // One design has its phase portrait.
    drawn(&folder, "motions.csv --where drive_voltage_pp=60").has(&["Rate (°/ms)"]);
}

#[test]
fn designs_of_different_models_share_a_table() {
    let folder = Folder::with_grid("preset = \"ozaki2018-large\"\n[params]\ndrive_voltage_pp = \"80 V\"\n");
    folder.ends(0, "run grid.toml jafferis2016 --trajectory motions.csv --samples 20 --cycles 1");
    let (header, rows) = table(&folder.read("motions.csv"));
    assert_eq!(header[..2], ["design", "time_s"]);
    assert!(header.iter().any(|name| name == "stroke_deg"), "{header:?}");
    assert_eq!(rows.iter().filter(|row| row[0] == "grid").count(), 21);
    assert_eq!(rows.iter().filter(|row| row[0] == "jafferis2016").count(), 21);
    drawn(&folder, "motions.csv").has(&["grid", "jafferis2016"]);
    // The rows of all designs, with the design in the first column.
    let csv = folder.ends(0, "run grid.toml jafferis2016 --each air_density=1.2,1.1 --format csv").stdout;
    assert!(
        csv.starts_with("design,air_density,column,value,unit,meaning\ngrid,1.2,status,periodic,"),
        "{csv}"
    );
    let statuses: Vec<&str> = csv.lines().filter(|line| line.contains(",status,")).collect();
    assert_eq!(statuses.len(), 4, "{statuses:?}");
    assert!(statuses[3].starts_with("jafferis2016,1.1,status,"), "{statuses:?}");
}

#[test]
fn impossible_designs_are_refused() {
    let folder = Folder::new();
    for (arguments, message) in [
        (
            "run ozaki2018-large ozaki2018-large",
            "the command line gives the same design of ozaki2018-large twice",
        ),
        (
            "run ozaki2018-large --each drive_voltage_pp=60 --set drive_voltage_pp=80",
            "sets drive_voltage_pp twice",
        ),
        ("run ozaki2018-large --each drive_voltage_pp=60,,80", "a value is empty"),
        ("run ozaki2018-large --each drive_voltage=60,80", "no parameter `drive_voltage`"),
        (
            "run ozaki2018-large --each air_density=1,1.2 --gradient lift_mean_mn",
            "--gradient requires one design",
        ),
        ("run", "PRESET|FILE"),
    ] {
        folder.ends(2, arguments).says(message);
    }
}

/// A column with the numbers of camera frames does not divide a file into several motions.
#[test]
fn numbers_of_frames_name_no_designs() {
    let folder = Folder::new();
    let mut lines = vec!["frame,time_s,stroke_deg,pitch_deg".to_owned()];
    lines.extend((0..40).map(|i| format!("{i},{},{},{}", f64::from(i) * 1e-4, i % 7, i % 5)));
    std::fs::write(folder.path("frames.csv"), lines.join("\n") + "\n").unwrap();
    drawn(&folder, "frames.csv").has(&["Rate (°/ms)"]);
}
