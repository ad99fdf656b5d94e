//! Hinges and transmissions.

mod torsion_hinge;

pub use torsion_hinge::TorsionHinge;
