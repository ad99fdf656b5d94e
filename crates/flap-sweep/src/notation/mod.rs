//! Numbers, units, times and formulas as text.

pub mod expression;
mod nearest;
pub(crate) mod position;
pub mod text;
pub mod time;
pub mod units;
pub mod value;

pub use nearest::nearest;
