//! Claims: the statement of a paper, the number that flap computes, and the verdict that follows from the two.
//!
//! Verdicts are rules applied to numbers; none is written by hand.

/// A statement of a paper beside what flap computes.
pub(crate) struct Claim {
    /// Section, figure or table of the paper.
    pub(crate) place: &'static str,
    /// The statement of the paper.
    pub(crate) statement: String,
    /// The paper's number or words.
    pub(crate) published: String,
    /// The number that flap computes.
    pub(crate) computed: String,
    pub(crate) verdict: Verdict,
}

/// The outcome of a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// The computed number is the published one to its rounding, or the statement holds.
    Met,
    /// The computed number is off by this share of the published one, within what the claim allows.
    MetWithin(f64),
    /// It is further off, or the statement does not hold.
    NotReproduced,
    /// There is nothing to compare, and why.
    CannotBeChecked(&'static str),
}

/// The share by which a resonance, or a number that the paper computed from the same parameters, may be off.
const CLOSELY: f64 = 0.03;
/// The share by which a number may be off that the paper calls approximate.
const ABOUT: f64 = 0.10;
/// The share by which a number may be off that the paper measured.
const MEASURED: f64 = 0.20;
/// The share by which a number may be off where wing and actuator are assumed.
const ASSUMED: f64 = 0.25;

/// A published number and how far off a computed one may be.
pub(crate) struct Expected {
    value: f64,
    /// Half a unit of the published number's last digit, or half the width of a range.
    rounding: f64,
    /// Largest share of the published number beyond which a computed one does not reproduce it.
    limit: f64,
}

/// A resonance, or a number that the paper computed from the same parameters.
pub(crate) fn closely(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: CLOSELY }
}

/// A number that the paper calls approximate.
pub(crate) fn about(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: ABOUT }
}

/// A number that the paper measured.
pub(crate) fn measured(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: MEASURED }
}

/// A number of a system whose wing and actuator are assumed, because the paper does not give them.
pub(crate) fn assumed(value: f64, rounding: f64) -> Expected {
    Expected { value, rounding, limit: ASSUMED }
}

/// A range that a number is in or not.
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

/// A statement of a paper, before anything is computed.
pub(crate) struct Said {
    place: &'static str,
    statement: String,
    published: String,
}

/// The paper says at `place` that `statement`: `published`.
pub(crate) fn said(place: &'static str, statement: impl Into<String>, published: impl Into<String>) -> Said {
    Said { place, statement: statement.into(), published: published.into() }
}

impl Said {
    /// The claim, where the computed number is compared with the published one.
    pub(crate) fn is(self, expected: &Expected, computed: f64, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), expected.verdict(computed))
    }

    /// The claim, where what was computed fulfils the statement or does not.
    pub(crate) fn holds(self, holds: bool, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), if holds { Verdict::Met } else { Verdict::NotReproduced })
    }

    /// The claim, if there is nothing to compare.
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
