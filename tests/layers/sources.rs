//! The hash of the sources that the build scripts compute.

use std::fs;
use std::path::Path;

use temp_dir::TempDir;

/// A folder with these files, and its hash.
fn hash_of(files: &[(&str, &str)]) -> u64 {
    let folder = TempDir::new().expect("a folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("it is in the folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
    flap_sources::hash(folder.path(), &["libm 0.2.16".to_owned()]).expect("the folder can be read")
}

#[test]
fn a_change_of_the_sources_is_another_build() {
    let sources = [("lib.rs", "mod a;\nmod b;\n"), ("a/mod.rs", "const PI: f64 = 3.14;\n"), ("b.rs", "")];
    let hash = hash_of(&sources);
    assert_eq!(hash, hash_of(&sources), "wherever they lie");
    let with = |place: usize, file| {
        let mut changed = sources;
        changed[place] = file;
        hash_of(&changed)
    };
    assert_eq!(hash, with(0, ("lib.rs", "mod a;\r\nmod b;\r\n")), "however lines end");
    assert_ne!(hash, with(1, ("a/mod.rs", "const PI: f64 = 3.15;\n")));
    assert_ne!(hash, with(1, ("a.rs", "const PI: f64 = 3.14;\n")));
    assert_ne!(hash, with(2, ("b.rs", "\n")));
    assert_ne!(hash, hash_of(&sources[..2]));
    assert_eq!(hash, hash_of(&[sources[2], sources[1], sources[0], ("notes.md", "notes")]), "only sources");
}

#[test]
fn versions_of_packages_that_compute_are_of_the_build() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let lock = fs::read_to_string(crates.join("../Cargo.lock")).expect("the lock file");
    let versions = flap_sources::versions(&lock);
    assert_eq!(versions.len(), 8, "every package of the list is locked: {versions:?}");
    let source = crates.join("flap-core/src");
    let hash = |versions: &[String]| flap_sources::hash(&source, versions).expect("the sources can be read");
    assert_eq!(format!("{:016x}", hash(&versions)), flap_core::SOURCES);
    assert_ne!(hash(&versions), hash(&versions[1..]));
}
