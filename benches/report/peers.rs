//! flap beside other solvers, out of what `just peers --json FILE` has measured.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::spread::Spread;

pub(crate) fn print(files: &[PathBuf]) {
    println!(
        "## Beside other solvers\n\nThe equations of `examples/own_equations`, the same points for all, in turn on one core: \
         see [benches/peers](../benches/peers/README.md).\n"
    );
    if files.is_empty() {
        println!("Not measured.\n");
    }
    for file in files {
        print_table(file).unwrap_or_else(|| panic!("{} is not what `just peers` writes", file.display()));
    }
}

/// `None` if the file is not as expected.
fn print_table(file: &Path) -> Option<()> {
    let told: Value = serde_json::from_str(&fs::read_to_string(file).ok()?).ok()?;
    let mut peers: Vec<&Value> = told["peers"].as_array()?.iter().collect();
    let speed = |peer: &Value| peer["points_per_cpu_second"]["median"].as_f64().unwrap_or(0.0);
    peers.sort_by(|a, b| speed(b).total_cmp(&speed(a)));
    let flap = peers.iter().find(|peer| peer["name"] == "flap").map(|flap| rounds(flap));

    println!(
        "{} points at rtol {:e}, {} rounds on {}:\n\n\
         | solver | points per CPU-second | rate of flap over this rate | median deviation | remarks |\n|---|---|---|---|---|",
        told["points"],
        told["rtol"].as_f64()?,
        told["rounds"],
        told["processor"].as_str()?
    );
    for peer in peers {
        let ratio = flap.as_ref().map(|flap| Spread::of_ratios(flap, &rounds(peer)));
        let deviation = peer["integration_deviation"]["median"].as_f64();
        let remarks: Vec<&str> = peer["remarks"].as_array()?.iter().filter_map(Value::as_str).collect();
        println!(
            "| {} | {} | {} | {} | {} |",
            peer["what"].as_str()?,
            Spread::of(rounds(peer)),
            ratio.filter(|_| peer["name"] != "flap").map_or("–".into(), |ratio| ratio.to_string()),
            deviation.map_or("–".into(), |deviation| format!("{deviation:.1e}")),
            remarks.join("; ")
        );
    }
    for skipped in told["skipped"].as_array()? {
        println!("\nSkipped: {}: {}.", skipped["name"].as_str()?, skipped["why"].as_str()?);
    }
    println!();
    Some(())
}

fn rounds(peer: &Value) -> Vec<f64> {
    let rounds = peer["points_per_cpu_second"]["rounds"].as_array();
    rounds.into_iter().flatten().filter_map(Value::as_f64).collect()
}
