//! `flap device wing`: outlines into devices.

use std::fmt::Write as _;
use std::fs;

use crate::support::Folder;

/// An outline whose edges are given in mm at 101 stations of a span (mm).
fn outline(span: f64, edges: impl Fn(f64) -> [f64; 2]) -> String {
    let mut text = "# drawn by hand\nspan [mm],leading_edge [mm],trailing_edge [mm]\n".to_owned();
    for station in 0..=100 {
        let x = f64::from(station) / 100.0;
        let [leading, trailing] = edges(x);
        let _ = writeln!(text, "{},{leading},{trailing}", x * span);
    }
    text
}

/// The value of a parameter in a device, in SI units.
fn value(folder: &Folder, device: &str, name: &str) -> f64 {
    let line = device.lines().find(|line| line.starts_with(&format!("{name} = "))).expect(name);
    let text = line.split(['=', '#']).nth(1).unwrap().trim();
    fs::write(folder.path("one.toml"), format!("preset = \"jafferis2016\"\n[params]\n{name} = {text}\n"))
        .unwrap();
    flap_sweep::notation::units::parse_as(text.trim_matches('"'), unit(name)).unwrap()
}

fn unit(name: &str) -> &'static str {
    let models = flap_core::simulate::all();
    let mut parameters = models.iter().flat_map(|model| model.parameters());
    parameters.find(|parameter| parameter.name == name).unwrap().unit
}

/// A quarter of an ellipse behind the axis, whose integrals have known formulas.
#[test]
fn an_elliptic_wing_has_its_integrals() {
    let folder = Folder::new();
    let (span, chord) = (15e-3, 5e-3);
    fs::write(folder.path("ellipse.csv"), outline(15.0, |x| [0.0, 5.0 * (1.0 - x * x).sqrt()])).unwrap();
    let arguments = ["device", "wing", "ellipse.csv", "--preset", "jafferis2016", "--mass", "0.5 mg"];
    let device = folder.ends_with(0, &arguments).stdout;
    let area = std::f64::consts::FRAC_PI_4 * span * chord;
    let close = |name: &str, expected: f64| {
        let found = value(&folder, &device, name);
        assert!((found / expected - 1.0).abs() < 2e-3, "{name}: {found:e}, not {expected:e}");
    };
    close("wing_area", area);
    close("wing_length", span);
    // Second moments of a quarter of an ellipse: area/4 times the square of the half axis.
    close("wing_radius_2", 0.5);
    close("wing_width_2", 0.5);
    close("wing_width", chord);
    close("wing_inertia_stroke", 0.5e-6 * span * span / 4.0);
    close("wing_inertia_hinge", 0.5e-6 * chord * chord / 4.0);
    // ∫ r z dm = σ a² b²/8.
    close("wing_inertia_product", 0.5e-6 / area * span * span * chord * chord / 8.0);
    // ∫ r³ c/∫ r² c = (2/15)/(π/16) of the span; ∫∫ z³/∫∫ z² the same of the chord.
    close("pressure_radius", 2.0 / 15.0 / (std::f64::consts::PI / 16.0) * span);
    close("rotation_pressure_width", 2.0 / 15.0 / (std::f64::consts::PI / 16.0) * chord);
    fs::write(folder.path("wing.toml"), device).unwrap();
    let run = folder.ends(0, "run wing.toml");
    run.prints("status = periodic");
    assert_eq!(run.stderr, "", "values with units are not doubted");
}

