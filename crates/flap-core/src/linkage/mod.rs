//! Hinges and transmissions, and their losses.

mod damping;
mod four_bar;
mod plane;
mod slider_crank;

pub use damping::{HingeParameters, structural_damping};
pub use four_bar::{FourBar, FourBarMotion, LinkInertias, LinkLengths};
pub use slider_crank::{SliderCrank, SliderMotion};
