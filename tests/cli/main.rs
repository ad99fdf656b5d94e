//! The `flap` command as users run it: its output streams, its files, and its exit codes.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

mod again;
mod companions;
mod completion;
mod control;
mod damage;
mod deviations;
mod devices;
mod documents;
mod doubts;
mod experiments;
mod formats;
mod formulas;
mod gradient;
mod hover;
mod inputs;
mod irregular;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod kills;
mod lists;
mod live;
mod look;
mod mistakes;
mod optimise;
mod plot;
mod point;
mod refine;
mod replaced;
mod rerun;
mod resonance;
mod respond;
mod resume;
mod schema;
mod shards;
mod streams;
mod support;
mod sweep;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod trace;
mod vehicle;
mod wings;
mod wrench_map;
