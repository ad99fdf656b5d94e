//! Control effectiveness of a vehicle: the change of its mean force and torque with each input, and trims.

mod effectiveness;
mod input;
mod trim;

pub use effectiveness::{COMPONENTS, ControlError, Effectiveness, Flight, Mode};
pub use input::{Input, InputError, WORDS};
pub use trim::{Target, Trim, TrimError, trim};
