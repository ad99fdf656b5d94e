//! `flap run`.

use std::fs;

use crate::support::{Folder, frequencies};

/// The text after the first word of the line that starts with `name`.
fn value<'t>(text: &'t str, name: &str) -> &'t str {
    let line = text.lines().find(|line| line.split_whitespace().next() == Some(name));
    line.and_then(|line| line.split_whitespace().nth(1)).unwrap_or_else(|| panic!("no {name} in\n{text}"))
}

#[test]
fn a_preset_runs_as_published() {
    let ended = Folder::new().ends(0, "run ozaki2018-large");
    assert_eq!(ended.stderr, "");
    let mut lines = ended.stdout.lines();
    assert_eq!(lines.next(), Some("direct-drive from ozaki2018-large"));
    assert!(lines.next().unwrap().starts_with("status = periodic, cycles = "), "{}", ended.stdout);
    assert!(value(&ended.stdout, "lift_mean_mn").parse::<f64>().unwrap() > 0.0);
}

#[test]
fn a_point_measures_the_same_as_its_row_of_a_sweep() {
    let folder = Folder::with_grid(&(frequencies(10) + "[output]\ncolumns = [\"lift_mean_mn\"]\n"));
    let sweep = folder.flap("sweep --grid grid.toml --out -").stdout;
    let row: Vec<&str> = sweep.lines().nth(8).unwrap().split(',').collect();
    let lift: f64 = row[3].parse().unwrap();
    for run in ["run grid.toml --point 7", "run ozaki2018-large --set drive_frequency=60.7"] {
        let shown: f64 = value(&folder.flap(run).stdout, "lift_mean_mn").parse().unwrap();
        assert!((shown - lift).abs() <= 1e-5 * lift.abs(), "{run}: {shown} and {lift}");
    }
}

#[test]
fn values_are_set_with_units_or_without() {
    let folder = Folder::new();
    let bare = folder.flap_with(&["run", "ozaki2018-large", "--set", "drive_frequency=70"]);
    let unit = folder.flap_with(&["run", "ozaki2018-large", "--set", "drive_frequency = 0.07 kHz"]);
    assert_eq!(bare.code, 0, "{}", bare.stderr);
    assert_eq!(bare.stdout, unit.stdout);
    assert_ne!(bare.stdout, folder.flap("run ozaki2018-large").stdout);
}

#[test]
fn tolerances_can_be_changed() {
    let folder = Folder::new();
    let evals = |arguments: &str| {
        let text = folder.flap(&format!("run ozaki2018-large {arguments}")).stdout;
        let second = text.lines().nth(1).unwrap_or_else(|| panic!("{arguments}: {text}")).to_owned();
        let words: Vec<&str> = second.split_whitespace().collect();
        words[words.len() - 1].parse::<u64>().unwrap()
    };
    assert!(evals("--rtol 1e-9") > evals(""));
    assert!(evals("--settle-tol 1e-2") < evals(""));
    folder.ends(0, "run ozaki2018-large --max-cycles 2").prints("\nstatus = unsettled, cycles = 2, ");
}

#[test]
fn a_trajectory_is_sampled() {
    let folder = Folder::new();
    folder
        .ends(0, "run ozaki2018-large --trajectory motion.csv --cycles 3 --samples 20")
        .prints("lift_mean_mn");
    let motion = folder.read("motion.csv");
    assert!(motion.starts_with("time_s,"), "{motion}");
    assert_eq!(motion.lines().count(), 1 + 3 * 20 + 1);

    let again = folder.flap("run ozaki2018-large --trajectory motion.csv");
    assert_eq!(again.code, 2, "it exists");
    let piped = folder.flap("run ozaki2018-large --trajectory - --cycles 3 --samples 20");
    assert_eq!(piped.stdout, motion);
    let rest = folder.ends(0, "run ozaki2018-large --trajectory - --cycles 3 --samples 20 --from-rest");
    assert_ne!(rest.stdout, motion);
}

/// The motions of all designs are in memory at once.
#[test]
fn trajectories_have_a_largest_number_of_samples() {
    let folder = Folder::new();
    fs::write(folder.path("wave.csv"), "time_s,wave\n0,0\n0.002,40\n0.004,0\n0.006,-40\n0.008,0\n").unwrap();
    let designs = "run ozaki2018-large --trajectory motion.csv --each drive_bias=0,1,2,3,4,5";
    folder.refuses(
        &format!("{designs} --cycles 4 --samples 250000"),
        "6000000 samples are too many: the number of designs times --cycles times --samples must be at most 5000000",
    );
    folder.refuses(
        &format!("{designs} --waveform wave.csv --once --samples 1000000"),
        "6000000 samples are too many: the number of designs times --samples must be at most 5000000",
    );
}

#[test]
fn a_chirp_gives_one_row_per_cycle_and_the_motion() {
    let folder = Folder::new();
    let ended = folder.flap("test chirp ozaki2018-small --from 180 --to 200 --rate 100");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let rows: Vec<&str> = ended.stdout.lines().collect();
    assert!(rows[0].starts_with("begin_s,end_s,frequency_hz,stroke_amplitude_deg,"), "{}", rows[0]);
    // 0.2 s at 190 Hz on average.
    assert_eq!(rows.len(), 1 + 38);

    let files = "test chirp ozaki2018-small --from 180 --to 200 --rate 100 \
                 --out e.csv --trajectory t.csv --samples 10";
    assert_eq!(folder.flap(files).code, 0);
    assert_eq!(folder.read("e.csv"), ended.stdout);
    assert_eq!(folder.read("t.csv").lines().count(), 1 + 38 * 10 + 1);
    assert_eq!(folder.flap(files).code, 2, "existing files are not overwritten unasked");
    assert_eq!(folder.flap(&format!("{files} --force")).code, 0);

    folder.ends(2, "test chirp ozaki2018-small --from 200 --to 100").says("sign of the change");
    assert_eq!(folder.flap("test impulse ozaki2018-small --out e.csv").code, 2);
}
