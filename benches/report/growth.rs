//! Time and memory over the number of points, from the file that `just growth --json FILE` writes.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::spread::{Spread, digits};

pub(crate) fn print(files: &[PathBuf]) {
    println!(
        "## Growth\n\n\
         This section reports the time and memory of `flap sweep` for different numbers of points.\n\
         The grids vary voltage and frequency around the published values of a preset, with `settle_tol` = `rtol`.\n\
         The rows have four measures and go into CSV files.\n\
         [Shards](../glossary.md#shard) run at the same time on one thread each and are then merged.\n\
         Their CPU time includes the merge, and their memory is the memory of the largest process.\n"
    );
    if files.is_empty() {
        println!("Not measured.\n");
    }
    for file in files {
        print_table(file).unwrap_or_else(|| panic!("{} is not what `just growth` writes", file.display()));
    }
}

/// `None` if the file is not as expected.
fn print_table(file: &Path) -> Option<()> {
    let told: Value = serde_json::from_str(&fs::read_to_string(file).ok()?).ok()?;
    println!(
        "![CPU time per point and peak memory over the number of points](../pictures/growth.svg)\n\n\
         `{}` on {}:\n\n\
         | points | rtol | sweep | points per second | CPU time per point, µs | peak memory, MiB | file, MB |\n\
         |---|---|---|---|---|---|---|",
        told["preset"].as_str()?,
        told["processor"].as_str()?
    );
    for run in told["runs"].as_array()? {
        let points = run["points"].as_f64()?;
        let rounds = |name: &str| -> Option<Vec<f64>> {
            run[name].as_array().map(|rounds| rounds.iter().filter_map(Value::as_f64).collect())
        };
        println!(
            "| {points} | {:e} | {} | {} | {} | {} | {} |",
            run["rtol"].as_f64()?,
            run["way"].as_str()?,
            Spread::of(rounds("wall_s")?.iter().map(|seconds| points / seconds)),
            Spread::of(rounds("cpu_s")?.iter().map(|seconds| 1e6 * seconds / points)),
            digits(Spread::of(rounds("peak_mib")?).median()),
            digits(run["bytes"].as_f64()? * 1e-6),
        );
    }
    println!();
    Some(())
}
