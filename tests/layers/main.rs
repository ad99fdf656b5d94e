//! The structure of the crates: their modules, the use of the outside world by flap-core, the thresholds of flap-core,
//! and the hash of the sources.

mod import_graph;
mod manifests;
mod modules;
mod names;
mod source;
mod sources;
mod thresholds;

use source::source_files;

/// Names of the standard library that print, open, spawn or read the clock.
const FORBIDDEN: &[&str] = &[
    "print!",
    "println!",
    "dbg!",
    "std::{",
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::process",
    "std::thread",
    "std::time",
];

#[test]
fn flap_core_touches_nothing_outside() {
    let mut wrong = Vec::new();
    for file in source_files("flap-core") {
        for (line, text) in file.code() {
            for forbidden in FORBIDDEN.iter().filter(|forbidden| text.contains(**forbidden)) {
                wrong.push(format!("{}:{line}: {forbidden}", file.path));
            }
        }
    }
    assert!(wrong.is_empty(), "flap-core prints, opens, spawns or reads the clock:\n{}", wrong.join("\n"));
}
