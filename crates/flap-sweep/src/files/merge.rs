//! Shards of a sweep into the file that one machine would have written.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use flap_core::simulate::Status;

use crate::files::integrity::RowCheck;
use crate::files::results::{Checksums, Format, Provenance, Reader, Writer};
use crate::files::sidecar::{Sidecar, State};
use crate::plan::Plan;
use crate::plan::selection::{Selection, Shard};
use crate::run::identity::{self, Identity};
use crate::run::{RunOptions, Summary};

/// The results of one shard.
#[derive(Debug)]
pub struct Part {
    /// The result file.
    pub path: PathBuf,
    /// What lies beside it.
    pub sidecar: Sidecar,
}

/// Why shards cannot be merged.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// They are not all shards of one sweep, each once: everything that is wrong.
    #[error("{}", .0.join("\n"))]
    Parts(Vec<String>),
    /// A shard cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The shard.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The rows cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// Checks that `parts` are the complete shards of one sweep by this version, each of them once.
///
/// # Errors
/// [`MergeError::Parts`] with all that is wrong.
pub fn check(parts: &[Part]) -> Result<(), MergeError> {
    let mut problems = Vec::new();
    let mut seen: BTreeMap<u64, &Path> = BTreeMap::new();
    let mut whole: Option<(&Part, Shard)> = None;
    for part in parts {
        let path = part.path.display();
        if part.sidecar.state != State::Complete {
            problems.push(format!("{path} is not complete"));
        }
        let shard: Option<Shard> = part.sidecar.shard.as_deref().and_then(|shard| shard.parse().ok());
        let Some(shard) = shard else {
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

/// What the rows are that the shard is a part of.
fn whole_of(sidecar: &Sidecar) -> Identity {
    Identity { selection: Selection::All.to_string(), ..sidecar.identity() }
}

/// Writes the rows of `parts`, which [`check`] has passed, and each of which one of `readers` reads, to `to` in the order of
/// their points.
///
/// # Errors
/// If a shard cannot be read or does not hold the rows that its sidecar tells of, or rows cannot be written. Rows that tolerant
/// readers give and that are none of their shard are left out.
pub fn merge(
    parts: &[Part],
    readers: &mut [Reader],
    plan: &Plan,
    to: (File, Format),
) -> Result<Checksums, MergeError> {
    let identity = parts
        .first()
        .map_or_else(|| Identity::of(plan, &RunOptions::default()), |first| whole_of(&first.sidecar));
    let provenance = Provenance::of(plan, &identity);
    let mut sources = Vec::with_capacity(parts.len());
    // The next row of every shard, the first point on top.
    let mut next = BinaryHeap::with_capacity(parts.len());
    for (part, reader) in parts.iter().zip(readers) {
        let mut source = Source::new(part, reader, plan, &provenance)?;
        next.extend(source.advance()?.map(|point| Reverse((point, sources.len()))));
        sources.push(source);
    }
    let mut writer = Writer::new(to.0, to.1, &provenance)?;
    while let Some(Reverse((_, number))) = next.pop() {
        let source = &mut sources[number];
        writer.row(&source.row)?;
        next.extend(source.advance()?.map(|point| Reverse((point, number))));
    }
    Ok(writer.finish()?)
}

/// The rows of one shard.
struct Source<'a> {
    path: &'a Path,
    reader: &'a mut Reader,
    check: RowCheck,
    row: StringRecord,
}

impl Source<'_> {
    fn new<'a>(
        part: &'a Part,
        reader: &'a mut Reader,
        plan: &Plan,
        provenance: &Provenance,
    ) -> Result<Source<'a>, MergeError> {
        let shard = part.sidecar.shard.as_deref().and_then(|shard| shard.parse().ok());
        let selection = shard.map_or(Selection::All, Selection::Shard);
        let mut check = RowCheck::of(plan, selection, part.sidecar.rows);
        if reader.is_tolerant() {
            check.allow_gaps();
        }
        let source = Source { path: &part.path, reader, check, row: StringRecord::new() };
        if !source.reader.names().iter().eq(provenance.columns.iter().map(|column| &column.name)) {
            return Err(source.wrong("its columns are not those of its grid file"));
        }
        Ok(source)
    }

    /// Reads the next row, and gives its point.
    fn advance(&mut self) -> Result<Option<u64>, MergeError> {
        let read = |source| MergeError::Read { path: self.path.to_owned(), source };
        while self.reader.next(&mut self.row).map_err(read)? {
            match self.check.row(&self.row) {
                Ok(point) => return Ok(Some(point)),
                Err(_) if self.reader.leave_out() => {}
                Err(reason) => return Err(self.wrong(&reason)),
            }
        }
        self.check.end().map_err(|reason| self.wrong(&reason))?;
        Ok(None)
    }

    fn wrong(&self, message: &str) -> MergeError {
        let source = io::Error::new(io::ErrorKind::InvalidData, message);
        MergeError::Read { path: self.path.to_owned(), source }
    }
}

/// What the shards came to together.
pub fn summary(parts: &[Part], plan: &Plan) -> Summary {
    let sidecars = || parts.iter().map(|part| &part.sidecar);
    let total = |number: fn(&Sidecar) -> Option<u64>| sidecars().filter_map(number).sum();
    let count = |status: Status| {
        let of_shard = |sidecar: &Sidecar| sidecar.statuses.as_ref()?.get(status.name()).copied();
        (status, sidecars().filter_map(of_shard).sum())
    };
    let unsatisfied = |name: &str| {
        let counts = sidecars().filter_map(|sidecar| sidecar.unsatisfied.get(name));
        (name.to_owned(), counts.sum())
    };
    let invalid = sidecars().flat_map(|sidecar| &sidecar.invalid);
    let mut invalid: Vec<_> = invalid.map(|invalid| (invalid.point, invalid.reason.clone())).collect();
    invalid.sort_unstable();
    invalid.truncate(Summary::MOST_REASONS);
    Summary {
        points: plan.len(),
        rows: total(|sidecar| sidecar.rows),
        excluded: total(|sidecar| sidecar.excluded),
        unsatisfied: plan.conditions.iter().map(|condition| unsatisfied(&condition.name)).collect(),
        interrupted: false,
        counts: Status::ALL.into_iter().map(count).collect(),
        rhs_evals: total(|sidecar| sidecar.rhs_evals),
        cycles: total(|sidecar| sidecar.cycles),
        doubts: sidecars().filter_map(|sidecar| sidecar.doubts).sum(),
        invalid,
    }
}
