//! The rooms of each crate: folders and files in `src`. A room uses only the rooms before it, and no files use each
//! other in a cycle.

use crate::house::House;
use crate::source::{SourceFile, source_files};

/// Each crate with its rooms, the lowest room first. A room is a folder or a file in `src`.
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
            "experiments",
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
    (
        "flap-live",
        &["page", "request", "latest", "rows", "opened", "description", "answer", "guard", "server", "lib"],
    ),
    (
        "flap-cli",
        &[
            "args", "models", "statuses", "complete", "console", "table", "duration", "progress", "failure",
            "print", "system", "job", "data", "cmd", "plot", "lib", "main",
        ],
    ),
];

/// The first part of a path below `src`.
fn room(path: &str) -> &str {
    path.split('/').next().unwrap_or(path).trim_end_matches(".rs")
}

fn upward_arrows(house: &House, rooms: &[&str]) -> Vec<String> {
    let floor = |path: &str| rooms.iter().position(|known| *known == room(path));
    let upward = house.arrows().into_iter().filter(|(user, used)| floor(user) < floor(used));
    upward.map(|(user, used)| format!("{user} uses {used}")).collect()
}

#[test]
fn every_room_is_known() {
    for (name, rooms) in CRATES {
        let files = source_files(name);
        for SourceFile { path, .. } in &files {
            assert!(rooms.contains(&room(path)), "{name}: {path} is in no room of this test's table");
        }
        for known in *rooms {
            assert!(files.iter().any(|file| room(&file.path) == *known), "{name} has no room \"{known}\"");
        }
    }
}

#[test]
fn rooms_use_only_those_below() {
    for (name, rooms) in CRATES {
        let upward = upward_arrows(&House::new(&source_files(name)), rooms);
        assert!(upward.is_empty(), "{name}: a room uses one above it:\n{}", upward.join("\n"));
    }
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    for name in CRATES.iter().map(|(name, _)| *name).chain(["flap-py"]) {
        let files = source_files(name);
        let house = House::new(&files);
        let circles = house.circles();
        assert!(circles.is_empty(), "{name}: files that use each other in a circle: {circles:#?}");
    }
}

fn file(path: &str, text: &str) -> SourceFile {
    SourceFile { path: path.to_owned(), text: text.to_owned() }
}

/// Two rooms with two files each, and the uses of the files.
fn small_house(low: &str, high: &str) -> House {
    House::new(&[
        file("lib.rs", "pub mod high;\npub mod low;\n"),
        file("low/mod.rs", "mod inner;\npub use inner::Inner;\n"),
        file("low/inner.rs", &format!("{low}\npub struct Inner;\n")),
        file("high/mod.rs", "mod upper;\npub use upper::Upper;\n"),
        file("high/upper.rs", &format!("{high}\npub struct Upper;\n")),
    ])
}

#[test]
fn an_upward_arrow_is_seen() {
    let rooms = ["low", "high"];
    let downward = small_house("", "use crate::low::Inner;");
    assert_eq!(downward.arrows().into_iter().collect::<Vec<_>>(), [("high/upper.rs", "low/inner.rs")]);
    assert!(upward_arrows(&downward, &rooms).is_empty());
    for upward in [
        "use crate::high::Upper;",
        "use super::super::high::Upper;",
        "use crate::{high::{self as other}};\nfn f(_: other::Upper) {}",
        "fn f(_: crate::high::Upper) {}",
        "fn f() { g!(0, crate::high::Upper) }",
        "mod more { fn f(_: crate::high::Upper) {} }",
    ] {
        let seen = upward_arrows(&small_house(upward, ""), &rooms);
        assert!(seen.iter().any(|arrow| arrow == "low/inner.rs uses high/upper.rs"), "{upward}: {seen:?}");
    }
    for no_arrow in ["// crate::high::Upper", "#[cfg(test)]\nmod tests { use crate::high::Upper; }"] {
        assert!(small_house(no_arrow, "").arrows().is_empty(), "{no_arrow}");
    }
}

#[test]
fn a_circle_is_seen() {
    assert!(small_house("", "use crate::low::Inner;").circles().is_empty());
    let both = small_house("use crate::high::Upper;", "use crate::low::Inner;");
    assert_eq!(both.circles(), [["high/upper.rs", "low/inner.rs"]]);
    let parent_and_child = House::new(&[
        file("lib.rs", "mod a;\n"),
        file("a.rs", "mod b;\npub struct A(b::B);\n"),
        file("a/b.rs", "use super::A;\npub struct B;\nfn f(_: A) {}\n"),
    ]);
    assert_eq!(parent_and_child.circles(), [["a.rs", "a/b.rs"]]);
    let siblings = House::new(&[
        file("lib.rs", "mod a;\nmod b;\nmod c;\n"),
        file("a.rs", "use crate::b::B;\npub struct A(B);\n"),
        file("b.rs", "use crate::c;\npub struct B(c::C);\n"),
        file("c.rs", "pub struct C(Box<super::a::A>);\n"),
    ]);
    assert_eq!(siblings.circles(), [["a.rs", "b.rs", "c.rs"]]);
}
