//! Shards of a sweep into the file that one machine would have written.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::results::{Checked, Checksums, Format, Provenance, Reader, RowCheck, RowsError, Writer};
use crate::files::sidecar::{Sidecar, State};
use crate::files::tallies;
use crate::plan::Plan;
use crate::plan::selection::{Selection, Shard};
use crate::run::identity::{self, Identity};
use crate::run::{RunOptions, Summary};

/// The results of one shard.
#[derive(Debug)]
pub struct Part {
    /// The result file.
    pub path: PathBuf,
    /// Its sidecar.
    pub sidecar: Sidecar,
}

impl Part {
    /// The shard that its sidecar names.
    fn shard(&self) -> Option<Shard> {
        self.sidecar.shard.as_deref()?.parse().ok()
    }
}

/// Shards that cannot be merged.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// They are not all shards of one sweep, each once. A line for each mistake.
    #[error("{}", .0.join("\n"))]
    Parts(Vec<String>),
    /// A shard cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The shard.
        path: PathBuf,
        /// The reason.
        source: RowsError,
    },
    /// The rows cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// Checks that `parts` are the complete shards of one sweep by this version, each of them once.
///
/// # Errors
/// [`MergeError::Parts`] with all mistakes.
pub fn check(parts: &[Part]) -> Result<(), MergeError> {
    let mut problems = Vec::new();
    let mut seen: BTreeMap<u64, &Path> = BTreeMap::new();
    let mut whole: Option<(&Part, Shard)> = None;
    for part in parts {
        let path = part.path.display();
        if part.sidecar.state != State::Complete {
            problems.push(format!("{path} is not complete"));
        }
        let Some(shard) = part.shard() else {
            problems.push(format!("{path} is not a shard"));
            continue;
        };
        let (first, like) = *whole.get_or_insert((part, shard));
        let differences = whole_of(&part.sidecar).differences(&whole_of(&first.sidecar));
        if !differences.is_empty() {
            let first = first.path.display();
            problems.push(format!("{path} does not belong to {first}: {}", differences.join("; ")));
        } else if shard.of() != like.of() {
            problems.push(format!("{path} is shard {shard}, {} is shard {like}", first.path.display()));
        } else if let Some(other) = seen.insert(shard.number(), &part.path) {
            problems.push(format!("{} and {path} are both shard {shard}", other.display()));
        }
    }
    if let Some((first, shard)) = whole {
        let (ours, build) = (env!("CARGO_PKG_VERSION"), identity::build());
        let theirs = &first.sidecar;
        if theirs.flap != ours {
            problems.push(format!("the shards are by flap {}, this is flap {ours}", theirs.flap));
        } else if theirs.build != build {
            let theirs = if theirs.build.is_empty() { "an unknown build" } else { &theirs.build };
            problems
                .push(format!("the shards are by another build of flap {ours}: {theirs}, this is {build}"));
        }
        let missing: Vec<String> = (1..=shard.of())
            .filter(|number| !seen.contains_key(number))
            .map(|number| format!("{number}/{}", shard.of()))
            .collect();
        match missing.len() {
            0 => {}
            1 => problems.push(format!("shard {} is missing", missing[0])),
            many => problems.push(format!("{many} shards are missing, the first is {}", missing[0])),
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(MergeError::Parts(problems)) }
}

/// The identity of the rows of all shards together.
fn whole_of(sidecar: &Sidecar) -> Identity {
    Identity { selection: Selection::All.to_string(), ..sidecar.identity() }
}

/// Writes the rows of `parts` to `to` in the order of their points. [`check`] has passed the parts; `readers` read them, in the
/// same order. Rows of tolerant readers that do not belong to their shard are left out.
///
/// # Errors
/// - [`MergeError::Read`] if a shard cannot be read, or does not hold the rows that its sidecar records
/// - [`MergeError::Write`] if rows cannot be written
pub fn merge(
    parts: &[Part],
    readers: &mut [Reader],
    plan: &Plan,
    to: (File, Format),
) -> Result<Checksums, MergeError> {
    let identity = parts
        .first()
        .map_or_else(|| Identity::of(plan, &RunOptions::default()), |first| whole_of(&first.sidecar));
    let mut sources = Vec::with_capacity(parts.len());
    // The next row of every shard, the first point on top.
    let mut next = BinaryHeap::with_capacity(parts.len());
    for (part, reader) in parts.iter().zip(readers) {
        let mut source = Source::new(part, reader, plan)?;
        next.extend(source.advance()?.map(|point| Reverse((point, sources.len()))));
        sources.push(source);
    }
    let mut writer = Writer::new(to.0, to.1, &Provenance::of(plan, &identity))?;
    while let Some(Reverse((_, number))) = next.pop() {
        let source = &mut sources[number];
        writer.row(source.rows.row())?;
        next.extend(source.advance()?.map(|point| Reverse((point, number))));
    }
    Ok(writer.finish()?)
}

/// The rows of one shard.
struct Source<'a> {
    path: &'a Path,
    rows: Checked<'a>,
}

impl Source<'_> {
    fn new<'a>(part: &'a Part, reader: &'a mut Reader, plan: &Plan) -> Result<Source<'a>, MergeError> {
        let selection = part.shard().map_or(Selection::All, Selection::Shard);
        let check = RowCheck::of(plan, selection, part.sidecar.rows);
        let rows = Checked::new(reader, check)
            .map_err(|source| MergeError::Read { path: part.path.clone(), source })?;
        Ok(Source { path: &part.path, rows })
    }

    /// Reads the next row, and gives its point.
    fn advance(&mut self) -> Result<Option<u64>, MergeError> {
        self.rows.next().map_err(|source| MergeError::Read { path: self.path.to_owned(), source })
    }
}

/// The summary of all shards together.
pub fn summary(parts: &[Part], plan: &Plan) -> Summary {
    let sidecars = || parts.iter().map(|part| &part.sidecar);
    let total = |number: fn(&Sidecar) -> Option<u64>| sidecars().filter_map(number).sum();
    let unsatisfied = |name: &str| {
        let counts = sidecars().filter_map(|sidecar| sidecar.unsatisfied.get(name));
        (name.to_owned(), counts.sum())
    };
    let invalid = sidecars().flat_map(|sidecar| &sidecar.invalid);
    let mut invalid: Vec<(u64, String)> = invalid.map(From::from).collect();
    invalid.sort_unstable();
    invalid.truncate(Summary::MOST_REASONS);
    Summary {
        points: plan.len(),
        // A row for each.
        ran: total(|sidecar| sidecar.rows),
        begun: 0,
        rows: total(|sidecar| sidecar.rows),
        excluded: total(|sidecar| sidecar.excluded),
        unsatisfied: plan.conditions().iter().map(|condition| unsatisfied(&condition.name)).collect(),
        interrupted: false,
        counts: tallies::total(sidecars().filter_map(|sidecar| sidecar.statuses.as_ref())),
        rhs_evals: total(|sidecar| sidecar.rhs_evals),
        cycles: total(|sidecar| sidecar.cycles),
        doubts: sidecars().filter_map(|sidecar| sidecar.doubts).sum(),
        invalid,
    }
}
