//! Commands and grids in the documents work.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{Folder, quick};

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub(crate) fn document(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap()
}

/// The code blocks of a Markdown document in `language`.
pub(crate) fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Words, with those in quotation marks kept together.
fn words(arguments: &str) -> Vec<&str> {
    let parts = arguments.split('"').enumerate();
    parts
        .flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .collect()
}

#[test]
fn grids_in_the_documents_are_valid() {
    let mut grids = 0;
    for name in ["README.md", "docs/grid.md"] {
        for block in blocks(&document(name), "toml").iter().filter(|block| block.starts_with("preset")) {
            Folder::with_grid(block).ends(0, "check grid.toml");
            grids += 1;
        }
    }
    assert!(grids >= 2, "{grids} grids found");
}

#[test]
fn commands_in_the_documents_work() {
    for (name, least) in [("README.md", 4), ("docs/response.md", 4), ("docs/terminal.md", 9)] {
        let mut commands = 0;
        // Later commands read the results of earlier ones.
        let folder = Folder::new();
        fs::create_dir(folder.path("examples")).unwrap();
        fs::copy(root().join("examples/ozaki_large.toml"), folder.path("examples/ozaki_large.toml")).unwrap();
        for block in blocks(&document(name), "sh") {
            for line in block.lines() {
                let command = line.split('#').next().unwrap().trim();
                let command = command.replace("cargo run --release -- ", "flap ");
                let Some(arguments) = command.strip_prefix("flap ") else { continue };
                // A shell would write what is printed to the file.
                let arguments = arguments.split(" > ").next().unwrap();
                folder.ends_with(0, &words(arguments));
                commands += 1;
            }
        }
        assert!(commands >= least, "{commands} commands found in {name}");
    }
}

/// The example grids: name and path.
pub(crate) fn examples() -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(root().join("examples")).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let grids: Vec<(String, PathBuf)> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), path))
        .collect();
    assert!(grids.len() >= 11, "{} grids found", grids.len());
    grids
}

/// The number of points of the grid at `path`, in digits. Fails if the grid is not valid.
fn points(path: &Path) -> String {
    let ended = Folder::new().ends_with(0, &["check", path.to_str().unwrap()]);
    ended.stdout.split(' ').next().unwrap().to_owned()
}

/// Every example says how to run it and how many designs it has, and is listed with them in `docs/grid.md`.
#[test]
fn example_grids_are_valid_and_described() {
    let page = document("docs/grid.md");
    for (name, path) in examples() {
        let points = points(&path);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(&format!("#   flap sweep examples/{name}\n")), "{name}");
        let results = name.replace(".toml", ".csv");
        assert!(text.contains(&format!("path = \"{results}\"")), "{name}");
        assert!(text.contains(&format!("= {points} designs")), "{name} has {points} points");

        let row = page.lines().find(|line| line.starts_with('|') && line.contains(&format!("`{name}`")));
        let row = row.unwrap_or_else(|| panic!("{name} is not in docs/grid.md")).replace(',', "");
        assert!(row.split(['|', ' ']).any(|word| word == points), "{row}: {name} has {points} points");
    }
}

/// The first and the last design of every example settle.
#[test]
fn example_grids_run() {
    for (name, path) in examples() {
        let last = points(&path).parse::<u64>().unwrap() - 1;
        for point in [0, last] {
            let point = point.to_string();
            let ended = Folder::new().ends_with(0, &["run", path.to_str().unwrap(), "--point", &point]);
            assert!(ended.stdout.contains("status = periodic"), "{name}, {point}\n{}", ended.stdout);
        }
    }
}

