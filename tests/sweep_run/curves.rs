//! Responses on the same runner as sweeps: a model that fails is an error, and continued runs have the same bytes as
//! uninterrupted runs.

use std::fs;
use std::path::Path;
use std::time::Duration;

use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::files::integrity::{self, Integrity};
use flap_sweep::files::job::{self, Begun, Done, Job, JobError, OnExisting};
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::files::session::SessionOptions;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::run::{Outcome, RowWriter, RunError, RunOptions, Sink, Summary};
use flap_sweep::study::response::Responses;
use flap_sweep::table::layout::Layout;
use temp_dir::TempDir;

use crate::fake::{Fake, Fault};
use crate::support::{must_end, options, plan_of};

/// A file in each format.
const FILES: &[&str] = &[
    "rows.csv",
    "rows.csv.zst",
    #[cfg(feature = "parquet")]
    "rows.parquet",
];

/// A number of designs, each followed from size 0 to 2 and back. No step is longer than the tolerance, so no step is
/// halved.
fn curves(model: &'static Fake, designs: u32) -> Plan {
    let plan = plan_of(
        model,
        &format!(
            "preset = \"fake2020\"\n[axes]\ndrive_frequency = {{ from = 1, to = {designs}, step = 1 }}\n"
        ),
    );
    plan.following(Along { parameter: 0, values: vec![0.0, 1.0, 2.0], tolerance: 1.0, unstable: false })
}

/// Writes all curves to `sink`. Stops with the curve of index `stop_at`.
fn write(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    stop_at: u64,
) -> Result<Summary, RunError> {
    let mut output = RowWriter::begin(plan, before, sink)?;
    let mut run = Responses::of(plan).unwrap().curves(options, output.done());
    let mut pull = || {
        while let Some(batch) = run.next_batch()? {
            for curve in &batch {
                if matches!(curve, Outcome::Ran(curve) if curve.design.index == stop_at) {
                    run.stop();
                }
                output.write_curve(curve)?;
            }
            output.flush()?;
        }
        Ok(())
    };
    let ended = pull();
    output.finish(ended)
}

/// The CSV text of all rows, and the summary.
fn csv(plan: &Plan, threads: usize, window: usize) -> (String, Result<Summary, RunError>) {
    let mut sink = CsvSink::new(Layout::of(plan).names(), Vec::new());
    let summary = write(plan, &options(threads, window), Summary::default(), &mut sink, u64::MAX);
    (String::from_utf8(sink.target().clone()).unwrap(), summary)
}

#[test]
fn rows_do_not_depend_on_threads() {
    let (text, summary) = csv(&curves(Fake::leak(Fault::None, 8), 500), 1, 1000);
    assert_eq!(text.lines().count(), 1 + 500 * 6);
    assert!(text.starts_with("curve,drive_frequency,branch,size,status,"), "{text}");
    let summary = summary.unwrap();
    assert_eq!((summary.ran, summary.rows, summary.points), (500, 3000, 500));
    for (threads, window) in [(2, 1000), (4, 10), (3, 1)] {
        assert_eq!(csv(&curves(Fake::leak(Fault::None, 8), 500), threads, window).0, text);
    }
}

#[test]
fn a_panic_is_an_error() {
    for (threads, window) in [(1, 1000), (2, 1000), (4, 10), (3, 1)] {
        let (text, summary) =
            must_end(move || csv(&curves(Fake::leak(Fault::Panic(2.0), 8), 10_000), threads, window));
        match summary.unwrap_err() {
            RunError::Panic(message) => assert_eq!(message, "the size is 2"),
            other => panic!("{other}"),
        }
        assert_eq!(text.lines().count(), 1, "no curve is complete");
    }
}

#[test]
fn a_model_that_breaks_its_contract_is_an_error() {
    for fault in [Fault::Narrow(1.0), Fault::Lose(1.0)] {
        let (_, summary) = must_end(move || csv(&curves(Fake::leak(fault, 8), 100), 2, 100));
        assert!(matches!(summary, Err(RunError::Model(_))), "{fault:?}");
    }
}

