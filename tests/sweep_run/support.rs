//! Plans, sinks and a watchdog.

use std::io;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::plan::Plan;
use flap_sweep::run::{Progress, RowWriter, RunError, RunOptions, Sink, Summary};
use flap_sweep::table::layout::{Cell, Layout};

use crate::fake::Fake;

/// A plan of `points` points: `size` runs from 0, in whole numbers.
pub(crate) fn plan(model: &'static Fake, points: u64) -> Plan {
    plan_with(model, points, "")
}

/// [`plan`] with the rest of its grid file.
pub(crate) fn plan_with(model: &'static Fake, points: u64, rest: &str) -> Plan {
    let last = points - 1;
    plan_of(
        model,
        &format!("preset = \"fake2020\"\n[axes]\nsize = {{ from = 0, to = {last}, step = 1 }}\n{rest}"),
    )
}

/// The plan of a grid file.
pub(crate) fn plan_of(model: &'static Fake, grid: &str) -> Plan {
    flap_sweep::grid::parse("grid.toml", grid, &[model]).expect("a correct grid file")
}

pub(crate) fn options(threads: usize, window: usize) -> RunOptions {
    RunOptions { threads: NonZeroUsize::new(threads).unwrap(), window, ..RunOptions::default() }
}

/// Fails the test if `work` takes too long, because it hangs.
pub(crate) fn must_end<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (send, receive) = mpsc::channel();
    let worker = thread::spawn(move || send.send(work()));
    match receive.recv_timeout(Duration::from_secs(60)) {
        Ok(value) => value,
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("hangs"),
        Err(mpsc::RecvTimeoutError::Disconnected) => {
            std::panic::resume_unwind(worker.join().expect_err("it ended without a result"))
        }
    }
}

/// Runs all points into `sink`, until `stop` is set.
pub(crate) fn run(
    plan: &Plan,
    options: &RunOptions,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    progress: &mut dyn FnMut(Progress),
) -> Result<Summary, RunError> {
    resume(plan, options, Summary::default(), sink, stop, progress)
}

/// Continues a run after the rows that `before` counts, see [`run`].
pub(crate) fn resume(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    progress: &mut dyn FnMut(Progress),
) -> Result<Summary, RunError> {
    let mut output = RowWriter::begin(plan, before, sink)?;
    let ended = output.run_points(options, |now| {
        progress(now);
        stop.load(Ordering::SeqCst)
    });
    output.finish(ended)
}

/// Runs all points, and returns the CSV text and the summary.
pub(crate) fn csv(plan: &Plan, options: &RunOptions) -> (String, Result<Summary, RunError>) {
    let mut sink = CsvSink::new(Layout::of(plan).names(), Vec::new());
    let summary = run(plan, options, &mut sink, &AtomicBool::new(false), &mut |_| {});
    (String::from_utf8(sink.target().clone()).unwrap(), summary)
}

/// A sink that stores the indices of the rows, reports its progress to the model, and can fail.
pub(crate) struct Watch {
    pub(crate) model: &'static Fake,
    pub(crate) indices: Vec<u64>,
    pub(crate) finished: bool,
    /// Index of the row at which the sink fails.
    pub(crate) full_at: Option<u64>,
    /// Index of the row at which the sink panics.
    pub(crate) panic_at: Option<u64>,
    /// Index of the row at which the sink sets the flag.
    pub(crate) stop_at: Option<(u64, &'static AtomicBool)>,
}

impl Watch {
    pub(crate) fn new(model: &'static Fake) -> Watch {
        Watch { model, indices: Vec::new(), finished: false, full_at: None, panic_at: None, stop_at: None }
    }

    pub(crate) fn assert_prefix(&self) {
        assert!(self.indices.iter().copied().eq(0..self.indices.len() as u64), "{:?}", self.indices);
    }
}

impl Sink for Watch {
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        let [Cell::Whole(index), Cell::Number(size), _, Cell::Number(lift), ..] = *cells else {
            panic!("other columns: {cells:?}");
        };
        assert!(lift.is_nan() || lift == size / 3.0, "the row of another point");
        assert!(self.panic_at != Some(index), "the sink panics");
        if self.full_at == Some(index) {
            return Err(io::Error::from(io::ErrorKind::StorageFull));
        }
        self.indices.push(index);
        self.model.written.fetch_add(1, Ordering::SeqCst);
        if let Some((at, stop)) = self.stop_at
            && at == index
        {
            stop.store(true, Ordering::SeqCst);
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.finished = true;
        Ok(())
    }
}

/// A stop flag that lives as long as the tests.
pub(crate) fn flag(raised: bool) -> &'static AtomicBool {
    Box::leak(Box::new(AtomicBool::new(raised)))
}