/// The tasks of the example for Slurm, run one after the other, make shards that can be merged.
#[test]
#[cfg(unix)]
fn the_slurm_example_works() {
    let folder = Folder::with_grid(&quick(50));
    let flap = Path::new(env!("CARGO_BIN_EXE_flap")).parent().unwrap();
    let paths = format!("{}:{}", flap.display(), std::env::var("PATH").unwrap());
    for task in 1..=8 {
        let output = std::process::Command::new(root().join("examples/slurm_array.sh"))
            .arg("grid.toml")
            .env("PATH", &paths)
            .env("SLURM_ARRAY_TASK_ID", task.to_string())
            .env("SLURM_CPUS_PER_TASK", "1")
            .current_dir(folder.path(""))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let shards: Vec<String> = folder.names().into_iter().filter(|name| name.ends_with("of8.csv")).collect();
    folder.ends(0, &format!("merge grid.csv {}", shards.join(" ")));
    assert_eq!(folder.read("grid.csv").lines().count(), 51);
}

/// The commands of the page on grid files work.
#[test]
#[cfg(unix)]
fn commands_in_the_grid_page_work() {
    let grid = quick(1).replace("to = 60.0, step = 0.1", "to = 61, n = 21");
    let folder = Folder::with_grid(&grid);
    let flap = Path::new(env!("CARGO_BIN_EXE_flap")).parent().unwrap();
    let paths = format!("{}:{}", flap.display(), std::env::var("PATH").unwrap());
    for block in blocks(&document("docs/grid.md"), "sh") {
        let mut shell = std::process::Command::new("sh");
        let ended =
            shell.args(["-ec", &block]).env("PATH", &paths).current_dir(folder.path("")).output().unwrap();
        assert!(ended.status.success(), "{block}: {}", String::from_utf8_lossy(&ended.stderr));
    }
    assert_eq!(folder.read("fine.csv").lines().count(), 82);
}

/// Runs blocks of commands in a shell that finds `flap`.
#[cfg(unix)]
fn run_in_shell(folder: &Folder, blocks: &[String]) {
    let flap = Path::new(env!("CARGO_BIN_EXE_flap")).parent().unwrap();
    let paths = format!("{}:{}", flap.display(), std::env::var("PATH").unwrap());
    for block in blocks {
        let mut shell = std::process::Command::new("sh");
        let ended =
            shell.args(["-ec", block]).env("PATH", &paths).current_dir(folder.path("")).output().unwrap();
        assert!(ended.status.success(), "{block}: {}", String::from_utf8_lossy(&ended.stderr));
    }
}

/// The commands of the page on devices work, and its grids begin with its device.
#[test]
#[cfg(unix)]
fn the_page_on_devices_works() {
    let folder = Folder::new();
    let page = document("docs/devices.md");
    run_in_shell(&folder, &blocks(&page, "sh"));
    let grids = blocks(&page, "toml");
    fs::write(folder.path("mybee.toml"), &grids[0]).unwrap();
    for grid in &grids {
        fs::write(folder.path("grid.toml"), grid).unwrap();
        folder.ends(0, "check grid.toml");
    }
    assert_eq!(grids.len(), 3);
}

/// Runs the arguments of a line; what is printed goes to the file behind `>`, if there is one.
fn run_line(folder: &Folder, line: &str) {
    let (arguments, file) = line.split_once(" > ").map_or((line, None), |(one, other)| (one, Some(other)));
    let printed = folder.ends_with(0, &words(arguments)).stdout;
    if let Some(file) = file {
        fs::write(folder.path(file), printed).unwrap();
    }
}

/// The commands of the page on vehicles work with its grid.
#[test]
#[cfg(feature = "plots")]
fn the_page_on_vehicles_works() {
    let folder = Folder::new();
    let page = document("docs/vehicle.md");
    fs::write(folder.path("vehicle.toml"), &blocks(&page, "toml")[0]).unwrap();
    let mut commands = 0;
    for line in blocks(&page, "sh").iter().flat_map(|block| block.lines()) {
        run_line(&folder, line.strip_prefix("flap ").unwrap());
        commands += 1;
    }
    assert_eq!(commands, 8);
}

/// The commands of the page on wings work with its outline, for every model.
#[test]
#[cfg(unix)]
fn the_page_on_wings_works() {
    let folder = Folder::new();
    let page = document("docs/wings.md");
    fs::write(folder.path("outline.csv"), &blocks(&page, "csv")[0]).unwrap();
    run_in_shell(&folder, &blocks(&page, "sh"));
    for preset in ["ozaki2018-small", "arabagi2013-75hz"] {
        let device = folder.ends(0, &format!("wing outline.csv --preset {preset}")).stdout;
        // The page says which parameters are written.
        for line in device.lines().filter(|line| line.contains(" = ") && !line.starts_with("preset")) {
            let name = line.split(' ').next().unwrap();
            assert!(name.starts_with("chord_") || page.contains(&format!("`{name}`")), "{name}");
        }
    }
}

/// The commands of the results page work one after the other, from a sweep that left points unsettled.
#[test]
fn commands_in_the_results_page_work() {
    let folder = Folder::with_grid(
        "preset = \"ozaki2018-large\"\n[axes]\ndrive_voltage_pp = [70, 80]\n\
         drive_frequency = { from = 95, to = 122, n = 10 }\n[solver]\nmax_cycles = 20\nnewton = false\n",
    );
    folder.ends(0, "sweep grid.toml --out sweep.csv").says(" unsettled");
    let mut commands = 0;
    for block in blocks(&document("docs/results.md"), "sh") {
        for line in block.lines() {
            let command = line.split('#').next().unwrap().trim();
            folder.ends_with(0, &words(command.strip_prefix("flap ").unwrap()));
            commands += 1;
        }
    }
    assert!(commands >= 6, "{commands} commands found");
}

/// The commands of the page on pictures work one after the other, and its pictures are there, and small.
#[test]
#[cfg(feature = "plots")]
fn commands_in_the_page_on_plots_work() {
    let folder = Folder::new();
    fs::create_dir(folder.path("examples")).unwrap();
    for grid in ["examples/ozaki_large.toml", "examples/jafferis_tolerance.toml", "examples/vehicle.toml"] {
        fs::copy(root().join(grid), folder.path(grid)).unwrap();
    }
    let page = document("docs/plots.md");
    let mut commands = 0;
    for block in blocks(&page, "sh") {
        for line in block.lines() {
            let Some(arguments) = line.split('#').next().unwrap().trim().strip_prefix("flap ") else {
                continue;
            };
            run_line(&folder, arguments);
            commands += 1;
        }
    }
    assert!(commands >= 12, "{commands} commands found");
    let pictures: Vec<&str> =
        page.split("](pictures/cli-").skip(1).map(|rest| rest.split(')').next().unwrap()).collect();
    assert!(pictures.len() >= 6, "{pictures:?}");
    for picture in pictures {
        let size = fs::metadata(root().join("docs/pictures/cli-".to_owned() + picture)).unwrap().len();
        assert!(size < 60_000, "{picture} has {size} bytes");
    }
}

/// Every key of the sidecar and every status is described.
#[test]
fn the_results_page_is_complete() {
    let page = document("docs/results.md");
    let folder = Folder::with_grid("preset = \"ozaki2018-large\"\n");
    assert_eq!(folder.flap("sweep grid.toml --out o.csv").code, 0);
    for line in folder.read("o.csv.meta.toml").lines().take_while(|line| !line.starts_with("[solver]")) {
        if let Some(key) = line.split(" = ").next().filter(|_| line.contains(" = ")) {
            assert!(page.contains(&format!("`{key}`")), "{key} is not described");
        }
    }
    for status in flap_core::simulate::Status::ALL {
        assert!(page.contains(&format!("| `{}` |", status.name())), "{} is not described", status.name());
    }
}

/// Every command in the table of wishes works, in the folder of the sweep above it.
#[test]
fn commands_in_the_table_of_the_readme_work() {
    let text = document("README.md");
    let folder = Folder::new();
    fs::create_dir(folder.path("examples")).unwrap();
    for name in ["ozaki_large.toml", "vehicle.toml"] {
        fs::copy(root().join("examples").join(name), folder.path("examples").join(name)).unwrap();
    }
    let table = text.split("## I want to").nth(1).unwrap().split("\n## ").next().unwrap();
    let commands = table.split('`').filter_map(|code| code.strip_prefix("flap "));
    let commands: Vec<&str> = commands.filter(|command| command.contains(' ')).collect();
    assert!(commands.len() >= 9, "{commands:?}");
    for command in commands {
        folder.ends_with(0, &words(command));
    }
}

/// The files that a document gives by name, such as "`grid.toml`:" above a block.
fn named_files(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let named = lines.iter().enumerate().filter_map(|(i, line)| {
        let name = line.strip_prefix('`')?.strip_suffix("`:")?;
        let body = lines[i + 1..].iter().skip_while(|line| !line.starts_with("```")).skip(1);
        let body: Vec<&str> = body.take_while(|line| !line.starts_with("```")).copied().collect();
        Some((name.to_owned(), body.join("\n") + "\n"))
    });
    named.collect()
}

/// Every question is answered by commands that work, and by the table that is shown where one is.
#[test]
fn commands_in_the_questions_page_work() {
    let text = document("docs/questions.md");
    let folder = Folder::new();
    for (name, body) in named_files(&text) {
        fs::write(folder.path(&name), body).unwrap();
    }
    let mut answers = 0;
    for question in text.split("\n## ").skip(1) {
        let mut printed = String::new();
        for line in blocks(question, "sh").iter().flat_map(|block| block.lines()) {
            let words = words(line.strip_prefix("flap ").unwrap());
            printed = folder.ends_with(0, &words).stdout;
        }
        for shown in blocks(question, "text") {
            assert_eq!(printed, shown);
        }
        assert!(question.contains("```sh"), "{question}");
        answers += 1;
    }
    assert!(answers >= 10, "{answers} questions found");
}
