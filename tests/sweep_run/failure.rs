//! Sweeps in which the sink or the model fails. The sweep returns an error, does not hang, and writes all rows in
//! order.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::Ordering;

use flap_sweep::run::{RunError, Summary};

use crate::fake::{Fake, Fault};
use crate::support::{Watch, flag, must_end, options, plan, run};

/// Threads and window of every test: large windows, a small window, and a window of one point.
const SHAPES: [(usize, usize); 4] = [(1, 1000), (2, 1000), (4, 10), (3, 1)];

/// Sweeps a million points.
fn sweep(sink: &mut Watch, threads: usize, window: usize) -> Result<Summary, RunError> {
    let plan = plan(sink.model, 1_000_000);
    run(&plan, &options(threads, window), sink, flag(false), &mut |_| {})
}

/// Returns the error of a sweep and the number of rows that were written.
fn fails(fault: Fault, threads: usize, window: usize) -> (RunError, u64) {
    must_end(move || {
        let mut sink = Watch::new(Fake::leak(fault, 8));
        let error = sweep(&mut sink, threads, window).unwrap_err();
        sink.assert_prefix();
        assert!(sink.finished, "what was written is kept");
        (error, sink.indices.len() as u64)
    })
}

#[test]
fn a_full_disk_ends_the_sweep_at_once() {
    for (threads, window) in SHAPES {
        must_end(move || {
            let model = Fake::leak(Fault::None, 8);
            let mut sink = Watch { full_at: Some(500), ..Watch::new(model) };
            match sweep(&mut sink, threads, window).unwrap_err() {
                RunError::Sink(source) => assert_eq!(source.kind(), io::ErrorKind::StorageFull),
                other => panic!("{other}"),
            }
            sink.assert_prefix();
            assert_eq!(sink.indices.len(), 500);
            let begun = model.begun.load(Ordering::SeqCst);
            assert!(begun <= 500 + window as u64, "{begun} points begun");
        });
    }
}

#[test]
fn a_panic_in_the_sink_reaches_the_caller() {
    for (threads, window) in SHAPES {
        must_end(move || {
            let mut sink = Watch { panic_at: Some(500), ..Watch::new(Fake::leak(Fault::None, 8)) };
            let caught = catch_unwind(AssertUnwindSafe(|| sweep(&mut sink, threads, window)));
            assert!(caught.is_err());
        });
    }
}

#[test]
fn a_panic_in_a_worker_is_an_error() {
    for (threads, window) in SHAPES {
        for size in [0.0, 700.0] {
            let (error, rows) = fails(Fault::Panic(size), threads, window);
            assert!(rows as f64 <= size, "{rows} rows");
            match error {
                RunError::Panic(message) => assert_eq!(message, format!("the size is {size}")),
                other => panic!("{other}"),
            }
        }
    }
}

#[test]
fn a_model_that_loses_a_point_is_an_error() {
    for (threads, window) in SHAPES {
        let (error, rows) = fails(Fault::Lose(700.0), threads, window);
        assert_eq!(rows, 700);
        assert_eq!(error.to_string(), "bug in the model: it returned without the rows of 1 point");
    }
}

#[test]
fn a_model_that_invents_a_row_is_an_error() {
    for (threads, window) in SHAPES {
        let (error, _) = fails(Fault::Invent(700.0), threads, window);
        assert!(matches!(error, RunError::Model(_)), "{error}");
    }
}

#[test]
fn a_model_that_returns_too_few_measures_is_an_error() {
    for (threads, window) in SHAPES {
        let (error, rows) = fails(Fault::Narrow(700.0), threads, window);
        assert_eq!(rows, 700);
        assert!(error.to_string().contains("1 measures, not 2"), "{error}");
    }
}
