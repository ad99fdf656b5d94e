//! Interrupted runs: the runs end at once, and return no incomplete rows.

use std::cell::Cell;
use std::collections::HashSet;

use flap_core::num::Backend;
use flap_core::simulate::{
    ChirpRequest, ImpulseRequest, Jobs, Point, PointRun, Row, Simulator, SolverSettings, TrajectoryRequest,
    Unfinished, preset,
};

use crate::rows::bits;

/// Settings with which no motion ever settles.
const ENDLESS: SolverSettings = SolverSettings {
    rtol: 1e-6,
    atol: 1e-8,
    settle_tol: 1e-300,
    max_cycles: 1_000_000_000,
    max_steps: u32::MAX,
    accuracy: 1e-3,
    newton: false,
    progressive: false,
    symmetry: true,
    loads: false,
};

/// Points that are interrupted when `until` returns true. The arguments of `until` are the number of calls of
/// `interrupted` and the number of rows.
struct Interrupted<F> {
    points: Vec<Vec<f64>>,
    next: usize,
    rows: Vec<(usize, Row)>,
    asked: Cell<u32>,
    until: F,
}

impl<F: Fn(u32, usize) -> bool> Interrupted<F> {
    fn run(model: &dyn Simulator, solver: &SolverSettings, points: Vec<Vec<f64>>, until: F) -> Self {
        let mut jobs = Interrupted { points, next: 0, rows: Vec::new(), asked: Cell::new(0), until };
        model.run(Backend::best(), solver, &mut jobs);
        jobs
    }
}

impl<F: Fn(u32, usize) -> bool> Jobs for Interrupted<F> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let point = self.points.get(self.next)?.clone();
        self.next += 1;
        Some(Point::at_rest(self.next as u64 - 1, point))
    }

    fn done(&mut self, index: u64, row: Row) {
        self.rows.push((index as usize, row));
    }

    fn interrupted(&self) -> bool {
        self.asked.set(self.asked.get() + 1);
        (self.until)(self.asked.get(), self.rows.len())
    }
}

/// A preset at some drive frequencies (Hz).
fn points(name: &str, frequencies: impl Iterator<Item = f64>) -> (&'static dyn Simulator, Vec<Vec<f64>>) {
    let (model, preset) = preset(name).unwrap();
    let index = model.parameters().iter().position(|parameter| parameter.name == "drive_frequency").unwrap();
    let values = frequencies.map(|frequency| {
        let mut values = (preset.values)();
        values[index] = frequency;
        values
    });
    (model, values.collect())
}

#[test]
fn points_that_never_settle_end_without_rows() {
    for name in ["jafferis2016", "ozaki2018-small", "arabagi2013-75hz"] {
        let (model, points) = points(name, (80..100).map(f64::from));
        let jobs = Interrupted::run(model, &ENDLESS, points, |asked, _| asked >= 50);
        assert!(jobs.rows.is_empty(), "{name}");
        assert!(jobs.asked.get() < 100, "{name}: asked {} times", jobs.asked.get());
    }
}

#[test]
fn a_drive_period_of_very_many_steps_is_interrupted_halfway() {
    let (model, points) = points("ozaki2018-small", [1e-3].into_iter());
    let jobs = Interrupted::run(model, &ENDLESS, points.clone(), |asked, _| asked >= 5);
    assert!(jobs.rows.is_empty());

    let asked = Cell::new(0);
    let interrupted = || {
        asked.set(asked.get() + 1);
        asked.get() >= 5
    };
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 10, settled: false };
    let motions = model.motions().unwrap();
    let motion = motions
        .trajectory(&PointRun::new(Backend::best(), &ENDLESS, &points[0]).until(&interrupted), &request);
    assert_eq!(motion, Err(Unfinished::Interrupted));
}

