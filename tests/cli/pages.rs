//! Pages are run as a reader runs them: the files that a page names are saved, its shell blocks are executed in order,
//! and each block prints the `text` block that follows it.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::documents::{blocks, document, root};
use crate::support::{Folder, quick};

/// A page with the folder in which it is run.
struct Page {
    name: &'static str,
    text: String,
    folder: Folder,
}

impl Page {
    /// The page in a new folder with the files that it names, and with the grids of `examples` that it runs.
    fn open(name: &'static str) -> Page {
        let page = Page { name, text: document(name), folder: Folder::new() };
        for (file, body) in page.named_files() {
            fs::write(page.folder.path(&file), body).unwrap();
        }
        fs::create_dir(page.folder.path("examples")).unwrap();
        let words = page.text.split(|character: char| character.is_whitespace() || character == '`');
        let grids = words.filter(|word| word.starts_with("examples/"));
        for grid in grids.filter(|word| Path::new(word).extension().is_some_and(|ending| ending == "toml")) {
            fs::copy(root().join(grid), page.folder.path(grid)).unwrap();
        }
        page
    }

    /// The files that the page shows below a line such as "`grid.toml`:", each with its text.
    fn named_files(&self) -> Vec<(String, String)> {
        let named = self.text.match_indices("`:\n\n```").filter_map(|(end, mark)| {
            let name = self.text[..end].rsplit_once("\n`")?.1;
            let body = self.text[end + mark.len()..].split_once('\n')?.1.split("```").next()?;
            Some((name.to_owned(), body.to_owned()))
        });
        named.collect()
    }

    /// Runs the shell blocks, and returns what they print. Fails if a block fails or lacks the `text` block that
    /// follows it, or if there are other than `expected` commands.
    #[track_caller]
    fn runs(&self, expected: usize) -> String {
        let mut all = String::new();
        let mut last = None;
        let mut commands = 0;
        // Parts with odd numbers are inside of fences.
        for block in self.text.split("```").skip(1).step_by(2) {
            let (language, body) = block.split_once('\n').unwrap();
            match (language, last.take()) {
                ("sh", _) => {
                    let lines: Vec<&str> = body.lines().filter(|line| !installs(line)).collect();
                    commands += lines.iter().filter(|line| line.contains("flap ")).count();
                    let printed = self.run(&lines.join("\n"));
                    all += &printed;
                    last = Some(printed);
                }
                ("text", Some(printed)) => {
                    assert!(printed.contains(body), "{}: it shows\n{body}\nnot\n{printed}", self.name);
                }
                _ => {}
            }
        }
        assert_eq!(commands, expected, "commands in {}", self.name);
        all
    }

    /// Standard output and errors of lines for a shell that finds `flap`.
    #[track_caller]
    fn run(&self, lines: &str) -> String {
        let flap = Path::new(env!("CARGO_BIN_EXE_flap")).parent().unwrap();
        let paths = format!("{}:{}", flap.display(), std::env::var("PATH").unwrap());
        let mut shell = Command::new("sh");
        shell
            .args(["-ec", lines])
            .env("PATH", &paths)
            .env_remove("COLUMNS")
            .current_dir(self.folder.path(""));
        let ended = shell.output().unwrap();
        let stderr = String::from_utf8(ended.stderr).unwrap();
        assert!(ended.status.success(), "{}: {lines}\n{stderr}", self.name);
        String::from_utf8(ended.stdout).unwrap() + &stderr
    }

    /// A column of results as numbers.
    fn column(&self, results: &str, name: &str) -> Vec<f64> {
        let rows = self.run(&format!("flap results convert {results} -"));
        let mut lines = rows.lines();
        let index = lines.next().unwrap().split(',').position(|column| column == name).unwrap();
        let cells = lines.filter_map(|line| line.split(',').nth(index));
        cells.filter_map(|cell| cell.parse().ok()).collect()
    }
}

/// Lines that fetch or build something, which tests do not.
fn installs(line: &str) -> bool {
    ["cargo ", "python3 -m venv", "pip install", "./scripts/"].iter().any(|start| line.starts_with(start))
}

#[test]
fn the_readme_works() {
    let page = Page::open("README.md");
    page.runs(4);
    // Every command in the table of wishes too.
    let table = page.text.split("## I want to").nth(1).unwrap().split("\n## ").next().unwrap();
    // These need files of the user, or a browser.
    let bare = ["flap device wing", "flap test track", "flap test lift", "flap live"];
    let commands = table.split('`').filter(|code| code.starts_with("flap ") && !bare.contains(code));
    let commands: Vec<&str> = commands.collect();
    assert!(commands.len() >= 9, "{commands:?}");
    page.run(&commands.join("\n"));
}

#[test]
fn the_page_on_responses_works() {
    Page::open("docs/response.md").runs(4);
}

#[test]
fn the_page_on_the_terminal_works() {
    Page::open("docs/terminal.md").runs(16);
}

#[test]
fn the_page_on_experiments_works() {
    Page::open("docs/experiments.md").runs(9);
}

