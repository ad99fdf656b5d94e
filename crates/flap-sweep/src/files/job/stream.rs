//! The rows of a plan into a stream.

use std::time::Instant;

use super::{Done, JobError};
use crate::files::csv_sink::CsvSink;
use crate::files::disk::Durable;
use crate::plan::Plan;
use crate::run::sink::Sink;
use crate::run::{RunError, RunOptions, Summary};
use crate::table::layout::Layout;

/// Computes the rows of a plan behind those that the summary counts, and writes them to the sink.
pub type Engine<'a> =
    &'a mut dyn FnMut(&Plan, &RunOptions, Summary, &mut dyn Sink) -> Result<Summary, RunError>;

/// Writes the rows of a plan as CSV to a stream, which can neither be read again nor resumed.
///
/// # Errors
/// [`JobError::Run`] if rows cannot be computed or written.
pub fn to_stream(
    plan: &Plan,
    stream: impl Durable,
    options: &RunOptions,
    engine: Engine<'_>,
) -> Result<Done, JobError> {
    let mut sink = CsvSink::new(Layout::of(plan).names(), stream);
    let start = Instant::now();
    let summary = engine(plan, options, Summary::default(), &mut sink)
        .map_err(|error| JobError::Run { error, resumable: false })?;
    Ok(Done { summary, rows_before: 0, seconds: start.elapsed().as_secs_f64(), place: None })
}
