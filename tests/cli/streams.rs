//! Standard streams, closed pipes and signals.

use std::io::{BufRead, BufReader, Read};

use crate::support::{Folder, frequencies, send, start, wait, wait_for_rows};

#[test]
fn stdout_carries_rows_and_nothing_else() {
    let folder = Folder::with_grid(&frequencies(3));
    let ended = folder.flap("sweep --grid grid.toml --out -");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert_eq!(ended.stdout.lines().count(), 4);
    assert!(ended.stdout.starts_with("point,drive_frequency,status,"));
    assert!(ended.stderr.ends_with("3 rows in stdout\n"), "{}", ended.stderr);
    assert_eq!(folder.names(), ["grid.toml"]);
}

#[test]
fn a_reader_who_has_seen_enough_is_no_error() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    for arguments in
        [&["sweep", "--grid", "grid.toml", "--out", "-"][..], &["params", "ozaki2018-large"], &["models"]]
    {
        let mut child = start(&folder, arguments);
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        assert!(!line.is_empty());
        assert_eq!(wait(&mut child), Some(0), "{arguments:?}");
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        // So many frequencies end far above the preset's.
        let mut told = stderr.lines().filter(|line| !line.starts_with("warning: drive_frequency"));
        assert_eq!(told.next(), None, "{arguments:?}");
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_sweep_keeps_the_rows_of_the_first_points() {
    for signal in ["INT", "TERM"] {
        let folder = Folder::with_grid(&frequencies(100_000_000));
        let mut child = start(&folder, &["sweep", "--grid", "grid.toml"]);
        wait_for_rows(&folder, 100);
        send(signal, &child);
        assert_eq!(wait(&mut child), Some(130));

        let text = folder.read("grid.csv");
        assert!(text.ends_with('\n'));
        let rows = text.lines().count() - 1;
        assert!(rows >= 100, "{rows}");
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        let last = format!(
            "interrupted: the rows of the first {rows} of 100000000 points are in grid.csv\n\
             `flap resume grid.csv` goes on\n"
        );
        assert!(stderr.ends_with(&last), "{stderr}");
        let sidecar: toml::Table = folder.read("grid.csv.meta.toml").parse().unwrap();
        assert_eq!(sidecar["state"].as_str(), Some("interrupted"));
        assert_eq!(sidecar["rows"].as_integer(), i64::try_from(rows).ok());

        // Another sweep of the same points begins with the same bytes.
        let mut again = start(&folder, &["sweep", "--grid", "grid.toml", "--out", "-"]);
        let first = BufReader::new(again.stdout.take().unwrap()).lines().take(100);
        assert!(first.map(Result::unwrap).eq(text.lines().take(100)));
        wait(&mut again);
    }
}

#[test]
#[cfg(unix)]
fn a_second_signal_ends_at_once() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    let mut child = start(&folder, &["sweep", "--grid", "grid.toml"]);
    wait_for_rows(&folder, 1);
    send("INT", &child);
    send("INT", &child);
    assert_eq!(wait(&mut child), Some(130));
}
