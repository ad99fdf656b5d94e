//! Converts the text of a grid file to a [`Plan`](crate::plan::Plan). If the text has mistakes, returns a
//! list of all mistakes.
//!
//! Each section of a grid file is read by a separate module. All modules add mistakes to the same list, so
//! that one check finds all mistakes of a file. See `docs/reference/grid.md` for the format of grid files.

mod axes;
mod designs;
mod device;
pub mod diagnostic;
mod formula;
mod gradient;
mod lookup;
mod output;
mod parse;
mod range;
mod refine;
mod resonance;
mod sample;
pub mod schema;
mod solver;
mod table;
mod uncertainty;
mod value;
mod vehicle;
mod written;

pub use lookup::why_absent;
pub use parse::{ReadError, parse, parse_recorded, read, read_from};
pub use written::{device, wing};
