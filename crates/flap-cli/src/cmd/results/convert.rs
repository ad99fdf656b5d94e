//! `flap results convert`: writes results in another format.

use std::io::ErrorKind;

use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::integrity::Note;
use flap_sweep::files::results::{Checksums, ConvertError, Format, Provenance, RowCheck, RowsError, convert};
use flap_sweep::files::sidecar::Sidecar;
use flap_sweep::notation::text::count;

use crate::args::ConvertArgs;
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure, IGNORE_HELP};
use crate::{job, system};

pub(super) fn run(args: &ConvertArgs) -> Result<Exit, Failure> {
    let to_stdout = is_stdout(&args.to);
    let to = if to_stdout { Format::Csv } else { Format::of(&args.to)? };
    let mut inputs = Inputs::new();
    inputs.add_results("the results", &args.from).protect_from_results(&args.to)?;
    let (mut source, plan, mut sidecar) = job::open_recorded(&args.from, &args.read)?;
    inputs.add_plan(&plan).protect_from_results(&args.to)?;
    let is_damaged = source.notes.iter().any(|note| matches!(note, Note::Damaged { .. }));
    let provenance = Provenance::of(&plan, &sidecar.identity);
    let check = RowCheck::new(&plan, sidecar.rows());
    if to_stdout {
        convert(&mut source.reader, (system::stdout()?, to), &provenance, check)
            .map_err(|error| failure(args, &error))?;
        job::tell_missed(&args.from, &source.reader);
        return Ok(Exit::Done);
    }
    let mut rows = 0;
    let made = job::make(&args.to, args.overwrite.force, |target| {
        let (written, checksums) = convert(&mut source.reader, (target, to), &provenance, check)?;
        rows = written;
        note(&mut sidecar, written, checksums, is_damaged);
        Ok::<_, ConvertError>(Some(sidecar))
    });
    made?.map_err(|error| failure(args, &error))?;
    job::tell_missed(&args.from, &source.reader);
    console::say(&format!("{} in {}", count(rows, "row"), args.to.display()));
    Ok(Exit::Done)
}

/// Stores the number and the checksums of the written rows in the sidecar. If the results are damaged, the
/// sidecar keeps its earlier checksums, which are the checksums of the undamaged rows.
fn note(sidecar: &mut Sidecar, rows: u64, checksums: Checksums, is_damaged: bool) {
    if is_damaged {
        // Damaged rows remain damaged in another format: the checksums are for the rows that were computed.
        sidecar.checksums = sidecar.checksums.take().map(|computed| Checksums { file: None, ..computed });
        return;
    }
    sidecar.checksums = Some(checksums);
    if let Some(summary) = &mut sidecar.summary {
        summary.rows = rows;
    }
}

fn failure(args: &ConvertArgs, error: &ConvertError) -> Failure {
    match error {
        ConvertError::Write(source) if source.kind() == ErrorKind::BrokenPipe => Failure::ClosedPipe,
        ConvertError::Write(_) => Failure::system(format!("{}: {error}", args.to.display())),
        ConvertError::Rows(RowsError::Read(source)) => {
            Failure::system(format!("{}: cannot read rows: {source}", args.from.display()))
        }
        ConvertError::Rows(RowsError::Columns) => {
            Failure::system(format!("{}: {error}", args.from.display()))
        }
        ConvertError::Rows(RowsError::Row(_)) => {
            Failure::damaged(format!("{} is damaged: {error}", args.from.display())).help(IGNORE_HELP)
        }
    }
}
