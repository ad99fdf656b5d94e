//! The layers of flap-core: each uses only those below it, and none touches the world outside.

mod source;
mod sources;

use source::source_files;

/// Each layer with the layers it may use besides itself. A layer is a folder or file in `src`.
const LAYERS: &[(&str, &[&str])] = &[
    ("num", &[]),
    ("ode", &["num"]),
    ("parameter", &[]),
    ("drive", &["num", "parameter"]),
    ("piezo", &["num", "parameter"]),
    ("linkage", &["num", "parameter"]),
    ("aero", &["num", "parameter"]),
    ("modes", &["num", "parameter"]),
    ("quadrature", &["num", "parameter"]),
    ("model", &["num", "ode", "parameter", "drive", "piezo", "linkage", "aero", "modes", "quadrature"]),
    ("measure", &["num", "ode", "parameter", "model"]),
    (
        "simulate",
        &[
            "num",
            "ode",
            "parameter",
            "drive",
            "piezo",
            "linkage",
            "aero",
            "modes",
            "quadrature",
            "model",
            "measure",
        ],
    ),
    ("resonance", &["num", "parameter", "modes", "measure", "simulate"]),
];

/// Macros that layers define; their names stand at the root of the crate.
const MACROS: &[(&str, &str)] = &[("per_lane", "num"), ("parameters", "parameter"), ("choice", "parameter")];

/// What prints, opens, spawns or reads the clock.
const FORBIDDEN: &[&str] = &[
    "print!",
    "println!",
    "dbg!",
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::process",
    "std::thread",
    "std::time",
];

#[test]
fn every_layer_is_known() {
    for file in source_files() {
        let known = file.layer == "lib" || LAYERS.iter().any(|(layer, _)| *layer == file.layer);
        assert!(known, "{}: layer \"{}\" is not in the table of this test", file.path, file.layer);
    }
    for (layer, _) in LAYERS {
        assert!(source_files().iter().any(|file| file.layer == *layer), "there is no layer \"{layer}\"");
    }
}

#[test]
fn layers_use_only_those_below() {
    let mut wrong = Vec::new();
    for file in source_files() {
        let Some((_, below)) = LAYERS.iter().find(|(layer, _)| *layer == file.layer) else { continue };
        for (line, name) in file.used_from_root() {
            let used =
                MACROS.iter().find(|(macro_name, _)| *macro_name == name).map_or(&*name, |(_, layer)| layer);
            if used != file.layer && !below.contains(&used) {
                wrong.push(format!("{}:{line}: {} uses crate::{name}", file.path, file.layer));
            }
        }
    }
    assert!(wrong.is_empty(), "layers that use what is not below them:\n{}", wrong.join("\n"));
}

#[test]
fn nothing_touches_the_world_outside() {
    let mut wrong = Vec::new();
    for file in source_files() {
        for (line, text) in file.code() {
            for forbidden in FORBIDDEN.iter().filter(|forbidden| text.contains(**forbidden)) {
                wrong.push(format!("{}:{line}: {forbidden}", file.path));
            }
        }
    }
    assert!(wrong.is_empty(), "flap-core prints, opens, spawns or reads the clock:\n{}", wrong.join("\n"));
}
