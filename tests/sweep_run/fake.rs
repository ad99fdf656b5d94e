//! A model without physics: measures follow from the values at once, and points finish in a random order.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use flap_core::model::{Description, OverWings};
use flap_core::num::Backend;
use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::{Column, Jobs, Point, PointRun, Row, Rows, Simulator, SolverSettings, Status};

/// A fault of the model, and the value of `size` at which it happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    None,
    Panic(f64),
    Slow(f64, Duration),
    /// The point runs until it is interrupted.
    Endless(f64),
    /// The row is never returned.
    Lose(f64),
    /// The model also returns a row for a point that does not exist.
    Invent(f64),
    /// The row has too few measures.
    Narrow(f64),
}

/// The model. If `size` modulo 10 is at least 3, the point is not periodic.
pub(crate) struct Fake {
    pub(crate) fault: Fault,
    pub(crate) lanes: usize,
    /// Number of rows that the sink has written; the test's sink updates the number.
    pub(crate) written: AtomicU64,
    /// The largest difference between the index of a started point and the number of written rows.
    pub(crate) widest: AtomicU64,
    /// Number of started points.
    pub(crate) begun: AtomicU64,
    columns: Vec<Column>,
}

static PARAMETERS: [Parameter<'static>; 4] = [
    Parameter::new("size", "m", "s", Kind::Number(Range::NonNegative), "Size."),
    Parameter::new("drive_frequency", "Hz", "f", Kind::Number(Range::Any), "Drive."),
    Parameter::new("arms", "", "", Kind::Choice(&["printed", "axis"]), "Reading."),
    Parameter::new("span", "m", "b", Kind::Following(Range::Positive, "twice size"), "Span."),
];

static PRESETS: [Preset; 1] =
    [Preset { name: "fake2020", doc: "Invented.", values: || vec![1.0, 100.0, 0.0, f64::NAN] }];

impl Fake {
    /// A model that lives as long as the tests.
    pub(crate) fn leak(fault: Fault, lanes: usize) -> &'static Fake {
        let column = |name: &str, unit| Column {
            name: name.to_owned(),
            unit,
            doc: String::new(),
            over_wings: OverWings::Omitted,
        };
        Box::leak(Box::new(Fake {
            fault,
            lanes,
            written: AtomicU64::new(0),
            widest: AtomicU64::new(0),
            begun: AtomicU64::new(0),
            columns: vec![column("lift_mean_mn", "mN"), column("power_mean_mw", "mW")],
        }))
    }

    fn begin(&self, point: &Point) {
        let ahead = (point.index + 1).saturating_sub(self.written.load(Ordering::SeqCst));
        self.widest.fetch_max(ahead, Ordering::SeqCst);
        self.begun.fetch_add(1, Ordering::SeqCst);
        match self.fault {
            Fault::Panic(size) => assert!(point.values[0] != size, "the size is {size}"),
            Fault::Slow(size, time) if point.values[0] == size => std::thread::sleep(time),
            _ => {}
        }
    }

    fn finish(&self, point: &Point, jobs: &mut dyn Jobs) {
        let mut row = Fake::row(&point.values);
        let size = point.values[0];
        match self.fault {
            Fault::Lose(lost) if size == lost => return,
            Fault::Invent(at) if size == at => jobs.done(point.index + 1_000_000, row.clone()),
            Fault::Narrow(at) if size == at => row.measures = vec![1.0],
            _ => {}
        }
        jobs.done(point.index, row);
    }

    fn row(values: &[f64]) -> Row {
        let (size, frequency) = (values[0], values[1]);
        let status = match size % 10.0 {
            3.0 => Status::Subharmonic,
            4.0 => Status::Unsettled,
            5.0 => Status::Diverged,
            6.0 => Status::StepLimit,
            7.0 => Status::Invalid,
            _ => Status::Periodic,
        };
        Row {
            status,
            measures: if status == Status::Periodic {
                vec![size / 3.0, size * frequency]
            } else {
                Vec::new()
            },
            cycles: 10,
            residual: if status == Status::Invalid { f64::NAN } else { 4e-9 },
            period: u32::from(status == Status::Periodic),
            floquet_max: if status == Status::Periodic { 0.5 } else { f64::NAN },
            error_estimate: if status == Status::Periodic { 2e-5 } else { f64::NAN },
            state: vec![size],
            rhs_evals: 1000,
            reason: (status == Status::Invalid).then(|| format!("a size of {size} m is impossible")),
        }
    }
}

impl Rows for Fake {
    fn columns(&self) -> &[Column] {
        &self.columns
    }

    fn run(&self, _set: Backend, _solver: &SolverSettings, jobs: &mut dyn Jobs) {
        let mut random = Random::new();
        let mut running: Vec<Point> = Vec::new();
        loop {
            while running.len() < self.lanes
                && let Some(point) = jobs.next(running.is_empty())
            {
                self.begin(&point);
                running.push(point);
            }
            if running.is_empty() {
                return;
            }
            let chosen = random.below(running.len());
            let point = running.swap_remove(chosen);
            if self.fault == Fault::Endless(point.values[0]) {
                while !jobs.interrupted() {
                    std::thread::sleep(Duration::from_millis(1));
                }
                return;
            }
            self.finish(&point, jobs);
        }
    }

    fn run_point(&self, run: &PointRun<'_>, _: Option<&[f64]>) -> Row {
        Fake::row(run.values)
    }
}

impl Simulator for Fake {
    fn description(&self) -> Description<'_> {
        Description::new("fake", "No physics at all.", &PARAMETERS, &PRESETS)
    }
}

/// Random numbers with a different sequence for every worker, so that the order of rows differs from run to run.
struct Random(u64);

impl Random {
    fn new() -> Random {
        static SEED: AtomicU64 = AtomicU64::new(1);
        Random(SEED.fetch_add(0x9E37_79B9_7F4A_7C15, Ordering::Relaxed) | 1)
    }

    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).unwrap() % end
    }
}
