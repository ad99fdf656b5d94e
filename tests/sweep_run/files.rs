//! Result files and their sidecars.

use std::fs;

use flap_core::num::Backend;
use flap_sweep::files::beside::sidecar_of;
use flap_sweep::files::disk::empty;
use flap_sweep::files::output::{CreateError, create};
use flap_sweep::files::sidecar::Sidecar;
use flap_sweep::run::Summary;
use temp_dir::TempDir;

use crate::fake::{Fake, Fault};
use crate::support::{csv, options, plan_of};

#[test]
fn an_existing_file_is_kept_unless_asked() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("rows.csv");
    fs::write(&path, "precious").unwrap();
    let error = create(&path, false).unwrap_err();
    assert!(matches!(error, CreateError::Exists { .. }), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "precious");
    let (file, _lock) = create(&path, true).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "precious", "kept until it is emptied");
    empty(&file).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "");
}

#[test]
fn an_empty_file_holds_no_results() {
    let directory = TempDir::new().unwrap();
    let path = directory.child("empty.csv");
    fs::write(&path, "").unwrap();
    assert!(create(&path, false).is_ok());
}

#[test]
fn a_file_being_written_is_not_overwritten() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("rows.csv");
    let _first = create(&path, false).unwrap();
    for overwrite in [false, true] {
        let error = create(&path, overwrite).unwrap_err();
        assert!(matches!(error, CreateError::Busy { .. }), "{error}");
    }
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let directory = TempDir::new().unwrap();
    for path in [directory.path().join("missing/rows.csv"), directory.path().to_owned()] {
        let error = create(&path, true).unwrap_err();
        assert!(matches!(error, CreateError::Io { .. }), "{error}");
        assert!(error.to_string().contains(&path.display().to_string()), "{error}");
    }
}

#[test]
#[cfg(unix)]
fn devices_hold_no_results() {
    let null = std::path::Path::new("/dev/null");
    let _first = create(null, false).unwrap();
    assert!(create(null, true).is_ok(), "nor are they locked");
}

#[test]
fn the_sidecar_tells_where_rows_come_from() {
    let grid =
        "preset = \"fake2020\"\n[params]\narms = \"axis\"\n[axes]\nsize = { from = 0, to = 9, step = 1 }\n";
    let plan = plan_of(Fake::leak(Fault::None, 4), grid);
    let started = "2026-01-02T03:04:05Z".to_owned();
    let mut sidecar = Sidecar::new(&plan, started, &options(2, 10), None);
    let directory = TempDir::new().unwrap();
    let path = sidecar_of(&directory.path().join("rows.csv"));
    assert!(path.ends_with("rows.csv.meta.toml"));

    let read = || fs::read_to_string(&path).unwrap().parse::<toml::Table>().unwrap();
    sidecar.write(&path).unwrap();
    let running = read();
    assert_eq!(running["state"].as_str(), Some("running"));
    assert_eq!(running["model"].as_str(), Some("fake"));
    assert_eq!(running["preset"].as_str(), Some("fake2020"));
    assert_eq!(running["points"].as_integer(), Some(10));
    assert_eq!(running["threads"].as_integer(), Some(2));
    let best = Backend::best();
    assert_eq!(running["identity"]["arithmetic"].as_str(), Some(best.arithmetic().name()));
    assert_eq!(running["instructions"].as_str(), Some(best.name()));
    assert_eq!(running["parameters"]["arms"].as_str(), Some("axis"));
    assert_eq!(running["parameters"]["drive_frequency"].as_float(), Some(100.0));
    assert!(running["parameters"].get("span").is_none(), "a follower that is not set");
    assert_eq!(
        running["identity"]["solver"]["max_cycles"].as_integer(),
        Some(i64::from(plan.solver().max_cycles))
    );
    assert_eq!(running["varied"][0]["name"].as_str(), Some("size"));
    assert_eq!(running["columns"][1]["unit"].as_str(), Some("mW"));
    assert_eq!(running["grid"]["text"].as_str(), Some(grid));
    assert_eq!(running["identity"]["grid"].as_str().map(str::len), Some(16));

    let summary = csv(&plan, &options(2, 10)).1.unwrap();
    sidecar.finish(&summary, "2026-01-02T03:04:07Z".to_owned(), 2.0);
    sidecar.write(&path).unwrap();
    let complete = read();
    assert_eq!(complete["state"].as_str(), Some("complete"));
    assert_eq!(complete["summary"]["rows"].as_integer(), Some(10));
    assert_eq!(complete["summary"]["statuses"]["periodic"].as_integer(), Some(5));
    assert_eq!(complete["summary"]["invalid"][0]["point"].as_integer(), Some(7));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "no temporary file is left");
}

#[test]
fn the_sidecar_of_a_stopped_sweep_says_so() {
    let plan = plan_of(Fake::leak(Fault::None, 4), "preset = \"fake2020\"\n");
    let mut sidecar = Sidecar::new(&plan, String::new(), &options(1, 10), None);
    let summary = Summary { points: 1, ..Summary::default() };
    sidecar.finish(&summary, String::new(), 0.0);
    assert!(sidecar.text().unwrap().contains("state = \"interrupted\""));
}
