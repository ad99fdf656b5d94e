//! Hinges and transmissions, and their losses.

mod damping;
mod four_bar;
mod plane;
mod slider_crank;

pub use damping::HingeParameters;
pub(crate) use damping::structural_damping;
pub(crate) use four_bar::LinkLengths;
pub use four_bar::{FourBar, FourBarMotion, LinkInertias};
pub use slider_crank::SliderCrank;
