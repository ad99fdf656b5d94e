//! flap beside other solvers, out of what `just peers --json FILE` has measured.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::spread::{Spread, digits};

/// A work of the benchmark, with its name in the files.
struct Work {
    name: &'static str,
    text: &'static str,
}

const WORKS: [Work; 3] = [
    Work {
        name: "integration",
        text: "## Beside other solvers\n\n\
               All solvers integrate the equations of `examples/own_equations` for the same points, one solver after the other on one core.\n\
               The error of a point is the largest relative error of its measures; the tables have the median over the points.\n\
               [Comparison with other solvers](../../benches/peers/README.md) describes the programs and the measurement.\n",
    },
    Work {
        name: "settled",
        text: "## Settled motions beside other solvers\n\n\
               Except in the last table of this section, the points are `jafferis2016` at voltages of 120 to 200 V and frequencies of 102 to 132 Hz.\n\
               Each motion starts at rest, runs until a drive period changes the state by at most 1e-6, and is measured over the next drive period.\n\
               The other solvers [march](../glossary.md#march) until the motion is settled.\n\
               flap runs as the command `flap sweep`, which writes rows with all columns.\n\
               The unit of the rate of `flap sweep` is [verified periodic orbits per second and core](../../benches/peers/README.md#verified-periodic-orbits-per-second).\n",
    },
    Work {
        name: "responses",
        text: "The next table covers the frequency responses of `examples/jafferis_fig4.toml` (40 to 240 V, 40 to 200 Hz), \
               where some motions settle slowly.\n",
    },
];

pub(crate) fn print(files: &[PathBuf]) {
    let results: Vec<(&PathBuf, Value)> = files.iter().map(|file| (file, read(file))).collect();
    for work in WORKS {
        println!("{}", work.text);
        let mut of_work = results.iter().filter(|(_, told)| told["work"] == work.name).peekable();
        if of_work.peek().is_none() {
            println!("Not measured.\n");
        }
        for (file, told) in of_work {
            print_table(told).unwrap_or_else(|| panic!("{} is not what `just peers` writes", file.display()));
        }
    }
}

fn read(file: &Path) -> Value {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// `None` if the results are not as expected.
fn print_table(told: &Value) -> Option<()> {
    let mut peers: Vec<&Value> = told["peers"].as_array()?.iter().collect();
    let speed = |peer: &Value| peer["points_per_cpu_second"]["median"].as_f64().unwrap_or(0.0);
    peers.sort_by(|a, b| speed(b).total_cmp(&speed(a)));
    let flap = peers.iter().find(|peer| peer["name"] == "flap").map(|flap| rounds(flap));

    let counted = peers.iter().any(|peer| peer["periods_per_point"].is_number());
    println!(
        "The next table is for {} points at rtol {:e}, measured {} times on {}:\n\n\
         | solver | points per CPU-second | rate of flap divided by rate of the solver |{} median relative error | remarks |\n\
         |---|---|---|{}---|---|",
        told["points"],
        told["rtol"].as_f64()?,
        told["rounds"],
        told["processor"].as_str()?,
        if counted { " drive periods per point |" } else { "" },
        if counted { "---|" } else { "" }
    );
    for peer in peers {
        let ratio = flap.as_ref().map(|flap| Spread::of_ratios(flap, &rounds(peer)));
        let periods = peer["periods_per_point"].as_f64().map_or("–".into(), digits);
        let deviation = peer["integration_deviation"]["median"].as_f64();
        let remarks: Vec<&str> = peer["remarks"].as_array()?.iter().filter_map(Value::as_str).collect();
        println!(
            "| {} | {} | {} |{} {} | {} |",
            peer["what"].as_str()?,
            Spread::of(rounds(peer)),
            ratio.filter(|_| peer["name"] != "flap").map_or("–".into(), |ratio| ratio.to_string()),
            if counted { format!(" {periods} |") } else { String::new() },
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
