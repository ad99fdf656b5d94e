//! Rows of sweeps without failures.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use flap_core::simulate::Status;
use flap_sweep::run::{Progress, RunError};

use crate::fake::{Fake, Fault};
use crate::support::{Watch, csv, flag, must_end, options, plan, plan_of, run};

#[test]
fn a_csv_file_reads_like_this() {
    let model = Fake::leak(Fault::None, 4);
    let grid = r#"
preset = "fake2020"
[axes]
arms = ["printed", "axis"]
size = [3e-6, 4, 7]
drive_frequency = ["120 Hz"]
"#;
    let (text, summary) = csv(&plan_of(model, grid), &options(2, 100));
    assert!(summary.is_ok());
    assert_eq!(
        text,
        "point,arms,size,drive_frequency,status,lift_mean_mn,power_mean_mw,cycles,residual,period,floquet_max,stable,error_estimate,rhs_evals\n\
         0,printed,3e-6,120.0,periodic,1e-6,0.00036,10,4e-9,1,0.5,true,2e-5,1000\n\
         1,printed,4.0,120.0,unsettled,,,10,4e-9,0,,,,1000\n\
         2,printed,7.0,120.0,invalid,,,10,,0,,,,1000\n\
         3,axis,3e-6,120.0,periodic,1e-6,0.00036,10,4e-9,1,0.5,true,2e-5,1000\n\
         4,axis,4.0,120.0,unsettled,,,10,4e-9,0,,,,1000\n\
         5,axis,7.0,120.0,invalid,,,10,,0,,,,1000\n"
    );
}

#[test]
fn selected_columns_come_in_the_order_asked_for() {
    let model = Fake::leak(Fault::None, 4);
    let grid = "preset = \"fake2020\"\n[output]\ncolumns = [\"stable\", \"power_mean_mw\", \"cycles\"]\n";
    let (text, _) = csv(&plan_of(model, grid), &options(1, 100));
    assert_eq!(text, "point,status,stable,power_mean_mw,cycles\n0,periodic,true,100.0,10\n");
}

#[test]
fn the_bytes_do_not_depend_on_threads_lanes_or_window() {
    let expected = csv(&plan(Fake::leak(Fault::None, 1), 5000), &options(1, 1)).0;
    assert_eq!(expected.lines().count(), 5001);
    for (threads, lanes, window) in
        [(1, 8, 16_384), (2, 8, 16_384), (4, 8, 100), (4, 8, 3), (2, 1, 2), (8, 3, 1)]
    {
        let found =
            must_end(move || csv(&plan(Fake::leak(Fault::None, lanes), 5000), &options(threads, window)));
        assert!(found.0 == expected, "{threads} threads, {lanes} lanes, window {window}");
    }
}

#[test]
fn no_more_points_are_in_hand_than_the_window_holds() {
    for (threads, lanes, window) in [(1, 8, 7), (3, 4, 7), (3, 4, 50), (2, 16, 1), (4, 8, 1000)] {
        let fault = Fault::Slow(11.0, Duration::from_millis(100));
        let model = Fake::leak(fault, lanes);
        must_end(move || {
            let mut sink = Watch::new(model);
            let plan = plan(model, 3000);
            run(&plan, &options(threads, window), &mut sink, flag(false), &mut |_| {}).unwrap();
            sink.assert_prefix();
            assert_eq!(sink.indices.len(), 3000);
        });
        let widest = model.widest.load(Ordering::SeqCst);
        assert!(widest <= window as u64, "{widest} points within a window of {window}");
    }
}

#[test]
fn others_go_on_while_one_point_is_slow() {
    let model = Fake::leak(Fault::Slow(0.0, Duration::from_millis(300)), 1);
    must_end(move || {
        let mut sink = Watch::new(model);
        run(&plan(model, 200), &options(2, 100), &mut sink, flag(false), &mut |_| {}).unwrap();
    });
    assert_eq!(model.widest.load(Ordering::SeqCst), 100);
}

