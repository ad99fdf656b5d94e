//! Runs points of a sweep for about a second, and measures the work of these points and the size of their
//! rows.

use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, Row, Status};
use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::plan::{Admission, Plan};
use flap_sweep::run::{self, Sink};
use flap_sweep::study::survey::spread;
use flap_sweep::table::layout::Layout;

/// `flap check` runs a sample of at most this number of points.
const MOST: usize = 256;

/// Time after which flap adds no further point to the sample, measured from the start of the sample.
const LONGEST_BEGIN: Duration = Duration::from_secs(1);

/// Time limit of the sample, measured from its start. When the time is over, flap abandons the points of the
/// sample that are not finished.
const LONGEST: Duration = Duration::from_secs(2);

/// Largest number of points that flap checks to find points that are not excluded.
const MOST_CHECKED: u64 = 100_000;

/// Smallest relative uncertainty that flap reports for an estimate, because the speed of a machine varies by
/// this fraction.
const SMALLEST_ERROR: f64 = 0.1;

/// A sample of points that are spread over the points of a sweep, and the measured work of each point.
///
/// Until the last point of the sample is finished, flap runs more points, so that all lanes are full as in a
/// sweep. Without these additional points, the slowest points of the sample would run alone, and the measured
/// time per point would be too long.
pub(super) struct Trial<'a> {
    plan: &'a Plan,
    started: Instant,
    /// The time that the computation of the whole sample took.
    took: Duration,
    checked: u64,
    /// True if flap adds no more points to the sample.
    closed: bool,
    /// The unfinished points of the sample. The set contains the number of each point in the order in which
    /// flap checks the points.
    running: BTreeSet<u64>,
    /// The work of each finished point of the sample: the number of evaluations of the equations of motion,
    /// including evaluations for derivatives.
    works: Vec<f64>,
    /// Number of started points, number of finished points, and the work of the finished points. These
    /// numbers include points that are not in the sample.
    begun: u64,
    done: u64,
    work: f64,
    /// Number of finished points that are valid.
    valid: u64,
    layout: Layout<'a>,
    /// The rows of the sample as CSV, and the number of rows.
    rows: CsvSink<Vec<u8>>,
    written: u64,
    /// Index of the first invalid point, and the reason why this point is invalid.
    first_reason: Option<(u64, String)>,
}

