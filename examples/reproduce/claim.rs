//! A claim consists of the statement of a paper, the number that flap computes, and a verdict about the
//! statement.
//!
//! Fixed rules determine each verdict from the published number and the computed number.

/// A statement of a paper, and the number that flap computes.
pub(crate) struct Claim {
    /// Section, figure or table of the paper that contains the statement.
    pub(crate) place: &'static str,
    /// The statement of the paper as text.
    pub(crate) statement: String,
    /// The number or the words that the paper gives.
    pub(crate) published: String,
    /// The number that flap computes, as text.
    pub(crate) computed: String,
    pub(crate) verdict: Verdict,
}

/// The verdict about a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// The computed number equals the rounded published number, or the computed motions fulfil the statement.
    Met,
    /// The difference between the computed and the published number is within the limit of the claim. The
    /// number in this verdict is the relative difference.
    MetWithin(f64),
    /// The difference between the two numbers exceeds the limit of the claim, or the computed motions do not
    /// fulfil the statement.
    NotReproduced,
    /// The paper lacks the numbers for a comparison. The text in this verdict is the reason.
    CannotBeChecked(&'static str),
}

/// Largest allowed relative difference for a resonance, or for a number that the paper computed from the
/// parameters that flap uses.
const CLOSELY: f64 = 0.03;
/// Largest allowed relative difference for a number that the paper calls approximate.
const ABOUT: f64 = 0.10;
/// Largest allowed relative difference for a number that the paper measured.
const MEASURED: f64 = 0.20;
/// Largest allowed relative difference for a robot whose wing and actuator are assumed.
const ASSUMED: f64 = 0.25;

/// A published number, and the limit for the difference between the computed and the published number.
pub(crate) struct Expected {
    value: f64,
    /// Half of the unit of the published number's last digit, or half of the width of a published range.
    rounding: f64,
    /// Largest relative difference at which the computed number still counts as equal to the published
    /// number.
    limit: f64,
}

/// Returns the expected value of a resonance, or of a number that the paper computed from the parameters that
/// flap uses.
pub(crate) fn closely(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: CLOSELY }
}

/// Returns the expected value of a number that the paper calls approximate.
pub(crate) fn about(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: ABOUT }
}

/// Returns the expected value of a number that the paper measured.
pub(crate) fn measured(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: MEASURED }
}

/// Returns the expected value of a number, for a robot whose wing and actuator are assumed. The paper does
/// not describe the wing and the actuator of the robot.
pub(crate) fn assumed(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: ASSUMED }
}

/// Returns the expected value for a published range. The computed number must be in the range.
pub(crate) fn between(low: f64, high: f64) -> Expected {
    Expected { value: 0.5 * (low + high), rounding: 0.5 * (high - low), limit: 0.0 }
}

impl Expected {
    fn verdict(&self, computed: f64) -> Verdict {
        let off = (computed - self.value).abs();
        if off <= self.rounding {
            Verdict::Met
        } else if off <= self.limit * self.value {
            Verdict::MetWithin(off / self.value)
        } else {
            Verdict::NotReproduced
        }
    }
}

/// A statement of a paper, without the number that flap computes.
pub(crate) struct Said {
    place: &'static str,
    statement: String,
    published: String,
}

/// Returns the statement `statement` from the section, figure or table `place` of a paper, with the published
/// number `published`.
pub(crate) fn said(place: &'static str, statement: impl Into<String>, published: impl Into<String>) -> Said {
    Said { place, statement: statement.into(), published: published.into() }
}

impl Said {
    /// Returns a claim whose verdict compares the computed number with the published number.
    pub(crate) fn is(self, expected: &Expected, computed: f64, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), expected.verdict(computed))
    }

    /// Returns a claim with the verdict `Met` if `holds` is true, and with the verdict `NotReproduced`
    /// otherwise.
    pub(crate) fn holds(self, holds: bool, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), if holds { Verdict::Met } else { Verdict::NotReproduced })
    }

    /// Returns a claim that flap cannot check. The text `why` is the reason.
    pub(crate) fn cannot_be_checked(self, why: &'static str, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), Verdict::CannotBeChecked(why))
    }

    fn claim(self, computed: String, verdict: Verdict) -> Claim {
        let Said { place, statement, published } = self;
        Claim { place, statement, published, computed, verdict }
    }
}

#[cfg(test)]
mod tests {
    use super::{Verdict, about, between};

    #[test]
    fn verdicts_follow_from_numbers() {
        assert_eq!(about(50.0, 0.5).verdict(49.5), Verdict::Met);
        assert_eq!(about(50.0, 0.5).verdict(48.0), Verdict::MetWithin(0.04));
        assert_eq!(about(50.0, 0.5).verdict(44.9), Verdict::NotReproduced);
        assert_eq!(about(50.0, 0.5).verdict(f64::NAN), Verdict::NotReproduced);
        assert_eq!(between(10.0, 20.0).verdict(20.0), Verdict::Met);
        assert_eq!(between(10.0, 20.0).verdict(20.1), Verdict::NotReproduced);
    }
}
