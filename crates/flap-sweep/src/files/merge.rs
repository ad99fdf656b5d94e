//! Merges the shards of a sweep into one file. The merged file equals the result file of the same sweep on
//! one machine.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::results::{Checked, Checksums, Format, Provenance, Reader, RowCheck, RowsError, Writer};
use crate::files::sidecar::{Sidecar, State};
use crate::plan::Plan;
use crate::plan::selection::{Selection, Shard};
use crate::run::Summary;
use crate::run::identity::Identity;

/// Results of one shard.
#[derive(Debug)]
pub struct Part {
    /// Result file.
    pub path: PathBuf,
    /// Sidecar of the results.
    pub sidecar: Sidecar,
}

impl Part {
    /// Returns the shard that the sidecar records.
    fn shard(&self) -> Option<Shard> {
        self.sidecar.shard.as_deref()?.parse().ok()
    }
}

/// Reason why shards cannot be merged.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// Shards are missing, unfinished, from different sweeps, or given twice. The error contains one line of
    /// text for each mistake.
    #[error("{}", .0.join("\n"))]
    Parts(Vec<String>),
    /// Different builds of flap computed the shards. The error contains, for each build, the first shard
    /// that this build computed.
    #[error("the shards were computed by several builds of flap, whose rows may differ: {}", .0.join(", "))]
    Builds(Vec<String>),
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

/// Rule for shards that different builds of flap have computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnBuilds {
    /// Shards of different builds are rejected, because rows of different builds may differ.
    Refuse,
    /// Shards of different builds are merged, and the sidecar lists all builds.
    Mix,
}

/// Checks that `parts` contains every shard of one sweep exactly once, and that every shard is complete.
///
/// The check computes no rows, so the build of flap that computed the shards may differ from this build.
///
/// # Errors
/// - [`MergeError::Parts`] with all mistakes.
/// - [`MergeError::Builds`] if different builds of flap computed the parts, and `on_builds` is
///   [`OnBuilds::Refuse`].
pub fn check(parts: &[Part], on_builds: OnBuilds) -> Result<(), MergeError> {
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
        let differences = shared(&part.sidecar).differences(&shared(&first.sidecar));
        if !differences.is_empty() {
            let first = first.path.display();
            problems.push(format!("{path} does not belong to {first}: {}", differences.join("; ")));
        } else if shard.of() != like.of() {
            problems.push(format!("{path} is shard {shard}, but {} is shard {like}", first.path.display()));
        } else if let Some(other) = seen.insert(shard.number(), &part.path) {
            problems.push(format!("{} and {path} are both shard {shard}", other.display()));
        }
    }
    if let Some((_, shard)) = whole {
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
    if !problems.is_empty() {
        return Err(MergeError::Parts(problems));
    }
    let mut builds: BTreeMap<(&str, &str), &Path> = BTreeMap::new();
    for Part { path, sidecar } in parts {
        builds.entry((&sidecar.identity.flap, &sidecar.identity.build)).or_insert(path);
    }
    if builds.len() > 1 && on_builds == OnBuilds::Refuse {
        let by = |((flap, build), path): (&(&str, &str), &&Path)| {
            format!("{} by build {build} of flap {flap}", path.display())
        };
        return Err(MergeError::Builds(builds.iter().map(by).collect()));
    }
    Ok(())
}

/// Returns the settings that determine the rows of a shard, without the number of the shard and without the
/// build of flap. The returned settings are equal for all shards of one sweep.
fn shared(sidecar: &Sidecar) -> Identity {
    let (flap, build) = (String::new(), String::new());
    Identity { flap, build, selection: Selection::All.to_string(), ..sidecar.identity.clone() }
}

/// Returns the sidecar for the merged rows of all `parts`. The sidecar contains no checksums. Returns `None`
/// if `parts` is empty.
///
/// The sidecar resembles the sidecar of a sweep on one machine, but lists the versions and builds of all
/// shards. The sidecar contains the sum of the threads of all shards, and the sum of the durations of all
/// shards.
pub fn sidecar(parts: &[Part]) -> Option<Sidecar> {
    let sidecars = || parts.iter().map(|part| &part.sidecar);
    let all = |name: fn(&Sidecar) -> &String| {
        let names: BTreeSet<&str> = sidecars().map(|sidecar| name(sidecar).as_str()).collect();
        names.into_iter().collect::<Vec<_>>().join(", ")
    };
    let mut whole = parts.first()?.sidecar.clone();
    whole.identity = Identity {
        flap: all(|sidecar| &sidecar.identity.flap),
        build: all(|sidecar| &sidecar.identity.build),
        selection: Selection::All.to_string(),
        ..whole.identity
    };
    whole.shard = None;
    whole.started = sidecars().map(|sidecar| sidecar.started.clone()).min()?;
    whole.threads = sidecars().map(|sidecar| sidecar.threads).sum();
    whole.checksums = None;
    let finished = sidecars().filter_map(|sidecar| sidecar.finished.clone()).max().unwrap_or_default();
    let seconds = sidecars().filter_map(|sidecar| sidecar.seconds).sum();
    let mut summary = Summary::default();
    sidecars().filter_map(|sidecar| sidecar.summary.as_ref()).for_each(|part| summary.add_all(part));
    whole.finish(&summary, finished, seconds);
    Some(whole)
}

/// Writes the rows of all `parts` into the file `to`, in the order of the points.
///
/// `parts` must have passed [`check`]. `whole` is the result of [`sidecar`] for all `parts`. `readers`
/// contains one reader for each part, in the order of `parts`. A tolerant reader leaves out rows that do not
/// belong to the shard.
///
/// # Errors
/// - [`MergeError::Read`] if a shard cannot be read, or does not contain the rows that its sidecar records.
/// - [`MergeError::Write`] if rows cannot be written.
pub fn merge(
    parts: &[Part],
    readers: &mut [Reader],
    plan: &Plan,
    whole: &Sidecar,
    to: (File, Format),
) -> Result<Checksums, MergeError> {
    let mut sources = Vec::with_capacity(parts.len());
    // The next row of every shard, with the first point on top.
    let mut next = BinaryHeap::with_capacity(parts.len());
    let unreadable =
        |number: usize| move |source| MergeError::Read { path: parts[number].path.clone(), source };
    for (number, (part, reader)) in parts.iter().zip(readers).enumerate() {
        let selection = part.shard().map_or(Selection::All, Selection::Shard);
        let check = RowCheck::of(plan, selection, part.sidecar.rows());
        let mut source = Checked::new(reader, check).map_err(unreadable(number))?;
        next.extend(source.next().map_err(unreadable(number))?.map(|point| Reverse((point, number))));
        sources.push(source);
    }
    let mut writer = Writer::new(to.0, to.1, &Provenance::of(plan, &whole.identity))?;
    while let Some(Reverse((_, number))) = next.pop() {
        let source = &mut sources[number];
        writer.row(source.row())?;
        next.extend(source.next().map_err(unreadable(number))?.map(|point| Reverse((point, number))));
    }
    Ok(writer.finish()?)
}
