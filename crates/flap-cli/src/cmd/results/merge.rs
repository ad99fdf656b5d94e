//! `flap results merge`: joins the shards of a sweep into one file.

use std::path::Path;

use flap_sweep::files::beside::sidecar_of;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::integrity::{Note, OnDamage};
use flap_sweep::files::merge::{self, MergeError, OnBuilds, Part};
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::notation::text::count;
use flap_sweep::run::identity::{self, Identity};

use crate::args::MergeArgs;
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure};
use crate::{job, system};

pub(super) fn run(args: &MergeArgs) -> Result<Exit, Failure> {
    let to_stdout = is_stdout(&args.out);
    let format = if to_stdout { Format::Csv } else { Format::of(&args.out)? };
    let mut inputs = Inputs::new();
    for shard in &args.shards {
        Failure::unless_results(shard)?;
        inputs.add_results("the shard", shard);
    }
    inputs.protect_from_results(&args.out)?;
    let on_damage = args.read.on_damage();
    let parts = args.shards.iter().map(|path| part(path, on_damage)).collect::<Result<Vec<_>, _>>()?;
    merge::check(&parts, if args.mixed_builds { OnBuilds::Mix } else { OnBuilds::Refuse })?;
    let (Some(first), Some(mut whole)) = (parts.first(), merge::sidecar(&parts)) else {
        return Err(Failure::usage("give the result files of the shards to merge"));
    };
    let plan = job::plan_of(&sidecar_of(&first.path), &first.sidecar)?.with_all_points();
    let Identity { flap, build, .. } = &whole.identity;
    if build != identity::build() {
        console::say(&format!("the sidecar records build {build} of flap {flap} for these rows"));
    }

    Inputs::new().add_plan(&plan).protect_from_results(&args.out)?;
    let mut readers = Vec::with_capacity(parts.len());
    let mut is_damaged = false;
    for part in &parts {
        let opened = job::open(&part.path, &args.read)?;
        is_damaged |= opened.notes.iter().any(|note| matches!(note, Note::Damaged { .. }));
        readers.push(opened.reader);
    }
    if to_stdout {
        merge::merge(&parts, &mut readers, &plan, &whole, (system::stdout()?, format))?;
        tell_missed(&parts, &readers);
        return Ok(Exit::Done);
    }

    let rows = whole.rows().unwrap_or_default();
    job::make(&args.out, args.overwrite.force, |target| {
        let checksums = merge::merge(&parts, &mut readers, &plan, &whole, (target, format))?;
        // Rows that were damaged before must not count as sound.
        whole.checksums = Some(checksums).filter(|_| !is_damaged);
        Ok::<_, MergeError>(Some(whole))
    })??;
    tell_missed(&parts, &readers);
    let (rows, shards) = (count(rows, "row"), count(parts.len() as u64, "shard"));
    console::say(&format!("{rows} of {shards} in {}", args.out.display()));
    Ok(Exit::Done)
}

fn part(path: &Path, on_damage: OnDamage) -> Result<Part, Failure> {
    Ok(Part { path: path.to_owned(), sidecar: job::read_sidecar(path, on_damage)? })
}

fn tell_missed(parts: &[Part], readers: &[Reader]) {
    for (part, reader) in parts.iter().zip(readers) {
        job::tell_missed(&part.path, reader);
    }
}
