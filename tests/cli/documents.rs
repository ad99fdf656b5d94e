//! The documents are complete, and the example grids work.

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

/// Every example contains its command and its number of designs, and `docs/reference/grid.md` lists both.
#[test]
fn example_grids_are_valid_and_described() {
    let page = document("docs/reference/grid.md");
    for (name, path) in examples() {
        let points = points(&path);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(&format!("#   flap sweep examples/{name}\n")), "{name}");
        let results = name.replace(".toml", ".csv");
        assert!(text.contains(&format!("path = \"{results}\"")), "{name}");
        assert!(text.contains(&format!("= {points} designs")), "{name} has {points} points");

        let row = page.lines().find(|line| line.starts_with('|') && line.contains(&format!("`{name}`")));
        let row = row.unwrap_or_else(|| panic!("{name} is not in docs/reference/grid.md")).replace(',', "");
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

/// The tasks of the example for Slurm compute shards that can be merged. The test runs the tasks one after the other.
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
    folder.ends(0, &format!("results merge grid.csv {}", shards.join(" ")));
    assert_eq!(folder.read("grid.csv").lines().count(), 51);
}

/// The page on results describes every key of the sidecar and every status.
#[test]
fn the_results_page_is_complete() {
    let page = document("docs/reference/results.md");
    let folder = Folder::with_grid("preset = \"ozaki2018-large\"\n");
    assert_eq!(folder.flap("sweep grid.toml --out o.csv").code, 0);
    let sidecar = folder.read("o.csv.meta.toml");
    let (origin, rest) = sidecar.split_once("[identity.solver]").unwrap();
    let (_, summary) = rest.split_once("[summary]").unwrap();
    let summary = summary.split("[parameters]").next().unwrap();
    for line in origin.lines().chain(summary.lines()) {
        if let Some(key) = line.split(" = ").next().filter(|_| line.contains(" = ")) {
            assert!(page.contains(&format!("`{key}`")), "{key} is not described");
        }
    }
    for status in flap_core::simulate::Status::ALL {
        assert!(page.contains(&format!("| `{}` |", status.name())), "{} is not described", status.name());
    }
}
