//! Grid files: from text to a [`Plan`](crate::plan::Plan), or to all mistakes in the text.
//!
//! Each part of the file has its own module below; all report mistakes into one list, so that one check finds all
//! mistakes of a file. See `docs/grid.md` for the format.

mod absent;
mod axes;
mod conditions;
mod derived;
mod device;
pub mod diagnostic;
mod former;
mod formula;
mod gradient;
mod keys;
mod lookup;
mod measures;
mod output;
mod params;
mod parse;
mod preset;
mod problems;
mod range;
mod read;
mod resonance;
mod sample;
pub mod schema;
mod solver;
mod syntax;
mod table;
mod uncertainty;
mod value;
mod vehicle;
mod written;
mod zip;

pub use absent::why_absent;
pub use parse::{parse, parse_recorded};
pub use read::{ReadError, read, read_from};
pub use written::{device, wing};
