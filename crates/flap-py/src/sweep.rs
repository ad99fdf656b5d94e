//! Runs every point of a plan, and writes the rows into columns in memory or into a file.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use flap_core::simulate::{Setting, SettingKind, SolverSettings};
use flap_sweep::derivative::{Per, column_name};
use flap_sweep::files::job::{self, Begun, Job, OnExisting};
use flap_sweep::files::session::SessionOptions;
use flap_sweep::plan::Plan;
use flap_sweep::plan::gradient::Gradient;
use flap_sweep::run::identity::Identity;
use flap_sweep::run::{self, Chunk, Progress, RowWriter, RunError, RunOptions, Sink, Summary};
use flap_sweep::table::layout::Layout;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::columns::{self, Columns};
use crate::grid::{self, Grid};
use crate::watch::{Watch, interruptible};
use crate::{convert, error};

/// Time between two checkpoints of results in a file.
const CHECKPOINT: Duration = Duration::from_secs(1);

/// Run a grid; see `flapwing.sweep`.
///
/// `chunks` is a function that returns rows that other processes have computed. The argument of `chunks` is
/// the number of finished points, and the result is the bytes of the rows that follow the finished points.
#[pyfunction]
#[pyo3(signature = (grid, /, *, out=None, restart=false, threads=None, progress=None, chunks=None))]
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    grid: &Bound<'py, Grid>,
    out: Option<PathBuf>,
    restart: bool,
    threads: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
    chunks: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let chunks = chunks.map(Bound::unbind);
    let plan = &grid.get().plan;
    let options = options(threads)?;
    // Otherwise the error would follow after all rows are computed.
    grid::check_axes(plan)?;
    let on_existing = if restart { OnExisting::Restart } else { OnExisting::Continue };
    match out {
        None if restart => Err(PyValueError::new_err("restart requires a file of results: give out")),
        None => into_columns(py, plan, &options, progress, chunks.as_ref()),
        Some(out) => {
            let options = SessionOptions { run: options, checkpoint_interval: CHECKPOINT };
            let job = Job { plan, out, on_existing, options, origin: None };
            into_file(py, &job, progress, chunks.as_ref())
        }
    }
}

/// Returns the options of a run, with the given number of threads or one per core.
pub(crate) fn options(threads: Option<&Bound<'_, PyAny>>) -> PyResult<RunOptions> {
    let mut options = RunOptions::default();
    if let Some(threads) = threads {
        let count = usize::try_from(convert::count("threads", threads)?).unwrap_or(usize::MAX);
        options.threads = NonZeroUsize::new(count).unwrap_or(NonZeroUsize::MIN);
    }
    Ok(options)
}

/// Runs a plan and returns its `columns`, `summary`, `axes` and `meta`.
fn into_columns<'py>(
    py: Python<'py>,
    plan: &Plan,
    options: &RunOptions,
    progress: Option<Py<PyAny>>,
    chunks: Option<&Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut sink = Columns::new(Layout::of(plan).columns());
    let mut watch = Watch::new(progress);
    let ran = if chunks.is_none() && plan.selected() <= 1 && plan.resonance().is_none() {
        interruptible(py, |interrupted| {
            let mut output = RowWriter::begin(plan, Summary::default(), &mut sink)?;
            for row in run::alone(plan, options, interrupted) {
                output.write(&row?)?;
            }
            output.finish(Ok(()))
        })?
    } else {
        py.detach(|| work(plan, options, Summary::default(), &mut sink, &mut watch, chunks))
    };
    if let Ok(summary) = &ran {
        watch.done(summary.points);
    }
    watch.ended()?;
    let summary = ran.map_err(|error| error::run(&error))?;
    let dict = PyDict::new(py);
    dict.set_item("columns", sink.into_python(py)?)?;
    dict.set_item("summary", columns::summary(py, &summary)?)?;
    dict.set_item("axes", grid::axes(py, plan)?)?;
    dict.set_item("meta", meta(py, plan, options)?)?;
    Ok(dict)
}

/// Computes the rows of a plan, writes the rows into a file, and returns `summary`, `axes` and `meta`. The
/// summary also counts the rows that earlier runs have written to the file. The summary is empty if the file
/// already contained all rows.
fn into_file<'py>(
    py: Python<'py>,
    job: &Job<'_>,
    progress: Option<Py<PyAny>>,
    chunks: Option<&Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut watch = Watch::new(progress);
    let mut unlocked = None;
    let ran = py.detach(|| {
        let mut writing = match job::begin(job)? {
            Begun::Writing(writing) => writing,
            Begun::Complete { .. } => return Ok(None),
        };
        unlocked = writing.unlocked().map(ToString::to_string);
        let before = writing.before.clone();
        let ended = work(job.plan, &job.options.run, before, writing.sink(), &mut watch, chunks);
        writing.finish(ended).map(Some)
    });
    if let Some(error) = unlocked {
        let out = job.out.display();
        let text =
            format!("{out} cannot be locked ({error}): make sure that no other run writes to this file");
        error::warn(py, text)?;
    }
    if let Ok(done) = &ran {
        watch.done(done.as_ref().map_or(job.plan.selected(), |done| done.summary.points));
    }
    watch.ended()?;
    let outcome = ran.map_err(|error| error::job(&error))?;
    let dict = PyDict::new(py);
    let summary = match outcome {
        Some(done) => columns::summary(py, &done.summary)?,
        None => PyDict::new(py),
    };
    dict.set_item("summary", summary)?;
    dict.set_item("axes", grid::axes(py, job.plan)?)?;
    dict.set_item("meta", meta(py, job.plan, &job.options.run)?)?;
    Ok(dict)
}

