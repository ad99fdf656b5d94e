//! `flap sweep`: every point of a grid file, one row each.

use std::path::{Path, PathBuf};

use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::results::Format;
use flap_sweep::files::sidecar::{Origin, Sidecar};
use flap_sweep::grid;
use flap_sweep::plan::Plan;
use flap_sweep::plan::selection::Shard;
use flap_sweep::study::deviation;

use crate::args::SweepArgs;
use crate::cmd::far;
use crate::failure::{Exit, Failure};
use crate::job::{self, Begin};
use crate::models;

pub(crate) fn run(args: &SweepArgs) -> Result<Exit, Failure> {
    let (mut plan, origin) = plan(args)?;
    let mut out = args.out.clone();
    if let Some(shard) = args.shard {
        plan = plan.with_shard(shard);
        let default = default_path(&plan, args.grid.as_deref());
        out = out.or_else(|| Some(name_of_shard(&default, shard)));
    }
    let out = out.unwrap_or_else(|| default_path(&plan, args.grid.as_deref()));
    if out.as_os_str() == "-" && args.resume {
        return Err(Failure::usage("what was written to stdout cannot be resumed"));
    }
    if let Some(sidecar) = &args.from_sidecar {
        Inputs::new().add("the sidecar", sidecar).protect_from_results(&out)?;
    }
    far::warn(&deviation::of(&plan));
    job::run(&plan, out, Begin::of(args.resume, args.begin.force), &args.begin.work, origin)
}

/// The plan, and the origin of its points if it is the plan of a rerun.
fn plan(args: &SweepArgs) -> Result<(Plan, Option<Origin>), Failure> {
    if let Some(path) = &args.from_sidecar {
        let sidecar = Sidecar::read(path)?;
        return Ok((job::plan_of(path, &sidecar)?, sidecar.origin().cloned()));
    }
    let grid = args.grid.as_ref().ok_or_else(|| Failure::usage("name a grid file with --grid"))?;
    Ok((grid::read(grid, models::all())?, None))
}

/// The file of the rows by default.
fn default_path(plan: &Plan, grid: Option<&Path>) -> PathBuf {
    let named_after_grid = || {
        let mut name = grid.and_then(Path::file_stem).unwrap_or_default().to_owned();
        name.push(".csv");
        PathBuf::from(name)
    };
    plan.output().path.clone().unwrap_or_else(named_after_grid)
}

/// The name of a shard's rows: `grid.2of8.csv` for `grid.csv`.
fn name_of_shard(whole: &Path, shard: Shard) -> PathBuf {
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    let (stem, ending) = Format::split_ending(&name);
    whole.with_file_name(format!("{stem}.{}of{}{ending}", shard.number(), shard.of()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_shards() {
        let shard: Shard = "2/8".parse().unwrap();
        for (whole, name) in [
            ("grid.csv", "grid.2of8.csv"),
            ("a/b.x.csv.zst", "a/b.x.2of8.csv.zst"),
            ("grid.parquet", "grid.2of8.parquet"),
            ("grid", "grid.2of8"),
        ] {
            assert_eq!(name_of_shard(Path::new(whole), shard), Path::new(name));
        }
    }
}
