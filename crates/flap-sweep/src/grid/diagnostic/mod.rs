//! Mistakes in a grid file: their places, their causes and their remedies.

mod mistake;
mod mistakes;
mod render;

pub use mistake::{Diagnostic, Related};
pub use mistakes::Mistakes;
pub use render::render;