impl Trial<'_> {
    /// Runs the sample on all threads.
    pub(super) fn run(plan: &Plan, threads: usize) -> Trial<'_> {
        let trial = Mutex::new(Trial {
            plan,
            started: Instant::now(),
            took: Duration::ZERO,
            checked: 0,
            closed: false,
            running: BTreeSet::new(),
            works: Vec::new(),
            begun: 0,
            done: 0,
            work: 0.0,
            valid: 0,
            layout: Layout::of(plan),
            rows: CsvSink::new(Vec::new(), Vec::new()),
            written: 0,
            first_reason: None,
        });
        thread::scope(|scope| {
            for _ in 0..threads {
                let work = || plan.rows().run(Backend::best(), plan.solver(), &mut Worker(&trial));
                // If no further thread starts, the other threads do the work.
                let _ = thread::Builder::new().spawn_scoped(scope, work);
            }
        });
        let mut trial = trial.into_inner().unwrap_or_else(PoisonError::into_inner);
        if trial.took.is_zero() {
            trial.took = trial.started.elapsed();
        }
        trial
    }

    /// Returns the number of points of the sample that were computed or are invalid.
    pub(super) fn tried(&self) -> usize {
        self.works.len()
    }

    /// If all points of the sample are invalid, returns the index of the first point and the reason why the
    /// point is invalid.
    pub(super) fn invalid(&self) -> Option<&(u64, String)> {
        self.first_reason.as_ref().filter(|_| self.valid == 0 && self.is_complete())
    }

    /// Returns an estimate of the mean work per point in a sweep of `points` points, and the relative
    /// uncertainty of this estimate. The result is `None` if no point was run.
    fn mean_work(&self, points: u64) -> Option<(f64, f64)> {
        let number = self.works.len() as f64;
        let mean = self.works.iter().sum::<f64>() / number;
        if mean.is_nan() || mean <= 0.0 {
            return None;
        }
        let squares: f64 = self.works.iter().map(|work| (work - mean).powi(2)).sum();
        // If the sample contains all points of the plan, the mean is exact.
        let left_out = (1.0 - number / points as f64).max(0.0);
        let deviation = (left_out * squares / (number * (number - 1.0).max(1.0))).sqrt();
        Some((mean, (2.0 * deviation / mean).max(SMALLEST_ERROR)))
    }

    /// Returns the bounds of the likely time of a sweep of `points` points (s). The result is `None` if no
    /// point was run.
    pub(super) fn seconds(&self, points: u64) -> Option<[f64; 2]> {
        let (mean, error) = self.mean_work(points)?;
        // Points that are still running count as half done.
        let work = self.work + 0.5 * mean * (self.begun - self.done) as f64;
        let seconds = points as f64 * mean * self.took.as_secs_f64() / work;
        Some([seconds / (1.0 + error), seconds * (1.0 + error)])
    }

    /// Returns the mean size of a row as CSV (bytes). The result is `None` if no row was written.
    pub(super) fn bytes_of_row(&self) -> Option<f64> {
        (self.written > 0).then(|| self.rows.target().len() as f64 / self.written as f64)
    }

    /// Returns true if flap adds no more points to the sample, and all points of the sample are finished.
    pub(super) fn is_complete(&self) -> bool {
        self.closed && self.running.is_empty()
    }

    fn is_over(&self) -> bool {
        self.is_complete() || self.started.elapsed() >= LONGEST
    }

    /// Returns the index in the grid of the point that flap checks after `number` earlier points.
    fn index(&self, number: u64) -> u64 {
        let points = self.plan.len();
        if points <= MOST as u64 { number % points } else { spread(number, points) }
    }

    fn next(&mut self) -> Option<Point> {
        while !self.is_over() && self.checked < MOST_CHECKED {
            let number = self.checked;
            let point = self.plan.point(self.index(number));
            self.checked += 1;
            let in_sample = !self.closed;
            match self.plan.judge(&point.values) {
                Admission::Runs => {
                    self.begun += 1;
                    if in_sample {
                        self.running.insert(number);
                    }
                    self.close();
                    // A point may run twice. Each run has its own number.
                    return Some(Point { index: number, ..point });
                }
                Admission::Invalid(invalid) if in_sample => {
                    self.works.push(0.0);
                    self.note_invalid(number, invalid.to_string());
                }
                Admission::Invalid(_) | Admission::Excluded(_) => {}
            }
            self.close();
        }
        self.closed = true;
        None
    }

    /// Stops adding points to the sample if the sample is large enough, if all points of the sweep were
    /// checked, or after the time limit.
    fn close(&mut self) {
        self.closed |= self.works.len() + self.running.len() >= MOST
            || self.checked >= self.plan.len()
            || self.started.elapsed() >= LONGEST_BEGIN;
    }

    /// Records the row of the finished point `point`, which flap checked after `number` earlier points.
    fn done(&mut self, number: u64, point: &Point, row: Row) {
        let work = row.rhs_evals as f64;
        self.done += 1;
        self.work += work;
        let in_sample = self.running.remove(&number);
        if in_sample {
            self.works.push(work);
            if self.is_complete() {
                self.took = self.started.elapsed();
            }
        }
        if row.status == Status::Invalid {
            self.note_invalid(number, row.reason.unwrap_or_default());
            return;
        }
        self.valid += 1;
        if in_sample {
            // A vector of bytes takes all rows.
            let _ = self.rows.write(&self.layout.cells(point, &row)).and_then(|()| self.rows.flush());
            self.written += 1;
        }
    }

    /// Records that the point with the number `number` is invalid, if it is the first invalid point.
    fn note_invalid(&mut self, number: u64, reason: String) {
        let index = self.index(number);
        self.first_reason.get_or_insert((index, reason));
    }
}

/// A thread that runs points of the sample.
struct Worker<'t, 'a>(&'t Mutex<Trial<'a>>);

impl<'a> Worker<'_, 'a> {
    fn trial(&self) -> MutexGuard<'_, Trial<'a>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Jobs for Worker<'_, '_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        self.trial().next()
    }

    fn done(&mut self, number: u64, mut row: Row) {
        let plan = self.trial().plan;
        let point = plan.point(self.trial().index(number));
        // The lock is free while this thread computes derivatives, because the other threads need the trial.
        if run::add_columns(plan, Backend::best(), &point, &mut row, &|| self.interrupted()) {
            self.trial().done(number, &point, row);
        }
    }

    fn interrupted(&self) -> bool {
        self.trial().is_over()
    }
}

#[cfg(test)]
mod tests {
    use flap_core::simulate::{all, never};
    use flap_sweep::run::{Outcome, RunOptions};

    use super::*;