#[test]
fn the_page_on_resonances_works() {
    let page = Page::open("docs/resonance.md");
    page.runs(1);
    // The table of driven resonances: "| `preset` | 60 V | 196.12 Hz, second … |", to the tolerance of the search.
    let mut resonances = 0;
    for line in page.text.lines().filter(|line| line.contains(" V | ")) {
        let cells: Vec<&str> = line.split(" | ").collect();
        let preset = cells[0].trim_matches(['|', ' ', '`']);
        let printed = page.run(&format!(
            "flap test resonance {preset} --set 'drive_voltage_pp={}' --format csv | grep driven | cut -d , -f 2",
            cells[1]
        ));
        let computed: Vec<f64> = printed.lines().filter_map(|line| line.parse().ok()).collect();
        let numbers = cells[2].split(' ').filter_map(|word| word.parse::<f64>().ok());
        for (stated, computed) in numbers.zip(computed) {
            assert!(
                (stated - computed).abs() < 0.006,
                "{preset}: {stated} Hz stated, {computed} Hz computed"
            );
            resonances += 1;
        }
    }
    assert_eq!(resonances, 6);
}

#[test]
fn the_page_on_grids_works() {
    let page = Page::open("docs/grid.md");
    let grid = quick(1).replace("to = 60.0, step = 0.1", "to = 61, n = 21");
    fs::write(page.folder.path("grid.toml"), grid).unwrap();
    page.runs(3);
    assert_eq!(page.folder.read("fine.csv").lines().count(), 82);
}

/// The grids of the page begin with its device.
#[test]
fn the_page_on_devices_works() {
    let page = Page::open("docs/devices.md");
    page.runs(2);
    let grids = blocks(&page.text, "toml");
    fs::write(page.folder.path("mybee.toml"), &grids[0]).unwrap();
    for grid in &grids {
        fs::write(page.folder.path("grid.toml"), grid).unwrap();
        page.folder.ends(0, "check grid.toml");
    }
    assert_eq!(grids.len(), 3);
}

#[test]
#[cfg(feature = "plots")]
fn the_page_on_vehicles_works() {
    Page::open("docs/vehicle.md").runs(8);
}

/// The page says which parameters are written for each model.
#[test]
fn the_page_on_wings_works() {
    let page = Page::open("docs/wings.md");
    page.runs(3);
    for preset in ["ozaki2018-small", "arabagi2013-75hz"] {
        let device = page.folder.ends(0, &format!("device wing outline.csv --preset {preset}")).stdout;
        for line in device.lines().filter(|line| line.contains(" = ") && !line.starts_with("preset")) {
            let name = line.split(' ').next().unwrap();
            assert!(name.starts_with("chord_") || page.text.contains(&format!("`{name}`")), "{name}");
        }
    }
}

/// The commands of the page begin with a sweep that left points unsettled.
#[test]
fn the_page_on_results_works() {
    let page = Page::open("docs/results.md");
    let grid = "preset = \"ozaki2018-large\"\n[axes]\ndrive_voltage_pp = [70, 80]\n\
                drive_frequency = { from = 95, to = 122, n = 10 }\n[solver]\nmax_cycles = 20\nnewton = false\n";
    fs::write(page.folder.path("grid.toml"), grid).unwrap();
    fs::write(page.folder.path("sweep.toml"), grid).unwrap();
    page.folder.ends(0, "sweep sweep.toml").says(" unsettled");
    page.runs(12);
}

/// The pictures of the page are there, and small.
#[test]
#[cfg(feature = "plots")]
fn the_page_on_plots_works() {
    let page = Page::open("docs/plots.md");
    page.runs(20);
    let pictures: Vec<&str> =
        page.text.split("](pictures/cli-").skip(1).map(|rest| rest.split(')').next().unwrap()).collect();
    assert!(pictures.len() >= 6, "{pictures:?}");
    for picture in pictures {
        let size = fs::metadata(root().join("docs/pictures/cli-".to_owned() + picture)).unwrap().len();
        assert!(size < 60_000, "{picture} has {size} bytes");
    }
}

/// Every question has an answer that works, and the trends and numbers of the answers in words are those of the rows.
#[test]
#[cfg(feature = "plots")]
fn the_page_of_questions_works() {
    let page = Page::open("docs/questions.md");
    for question in page.text.split("\n## ").skip(1) {
        assert!(question.contains("```sh"), "{question}");
    }
    page.runs(29);

    // The wing that is longer and heavier: "the lift falls from 226 mgf at 14 mm through 159 mgf at 17 mm to 107 mgf".
    let wing = |name: &str| page.column("wing.csv", name);
    assert!(wing("vehicle_lift_mgf").is_sorted_by(|longer, shorter| longer > shorter));
    let stated = |name: &str, numbers: [(usize, f64, f64); 3]| {
        for (row, number, half_unit) in numbers {
            let value = wing(name)[row];
            assert!((value - number).abs() <= half_unit, "{name} in row {row}: {value}, not {number}");
        }
    };
    stated("vehicle_lift_mgf", [(0, 226.0, 0.5), (3, 159.0, 0.5), (6, 107.0, 0.5)]);
    stated("resonance_hz", [(0, 188.0, 0.5), (3, 128.0, 0.5), (6, 93.0, 0.5)]);
    stated("efficiency_gf_per_w", [(0, 13.4, 0.05), (3, 19.1, 0.05), (6, 23.4, 0.05)]);

    // The efficiency falls with the voltage at each frequency.
    let efficiency = page.column("efficiency.csv", "efficiency_gf_per_w");
    assert!(efficiency.chunks(3).all(|voltages| voltages.is_sorted_by(|lower, higher| lower > higher)));
}
