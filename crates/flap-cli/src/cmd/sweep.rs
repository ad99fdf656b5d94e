//! `flap sweep`: every point of a grid file, one row each.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use flap_core::simulate::Status;
use flap_sweep::csv_sink::CsvSink;
use flap_sweep::layout::Layout;
use flap_sweep::plan::Plan;
use flap_sweep::run::{self, RunError, RunOptions, Summary};
use flap_sweep::sidecar::{self, End, Sidecar, Start};
use flap_sweep::sink::Sink;
use flap_sweep::{output, spec};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::exclusion;
use crate::args::SweepArgs;
use crate::failure::{Exit, Failure};
use crate::progress::Bar;
use crate::{console, time};

pub(crate) fn run(args: &SweepArgs) -> Result<Exit, Failure> {
    let plan = spec::read(&args.grid)?;
    let mut options = RunOptions::default();
    if let Some(threads) = args.threads {
        options.threads = threads;
    }
    let out = args.out.clone().unwrap_or_else(|| default_path(&plan, &args.grid));

    let (summary, elapsed) = if out.as_os_str() == "-" {
        run_to_stdout(&plan, &options)?
    } else {
        refuse_bad_name(&out, &args.grid)?;
        let file = output::create(&out, args.force)?;
        run_to_file(&plan, &options, file, &out)?
    };
    report(&summary, elapsed, &out);

    let all_periodic = summary.counts.of(Status::Periodic) == summary.rows;
    Ok(match summary {
        Summary { interrupted: true, .. } => Exit::Interrupted,
        _ if args.strict && !all_periodic => Exit::NotAllPeriodic,
        _ => Exit::Done,
    })
}

/// Where rows go if the command line does not say.
fn default_path(plan: &Plan, grid: &Path) -> PathBuf {
    let named_after_grid = || {
        let mut name = grid.file_stem().unwrap_or_default().to_owned();
        name.push(".csv");
        PathBuf::from(name)
    };
    plan.output.path.clone().unwrap_or_else(named_after_grid)
}

fn refuse_bad_name(out: &Path, grid: &Path) -> Result<(), Failure> {
    if fs::canonicalize(out).is_ok_and(|out| fs::canonicalize(grid).is_ok_and(|grid| out == grid)) {
        let message = format!("rows would overwrite the grid file {}", grid.display());
        return Err(Failure::usage(message).help("name another file with --out"));
    }
    match out.extension().and_then(|extension| extension.to_str()) {
        Some(extension @ ("parquet" | "zst" | "gz")) => {
            let message = format!("{}: rows cannot be written as .{extension}", out.display());
            Err(Failure::usage(message).help("name a .csv file"))
        }
        _ => Ok(()),
    }
}

fn run_to_stdout(plan: &Plan, options: &RunOptions) -> Result<(Summary, Duration), Failure> {
    let mut sink = CsvSink::new(Layout::of(plan), io::stdout());
    let start = Instant::now();
    let summary = run_with_progress(plan, options, &mut sink)?;
    Ok((summary, start.elapsed()))
}

fn run_to_file(
    plan: &Plan,
    options: &RunOptions,
    file: File,
    path: &Path,
) -> Result<(Summary, Duration), Failure> {
    let provenance = Start { started: time::now(), options: *options };
    let mut sidecar = Sidecar::new(plan, provenance);
    // Devices and pipes have nothing beside them.
    let beside = file.metadata().is_ok_and(|metadata| metadata.is_file()).then(|| sidecar::path_of(path));
    write_sidecar(&sidecar, beside.as_deref())?;
    // Earlier rows go only now that nothing stands in the way of new ones.
    let refused = |error| Failure::System(format!("cannot write {}: {error}", path.display()), Vec::new());
    output::empty(&file).map_err(refused)?;

    let mut sink = CsvSink::new(Layout::of(plan), file);
    let start = Instant::now();
    let outcome = run_with_progress(plan, options, &mut sink);
    let elapsed = start.elapsed();
    let end = End { finished: time::now(), seconds: elapsed.as_secs_f64() };
    match outcome {
        Ok(summary) => {
            sidecar.finish(&summary, end);
            write_sidecar(&sidecar, beside.as_deref())?;
            Ok((summary, elapsed))
        }
        Err(error) => {
            sidecar.fail(error.to_string(), end);
            // The first error is the one to tell.
            let _ = write_sidecar(&sidecar, beside.as_deref());
            Err(error.into())
        }
    }
}

fn write_sidecar(sidecar: &Sidecar, path: Option<&Path>) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    let refused = |error| Failure::System(format!("cannot write {}: {error}", path.display()), Vec::new());
    sidecar.write(path).map_err(refused)
}

/// Runs the plan with a progress bar; the first signal to end drains the sweep, the second exits at once.
fn run_with_progress(plan: &Plan, options: &RunOptions, sink: &mut dyn Sink) -> Result<Summary, RunError> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // Order matters: the flag is still down when the first signal asks whether to exit. If signals
        // cannot be caught they end the program at once, and what was written so far is in order.
        let _ = flag::register_conditional_shutdown(signal, Exit::Interrupted as i32, Arc::clone(&stop));
        let _ = flag::register(signal, Arc::clone(&stop));
    }
    let mut bar = Bar::new();
    let outcome = run::run(plan, options, sink, &stop, &mut |progress| {
        bar.show(progress, stop.load(Ordering::Relaxed));
    });
    bar.clear();
    outcome
}

/// Tells what the sweep came to.
fn report(summary: &Summary, elapsed: Duration, out: &Path) {
    for (point, reason) in &summary.invalid {
        console::say(&format!("point {point} is invalid: {reason}"));
    }
    let counts = summary.counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let counts = if counts.is_empty() { "no points".to_owned() } else { counts.join(", ") };
    let seconds = elapsed.as_secs_f64();
    let rate = summary.rows as f64 / seconds.max(1e-9);
    console::say(&format!("{counts} in {seconds:.2} s ({rate:.0} points/s)"));

    if summary.excluded > 0 {
        console::say(&exclusion::text(summary.excluded, &summary.unsatisfied));
    }
    let unsettled = summary.counts.of(Status::Unsettled);
    if unsettled > 0 {
        console::say(&format!(
            "{unsettled} did not settle: where `residual` is still falling, raise max_cycles in [solver]; \
             where it is not, lower rtol or raise settle_tol"
        ));
    }

    let place = if out.as_os_str() == "-" { "stdout".to_owned() } else { out.display().to_string() };
    if summary.interrupted {
        let (done, points) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {points} points are in {place}"));
    } else {
        console::say(&format!("{} rows in {place}", summary.rows));
    }
}
