//! Pictures and pages of results.

mod drawn;
mod matrices;
mod mistakes;
mod motions;
mod pages;
mod pictures;
mod print;
mod samples;

use std::fmt::Write as _;
use std::fs;

use crate::support::{Ended, Folder};

/// The header of the tables below: two axes, a constant parameter, a status, and measures.
const HEADER: &str = "point,drive_voltage_pp,drive_frequency,hinge_stiffness,status,stroke_amplitude_deg,lift_mean_mn,power_mean_mw,cycles,stable";

/// Rows of a sweep of voltages and frequencies. The rows at 110 Hz and 80 V or more have no measures.
fn sweep() -> String {
    let mut text = HEADER.to_owned() + "\n";
    let mut point = 0;
    for voltage in [60, 80, 100] {
        for frequency in [90, 100, 110, 120] {
            let (v, f) = (f64::from(voltage), f64::from(frequency));
            let _ = write!(text, "{point},{v:?},{f:?},0.0001,");
            if frequency == 110 && voltage >= 80 {
                text += "unsettled,,,,400,\n";
            } else {
                let (stroke, lift, power) =
                    (v / 10.0 - (f - 105.0).abs() / 10.0, v * f / 3000.0, v * v / 200.0);
                let _ = writeln!(text, "periodic,{stroke},{lift},{power},22,true");
            }
            point += 1;
        }
    }
    text
}

/// Rows of a response of one design, with its unstable orbits.
fn response() -> String {
    let mut text =
        "curve,branch,drive_frequency,status,bistable,stroke_amplitude_deg,lift_mean_mn\n".to_owned();
    let rows = [
        ("up", [110, 120, 130], [70, 60, 20]),
        ("down", [130, 120, 110], [20, 25, 70]),
        ("unstable", [128, 124, 121], [50, 40, 30]),
    ];
    for (branch, frequencies, strokes) in rows {
        for (frequency, stroke) in frequencies.into_iter().zip(strokes) {
            let bistable = match branch {
                "unstable" => "",
                _ if frequency == 120 => "true",
                _ => "false",
            };
            let _ = writeln!(text, "0,{branch},{frequency}.0,periodic,{bistable},{stroke}.0,1.0");
        }
    }
    text
}

fn motion() -> String {
    let mut text = "time_s,stroke_rate_rad_s,stroke_deg,pitch_deg\n".to_owned();
    for i in 0..101 {
        let phase = f64::from(i) / 50.0 * std::f64::consts::TAU;
        let _ = writeln!(
            text,
            "{},{},{},{}",
            f64::from(i) * 2e-4,
            phase.cos() * 600.0,
            40.0 * phase.sin(),
            30.0 * phase.cos()
        );
    }
    text
}

fn folder() -> Folder {
    let folder = Folder::new();
    fs::write(folder.path("sweep.csv"), sweep()).unwrap();
    fs::write(folder.path("response.csv"), response()).unwrap();
    fs::write(folder.path("motion.csv"), motion()).unwrap();
    folder
}

fn count(text: &str, part: &str) -> usize {
    text.matches(part).count()
}

fn refused(folder: &Folder, arguments: &[&str]) -> Ended {
    let words: Vec<&str> = std::iter::once("plot").chain(arguments.iter().copied()).collect();
    let before = folder.names();
    let ended = folder.flap_with(&words);
    assert_eq!((ended.code, ended.stdout.as_str()), (2, ""), "{arguments:?}\n{}", ended.stderr);
    assert_eq!(folder.names(), before, "{arguments:?} leaves files behind");
    ended
}