/// From the outline of the wing of `arabagi2013-75hz`, flap computes the rows of the preset. Small differences come
/// from the straight lines between the stations.
#[test]
fn the_outline_of_a_preset_gives_its_rows() {
    let folder = Folder::new();
    let chord = |x: f64| 8.3 * (1.0 + x - 2.0 * x.powi(4));
    fs::write(folder.path("own.csv"), outline(24.0, |x| [0.25 * chord(x), 0.75 * chord(x)])).unwrap();
    let arguments = ["device", "wing", "own.csv", "--preset", "arabagi2013-75hz", "--offset", "4 mm"];
    let ended = folder.ends_with(0, &arguments);
    ended.says("of the wing are the values of the preset");
    assert!(ended.stdout.contains("chord_table = \"on\""), "{}", ended.stdout);
    fs::write(folder.path("wing.toml"), &ended.stdout).unwrap();
    let measure = |what: &str, name: &str| {
        let text = folder.ends(0, &format!("run {what}")).stdout;
        let mut lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        let line = lines.find(|line| line.first() == Some(&name)).unwrap();
        line[1].parse::<f64>().unwrap()
    };
    for name in ["lift_mean_mn", "stroke_pp_deg", "power_mean_mw"] {
        let (own, preset) = (measure("wing.toml", name), measure("arabagi2013-75hz", name));
        assert!((own / preset - 1.0).abs() < 0.02, "{name}: {own} against {preset}");
    }
}

/// The chord of a square tip falls to zero within the last tenth of the table.
#[test]
fn a_table_of_chords_that_loses_area_is_told() {
    let folder = Folder::new();
    let head = "span [mm],leading_edge [mm],trailing_edge [mm]\n";
    fs::write(folder.path("square.csv"), format!("{head}0,0,5\n29.9,0,5\n30,0,0\n")).unwrap();
    // Areas in mm²: the table falls over 3 mm, the outline over 0.1 mm.
    let (table, outline) = (5.0 * 28.5, 5.0 * 29.95);
    let told = format!(
        "have {:.1} % less area than the outline: multiply each chord by {:.4} to match the area of the outline",
        100.0 * (1.0 - table / outline),
        outline / table
    );
    for preset in ["ozaki2018-large", "arabagi2013-75hz"] {
        let arguments = ["device", "wing", "square.csv", "--preset", preset, "--offset", "2 mm"];
        folder.ends_with(0, &arguments).says(&told);
        let quiet = folder.ends_with(0, &[&arguments[..], &["--quiet"]].concat());
        assert_eq!(quiet.stderr, "");
    }
    let bimorph = folder.ends_with(0, &["device", "wing", "square.csv", "--preset", "jafferis2016"]);
    assert!(!bimorph.stderr.contains("area than"), "{}", bimorph.stderr);
    fs::write(folder.path("straight.csv"), outline_of_a_rectangle()).unwrap();
    let straight = folder.ends_with(0, &["device", "wing", "straight.csv", "--preset", "ozaki2018-large"]);
    assert!(!straight.stderr.contains("area than"), "{}", straight.stderr);
}

fn outline_of_a_rectangle() -> String {
    outline(30.0, |_| [0.0, 5.0])
}

#[test]
fn a_root_that_moves_to_the_stroke_axis_is_told() {
    let folder = Folder::new();
    fs::write(folder.path("wing.csv"), outline_of_a_rectangle()).unwrap();
    let begin = "without --offset, the wing's root is on the stroke axis (wing_offset = 0 m), but in";
    for (preset, end) in [
        ("arabagi2013-75hz", "it is at 4 mm: --offset '4 mm' keeps that offset"),
        (
            "ozaki2018-large",
            "it is at half of actuator_length, 10.5 mm: --offset '10.5 mm' keeps that offset",
        ),
    ] {
        let arguments = ["device", "wing", "wing.csv", "--preset", preset];
        folder.ends_with(0, &arguments).says(&format!("{begin} {preset} {end}"));
        let quiet = folder.ends_with(0, &[&arguments[..], &["--quiet"]].concat());
        assert_eq!(quiet.stderr, "");
        for offset in ["0 mm", "4 mm"] {
            let given = folder.ends_with(0, &[&arguments[..], &["--offset", offset]].concat());
            assert!(!given.stderr.contains("--offset"), "{}", given.stderr);
        }
    }
    // A device whose root is on the axis.
    fs::write(folder.path("axis.toml"), "preset = \"arabagi2013-75hz\"\n[params]\nwing_offset = \"0 mm\"\n")
        .unwrap();
    let device = folder.ends_with(0, &["device", "wing", "wing.csv", "--preset", "axis.toml"]);
    assert!(!device.stderr.contains("--offset"), "{}", device.stderr);
}

