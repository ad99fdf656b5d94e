//! Aerodynamics that models share: the wing as a row of strips, its chord as a table, its outline and mass.

mod chord_table;
mod strips;
mod wing;

pub use chord_table::{ChordTable, STATIONS, Tabulated, chord_table};
pub use strips::{Cut, Strip, StripSums, Strips, sum};
pub use wing::{Masses, Material, Outline, OutlineError, Station, Wing};
