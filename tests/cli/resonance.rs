//! `flap run --drive impulse` and `flap test resonance`.

use crate::support::Folder;

/// The second word of the line that starts with `name`, a number.
fn number(text: &str, name: &str) -> f64 {
    let line = text.lines().find(|line| line.split_whitespace().next() == Some(name));
    let word = line.and_then(|line| line.split_whitespace().nth(1));
    word.and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("no {name} in\n{text}"))
}

#[test]
fn an_impulse_sets_the_resting_wing_in_motion() {
    let folder = Folder::new();
    let run = |more: &str| {
        let words = ["test", "impulse", "ozaki2018-small", "--amplitude", "20 deg", "--duration", "50 ms"];
        folder.flap_with(&words.into_iter().chain(more.split_whitespace()).collect::<Vec<_>>())
    };
    let ended = run("--trajectory free.csv --samples 100");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    // 2π f₁ times 20 deg.
    let rate = std::f64::consts::TAU * number(&ended.stdout, "mode_1_hz") * 20_f64.to_radians();
    assert!((number(&ended.stdout, "stroke_rate_rad_s") / rate - 1.0).abs() < 1e-5, "{}", ended.stdout);
    let motion = folder.read("free.csv");
    let rows: Vec<Vec<f64>> = motion
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert!(motion.starts_with("time_s,stroke_rad,pitch_rad,stroke_rate_rad_s,"), "{motion}");
    assert!((rows[0][3] / rate - 1.0).abs() < 1e-5);
    assert_eq!(rows[0][..3], [0.0; 3]);
    assert!((rows.last().unwrap()[0] - 0.05).abs() < 1e-15);
    // 50 ms are 9.8 periods.
    assert!(rows.len() > 970 && rows.len() < 1000, "{}", rows.len());
    // The voltage is zero: no power.
    assert!(rows.iter().all(|row| row[10] == 0.0), "{motion}");

    assert_eq!(run("--trajectory free.csv").code, 2, "existing files are not overwritten unasked");
    let piped = run("--trajectory - --samples 100");
    assert_eq!(piped.stdout, motion);
    assert_eq!(piped.stderr, "");
    let json: serde_json::Value = serde_json::from_str(&run("--format json").stdout).unwrap();
    assert_eq!(json[2]["column"], "stroke_rate_rad_s");
    assert!((json[2]["value"].as_f64().unwrap() / rate - 1.0).abs() < 1e-5, "{json}");
}

#[test]
fn resonances_are_compared() {
    let folder = Folder::new();
    let ended = folder.ends(0, "test resonance ozaki2018-large --impulse 20deg --from 90 --to 130");
    let text = &ended.stdout;
    assert!(text.starts_with("direct-drive from ozaki2018-large\n\nRESONANCE "), "{text}");
    assert!((number(text, "mode_1") - 102.2).abs() < 0.1, "{text}");
    assert!((number(text, "impulse_fit") - 107.9).abs() < 1.5, "{text}");
    assert!((number(text, "driven_1") - 110.7).abs() < 0.1, "{text}");
    assert_eq!(
        folder.flap("test resonance ozaki2018-large --from 90 --to 130 --impulse 20deg").stdout,
        *text
    );

    let csv = folder.flap("test resonance ozaki2018-large --from 90 --to 130 --format csv").stdout;
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][..3], ["resonance", "frequency_hz", "relative_height"]);
    assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{csv}");
    let driven = lines.iter().find(|line| line[0] == "driven_1").unwrap();
    let frequency: f64 = driven[1].parse().unwrap();
    assert!((frequency - number(text, "driven_1")).abs() < 1e-3, "{csv}");
    assert_eq!(driven[2], "1.0");
}

#[test]
fn what_hides_a_peak_is_told() {
    let folder = Folder::new();
    let ended = folder.ends(0, "test resonance ozaki2018-large --from 60 --to 90");
    ended.says("larger at the end of the range, 90.0 Hz");
    assert!(!ended.stdout.contains("driven_1"), "{}", ended.stdout);

    let ended = folder.ends(0, "test resonance ozaki2018-large --from 100 --to 120 --max-cycles 3");
    ended.says("11 of 11 drive frequencies have no periodic motion");
    ended.says("100.0 to 120.0 Hz unsettled (11)");
}

#[test]
fn impossible_motions_and_searches_are_refused() {
    let folder = Folder::new();
    for (arguments, message) in [
        ("test impulse ozaki2018-small --amplitude 20", "write a number with a unit, such as `20 deg`"),
        ("test impulse ozaki2018-small --amplitude 20mm", "write a number with a unit, such as `20 deg`"),
        ("test impulse ozaki2018-small --amplitude 200deg", "is larger than 180 deg: give at most 180 deg"),
        ("test resonance ozaki2018-small --impulse 20rad", "an impulse of 1145.9 deg (20 rad) is larger"),
        ("test impulse ozaki2018-small --amplitude 0deg", "must be finite and not zero"),
        ("test impulse ozaki2018-small --duration 0s", "cannot be sampled"),
        ("test impulse ozaki2018-small --duration 1e9s", "cannot be sampled"),
        (
            "test resonance ozaki2018-small --from 100 --to 90",
            "there are no drive frequencies from 100 to 90 Hz",
        ),
        ("test resonance ozaki2018-small --from 0", "more than zero"),
        ("test resonance ozaki2018-small --from 5mm", "write a number with a unit, such as `120 Hz`"),
        ("test resonance ozaki2018-small --tolerance 0", "the tolerance must be more than zero, not 0 Hz"),
        ("test resonance ozaki2018-small --window-cycles 1", "2..=1000"),
        (
            "test resonance ozaki2018-small --spectrum-window 5ms",
            "the spectrum window of 0.005 s contains 0.9",
        ),
        ("test resonance ozaki2018-small --spectrum-window 0s", "contains 0.000 periods of the first mode"),
        ("test resonance ozaki2018-small --set drive_freqency=100", "did you mean `drive_frequency`?"),
        ("test resonance ozaki2018-small --point 1", "there is no point 1"),
        (
            "test resonance ozaki2018-small --set stroke_mode=prescribed",
            "the same at every frequency, set stroke_mode to free",
        ),
    ] {
        folder.refuses(arguments, message);
    }
    folder.ends(2, "test resonance ozaki2018-small --set wing_inertia_product=1").says("mass matrix");
    assert_eq!(folder.names(), [""; 0]);
}
