//! Opens results that commands read, and reads the plans in the sidecars of results.

use std::io::ErrorKind;
use std::path::Path;

use csv::StringRecord;
use flap_sweep::files::beside::{journal_of, sidecar_of};
use flap_sweep::files::integrity::{self, Note, OnDamage, Opened};
use flap_sweep::files::journal;
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::files::sidecar::{PlanError, Sidecar, SidecarError, State};
use flap_sweep::plan::Plan;
use flap_sweep::refine;
use flap_sweep::run::Summary;

use crate::args::ReadArgs;
use crate::console;
use crate::failure::{Failure, IGNORE_HELP};
use crate::models;

/// The help line for results without a sidecar.
const SIDECAR_HELP: &str =
    "the sidecar FILE.meta.toml must be in the folder of the results; it contains the grid";

/// Returns the plan with which a results file was computed, and the sidecar of the file. The sidecar is in
/// the same folder as the results file.
pub(crate) fn recorded(results: &Path, on_damage: OnDamage) -> Result<(Plan, Sidecar), Failure> {
    let sidecar = read_sidecar(results, on_damage)?;
    Ok((plan_of(&sidecar_of(results), &sidecar)?, sidecar))
}

/// Reads the sidecar of a results file.
pub(crate) fn read_sidecar(results: &Path, on_damage: OnDamage) -> Result<Sidecar, Failure> {
    let path = sidecar_of(results);
    let sidecar = match Sidecar::read(&path) {
        Err(SidecarError::Damaged { .. }) if on_damage == OnDamage::Tolerate => Sidecar::read_damaged(&path),
        read => read,
    };
    sidecar.map_err(|error| {
        let is_missing =
            matches!(&error, SidecarError::Io { source, .. } if source.kind() == ErrorKind::NotFound);
        if is_missing && !results.exists() {
            return Failure::missing(results);
        }
        let help = if matches!(error, SidecarError::Damaged { .. }) { IGNORE_HELP } else { SIDECAR_HELP };
        Failure::from(error).help(help)
    })
}

/// Returns the plan with which the results of a sidecar were computed. Error messages contain `path`, the path
/// of the sidecar.
pub(crate) fn plan_of(path: &Path, sidecar: &Sidecar) -> Result<Plan, Failure> {
    sidecar.plan(models::all()).map_err(|error| {
        let failure = Failure::usage(format!("{}: {error}", path.display()));
        match error {
            PlanError::Grid(mistakes) => Failure::Grid(mistakes),
            PlanError::GridText => {
                failure.help("to sweep another grid, write it to a grid file and run `flap sweep GRID`")
            }
            PlanError::PointsFile { .. } => {
                failure.help("restore the file of points, or sweep the grid file again")
            }
            PlanError::Changed(_) => failure,
        }
    })
}

/// Opens results for reading, and prints warnings about the results.
pub(crate) fn open(results: &Path, read: &ReadArgs) -> Result<Opened, Failure> {
    Failure::unless_results(results)?;
    let opened = integrity::open(results, read.on_damage())?;
    for note in &opened.notes {
        tell(note);
    }
    require_checkpoint(results, &opened)?;
    Ok(opened)
}

/// Returns an error if unfinished results have no header. flap writes the header at the first checkpoint.
pub(crate) fn require_checkpoint(results: &Path, opened: &Opened) -> Result<(), Failure> {
    let is_unfinished = opened.notes.iter().any(|note| matches!(note, Note::Unfinished { .. }));
    if !is_unfinished || !opened.reader.names().is_empty() {
        return Ok(());
    }
    let results = results.display();
    let failure =
        Failure::usage(format!("{results} has no rows yet: its sweep has not reached a checkpoint"));
    Err(failure.help(format!("if the sweep is not running, `flap results resume {results}` continues it")))
}

/// Returns an error if the sidecar and the journal of unfinished results describe different sweeps.
pub(crate) fn require_own_sidecar(results: &Path, sidecar: &Sidecar) -> Result<(), Failure> {
    let past = journal::read(&journal_of(results)).ok().flatten();
    let past = past.filter(|_| sidecar.state != State::Complete);
    match past.map(|past| past.header.identity.differences(&sidecar.identity)) {
        Some(differences) if !differences.is_empty() => {
            let damage = integrity::foreign_sidecar(&differences);
            Err(Failure::damaged(format!("{} is damaged: {damage}", results.display())))
        }
        _ => Ok(()),
    }
}

/// Prints a note about a results file as a warning.
pub(crate) fn tell(note: &Note) {
    console::warn(&note.to_string());
}

/// Opens a results file that has a sidecar. Returns the opened results, the plan with which the
/// results were computed, and the sidecar.
pub(crate) fn open_recorded(results: &Path, read: &ReadArgs) -> Result<(Opened, Plan, Sidecar), Failure> {
    Failure::unless_results(results)?;
    Format::of(results)?;
    let (plan, sidecar) = recorded(results, read.on_damage())?;
    require_own_sidecar(results, &sidecar)?;
    Ok((open(results, read)?, plan, sidecar))
}

/// Returns the plan with which a results file was computed. If `point` is a point that the refinement added,
/// the plan includes all added points.
///
/// The function computes the added points again from the rows of the results.
pub(crate) fn with_refinement(
    plan: Plan,
    results: &Path,
    sidecar: &Sidecar,
    point: Option<u64>,
) -> Result<Plan, Failure> {
    let Some(point) = point.filter(|point| plan.refine().is_some() && *point >= plan.len()) else {
        return Ok(plan);
    };
    let done = sidecar.summary.as_ref().map_or(point + 1, Summary::done);
    let unreadable = |error| Failure::system(format!("cannot read {}: {error}", results.display()));
    let mut reader = integrity::open(results, OnDamage::Refuse)?.reader;
    let rows = std::iter::from_fn(|| {
        let mut row = StringRecord::new();
        reader.next(&mut row).map(|found| found.then_some(row)).transpose()
    });
    let replayed = refine::replay(&plan, done, rows).map_err(unreadable)?;
    Ok(replayed.map_or(plan, |(plan, _)| plan))
}

/// Prints a warning about the rows that were left out because the results are damaged.
pub(crate) fn tell_missed(results: &Path, reader: &Reader) {
    if let Some(missed) = reader.missed() {
        console::warn(&format!("{}: {missed}", results.display()));
    }
}