/// Runs a job that stops with the curve of index `stop_at`. `None` if the job is already complete.
fn run(plan: &Plan, out: &Path, on_existing: OnExisting, stop_at: u64) -> Result<Option<Done>, JobError> {
    let options = SessionOptions { run: options(2, 100), checkpoint_interval: Duration::from_millis(5) };
    let job = Job { plan, out: out.to_owned(), on_existing, options, origin: None };
    let mut writing = match job::begin(&job)? {
        Begun::Writing(writing) => writing,
        Begun::Complete { .. } => return Ok(None),
    };
    let before = writing.before.clone();
    let ended = write(plan, &options.run, before, writing.sink(), stop_at);
    writing.finish(ended).map(Some)
}

#[test]
fn an_interrupted_response_goes_on_to_the_same_bytes() {
    // Slow, so that a raised flag leaves curves over.
    let model = Fake::leak(Fault::Slow(1.0, Duration::from_micros(200)), 8);
    let plan = curves(model, 2000);
    for name in FILES {
        let folder = TempDir::new().unwrap();
        let [whole, out] = ["whole", "out"].map(|folder_name| {
            let folder = folder.path().join(folder_name);
            fs::create_dir(&folder).unwrap();
            folder.join(name)
        });
        assert!(matches!(run(&plan, &whole, OnExisting::Continue, u64::MAX), Ok(Some(_))));
        let Ok(Some(first)) = run(&plan, &out, OnExisting::Continue, 300) else { panic!("{name}") };
        let Done { summary, .. } = first;
        assert!(
            summary.is_interrupted() && summary.ran > 300 && summary.ran < 2000,
            "{name}: {}",
            summary.ran
        );
        assert!(matches!(integrity::verify(&out), Ok(Integrity::Unfinished { done: Some(_) })), "{name}");
        let Ok(Some(second)) = run(&plan, &out, OnExisting::Continue, u64::MAX) else { panic!("{name}") };
        assert!(second.rows_before > 1000, "{name}: {}", second.rows_before);
        assert_eq!((second.summary.ran, second.summary.rows), (2000, 12_000), "{name}");
        assert!(fs::read(&whole).unwrap() == fs::read(&out).unwrap(), "{name}: other bytes");
        assert_eq!(integrity::verify(&out).unwrap(), Integrity::Sound { rows: 12_000 }, "{name}");
        assert!(matches!(run(&plan, &out, OnExisting::Continue, 0), Ok(None)), "{name}");
    }
}

#[test]
fn every_format_holds_the_same_rows() {
    let plan = curves(Fake::leak(Fault::None, 8), 100);
    let folder = TempDir::new().unwrap();
    let rows: Vec<Vec<String>> = FILES
        .iter()
        .map(|name| {
            let out = folder.path().join(name);
            assert!(matches!(run(&plan, &out, OnExisting::Continue, u64::MAX), Ok(Some(_))));
            let mut reader = Reader::new(fs::File::open(&out).unwrap(), Format::of(&out).unwrap()).unwrap();
            let mut lines = vec![reader.names().join(",")];
            let mut row = csv::StringRecord::new();
            while reader.next(&mut row).unwrap() {
                lines.push(row.iter().collect::<Vec<_>>().join(","));
            }
            lines
        })
        .collect();
    assert_eq!(rows[0], csv(&plan, 1, 100).0.lines().collect::<Vec<_>>());
    assert!(rows.iter().all(|other| *other == rows[0]));
}

#[test]
fn a_response_along_other_values_is_another() {
    let model = Fake::leak(Fault::Slow(1.0, Duration::from_micros(200)), 8);
    let plan = curves(model, 2000);
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("rows.csv");
    assert!(matches!(run(&plan, &out, OnExisting::Continue, 10), Ok(Some(_))));
    let along = plan.followed().unwrap().clone();
    let plan = plan.following(Along { tolerance: 0.2, ..along });
    let Err(JobError::Resume { error, .. }) = run(&plan, &out, OnExisting::Continue, 0) else {
        panic!("resumed")
    };
    assert!(error.to_string().contains("the followed parameter"), "{error}");
}
