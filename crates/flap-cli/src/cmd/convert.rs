//! `flap convert`: results in another format.

use flap_sweep::identity::Identity;
use flap_sweep::integrity::{Note, RowCheck};
use flap_sweep::results::{Checksums, ConvertError, Converted, Format, Provenance, convert};
use flap_sweep::sidecar::{self, Sidecar, State};

use crate::args::ConvertArgs;
use crate::console;
use crate::failure::{Exit, Failure, IGNORE_HELP};
use crate::job;

pub(crate) fn run(args: &ConvertArgs) -> Result<Exit, Failure> {
    let to = Format::of(&args.to)?;
    let (mut source, plan, mut sidecar) = job::open_recorded(&args.from, &args.read)?;
    let is_damaged = source.notes.iter().any(|note| matches!(note, Note::Damaged { .. }));
    let provenance = Provenance::of(&plan, &Identity::recorded(&sidecar));
    let written = sidecar.rows.filter(|_| sidecar.state == State::Complete);
    let check = RowCheck::new(&plan, written);
    let mut converted = None;
    let made = job::make(&args.to, args.force, |target| {
        convert(&mut source.reader, (target, to), &provenance, Some(check)).map(|done| converted = Some(done))
    });
    made?.map_err(|error| failure(args, &error))?;
    job::tell_missed(&args.from, &source.reader);
    let Some(Converted { rows, checksums }) = converted else {
        return Err(Failure::Bug("nothing was converted".to_owned()));
    };
    note(&mut sidecar, rows, checksums, is_damaged);
    let path = sidecar::path_of(&args.to);
    sidecar.write(&path).map_err(|error| Failure::cannot_write(&path, &error))?;
    console::say(&format!("{rows} rows in {}", args.to.display()));
    Ok(Exit::Done)
}

/// Notes in the sidecar what has been written.
fn note(sidecar: &mut Sidecar, rows: u64, checksums: Checksums, is_damaged: bool) {
    if is_damaged {
        // Damaged rows stay damaged in another format: their checksums are those of the rows that were computed.
        sidecar.checksums = sidecar.checksums.take().map(|computed| Checksums { file: None, ..computed });
        return;
    }
    sidecar.checksums = Some(checksums);
    sidecar.rows = Some(rows);
}

fn failure(args: &ConvertArgs, error: &ConvertError) -> Failure {
    match error {
        ConvertError::Write(_) => Failure::System(format!("{}: {error}", args.to.display()), Vec::new()),
        ConvertError::Read(_) | ConvertError::Columns => {
            Failure::System(format!("{}: {error}", args.from.display()), Vec::new())
        }
        ConvertError::Rows(_) => {
            Failure::damaged(format!("{} is damaged: {error}", args.from.display())).help(IGNORE_HELP)
        }
    }
}
