//! Refined grids: points are added in rounds, and a continued run has the same bytes as one run.

use std::fs;
use std::io;
use std::sync::atomic::AtomicBool;

use csv::StringRecord;
use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::files::session::Session;
use flap_sweep::plan::Plan;
use flap_sweep::refine::replay;
use flap_sweep::run::Summary;
use flap_sweep::run::identity::Identity;
use flap_sweep::table::layout::Layout;
use temp_dir::TempDir;

use crate::fake::{Fake, Fault};
use crate::journal::{often, run_to, start};
use crate::support::{csv, options, plan_of, run};

/// A peak and a jump, with one map for each reading. Points with a size of 3 to 7 have no measures, and some points are
/// excluded.
const GRID: &str = r#"
preset = "fake2020"

[axes]
size = { from = 1, to = 9, n = 9 }
arms = ["printed", "axis"]
drive_frequency = { from = 10, to = 1000, n = 7, scale = "log" }

[where]
not_high = "size + drive_frequency / 100 < 18"

[measure]
peak = "1 / (1 + (size - 8.3)^2 + (log10(drive_frequency) - 2)^2)"
jump = "max(0, sign(size * drive_frequency - 700))"

[refine]
measure = ["peak", "jump"]
error = ["2 %", 0.1]
max_points = 700
"#;

fn refined(more: &str) -> Plan {
    plan_of(Fake::leak(Fault::None, 8), &(GRID.to_owned() + more))
}

fn records(text: &str) -> impl Iterator<Item = io::Result<StringRecord>> {
    let records: Vec<StringRecord> =
        csv::Reader::from_reader(text.as_bytes()).records().map(Result::unwrap).collect();
    records.into_iter().map(Ok)
}

#[test]
fn the_points_of_a_refinement_do_not_depend_on_threads() {
    let plan = refined("");
    let (one, summary) = csv(&plan, &options(1, 100));
    let (three, _) = csv(&plan, &options(3, 20));
    assert!(one == three);
    let summary = summary.unwrap();
    let refined = summary.refined.unwrap();
    assert_eq!(plan.len(), 126);
    assert_eq!(summary.points, 126 + refined.added);
    assert_eq!((summary.done(), summary.is_interrupted()), (summary.points, false));
    assert!(refined.rounds > 2 && summary.points > 600 && summary.points <= 700, "{summary:?}");
    assert!(summary.excluded > 0 && summary.rows == summary.points - summary.excluded);
    let points: Vec<u64> = records(&one).map(|row| row.unwrap()[0].parse().unwrap()).collect();
    assert!(points.is_sorted_by(|a, b| a < b), "rows are in point order");
}

/// Added points lie between values of the axes, on the scale of each axis, in the ranges of the parameters.
#[test]
fn points_are_added_on_the_scale_of_their_axes() {
    let plan = refined("");
    let (text, summary) = csv(&plan, &options(2, 100));
    let (grown, _) = replay(&plan, summary.unwrap().points, records(&text)).unwrap().unwrap();
    assert!(grown.len() > plan.len());
    for index in plan.len()..grown.len() {
        let positions = &grown.added()[usize::try_from(index - plan.len()).unwrap()];
        let values = grown.point(index).values;
        assert!((values[0] - (1.0 + positions[0])).abs() < 1e-12, "{positions:?}: {values:?}");
        assert_eq!(values[2], positions[1]);
        let frequency = 10.0 * 100.0_f64.powf(positions[2] / 6.0);
        assert!((values[1] / frequency - 1.0).abs() < 1e-12, "{positions:?}: {values:?}");
        // Cells are halved six times at most.
        assert_eq!((positions[0] * 64.0).fract(), 0.0);
    }
    assert!(replay(&plan, 200, records("point\n0\n2\n")).is_err(), "rows of another grid");
}

/// Wherever a run ends, the continued run has the same bytes and the same summary as one run.
#[test]
fn a_refinement_goes_on_where_the_last_run_ended() {
    let plan = refined("");
    let (text, summary) = csv(&plan, &options(2, 100));
    let summary = summary.unwrap();
    for name in ["rows.csv", "rows.csv.zst"] {
        // The last point of the axes, and points of the first and of later rounds.
        for stops in [
            vec![1, 125, 126, 127],
            vec![126, 189, 190, 400],
            vec![300],
            vec![summary.points - 1, summary.points],
        ] {
            let folder = TempDir::new().unwrap();
            let path = folder.path().join(name);
            assert_eq!(run_to(&mut start(&path, &plan), &plan, Summary::default(), stops[0]), None);
            for &stop in &stops[1..] {
                let resumed = Session::resume(&path, &plan, &often()).unwrap();
                let mut session = resumed.session;
                run_to(&mut session, &plan, resumed.before, stop);
            }
            let resumed = Session::resume(&path, &plan, &often()).unwrap();
            let mut session = resumed.session;
            assert_eq!(
                run_to(&mut session, &plan, resumed.before, u64::MAX),
                Some(summary.clone()),
                "{stops:?}"
            );
            drop(session);
            let bytes = fs::read(&path).unwrap();
            let rows = if name == "rows.csv" { bytes } else { zstd::decode_all(&bytes[..]).unwrap() };
            assert!(String::from_utf8(rows).unwrap() == text, "{name}, {stops:?}");
        }
    }
}

/// A run that is stopped after the last row of a round is not complete.
#[test]
fn a_run_that_stops_between_two_rounds_is_unfinished() {
    let plan = refined("");
    let stop = AtomicBool::new(false);
    let mut sink = CsvSink::new(Layout::of(&plan).names(), Vec::new());
    let summary = run(&plan, &options(1, 100), &mut sink, &stop, &mut |progress| {
        stop.store(progress.finished == plan.len(), std::sync::atomic::Ordering::SeqCst);
    });
    let summary = summary.unwrap();
    assert_eq!(summary.done(), plan.len());
    assert!(summary.is_interrupted() && summary.refined.is_none(), "{summary:?}");
}

/// The shards of a refined grid contain only the points of its axes.
#[test]
fn shards_contain_no_points_of_a_refinement() {
    let plan = refined("").with_shard("2/3".parse().unwrap());
    let (text, summary) = csv(&plan, &options(2, 100));
    assert_eq!(summary.unwrap().done(), 42);
    assert!(records(&text).all(|row| row.unwrap()[0].parse::<u64>().unwrap() % 3 == 1));
}

/// Equal indices of added points do not mean equal points.
#[test]
fn listed_points_are_those_of_one_refinement() {
    let identity = |position: f64| {
        let plan = refined("").with_added(vec![vec![position, 0.0, 0.0]]).unwrap();
        let last = plan.len() - 1;
        Identity::of(&plan.with_points(vec![last]).unwrap(), &options(1, 1))
    };
    assert_eq!(identity(0.5), identity(0.5));
    assert_ne!(identity(0.5), identity(1.5));
    assert_eq!(identity(0.5).differences(&identity(1.5)).len(), 1);
}
