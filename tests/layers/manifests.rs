//! The manifests of the crates.

use std::fs;
use std::path::Path;

use crate::source::source_files;

/// True if cargo runs no tests in the sources of the library.
fn runs_no_unit_tests(manifest: &str) -> bool {
    let manifest: toml::Table = manifest.parse().expect("the manifest is TOML");
    manifest.get("lib").and_then(|lib| lib.get("test")).and_then(toml::Value::as_bool) == Some(false)
}

/// The lines with tests in the sources of crates whose manifest disables unit tests.
fn tests_that_never_run() -> Vec<String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for folder in fs::read_dir(crates).expect("the folder can be read") {
        let folder = folder.expect("the folder can be read");
        let manifest =
            fs::read_to_string(folder.path().join("Cargo.toml")).expect("each crate has a manifest");
        if !runs_no_unit_tests(&manifest) {
            continue;
        }
        let name = folder.file_name().to_string_lossy().into_owned();
        for file in source_files(&name) {
            for (line, text) in file.code() {
                if text.contains("#[cfg(test)]") || text.contains("#[test]") {
                    found.push(format!("{name}/src/{}:{line}", file.path));
                }
            }
        }
    }
    found
}

#[test]
fn no_crate_has_unit_tests_that_cargo_does_not_run() {
    assert!(runs_no_unit_tests("[lib]\ntest = false\n"));
    assert!(!runs_no_unit_tests("[lib]\nbench = false\n[[example]]\ntest = false\n"));
    let found = tests_that_never_run();
    assert!(
        found.is_empty(),
        "these tests never run, because [lib] of their crate has `test = false`: move them to `tests`:\n{}",
        found.join("\n")
    );
}
