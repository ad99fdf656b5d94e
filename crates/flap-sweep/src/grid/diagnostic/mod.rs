//! Mistakes in a grid file: their places, their causes and their remedies.

mod mistake;
mod mistakes;
mod position;
mod render;

pub use mistake::{Diagnostic, Related};
pub use mistakes::Mistakes;
pub(crate) use position::position;
pub use render::render;