#[test]
fn materials_give_masses() {
    let folder = Folder::new();
    fs::write(folder.path("wing.csv"), outline(32.0, |_| [0.0, 8.0])).unwrap();
    let options =
        ["--thickness", "2 um", "--density", "1400 kg/m^3", "--spar", "20 mg/m", "--offset", "10 mm"];
    let arguments = [&["device", "wing", "wing.csv", "--preset", "ozaki2018-large"][..], &options].concat();
    let device = folder.ends_with(0, &arguments).stdout;
    let (membrane, spar) = (2e-6 * 1400.0 * 32e-3 * 8e-3, 20e-6 * 32e-3);
    let mass = value(&folder, &device, "wing_mass");
    assert!((mass / (membrane + spar) - 1.0).abs() < 1e-9, "{mass:e}");
    let centre = value(&folder, &device, "mass_centre_chord");
    assert!((centre / -(membrane * 4e-3 / (membrane + spar)) - 1.0).abs() < 1e-9, "{centre:e}");
    assert!((value(&folder, &device, "mass_centre_span") / 16e-3 - 1.0).abs() < 1e-9);
    fs::write(folder.path("wing.toml"), device).unwrap();
    folder.ends(0, "check wing.toml").prints("wing_mass");
}

#[test]
fn mistakes_are_told_with_their_place() {
    let folder = Folder::new();
    let told = |text: &str, message: &str| {
        fs::write(folder.path("wing.csv"), text).unwrap();
        folder.ends(2, "device wing wing.csv --preset jafferis2016").says(message).says("span [mm]");
    };
    let head = "span [mm],leading_edge [mm],trailing_edge [mm]\n";
    told("span,chord\n0,1\n", "wing.csv:1: there is no column `leading_edge`");
    told("span,leading_edge,trailing_edge\n0,0,1\n14,0,1\n", "wing.csv:1: the column `span` has no unit");
    told(
        "span [mm],leading_edge [mm],trailing_edge [mm],span [m]\n0,0,1,0\n14,0,1,1\n",
        "wing.csv:1: two columns are called span: keep one of them",
    );
    told(&head.replace(',', ";"), "wing.csv:1: the first line contains `;` instead of commas");
    told(&format!("{head}0,0,one\n1,0,2\n"), "wing.csv:2: ");
    told(&format!("{head}0,0,1\n1,0\n"), "wing.csv");
    told(&format!("{head}0,0,1\n"), "an outline has at least two stations, not 1");
    told(&format!("{head}1,0,1\n2,0,1\n"), "an outline begins at 0, the wing's root");
    told(&format!("{head}0,0,1\n2,0,1\n1,0,1\n"), "station 3 is not farther out");
    told(&format!("{head}0,0,1\n2,0,-1\n"), "the chord is negative at station 2");
    told(&format!("{head}0,0,0\n2,0,0\n"), "the wing has no area");
    folder
        .ends(2, "device wing nothing.csv --preset jafferis2016")
        .says("nothing.csv: there is no such file");
    fs::write(folder.path("wing.csv"), outline(15.0, |_| [0.0, 5.0])).unwrap();
    folder
        .ends_with(2, &["device", "wing", "wing.csv", "--preset", "jafferis2016", "--thickness", "2 um"])
        .says("are required together");
    folder
        .ends_with(2, &["device", "wing", "wing.csv", "--preset", "jafferis2016", "--mass", "0 mg"])
        .says("the mass must be more than zero");
    folder
        .ends_with(2, &["device", "wing", "wing.csv", "--preset", "jafferis2016", "--offset", "-1mm"])
        .says("expected zero or more");
    folder.ends_with(2, &["device", "wing", "wing.csv", "--preset", "jaferis2016"]).says("jafferis2016");
}

