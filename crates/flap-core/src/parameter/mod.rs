//! Tables of parameters: names, units, descriptions and ranges.
//!
//! A point of a design space is one `f64` per parameter, in the order of the model's table. The value is one of
//! these:
//!
//! - a number in SI units
//! - the index of an option, for a choice
//! - NaN, for a number that is not set and follows others (see [`Kind::Following`])
//!
//! User input never contains NaN, so NaN has no other meaning.

mod declare;
mod invalid;
mod table;

pub use declare::{Slot, joined, rows};
pub use invalid::Invalid;
pub use table::{Kind, Parameter, Preset, Range};
