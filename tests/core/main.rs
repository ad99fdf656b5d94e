//! Tests of flap-core, from elementary functions to published operating points.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::ignored_unit_patterns,
    reason = "tests may panic and print, and their numbers are small"
)]

mod accuracy;
mod bimorph;
mod body;
mod by_name;
mod continued;
mod data;
mod direct_drive;
mod dormand_prince;
mod edges;
mod elementary;
mod ensemble;
mod faces;
mod floquet;
mod four_bar;
mod gradient;
mod harmonics;
mod impulses;
mod interrupted;
mod jafferis_figures;
mod loads;
mod multipliers;
mod orbits;
mod outlines;
mod own_model;
mod parameters;
mod probe;
mod progressive;
mod quarters;
mod reals;
mod robustness;
mod rows;
mod samples;
mod sections;
mod settings;
mod slopes;
mod span;
mod strobe;
mod switching;
mod symmetry;
mod terms;
mod vehicle;
mod waveforms;
mod wings;