/// flap prints no device that it could not read.
#[test]
fn wings_without_finite_parameters_are_refused() {
    let folder = Folder::new();
    let head = "span [m],leading_edge [m],trailing_edge [m]\n";
    fs::write(folder.path("huge.csv"), format!("{head}0,0,1e308\n1e308,0,1e308\n")).unwrap();
    fs::write(folder.path("tiny.csv"), format!("{head}0,0,1e-150\n1e-150,0,1e-150\n")).unwrap();
    fs::write(folder.path("wing.csv"), outline_of_a_rectangle()).unwrap();
    for preset in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let ended =
            folder.ends_with(2, &["device", "wing", "huge.csv", "--preset", preset, "--mass", "1 mg"]);
        ended.says("of this wing is ").says(", but must be ").says("is 1e299 Gm long and reaches 1e299 Gm");
        assert_eq!(ended.stdout, "");
        for options in [["--offset", "1e300 m"], ["--mass", "1e308 kg"]] {
            let arguments = [&["device", "wing", "wing.csv", "--preset", preset][..], &options].concat();
            let ended = folder.flap_with(&arguments);
            assert!(!ended.stdout.contains("inf") && !ended.stdout.contains("NaN"), "{}", ended.stdout);
            fs::write(folder.path("device.toml"), &ended.stdout).unwrap();
            assert!(ended.code == 2 || folder.flap("check device.toml").code == 0, "{arguments:?}");
        }
        let tiny = folder.flap_with(&["device", "wing", "tiny.csv", "--preset", preset]);
        assert!(!tiny.stdout.contains("NaN"), "{}", tiny.stdout);
    }
}

/// A wing with its own device has the standard errors and the correlations of the device.
#[test]
fn the_device_of_a_wing_has_its_correlations() {
    let device = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = { value = 2e-6, sd = 1e-7 }\n\
                  wing_inertia_stroke = { value = 50e-12, sd = 1e-12 }\n[[correlation]]\n\
                  between = [\"hinge_stiffness\", \"wing_inertia_stroke\"]\ncoefficient = 0.9\n";
    let grid = "preset = \"jafferis2016\"\n[vehicle]\n[[vehicle.wings]]\nname = \"left\"\ndevice = \"left.toml\"\n\
                [[vehicle.wings]]\nname = \"right\"\nmirrored = true\n\
                [sample]\nmethod = \"sobol\"\nn = 64\nof = \"device\"\n[output]\ncolumns = [\"force_up_mn\"]\n[solver]\nmax_cycles = 1\n";
    let folder = Folder::with_grid(grid);
    fs::write(folder.path("left.toml"), device).unwrap();
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let text = folder.read("rows.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let z = |name: &str, mean: f64, sd: f64| {
        let place = rows[0].iter().position(|known| *known == name).unwrap();
        let number = move |row: &Vec<&str>| (row[place].parse::<f64>().unwrap() - mean) / sd;
        rows[1..].iter().map(number).collect::<Vec<f64>>()
    };
    let stiffness = z("left_hinge_stiffness", 2e-6, 1e-7);
    let inertia = z("left_wing_inertia_stroke", 50e-12, 1e-12);
    let correlation = stiffness.iter().zip(&inertia).map(|(a, b)| a * b).sum::<f64>() / 64.0;
    assert!((correlation - 0.9).abs() < 0.1, "{correlation}");
}

/// The mean of one wing's parameter is not the value of all wings if this value differs between points.
#[test]
fn a_mean_does_not_ignore_sampled_and_derived_values_of_all_wings() {
    let grid = "preset = \"jafferis2016\"\n[vehicle]\n[[vehicle.wings]]\nname = \"left\"\n[[vehicle.wings]]\n\
                name = \"right\"\nmirrored = true\n[sample]\nmethod = \"random\"\nn = 2\n[sample.parameters]\n\
                left_hinge_stiffness = { relative_sd = \"5 %\" }\n";
    let told = "`left_hinge_stiffness` is not set, so it has no value for the mean";
    for (more, code) in [
        ("", 0),
        ("hinge_stiffness = { relative_sd = \"5 %\" }\n", 2),
        ("[derived]\nhinge_stiffness = \"2e-6\"\n", 2),
    ] {
        let ended = Folder::with_grid(&format!("{grid}{more}")).ends(code, "check grid.toml");
        assert_eq!(ended.stderr.contains(told), code == 2, "{more}: {}", ended.stderr);
    }
}
