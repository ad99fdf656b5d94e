//! Files that cannot be read, and a file that can be read.

use std::fs;
use std::path::Path;

use flap_core::simulate;
use flap_sweep::grid::{self, ReadError};
use flap_sweep::input::{self, InputError};
use flap_sweep::notation::units;
use temp_dir::TempDir;

fn error(path: &Path) -> ReadError {
    grid::read(path, simulate::all()).err().expect("no plan")
}

#[test]
fn a_missing_file() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("grid.toml");
    let error = error(&path);
    assert!(matches!(error, ReadError::Input { error: InputError::Missing, .. }), "{error:?}");
    assert_eq!(error.to_string(), format!("{}: there is no such file", path.display()));
}

#[test]
fn a_folder() {
    let folder = TempDir::new().expect("a folder");
    let error = error(folder.path());
    assert!(matches!(error, ReadError::Input { error: InputError::Folder, .. }), "{error:?}");
}

#[test]
fn text_that_is_not_utf8() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("latin1.toml");
    fs::write(&path, b"preset = \"fly\"\n# \xc3\xa9t\xe9\n").expect("written");
    match error(&path) {
        ReadError::Input { error: InputError::NotUtf8 { byte: 20, line: 2, column: 5 }, .. } => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn mistakes_are_named_after_the_file() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("grid.toml");
    fs::write(&path, "\nprest = 1\n").expect("written");
    let message = error(&path).to_string();
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines[0], format!("{}:2:1: unknown key `prest` at the top of a grid file", path.display()));
    assert!(!message.contains("missing"), "one slip is one mistake: {message}");
}

#[test]
fn presets_of_all_models_are_found() {
    let folder = TempDir::new().expect("a folder");
    for preset in simulate::all().iter().flat_map(|model| model.presets()) {
        let path = folder.path().join(preset.name);
        fs::write(&path, format!("preset = \"{}\"", preset.name)).expect("written");
        let plan = grid::read(&path, simulate::all()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((plan.preset(), plan.len()), (preset.name, 1));
    }
}

/// One SI unit of a parameter is the number 1, so that numbers with and without units agree.
#[test]
fn units_of_all_parameters_are_si() {
    for model in simulate::all() {
        for parameter in model.parameters().iter().filter(|parameter| !parameter.unit.is_empty()) {
            let one = units::parse_as(&format!("1 {}", parameter.unit), parameter.unit);
            assert_eq!(one, Ok(1.0), "{} of {}", parameter.name, model.name());
        }
    }
}

/// A parser that tried every line of results as a grid file would take minutes and gigabytes.
#[test]
fn results_are_not_grid_files() {
    let folder = TempDir::new().expect("a folder");
    let contents: [(&str, &[u8]); 3] = [
        ("rows.csv", b"point,drive_frequency,status\n0,60.0,periodic\n"),
        ("rows.csv.zst", &[0x28, 0xb5, 0x2f, 0xfd, 0, 0]),
        ("rows.parquet", b"PAR1"),
    ];
    for (name, bytes) in contents {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("written");
        let error = error(&path);
        assert!(matches!(error, ReadError::Results { .. }), "{error:?}");
        assert_eq!(error.help(), Some(format!("did you mean `flap plot {}`?", path.display())));
    }
}

#[test]
fn grid_files_have_a_largest_size() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("grid.toml");
    fs::File::create(&path).and_then(|file| file.set_len(input::MOST_BYTES + 1)).expect("made");
    let error = error(&path);
    assert!(matches!(error, ReadError::Input { error: InputError::TooLarge(_), .. }), "{error:?}");
    assert!(error.to_string().ends_with("the file is too large: at most 16 MiB are allowed"), "{error}");
}

/// Parsing time grows in proportion to the number of lines: twenty times as many lines take twenty times as long.
#[test]
fn mistakes_without_number_are_counted_in_linear_time() {
    let count = 300_000_u32;
    let keys = (0..count).map(|number| format!("key_{number} = 1\n")).collect::<Vec<_>>().concat();
    let rows =
        (0..count).map(|number| format!("{number},{number}.5,periodic\n")).collect::<Vec<_>>().concat();
    let texts = [format!("preset = \"ozaki2018-large\"\n[params]\n{keys}"), rows];
    for text in texts {
        let started = std::time::Instant::now();
        let mistakes = grid::parse("grid.toml", &text, simulate::all()).err().expect("mistakes");
        assert_eq!(mistakes.len(), 20);
        assert_eq!(mistakes.count(), count as usize);
        let shown = flap_sweep::grid::diagnostic::render(&mistakes, false);
        let end = "\n\nand 299980 more\n\ngrid.toml: 300000 mistakes, nothing was run";
        assert!(shown.ends_with(end) && shown.len() < 20_000, "{} bytes", shown.len());
        assert!(started.elapsed().as_secs() < 30, "{:?}", started.elapsed());
    }
}

#[test]
fn names_of_any_length_are_shortened() {
    let name = "a".repeat(1_000_000);
    let text = format!("preset = \"ozaki2018-large\"\n[params]\n{name} = 1\n");
    let mistakes = grid::parse("grid.toml", &text, simulate::all()).err().expect("a mistake");
    assert!(mistakes[0].message.contains("…(1000002 characters)…"), "{}", mistakes[0].message);
    assert!(flap_sweep::grid::diagnostic::render(&mistakes, false).len() < 1000);
}