#[test]
fn rows_before_an_interruption_are_those_without_one() {
    let solver = SolverSettings::default();
    let (model, points) = points("ozaki2018-large", (0..2000).map(|i| 95.0 + 0.01 * f64::from(i)));
    for newton in [true, false] {
        let solver = SolverSettings { newton, ..solver };
        let jobs = Interrupted::run(model, &solver, points.clone(), |_, rows| rows >= 300);
        assert!((300..2000).contains(&jobs.rows.len()), "{} rows", jobs.rows.len());
        let indices: HashSet<usize> = jobs.rows.iter().map(|(index, _)| *index).collect();
        assert_eq!(indices.len(), jobs.rows.len(), "no point has two rows");
        for (index, row) in jobs.rows.iter().step_by(17) {
            let alone = model.run_point(&PointRun::new(Backend::best(), &solver, &points[*index]), None);
            assert_eq!(bits(row), bits(&alone), "point {index}");
        }
    }
}

#[test]
fn motions_of_one_point_end_when_interrupted() {
    let (model, points) = points("jafferis2016", [100.0].into_iter());
    let (set, values) = (Backend::best(), &points[0]);
    let always = || true;
    let interrupted = Some(Unfinished::Interrupted);

    // The row is meaningless, but the run ends.
    model.run_point(&PointRun::new(set, &ENDLESS, values).until(&always), None);

    let (motions, experiments) = (model.motions().unwrap(), model.experiments().unwrap());
    let settled = TrajectoryRequest { cycles: 1, samples_per_cycle: 10, settled: true };
    assert_eq!(
        motions.trajectory(&PointRun::new(set, &ENDLESS, values).until(&always), &settled).err(),
        interrupted
    );
    let from_rest = TrajectoryRequest { cycles: 1_000_000_000, settled: false, ..settled };
    assert_eq!(
        motions.trajectory(&PointRun::new(set, &ENDLESS, values).until(&always), &from_rest).err(),
        interrupted
    );
    let chirp = ChirpRequest { from: 90.0, to: 110.0, rate: 1e-6, samples_per_cycle: 0 };
    assert_eq!(
        experiments.chirp(&PointRun::new(set, &ENDLESS, values).until(&always), &chirp).err(),
        interrupted
    );
    let impulse = ImpulseRequest { stroke_rate: 1.0, duration: 1e6, intervals: 100 };
    assert_eq!(
        experiments.free_response(&PointRun::new(set, &ENDLESS, values).until(&always), &impulse).err(),
        interrupted
    );
    assert_eq!(
        motions.period(&PointRun::new(set, &ENDLESS, values).until(&always), &[0.0; 4]).err(),
        interrupted
    );
    assert!(motions.period(&PointRun::new(set, &ENDLESS, values), &[0.0; 4]).is_ok());
}

/// An endless list of points, which ends when `wanted` rows are complete.
struct Endless {
    values: Vec<f64>,
    given: u64,
    wanted: u64,
    rows: u64,
    /// The largest number of points that were running at the same time.
    most: u64,
    /// The first points that have no row yet.
    first: Vec<u64>,
}

impl Jobs for Endless {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        self.given += 1;
        self.most = self.most.max(self.given - self.rows);
        Some(Point::at_rest(self.given - 1, self.values.clone()))
    }

    fn done(&mut self, index: u64, _row: Row) {
        self.rows += 1;
        self.first.retain(|&first| first != index);
    }

    fn interrupted(&self) -> bool {
        self.rows >= self.wanted
    }
}

/// Rows are complete while more points begin: no point waits for the end of the sweep.
#[test]
fn no_point_is_left_behind_while_others_come() {
    for name in ["ozaki2018-large", "jafferis2016", "arabagi2013-75hz"] {
        for progressive in [true, false] {
            let (model, preset) = preset(name).unwrap();
            let solver = SolverSettings { progressive, ..SolverSettings::DEFAULT };
            let mut jobs = Endless {
                values: (preset.values)(),
                given: 0,
                wanted: 3000,
                rows: 0,
                most: 0,
                first: (0..100).collect(),
            };
            model.run(Backend::best(), &solver, &mut jobs);
            println!("{name}: at most {} points on their way", jobs.most);
            assert!(jobs.first.is_empty(), "{name}: no rows of {:?}", jobs.first);
            assert!(jobs.most < 1000, "{name}: {} points on their way", jobs.most);
        }
    }
}
