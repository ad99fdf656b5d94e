//! Numbers, units, times and formulas as text.

pub mod expression;
pub mod quantity;
pub mod text;
pub mod time;
pub mod units;
pub mod value;

pub use text::nearest;
