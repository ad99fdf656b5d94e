//! `flap sweep`: runs every point of a grid file and writes one row for each point.

use std::path::{Path, PathBuf};

use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::results::Format;
use flap_sweep::files::sidecar::{Origin, Sidecar};
use flap_sweep::plan::Plan;
use flap_sweep::plan::selection::Shard;
use flap_sweep::study::deviation;

use crate::args::SweepArgs;
use crate::cmd::{deviations, grid};
use crate::failure::{Exit, Failure};
use crate::job;

pub(crate) fn run(args: &SweepArgs) -> Result<Exit, Failure> {
    let grid = args.grid();
    let is_sidecar = grid.to_string_lossy().ends_with(".meta.toml");
    let (mut plan, origin) = if is_sidecar { repeated(args)? } else { (grid::read(grid)?, None) };
    if let Some(shard) = args.shard {
        plan = plan.with_shard(shard);
    }
    let out = match &args.out {
        Some(out) => out.clone(),
        None => default_path(&plan, args)?,
    };
    if is_sidecar {
        Inputs::new().add("the sidecar", grid).protect_from_results(&out)?;
    }
    deviations::warn(&deviation::of(&plan));
    job::run(&plan, out, args.begin.on_existing(), &args.begin.work, origin)
}

/// Returns the plan of the sweep that the sidecar of earlier results records. If the earlier results are a
/// rerun, also returns the results from which the points of the rerun were chosen.
fn repeated(args: &SweepArgs) -> Result<(Plan, Option<Origin>), Failure> {
    let path = args.grid();
    if args.shard.is_some() {
        return Err(Failure::usage(
            "a sidecar has its own selection of points: --shard requires a grid file",
        ));
    }
    if args.out.is_none() {
        return Err(Failure::usage("a sidecar as input requires a name for the new results")
            .help("name the file of the results with --out FILE"));
    }
    let sidecar = Sidecar::read(path)?;
    Ok((job::plan_of(path, &sidecar)?, sidecar.origin().cloned()))
}

/// Returns the path of the file for the rows if the user did not give `--out`.
fn default_path(plan: &Plan, args: &SweepArgs) -> Result<PathBuf, Failure> {
    let whole = match &plan.output().path {
        Some(path) => path.clone(),
        None if grid::is_stdin(args.grid()) => {
            let failure = Failure::usage("a grid from stdin requires a name for its results");
            return Err(failure.help(
                "name the file of the results with --out FILE, or with `path` in [output] of the grid",
            ));
        }
        None => {
            let mut name = args.grid().file_stem().unwrap_or_default().to_owned();
            name.push(".csv");
            PathBuf::from(name)
        }
    };
    Ok(args.shard.map_or_else(|| whole.clone(), |shard| name_of_shard(&whole, shard)))
}

/// Returns the name of the file for the rows of a shard, such as `grid.2of8.csv` for `grid.csv`.
fn name_of_shard(whole: &Path, shard: Shard) -> PathBuf {
    Format::with_word(whole, &format!("{}of{}", shard.number(), shard.of()))
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
