//! Expressions in grid files, from the command line.

use crate::support::Folder;

const GRID: &str = r#"
preset = "ozaki2018-large"
[axes]
drive_frequency = { from = 100, to = 120, step = 5 }
[derived]
hinge_stiffness = "preset.hinge_stiffness * (drive_frequency / preset.drive_frequency)^2"
[where]
low = "drive_frequency < 119"
[measure]
lift_per_power = "lift_mean_mn / power_mean_mw"
strong = "lift_mean_mn > 1"
[output]
columns = ["lift_mean_mn", "power_mean_mw", "lift_per_power", "strong"]
"#;

#[test]
fn a_sweep_tells_what_it_left_out() {
    let folder = Folder::with_grid(GRID);
    folder
        .ends(0, "sweep --grid grid.toml --out o.csv")
        .says("1 point is excluded by [where]: condition `low` fails at 1 point\n");
    let text = folder.read("o.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[0][..8],
        [
            "point",
            "drive_frequency",
            "hinge_stiffness",
            "status",
            "lift_mean_mn",
            "power_mean_mw",
            "lift_per_power",
            "strong",
        ]
    );
    assert_eq!(rows.len(), 5);
    for row in &rows[1..] {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        assert_eq!(number(6), number(4) / number(5));
        assert_eq!(row[7], (number(4) > 1.0).to_string());
    }
    let sidecar: toml::Table = folder.read("o.csv.meta.toml").parse().unwrap();
    assert_eq!(sidecar["points"].as_integer(), Some(5));
    assert_eq!(sidecar["summary"]["rows"].as_integer(), Some(4));
    assert_eq!(sidecar["summary"]["excluded"].as_integer(), Some(1));
    let low = &sidecar["summary"]["unsatisfied"][0];
    assert_eq!((low["condition"].as_str(), low["points"].as_integer()), (Some("low"), Some(1)));
}

/// The size of a hinge has no default. Other parameters that are not set follow from parameters that are set.
#[test]
fn parameters_without_a_default_are_told_as_such() {
    let told = |section: &str| {
        let grid = format!("preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = [100, 110]\n{section}");
        Folder::with_grid(&grid).ends(2, "check grid.toml").stderr
    };
    let no_default = "it has no default (hinge_strain_max is empty)";
    let thick = told("[where]\nthick = \"hinge_thickness > 1e-6\"\n");
    assert!(thick.contains(&format!("{no_default}: set `hinge_thickness` under [params]")), "{thick}");
    let preset = told("[where]\nthick = \"preset.hinge_thickness > 1e-6\"\n");
    assert!(preset.contains(&format!("{no_default}, so that there is no number to use")), "{preset}");
    let slope = told("[gradient]\nof = [\"lift_mean_mn\"]\nwith_respect_to = [\"hinge_thickness\"]\n");
    assert!(slope.contains(&format!("`hinge_thickness` is not set: {no_default}")), "{slope}");
    let bias = told("[where]\nhigh = \"drive_bias > 1\"\n");
    assert!(
        bias.contains("it follows other parameters (half of drive_voltage_pp): set `drive_bias`"),
        "{bias}"
    );
}

#[test]
fn one_point_shows_its_own_measures() {
    let folder = Folder::with_grid(GRID);
    let ended = folder.ends(0, "run grid.toml --point 1");
    ended.prints("\nlift_per_power ");
    assert!(ended.stdout.lines().any(|line| line.starts_with("strong ") && line.contains(" true ")));
    let excluded = folder.ends(0, "run grid.toml --point 4");
    assert_eq!(excluded.stderr, "a sweep excludes this point, because it does not satisfy low\n");
}

#[test]
fn derived_parameters_follow_those_that_are_set() {
    let folder = Folder::with_grid(GRID);
    let at = |arguments: &str| {
        folder.flap(&format!("run grid.toml {arguments}")).stdout.replace("point 0", "point 1")
    };
    assert_eq!(at("--set drive_frequency=105"), at("--point 1"));
    assert_ne!(at("--point 1 --set hinge_stiffness=1e-4"), at("--point 1"));
    Folder::with_grid(&GRID.replace("^2", "^2 - 1"))
        .ends(2, "run grid.toml")
        .says("`hinge_stiffness` is computed as -0.99");
}

#[test]
fn check_shows_what_is_sampled_derived_and_excluded() {
    let grid = r#"
preset = "jafferis2016"
[axes]
drive_frequency = { from = 100, to = 119, step = 1 }
[sample]
method = "latin-hypercube"
n = 5
seed = 3
[sample.parameters]
wing_area = { relative_sd = "5 %", from = "40 mm^2" }
air_density = { from = 1.1, to = 1.3 }
centre_of_pressure = ["folded", "directional"]
[derived]
hinge_stiffness = "preset.hinge_stiffness * drive_frequency / 100"
[where]
low = "drive_frequency < 115"
other = "drive_frequency > 102"
"#;
    let ended = Folder::with_grid(grid).ends(0, "check grid.toml");
    for part in [
        "100 points of bimorph",
        "\naxis 2: Latin hypercube, seed 3\n",
        "\n40 points are excluded by [where]: condition `low` fails at 25 points, condition `other` fails at 15 points\n",
        "  one of folded, directional",
        ", from 4e-5",
        "(excluded)\n",
        ", hinge_stiffness = ",
        "\nestimate: ",
    ] {
        ended.prints(part);
    }
    // Too many to count.
    let many = grid.replace("n = 5", "n = 4_000_000_000");
    let ended = Folder::with_grid(&many).flap("check grid.toml");
    let counted = "\nthe grid is too large to check every point; of 1000000 points spread over the grid, ";
    let (_, rest) = ended.stdout.split_once(counted).unwrap();
    let excluded: f64 = rest.split(' ').next().unwrap().parse().unwrap();
    assert!((excluded / 1e6 - 0.4).abs() < 1e-3, "{excluded}");
}
