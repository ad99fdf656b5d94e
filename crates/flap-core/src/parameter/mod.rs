//! Tables of parameters: names, units, descriptions and ranges.
//!
//! A point of a design space is a list with one `f64` for each parameter, in the order of the model's table. The value
//! of a parameter is one of these numbers:
//!
//! - a number in SI units
//! - the index of an option, for a choice
//! - NaN, for a parameter that is not set, so that flap computes its value from other parameters (see
//!   [`Kind::Following`])
//!
//! Values that a user sets are never NaN, so NaN always means that the parameter is not set.

mod declare;
mod invalid;
mod table;

pub use declare::{Slot, joined, rows};
pub use invalid::Invalid;
pub use table::{Kind, Parameter, Preset, Range};
