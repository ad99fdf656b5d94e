//! The size of an impulse on the resting stroke.

use std::f64::consts::PI;

/// An impulse whose amplitude no wing can reach.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("an impulse of {:.1} deg ({amplitude} rad) is larger than half a turn", amplitude.to_degrees())]
pub struct LargeImpulse {
    /// The amplitude (rad).
    amplitude: f64,
}

impl LargeImpulse {
    /// The remedy.
    pub const HELP: &str = "give at most 180 deg, such as \"20 deg\"";
}

/// The amplitude (rad) of an impulse, if it is at most half a turn: a wing that turns further passes through the body.
///
/// # Errors
/// [`LargeImpulse`] for a larger amplitude.
pub fn impulse(amplitude: f64) -> Result<f64, LargeImpulse> {
    if amplitude.abs() <= PI { Ok(amplitude) } else { Err(LargeImpulse { amplitude }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_is_at_most_half_a_turn() {
        assert_eq!(impulse(-PI), Ok(-PI));
        let refused = impulse(20.0).map_err(|error| error.to_string());
        assert_eq!(refused, Err("an impulse of 1145.9 deg (20 rad) is larger than half a turn".to_owned()));
        assert!(impulse(f64::NAN).is_err());
    }
}
