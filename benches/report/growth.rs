//! Time and memory over the number of points, from the file that `just growth --json FILE` writes.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::spread::{Spread, digits};

pub(crate) fn print(files: &[PathBuf]) {
    println!(
        "## Growth\n\n\
         This section reports the time and memory of `flap sweep` for different numbers of points.\n\
         The grids vary voltage and frequency around the published values of a preset; the tolerance `settle_tol` equals `rtol`.\n\
         Each row has four measures, and the rows go into CSV files.\n\
         `just bench-report` measures with one and two threads; `just growth --threads 1,2,4,8,16 --shards 16` measures with up to 16 threads.\n\
         [Shards](../glossary.md#shard) run at the same time, each on one thread, and the files of all shards are merged afterwards.\n\
         The CPU time of shards includes the merge, and the memory of shards is the memory of the largest process.\n"
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
         The next table is for sweeps of `{}` on {} with {} hardware threads:\n\n\
         | points | rtol | sweep | points per second | CPU time per point, µs | peak memory, MiB | file, MB |\n\
         |---|---|---|---|---|---|---|",
        told["preset"].as_str()?,
        told["processor"].as_str()?,
        told["hardware_threads"].as_u64()?
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
