//! Writes docs/evidence/performance.md to stdout: the speed of flap on this machine, measured in this run.
//!
//! ```sh
//! just bench-report
//! ```
//!
//! Compared programs run in turn, so that other work on the machine slows all of them. Numbers are medians, with the smallest
//! and the largest value. Without `--bench` the report covers a few points only, to test the program.
#![expect(clippy::print_stdout, reason = "a bench reports")]

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[path = "../../tests/instructions/counter.rs"]
mod counter;
#[path = "../../examples/own_equations/equations.rs"]
#[allow(dead_code, unreachable_pub, missing_docs, reason = "an example, of which the equations are used")]
mod equations;

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod executed;
mod grid;
mod growth;
mod machine;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod peak;
mod peers;
mod presets;
mod spread;
mod whole;

use std::path::PathBuf;

/// Amount of work.
#[derive(Clone, Copy)]
struct Effort {
    /// Rounds of each comparison.
    rounds: usize,
    /// Points per side of the grid of each preset.
    side: usize,
    /// Points of the whole sweep.
    points: usize,
    /// Timed drive periods for the share of the peak.
    periods: u64,
}

const MEASURED: Effort = Effort { rounds: 5, side: 24, points: 10_000, periods: 2000 };
const TRIAL: Effort = Effort { rounds: 1, side: 3, points: 50, periods: 2 };

fn main() {
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    if let Some(name) = counter::work_of_child() {
        counter::be_counted(|mark| peak::march_by_name(&name, mark)).expect("this process may be traced");
        return;
    }

    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let effort = if arguments.iter().any(|argument| argument == "--bench") { MEASURED } else { TRIAL };

    println!("# Performance\n\n<!-- keywords: performance, speed, benchmark, memory -->\n");
    println!(
        "<!-- The command `just bench-report` writes this page. Change the texts in benches/report. -->\n"
    );
    println!(
        "This page reports the speed and memory of flap, and compares flap with other solvers.\n\
         The numbers differ between machines. If the text above a table names no processor, the numbers are from the machine in the section [Machine](#machine).\n\
         Measured numbers are medians of repeated measurements, with the smallest and the largest value in parentheses.\n"
    );
    machine::print();
    peers::print(&files_of(&arguments, "--peers"));
    presets::print(effort);
    whole::print(effort);
    growth::print(&files_of(&arguments, "--growth"));
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    peak::print(effort);
}

/// The files after an option, up to the next option.
fn files_of(arguments: &[String], option: &str) -> Vec<PathBuf> {
    let behind = arguments.iter().skip_while(|argument| *argument != option).skip(1);
    behind.take_while(|argument| !argument.starts_with('-')).map(PathBuf::from).collect()
}
