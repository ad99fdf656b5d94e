//! The top-level modules of each crate: folders and files in `src`. A module imports only the modules before it, and no
//! files import each other in a cycle.

use crate::import_graph::ImportGraph;
use crate::source::{SourceFile, source_files};

/// Each crate with its top-level modules, the lowest module first. Such a module is a folder or a file in `src`.
const CRATES: &[(&str, &[&str])] = &[
    (
        "flap-core",
        &[
            "num",
            "ode",
            "parameter",
            "quadrature",
            "drive",
            "piezo",
            "linkage",
            "springs",
            "body",
            "aero",
            "modes",
            "model",
            "measure",
            "simulate",
            "vehicle",
            "lib",
        ],
    ),
    ("flap-experiments", &["damped_sine", "spectrum", "tracking", "free", "lib"]),
    (
        "flap-sweep",
        &[
            "system",
            "notation",
            "input",
            "derivative",
            "resonance",
            "vehicle",
            "plan",
            "table",
            "refine",
            "picture",
            "grid",
            "run",
            "study",
            "files",
            "lib",
        ],
    ),
    ("flap-live", &["page", "request", "rows", "opened", "description", "answer", "guard", "server", "lib"]),
    (
        "flap-cli",
        &[
            "args", "models", "statuses", "complete", "console", "table", "duration", "progress", "failure",
            "print", "system", "job", "data", "cmd", "plot", "lib", "main",
        ],
    ),
];

/// The first part of a path below `src`.
fn module_of(path: &str) -> &str {
    path.split('/').next().unwrap_or(path).trim_end_matches(".rs")
}

fn upward_imports(graph: &ImportGraph, modules: &[&str]) -> Vec<String> {
    let level = |path: &str| modules.iter().position(|known| *known == module_of(path));
    let upward = graph.imports().into_iter().filter(|(importer, imported)| level(importer) < level(imported));
    upward.map(|(importer, imported)| format!("{importer} imports {imported}")).collect()
}

#[test]
fn every_module_is_known() {
    for (name, modules) in CRATES {
        let files = source_files(name);
        for SourceFile { path, .. } in &files {
            assert!(
                modules.contains(&module_of(path)),
                "{name}: {path} is in no module of this test's table"
            );
        }
        for known in *modules {
            assert!(
                files.iter().any(|file| module_of(&file.path) == *known),
                "{name} has no module \"{known}\""
            );
        }
    }
}

#[test]
fn modules_import_only_those_below() {
    for (name, modules) in CRATES {
        let upward = upward_imports(&ImportGraph::new(&source_files(name)), modules);
        assert!(upward.is_empty(), "{name}: a module imports one above it:\n{}", upward.join("\n"));
    }
}

#[test]
fn no_files_import_each_other_in_a_cycle() {
    for name in CRATES.iter().map(|(name, _)| *name).chain(["flap-py"]) {
        let files = source_files(name);
        let graph = ImportGraph::new(&files);
        let cycles = graph.cycles();
        assert!(cycles.is_empty(), "{name}: files that import each other in a cycle: {cycles:#?}");
    }
}

fn file(path: &str, text: &str) -> SourceFile {
    SourceFile { path: path.to_owned(), text: text.to_owned() }
}

/// Two modules with two files each, and the imports of the files.
fn small_graph(low: &str, high: &str) -> ImportGraph {
    ImportGraph::new(&[
        file("lib.rs", "pub mod high;\npub mod low;\n"),
        file("low/mod.rs", "mod inner;\npub use inner::Inner;\n"),
        file("low/inner.rs", &format!("{low}\npub struct Inner;\n")),
        file("high/mod.rs", "mod upper;\npub use upper::Upper;\n"),
        file("high/upper.rs", &format!("{high}\npub struct Upper;\n")),
    ])
}

#[test]
fn an_upward_import_is_seen() {
    let modules = ["low", "high"];
    let downward = small_graph("", "use crate::low::Inner;");
    assert_eq!(downward.imports().into_iter().collect::<Vec<_>>(), [("high/upper.rs", "low/inner.rs")]);
    assert!(upward_imports(&downward, &modules).is_empty());
    for upward in [
        "use crate::high::Upper;",
        "use super::super::high::Upper;",
        "use crate::{high::{self as other}};\nfn f(_: other::Upper) {}",
        "fn f(_: crate::high::Upper) {}",
        "fn f() { g!(0, crate::high::Upper) }",
        "mod more { fn f(_: crate::high::Upper) {} }",
    ] {
        let seen = upward_imports(&small_graph(upward, ""), &modules);
        assert!(
            seen.iter().any(|import| import == "low/inner.rs imports high/upper.rs"),
            "{upward}: {seen:?}"
        );
    }
    for no_import in ["// crate::high::Upper", "#[cfg(test)]\nmod tests { use crate::high::Upper; }"] {
        assert!(small_graph(no_import, "").imports().is_empty(), "{no_import}");
    }
}

#[test]
fn a_cycle_is_seen() {
    assert!(small_graph("", "use crate::low::Inner;").cycles().is_empty());
    let both = small_graph("use crate::high::Upper;", "use crate::low::Inner;");
    assert_eq!(both.cycles(), [["high/upper.rs", "low/inner.rs"]]);
    let parent_and_child = ImportGraph::new(&[
        file("lib.rs", "mod a;\n"),
        file("a.rs", "mod b;\npub struct A(b::B);\n"),
        file("a/b.rs", "use super::A;\npub struct B;\nfn f(_: A) {}\n"),
    ]);
    assert_eq!(parent_and_child.cycles(), [["a.rs", "a/b.rs"]]);
    let siblings = ImportGraph::new(&[
        file("lib.rs", "mod a;\nmod b;\nmod c;\n"),
        file("a.rs", "use crate::b::B;\npub struct A(B);\n"),
        file("b.rs", "use crate::c;\npub struct B(c::C);\n"),
        file("c.rs", "pub struct C(Box<super::a::A>);\n"),
    ]);
    assert_eq!(siblings.cycles(), [["a.rs", "b.rs", "c.rs"]]);
}