/// Writes the rows of all points to `sink`. If `chunks` is given, other processes compute the rows, except
/// the rows of points that `[refine]` adds.
fn work(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    watch: &mut Watch,
    chunks: Option<&Py<PyAny>>,
) -> Result<Summary, RunError> {
    let mut output = RowWriter::begin(plan, before, sink)?;
    let ended = match chunks {
        None => Ok(()),
        Some(chunks) => fetch(plan, options, &mut output, watch, chunks),
    };
    // Points of a refinement follow from the rows, so they run here.
    let ended = ended.and_then(|()| {
        let is_left = chunks.is_some() && (watch.is_stopped() || output.done() < plan.selected());
        // A resumed refinement may already have points without rows.
        let has_round = chunks.is_none() || output.done() < output.plan().selected();
        if !is_left && (has_round || output.next_round()) {
            output.run_points(options, |progress| watch.stops(progress))
        } else {
            Ok(())
        }
    });
    output.finish(ended)
}

/// Writes the rows that other processes compute, until all rows are written or the run is interrupted.
fn fetch(
    plan: &Plan,
    options: &RunOptions,
    output: &mut RowWriter<'_>,
    watch: &mut Watch,
    chunks: &Py<PyAny>,
) -> Result<(), RunError> {
    let points = plan.selected();
    while output.done() < points && !watch.stops(Progress { finished: output.done(), points }) {
        let done = output.done();
        let fetched: PyResult<Option<Vec<u8>>> = Python::attach(|py| {
            let bytes = chunks.call1(py, (done,))?;
            let bytes = bytes.bind(py);
            if bytes.is_none() { Ok(None) } else { Ok(Some(bytes.cast::<PyBytes>()?.as_bytes().to_vec())) }
        });
        let bytes = fetched.map_err(|error| {
            let message = error.to_string();
            watch.note(Err(error));
            RunError::Fetch(message)
        })?;
        let Some(bytes) = bytes else { break };
        for row in &Chunk::from_bytes(&bytes)?.outcomes(plan, options, done)? {
            output.write(row)?;
        }
        output.flush()?;
    }
    Ok(())
}

/// Returns a dictionary that describes the derivatives in the rows: the names of the measures, of the
/// parameters, and of the columns. There is one column for each pair of a measure and a parameter.
fn slopes<'py>(py: Python<'py>, plan: &Plan, gradient: &Gradient) -> PyResult<Bound<'py, PyDict>> {
    let known: Vec<&str> = plan.measured().collect();
    let of: Vec<&str> = gradient.of.iter().map(|&of| known[of]).collect();
    let by: Vec<&str> = gradient.with_respect_to.iter().map(|&by| plan.parameters()[by].name).collect();
    let columns = of.iter().flat_map(|of| by.iter().map(move |by| column_name(of, by, gradient.per)));
    let columns: Vec<String> = columns.collect();
    let dict = PyDict::new(py);
    dict.set_item("per", if gradient.per == Per::Cent { "per cent" } else { "SI unit" })?;
    dict.set_item("columns", columns)?;
    dict.set_item("of", of)?;
    dict.set_item("with_respect_to", by)?;
    Ok(dict)
}

/// Returns a dictionary that describes how rows were computed: versions, model, solver settings, and the text
/// of the grid.
pub(crate) fn meta<'py>(py: Python<'py>, plan: &Plan, options: &RunOptions) -> PyResult<Bound<'py, PyDict>> {
    let identity = Identity::of(plan, options);
    let solver = PyDict::new(py);
    for Setting { name, kind, .. } in SolverSettings::TABLE {
        match kind {
            SettingKind::Number { get, .. } => solver.set_item(name, get(plan.solver()))?,
            SettingKind::Count { get, .. } => solver.set_item(name, get(plan.solver()))?,
            SettingKind::Flag { get, .. } => solver.set_item(name, get(plan.solver()))?,
        }
    }
    let dict = PyDict::new(py);
    dict.set_item("flap", identity.flap)?;
    dict.set_item("build", identity.build)?;
    dict.set_item("model", plan.simulator().name())?;
    dict.set_item("preset", plan.preset())?;
    dict.set_item("pitch_sign", plan.robot().model().description().pitch_sign)?;
    dict.set_item("arithmetic", identity.arithmetic)?;
    dict.set_item("solver", solver)?;
    dict.set_item("grid", &plan.source().text)?;
    if let Some(along) = plan.followed() {
        dict.set_item("parameter", plan.parameters()[along.parameter].name)?;
    }
    if let Some(gradient) = plan.gradient() {
        dict.set_item("gradient", slopes(py, plan, gradient)?)?;
    }
    Ok(dict)
}
