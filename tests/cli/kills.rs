//! Commands that are killed before each system call that changes files.

use std::fs;

use flap_sweep::files::integrity::{self, Integrity};
use nix::errno::Errno;

use crate::support::{Folder, quick};
use crate::trace::{Call, Fate, Traced, trace};

type Files = Vec<(String, Vec<u8>)>;

/// Every file of a folder except temporary files. A kill may leave one temporary file.
fn files(folder: &Folder) -> Files {
    let names: Vec<String> = folder.names();
    assert!(names.iter().filter(|name| name.starts_with('.')).count() <= 2, "{names:?}");
    let kept = names.into_iter().filter(|name| !name.starts_with('.'));
    kept.map(|name| (name.clone(), fs::read(folder.path(&name)).unwrap())).collect()
}

fn names(folder: &Folder) -> Vec<String> {
    files(folder).into_iter().map(|(name, _)| name).collect()
}

fn copy(files: &Files) -> Folder {
    let folder = Folder::new();
    for (name, bytes) in files {
        fs::write(folder.path(name), bytes).unwrap();
    }
    folder
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

fn is_sound(folder: &Folder, out: &str) -> bool {
    matches!(integrity::verify(&folder.path(out)), Ok(Integrity::Sound { .. }))
}

/// Kills `command` before each of its calls in turn, each time in a new folder with the files `begin`. `check` examines
/// the remaining files; its second argument describes the call. Returns the number of kills.
fn kill_everywhere(begin: &Files, command: &str, check: impl Fn(&Folder, &str)) -> usize {
    for at in 0.. {
        let folder = copy(begin);
        let traced =
            trace(&folder, command, |number, _| if number == at { Fate::Killed } else { Fate::Goes });
        if traced.code.is_some() {
            assert_eq!(traced.code, Some(0), "{command}: {}", traced.stderr);
            return at;
        }
        check(&folder, &format!("{command}, killed at {at}: {:?}", traced.calls.last().unwrap()));
    }
    unreachable!("a command has an end")
}

/// The rows of `out` stay the same, or become the rows of `command`, and flap never reports damage. Wherever `command`
/// is killed, one further command makes the rows complete.
fn replaces(folder: &Folder, out: &str, command: &str) {
    let begin = files(folder);
    let sidecar = format!("{out}.meta.toml");
    let done = copy(&begin);
    let ended = trace(&done, command, |_, _| Fate::Goes);
    assert_eq!(ended.code, Some(0), "{command}: {}", ended.stderr);
    let (old, new) = (bytes(folder, out), bytes(&done, out));
    assert!(old != new);
    let whole = names(&done);
    assert!(whole.contains(&sidecar), "{whole:?}");

    let resumes = command.starts_with("sweep")
        || command.starts_with("respond")
        || command.starts_with("results rerun");
    let kills = kill_everywhere(&begin, command, |left, place| {
        let rows = bytes(left, out);
        assert!(rows == old || rows == new, "{place}: {:?}", left.names());
        let verdict = left.flap(&format!("results verify {out}"));
        match verdict.code {
            0 => verdict.prints(": sound: "),
            1 => verdict.prints("there is no sidecar"),
            _ => panic!("{place}: {}", verdict.stdout),
        };

        let again = copy(&files(left));
        let ended = again.flap(command);
        assert_eq!(ended.code, 0, "{place}: {}", ended.stderr);
        assert!(bytes(&again, out) == new, "{place}");
        assert_eq!(names(&again), whole, "{place}");
        assert!(is_sound(&again, out), "{place}");

        if resumes {
            let ended = left.flap(&format!("results resume {out}"));
            assert_eq!(ended.code, 0, "{place}: {}", ended.stderr);
            let rows = bytes(left, out);
            assert!(rows == old || rows == new, "{place}");
            assert!(is_sound(left, out), "{place}");
            if rows == new {
                assert_eq!(names(left), whole, "{place}");
            }
        }
    });
    assert!(kills > 15, "{command}: {kills}");
}

/// Results with three points in `out`, and a grid with two points.
fn replaced(out: &str) -> Folder {
    let folder = Folder::with_grid(&quick(3));
    folder.ends(0, &format!("sweep grid.toml --out {out}"));
    fs::write(folder.path("grid.toml"), quick(2)).unwrap();
    folder
}

#[test]
fn a_forced_sweep_into_csv() {
    replaces(&replaced("rows.csv"), "rows.csv", "sweep grid.toml --out rows.csv --restart --threads 1");
}

#[test]
fn a_forced_sweep_into_compressed_csv() {
    let command = "sweep grid.toml --out rows.csv.zst --restart --threads 1";
    replaces(&replaced("rows.csv.zst"), "rows.csv.zst", command);
}

#[test]
fn a_forced_sweep_into_parquet() {
    let command = "sweep grid.toml --out rows.parquet --restart --threads 1";
    replaces(&replaced("rows.parquet"), "rows.parquet", command);
}

#[test]
fn a_forced_rerun() {
    let folder = replaced("rows.csv");
    folder.ends(0, "sweep grid.toml --out earlier.csv");
    let command = "results rerun earlier.csv --status unsettled --max-cycles 2 --out rows.csv -f --threads 1";
    replaces(&folder, "rows.csv", command);
}

#[test]
fn a_forced_response() {
    let folder = replaced("rows.csv");
    replaces(&folder, "rows.csv", "respond grid.toml --out rows.csv -f --threads 1");
}

#[test]
fn a_forced_conversion() {
    let folder = replaced("rows.csv");
    folder.ends(0, "sweep grid.toml --out earlier.parquet");
    replaces(&folder, "rows.csv", "results convert earlier.parquet rows.csv --force");
}

#[test]
fn a_forced_merge() {
    let folder = replaced("rows.parquet");
    folder.ends(0, "sweep grid.toml --shard 1/2");
    folder.ends(0, "sweep grid.toml --shard 2/2");
    replaces(&folder, "rows.parquet", "results merge rows.parquet grid.1of2.csv grid.2of2.csv --force");
}

/// A command can also replace unfinished results.
#[test]
fn a_forced_sweep_over_unfinished_rows() {
    let folder = Folder::with_grid(&quick(3));
    let into = "sweep grid.toml --out rows.csv --threads 1";
    let is_written = |call: &Call| call.name == "sync" && call.files == ["rows.csv"];
    trace(&folder, into, |_, call| if is_written(call) { Fate::Killed } else { Fate::Goes });
    assert_eq!(
        folder.names(),
        ["grid.toml", "rows.csv", "rows.csv.journal", "rows.csv.lock", "rows.csv.meta.toml"]
    );
    fs::write(folder.path("grid.toml"), quick(2)).unwrap();
    let begin = files(&folder);
    kill_everywhere(&begin, &format!("{into} --force"), |left, place| {
        for (end, code) in [(format!("{into} --force"), 0), ("results resume rows.csv".to_owned(), 0)] {
            let left = copy(&files(left));
            let ended = left.flap(&end);
            assert_eq!(ended.code, code, "{place}, {end}: {}", ended.stderr);
            assert!(is_sound(&left, "rows.csv"), "{place}, {end}");
        }
    });
}

/// If a sweep is killed, the same command completes the sweep.
#[test]
fn a_new_sweep() {
    for ending in ["csv", "parquet"] {
        let out = format!("rows.{ending}");
        let command = format!("sweep grid.toml --out {out} --threads 1");
        let folder = Folder::with_grid(&quick(3));
        let begin = files(&folder);
        folder.ends(0, &command);
        let (whole, rows) = (names(&folder), bytes(&folder, &out));
        let kills = kill_everywhere(&begin, &command, |left, place| {
            for end in ["", " --restart"] {
                let left = copy(&files(left));
                let ended = left.flap(&format!("{command}{end}"));
                assert_eq!(ended.code, 0, "{place}{end}: {}", ended.stderr);
                assert_eq!(names(&left), whole, "{place}{end}");
                assert!(bytes(&left, &out) == rows, "{place}{end}");
                assert!(is_sound(&left, &out), "{place}{end}");
            }
        });
        assert!(kills > 20, "{kills}");
    }
}

/// The position of the first call with this name and these files.
fn place(calls: &[Call], name: &str, files: &[&str]) -> usize {
    let found = calls.iter().position(|call| call.name == name && call.files == files);
    found.unwrap_or_else(|| panic!("{name} {files:?} is not in {calls:#?}"))
}

/// After a crash of the machine, only synced files remain, so each step waits until the step before is synced.
#[test]
fn names_are_durable_before_what_leads_to_them_is_removed() {
    let folder = Folder::with_grid(&quick(3));
    let Traced { calls, .. } =
        trace(&folder, "sweep grid.toml --out rows.csv --threads 1", |_, _| Fate::Goes);
    let renamed = calls.iter().rposition(|call| call.files == ["?", "rows.csv.meta.toml"]).unwrap();
    assert_eq!((calls[renamed + 1].name, &calls[renamed + 1].files[..]), ("sync", &[".".to_owned()][..]));
    assert!(place(&calls, "remove", &["rows.csv.journal"]) > renamed + 1);
    let header = place(&calls, "write", &["rows.csv.journal"]);
    let rows = place(&calls, "write", &["rows.csv"]);
    let folder_synced = calls[header..rows].iter().any(|call| call.name == "sync" && call.files == ["."]);
    assert!(folder_synced, "{calls:#?}");

    let command = "sweep grid.toml --out rows.csv --threads 1 --restart";
    let Traced { calls, .. } = trace(&folder, command, |_, _| Fate::Goes);
    let complete = place(&calls, "remove", &["rows.csv.meta.toml"]);
    let renamed = place(&calls, "rename", &["rows.new.csv", "rows.csv"]);
    let sidecar = place(&calls, "rename", &["?", "rows.csv.meta.toml"]);
    let journal = place(&calls, "remove", &["rows.new.csv.journal"]);
    assert!(complete < renamed && renamed < sidecar && sidecar < journal, "{calls:#?}");
    for at in [renamed, sidecar] {
        assert_eq!((calls[at + 1].name, &calls[at + 1].files[..]), ("sync", &[".".to_owned()][..]));
    }

    let Traced { calls, .. } = trace(&folder, "results convert rows.csv other.csv", |_, _| Fate::Goes);
    let rows = place(&calls, "rename", &["?", "other.csv"]);
    let sidecar = place(&calls, "rename", &["?", "other.csv.meta.toml"]);
    assert!(rows < sidecar);
    assert_eq!((calls[rows + 1].name, &calls[rows + 1].files[..]), ("sync", &[".".to_owned()][..]));
}

/// On a file system without locks, flap works, and prints one warning that it cannot protect the results.
#[test]
fn a_missing_lock_is_mentioned_once() {
    let folder = Folder::with_grid(&quick(3));
    let without = |command: &str| {
        trace(&folder, command, |_, call| match call.name {
            "lock" => Fate::Fails(Errno::ENOLCK),
            _ => Fate::Goes,
        })
    };
    let commands = [
        ("sweep grid.toml --out rows.csv", "rows.csv"),
        ("sweep grid.toml --out rows.csv --restart", "rows.csv"),
        ("results convert rows.csv rows.parquet", "rows.parquet"),
    ];
    for (command, out) in commands {
        let Traced { code, stderr, .. } = without(command);
        assert_eq!(code, Some(0), "{stderr}");
        let warning = format!(
            "warning: {out} cannot be locked (No locks available (os error 37)): \
             make sure that no other run writes to this file\n"
        );
        assert_eq!(stderr.matches("warning: ").count(), 1, "{stderr}");
        assert!(stderr.starts_with(&warning), "{stderr}");
    }
}

/// flap reads complete results without permission to write, for example on a read-only file system.
#[test]
fn complete_results_are_only_read() {
    let folder = Folder::with_grid(&quick(3));
    for out in ["rows.csv", "rows.parquet"] {
        folder.ends(0, &format!("sweep grid.toml --out {out}"));
        let before = files(&folder);
        for command in [format!("results resume {out}"), format!("sweep grid.toml --out {out}")] {
            let Traced { code, stderr, calls } = trace(&folder, &command, |_, _| Fate::Fails(Errno::EROFS));
            assert_eq!((code, calls), (Some(0), Vec::new()), "{stderr}");
            assert_eq!(
                stderr,
                format!("{out} is complete: nothing is left to run; use --restart to run its points again\n")
            );
        }
        assert!(files(&folder) == before);
    }
}
