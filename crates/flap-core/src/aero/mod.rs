//! Aerodynamics that several models use.
//!
//! The module contains the strips of the wing, the force coefficients, the added mass and the rotational circulation.
//! The module also contains the table of the chord, and the outline and the mass of the wing.

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
pub use wing::{Masses, Material, Outline, Station, Wing};