    /// Runs all points of a plan, and adds up the work of these points.
    struct All<'a> {
        plan: &'a Plan,
        next: u64,
        work: f64,
    }

    impl Jobs for All<'_> {
        fn next(&mut self, _idle: bool) -> Option<Point> {
            (self.next < self.plan.len()).then(|| {
                self.next += 1;
                self.plan.point(self.next - 1)
            })
        }

        fn done(&mut self, _index: u64, row: Row) {
            self.work += row.rhs_evals as f64;
        }
    }

    /// Points near hysteresis and points that never settle need up to a hundred times the work of other points.
    #[test]
    fn the_mean_work_is_that_of_the_sweep() {
        let grid = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = \"0.7486 uN*m/rad\"\n[axes]\n\
                    drive_voltage_pp = { from = \"100 V\", to = \"240 V\", n = 15 }\n\
                    drive_frequency = { from = \"60 Hz\", to = \"150 Hz\", n = 80 }\n";
        let plan =
            flap_sweep::grid::parse("grid.toml", grid, all()).unwrap_or_else(|error| panic!("{error:?}"));
        let mut whole = All { plan: &plan, next: 0, work: 0.0 };
        plan.rows().run(Backend::best(), plan.solver(), &mut whole);
        let truth = whole.work / plan.len() as f64;
        for threads in [1, 2] {
            let trial = Trial::run(&plan, threads);
            let (mean, error) = trial.mean_work(plan.len()).unwrap();
            println!("{} points: {mean} of {truth}, {error}", trial.works.len());
            assert!(trial.works.len() >= 32, "{} points", trial.works.len());
            assert!((mean / truth - 1.0).abs() < 0.3 && error < 0.6, "{mean} {truth} {error}");
        }
    }

    /// The work of a point in the sample equals its work in a sweep, including the evaluations for
    /// derivatives.
    #[test]
    fn derivatives_are_work() {
        let grid = "preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = [95, 105]\n";
        let gradient = "[gradient]\nof = [\"lift_mean_mn\"]\n\
                        with_respect_to = [\"hinge_stiffness\", \"leading_edge_inertia\", \"drive_voltage_pp\"]\n";
        let [without, with] = [grid.to_owned(), grid.to_owned() + gradient].map(|text| {
            let plan = flap_sweep::grid::parse("grid.toml", &text, all())
                .unwrap_or_else(|error| panic!("{error:?}"));
            let (trial, options) = (Trial::run(&plan, 1), RunOptions::default());
            let rows = run::alone(&plan, &options, &never).map(|outcome| match outcome {
                Ok(Outcome::Ran(row)) => row.rhs_evals as f64,
                other => panic!("{other:?}"),
            });
            let rows: Vec<f64> = rows.collect();
            assert!(!trial.works.is_empty());
            for work in &trial.works {
                assert!(rows.contains(work), "{work} of {rows:?}");
            }
            rows[0]
        });
        assert!(with > 1.1 * without, "{with} {without}");
    }

    /// The estimated time is the work of the sweep divided by the speed of the sample. In the speed of the
    /// sample, each unfinished point counts as half of the mean work of the finished points.
    #[test]
    fn seconds_are_the_work_of_the_sweep_over_the_speed_of_the_sample() {
        let grid = "preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = [95, 105]\n";
        let plan =
            flap_sweep::grid::parse("grid.toml", grid, all()).unwrap_or_else(|error| panic!("{error:?}"));
        let trial = Trial {
            took: Duration::from_secs(2),
            works: vec![100.0, 300.0],
            begun: 10,
            done: 8,
            work: 1000.0,
            ..Trial::run(&plan, 1)
        };
        // The work in 2 s is 1000, and half of 200 for each of 2 running points.
        let near = |points: u64, seconds: f64, error: f64| {
            let [low, high] = trial.seconds(points).unwrap();
            assert!((low * (1.0 + error) / seconds - 1.0).abs() < 1e-12, "{points}: {low}");
            assert!((high / (1.0 + error) / seconds - 1.0).abs() < 1e-12, "{points}: {high}");
        };
        near(2, 2.0 * 200.0 * 2.0 / 1200.0, 0.1);
        // 2 of 100 works, with a sample variance of 20 000 and a mean of 200: twice the standard error of the mean.
        near(100, 100.0 * 200.0 * 2.0 / 1200.0, 2.0 * (0.98_f64 * 20_000.0 / 2.0).sqrt() / 200.0);
    }

    /// If the sample contains all points of the plan, only the varying speed of the machine makes the
    /// estimate uncertain.
    #[test]
    fn a_small_plan_is_run_as_a_whole() {
        let grid =
            "preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = { from = 90, to = 120, n = 31 }\n";
        let plan =
            flap_sweep::grid::parse("grid.toml", grid, all()).unwrap_or_else(|error| panic!("{error:?}"));
        let trial = Trial::run(&plan, 2);
        if trial.is_complete() && trial.works.len() == 31 {
            assert_eq!(trial.mean_work(31).unwrap().1, SMALLEST_ERROR);
        }
        assert!(trial.seconds(31).is_some());
        let [low, high] = trial.seconds(31_000).unwrap();
        assert!(low > 0.0 && high > low && high < 3.0 * low, "{low} {high}");
    }
}
