//! Files that cannot be read, and one that can.

use std::fs;
use std::path::Path;

use flap_core::simulate;
use flap_sweep::spec::{self, ReadError};
use flap_sweep::units;

fn error(path: &Path) -> ReadError {
    spec::read(path).err().expect("no plan")
}

#[test]
fn a_missing_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("grid.toml");
    let error = error(&path);
    assert!(matches!(error, ReadError::Missing { .. }), "{error:?}");
    assert_eq!(error.to_string(), format!("{}: there is no such file", path.display()));
}

#[test]
fn a_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = error(folder.path());
    assert!(matches!(error, ReadError::Folder { .. }), "{error:?}");
}

#[test]
fn text_that_is_not_utf8() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("latin1.toml");
    fs::write(&path, b"preset = \"fly\"\n# \xc3\xa9t\xe9\n").expect("written");
    match error(&path) {
        ReadError::NotUtf8 { byte: 20, line: 2, column: 5, .. } => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn mistakes_are_named_after_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("grid.toml");
    fs::write(&path, "\nprest = 1\n").expect("written");
    let message = error(&path).to_string();
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines[0], format!("{}:1:1: `preset` is missing", path.display()));
    assert_eq!(lines[1], format!("{}:2:1: unknown key `prest` at the top of a grid file", path.display()));
}

#[test]
fn presets_of_all_models_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    for preset in simulate::all().iter().flat_map(|model| model.presets()) {
        let path = folder.path().join(preset.name);
        fs::write(&path, format!("preset = \"{}\"", preset.name)).expect("written");
        let plan = spec::read(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((plan.preset, plan.len()), (preset.name, 1));
    }
}

/// One of the SI unit is 1: otherwise bare numbers and numbers with units would disagree.
#[test]
fn units_of_all_parameters_are_si() {
    for model in simulate::all() {
        for parameter in model.parameters().iter().filter(|parameter| !parameter.unit.is_empty()) {
            let one = units::parse_as(&format!("1 {}", parameter.unit), parameter.unit);
            assert_eq!(one, Ok(1.0), "{} of {}", parameter.name, model.name());
        }
    }
}