#[test]
fn a_stopped_sweep_leaves_the_rows_of_the_first_points() {
    for (threads, window) in [(1, 16_384), (2, 64), (4, 10), (2, 1)] {
        must_end(move || {
            let model = Fake::leak(Fault::None, 8);
            let stop = flag(false);
            let mut sink = Watch { stop_at: Some((100, stop)), ..Watch::new(model) };
            let plan = plan(model, 1_000_000_000_000);
            let summary = run(&plan, &options(threads, window), &mut sink, stop, &mut |_| {}).unwrap();
            sink.assert_prefix();
            assert!(sink.finished);
            assert!(summary.is_interrupted());
            assert_eq!(summary.rows, sink.indices.len() as u64);
            assert_eq!(summary.rows, model.begun.load(Ordering::SeqCst), "every point begun is written");
            assert!(summary.rows > 100);
        });
    }
}

#[test]
fn a_stopped_sweep_drops_a_point_that_does_not_end() {
    for threads in [1, 3] {
        must_end(move || {
            let model = Fake::leak(Fault::Endless(300.0), 8);
            let stop = flag(false);
            let mut sink = Watch { stop_at: Some((100, stop)), ..Watch::new(model) };
            let plan = plan(model, 1_000_000_000_000);
            let summary = run(&plan, &options(threads, 1000), &mut sink, stop, &mut |_| {}).unwrap();
            sink.assert_prefix();
            assert!(summary.is_interrupted());
            assert!((100..=300).contains(&summary.rows), "{} rows", summary.rows);
        });
    }
}

#[test]
fn a_point_that_does_not_end_is_dropped_when_rows_cannot_be_written() {
    must_end(|| {
        let model = Fake::leak(Fault::Endless(300.0), 8);
        let mut sink = Watch { full_at: Some(100), ..Watch::new(model) };
        let ended = run(&plan(model, 1_000_000), &options(2, 1000), &mut sink, flag(false), &mut |_| {});
        assert!(matches!(ended, Err(RunError::Sink(_))), "{ended:?}");
    });
}

#[test]
fn a_sweep_stopped_beforehand_has_no_rows() {
    let model = Fake::leak(Fault::None, 8);
    let mut sink = Watch::new(model);
    let summary = run(&plan(model, 1000), &options(2, 10), &mut sink, flag(true), &mut |_| {}).unwrap();
    assert_eq!((summary.rows, summary.points, summary.is_interrupted()), (0, 1000, true));
    assert!(sink.finished);
}

#[test]
fn stopping_after_the_last_point_interrupts_nothing() {
    let model = Fake::leak(Fault::None, 8);
    let stop = flag(false);
    let mut sink = Watch { stop_at: Some((999, stop)), ..Watch::new(model) };
    let summary = run(&plan(model, 1000), &options(2, 10), &mut sink, stop, &mut |_| {}).unwrap();
    assert!(!summary.is_interrupted());
    assert_eq!(summary.rows, 1000);
}

#[test]
fn the_summary_counts_what_was_written() {
    let (_, summary) = csv(&plan(Fake::leak(Fault::None, 8), 1000), &options(3, 100));
    let summary = summary.unwrap();
    let counts: Vec<u64> = summary.statuses.iter().map(|(_, count)| count).collect();
    assert_eq!(counts, [500, 0, 100, 100, 100, 100, 100]);
    assert_eq!(summary.statuses.of(Status::Invalid), 100);
    assert_eq!((summary.points, summary.rows, summary.is_interrupted()), (1000, 1000, false));
    assert_eq!((summary.cycles, summary.rhs_evals), (10_000, 1_000_000));
    let points: Vec<u64> = summary.invalid.iter().map(|invalid| invalid.point).collect();
    assert_eq!(points, [7, 17, 27, 37, 47]);
    assert_eq!(summary.invalid[1].reason, "a size of 17 m is impossible");
}

#[test]
fn progress_rises_to_the_total() {
    let model = Fake::leak(Fault::None, 8);
    let mut seen: Vec<Progress> = Vec::new();
    let mut sink = Watch::new(model);
    let plan = plan(model, 1000);
    run(&plan, &options(2, 100), &mut sink, &AtomicBool::new(false), &mut |p| seen.push(p)).unwrap();
    assert!(seen.is_sorted_by_key(|progress| progress.finished));
    assert_eq!(seen.last(), Some(&Progress { finished: 1000, points: 1000 }));
}
