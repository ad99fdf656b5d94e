//! Hostile input: every target runs on its corpus, and on thousands of changed inputs. The folder `fuzz` has the same
//! targets for a fuzzer, which searches for new paths automatically.

mod mutate;
mod targets;

use std::fs;
use std::path::{Path, PathBuf};

use mutate::Mutator;

/// Number of changed inputs per target.
const CHANGES: usize = 8000;

/// The inputs of a target's corpus; the corpus of grid files also contains the examples.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let listed = |folder: PathBuf| {
        let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
        paths.sort();
        paths
    };
    let mut paths = listed(root.join("fuzz/corpus").join(name));
    if name == "grid" {
        let examples = listed(root.join("examples"));
        paths.extend(examples.into_iter().filter(|path| path.extension().is_some_and(|is| is == "toml")));
    }
    paths.iter().map(|path| fs::read(path).expect("a readable file")).collect()
}

/// Runs the target `name` on its corpus and on changed inputs.
fn run(name: &str, target: fn(&[u8])) {
    let corpus = corpus(name);
    assert!(!corpus.is_empty(), "{name}");
    for input in &corpus {
        target(input);
    }
    let mut mutator = Mutator::new(&corpus);
    for _ in 0..CHANGES {
        target(&mutator.next());
    }
}

/// Declares a test for each target. The name of a target is also the name of its corpus.
macro_rules! test_targets {
    ($($name:ident),*) => { $(
        #[test]
        fn $name() {
            super::run(stringify!($name), super::targets::$name);
        }
    )* };
}

mod no_input_is_too_odd {
    test_targets!(grid, units, expression, outline, record, journal, sidecar);
}

/// Every input of the corpus must be valid. Changes of invalid inputs would test little.
#[test]
fn seeds_are_good() {
    for input in corpus("grid") {
        let text = String::from_utf8(input).expect("text");
        let parsed = flap_sweep::grid::parse("grid.toml", &text, flap_core::simulate::all());
        assert!(parsed.is_ok(), "{text}: {:?}", parsed.err());
    }
    for input in corpus("sidecar") {
        let parsed = flap_sweep::files::sidecar::Sidecar::parse(
            Path::new("rows.csv.meta.toml"),
            &targets::with_checksum(&input),
        );
        assert!(parsed.is_ok(), "{:?}", parsed.err());
    }
    for input in corpus("journal") {
        let lines = input.split_inclusive(|&byte| byte == b'\n').count();
        let whole: Vec<u8> = input
            .split(|&byte| byte == b'\n')
            .filter(|line| !line.is_empty())
            .flat_map(|line| {
                [format!("{:016x} ", xxhash_rust::xxh3::xxh3_64(line)).as_bytes(), line, b"\n"].concat()
            })
            .collect();
        let journal = flap_sweep::files::journal::parse(&whole).expect("a first line");
        assert_eq!(journal.checkpoints.len() + 1, lines);
    }
}
