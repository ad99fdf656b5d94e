//! Sweeps with excluded points, derived parameters and measures that the user defines.

use std::sync::atomic::{AtomicBool, Ordering};

use flap_core::simulate::Status;
use flap_sweep::plan::Plan;
use flap_sweep::run::{InvalidPoint, Progress, Unsatisfied};

use crate::fake::{Fake, Fault};
use crate::support::{Watch, csv, flag, must_end, options, plan_with, run};

/// Excluded points, derived parameters and measures of the user, with twelve sizes.
pub(crate) const FORMULAS: &str = r#"
[derived]
drive_frequency = "100 - 10 * size"
span = "size - 1"
[where]
not_two = "size != 2"
not_tiny_or_huge = "size > 0 and size < 10"
[measure]
ratio = "power_mean_mw / lift_mean_mn"
strong = "lift_mean_mn >= 3 and drive_frequency > preset.drive_frequency / 100"
"#;

#[test]
fn rows_of_a_grid_with_formulas_read_like_this() {
    let (text, summary) = csv(&plan_with(Fake::leak(Fault::None, 4), 12, FORMULAS), &options(2, 100));
    assert_eq!(
        text,
        "point,size,drive_frequency,span,status,lift_mean_mn,power_mean_mw,ratio,strong,cycles,residual,period,floquet_max,stable,error_estimate,rhs_evals\n\
         1,1.0,90.0,0.0,invalid,,,,,0,,0,,,,0\n\
         3,3.0,70.0,2.0,subharmonic,,,,,10,4e-9,0,,,,1000\n\
         4,4.0,60.0,3.0,unsettled,,,,,10,4e-9,0,,,,1000\n\
         5,5.0,50.0,4.0,diverged,,,,,10,4e-9,0,,,,1000\n\
         6,6.0,40.0,5.0,step_limit,,,,,10,4e-9,0,,,,1000\n\
         7,7.0,30.0,6.0,invalid,,,,,10,,0,,,,1000\n\
         8,8.0,20.0,7.0,periodic,2.6666666666666665,160.0,60.0,false,10,4e-9,1,0.5,true,2e-5,1000\n\
         9,9.0,10.0,8.0,periodic,3.0,90.0,30.0,true,10,4e-9,1,0.5,true,2e-5,1000\n"
    );
    let summary = summary.unwrap();
    assert_eq!((summary.points, summary.rows, summary.excluded, summary.done()), (12, 8, 4, 12));
    assert!(!summary.is_interrupted());
    assert_eq!(summary.statuses.of(Status::Invalid), 2);
    let unsatisfied = [("not_two", 1), ("not_tiny_or_huge", 3)]
        .map(|(condition, points)| Unsatisfied { condition: condition.to_owned(), points });
    assert_eq!(summary.unsatisfied, unsatisfied);
    let reason = "`span` is computed as 0.0 m, but must be more than zero";
    assert_eq!(summary.invalid[0], InvalidPoint { point: 1, reason: reason.to_owned() });
    assert_eq!(summary.invalid[1].point, 7);
}

/// A grid that excludes most points, in long series of points.
const SPARSE: &str = r#"
[where]
few = "size / 100 == floor(size / 100) or size < 50"
"#;

/// The sparse grid.
fn sparse(model: &'static Fake) -> Plan {
    plan_with(model, 20_000, SPARSE)
}

#[test]
fn the_bytes_of_a_sparse_grid_do_not_depend_on_threads_lanes_or_window() {
    let (expected, summary) = csv(&sparse(Fake::leak(Fault::None, 1)), &options(1, 1));
    assert_eq!(expected.lines().count(), 1 + 200 + 49);
    assert_eq!(summary.unwrap().excluded, 20_000 - 249);
    for (threads, lanes, window) in [(1, 8, 16_384), (2, 8, 100), (4, 8, 3), (2, 1, 2), (8, 3, 1)] {
        let plan = move || sparse(Fake::leak(Fault::None, lanes));
        let found = must_end(move || csv(&plan(), &options(threads, window)));
        assert!(found.0 == expected, "{threads} threads, {lanes} lanes, window {window}");
    }
}

#[test]
fn progress_counts_excluded_points() {
    let mut seen: Vec<Progress> = Vec::new();
    let model = Fake::leak(Fault::None, 8);
    let mut sink = Watch::new(model);
    let plan = sparse(model);
    run(&plan, &options(2, 100), &mut sink, &AtomicBool::new(false), &mut |p| seen.push(p)).unwrap();
    assert!(seen.is_sorted_by_key(|progress| progress.finished));
    assert_eq!(seen.last(), Some(&Progress { finished: 20_000, points: 20_000 }));
}

#[test]
fn a_sparse_grid_can_be_stopped() {
    must_end(|| {
        let model = Fake::leak(Fault::None, 8);
        let stop = flag(false);
        let mut sink = Watch { stop_at: Some((500, stop)), ..Watch::new(model) };
        let summary = run(&sparse(model), &options(2, 64), &mut sink, stop, &mut |_| {}).unwrap();
        assert!(summary.is_interrupted() && summary.done() < 20_000);
        assert_eq!(summary.rows, sink.indices.len() as u64);
        assert_eq!(summary.rows, model.begun.load(Ordering::SeqCst), "every point begun is written");
        let expected: Vec<u64> = (0..20_000).filter(|point| point % 100 == 0 || *point < 50).collect();
        assert_eq!(sink.indices, expected[..sink.indices.len()]);
    });
}

#[test]
fn a_grid_without_a_point_that_satisfies_its_conditions_has_no_rows() {
    let grid = SPARSE.replace("or size < 50", "and size < 0");
    let (text, summary) = csv(&plan_with(Fake::leak(Fault::None, 8), 20_000, &grid), &options(2, 64));
    assert_eq!(text.lines().count(), 1);
    let summary = summary.unwrap();
    assert_eq!((summary.rows, summary.excluded, summary.is_interrupted()), (0, 20_000, false));
}
