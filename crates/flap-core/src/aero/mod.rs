//! Aerodynamics that several models use.
//!
//! The files contain strips of the wing, force coefficients, added mass and rotational circulation. Further files contain
//! the table of the chord, and outline and mass of the wing.

mod chord_table;
mod harmonics;
mod oblique;
mod strips;
mod unsteady;
mod wing;

pub(crate) use chord_table::chord_table;
pub use chord_table::{ChordTable, STATIONS, Tabulated};
pub use harmonics::{HarmonicParameters, Harmonics};
pub use oblique::{Flow, ObliqueForces, ObliqueStrip, oblique_forces};
pub(crate) use strips::{Cut, check_chords, cut, sum};
pub use strips::{StripSums, Strips};
pub use unsteady::{AddedMass, ChordIntegral, Circulation, NormalLoad, RotationalForce};
pub use wing::{Masses, Material, Outline, OutlineError, Station, Wing};
