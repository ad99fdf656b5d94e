//! Claims: the statement of a paper, the number that flap computes, and the verdict that follows from both.
//!
//! Rules compute each verdict from the numbers.

/// A statement of a paper, and the number that flap computes.
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
    /// The computed number equals the published number to its rounding, or the statement holds.
    Met,
    /// The relative error of the computed number, within the limit of the claim.
    MetWithin(f64),
    /// The relative error exceeds the limit of the claim, or the statement does not hold.
    NotReproduced,
    /// The reason why the claim cannot be compared.
    CannotBeChecked(&'static str),
}

/// Largest relative error of a resonance, or of a number that the paper computed from the same parameters.
const CLOSELY: f64 = 0.03;
/// Largest relative error of a number that the paper calls approximate.
const ABOUT: f64 = 0.10;
/// Largest relative error of a number that the paper measured.
const MEASURED: f64 = 0.20;
/// Largest relative error of a number, if wing and actuator are assumed.
const ASSUMED: f64 = 0.25;

/// A published number, and the largest relative error of the computed number.
pub(crate) struct Expected {
    value: f64,
    /// Half a unit of the published number's last digit, or half the width of a range.
    rounding: f64,
    /// Largest relative error at which the computed number reproduces the published number.
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

/// A published range, in which the computed number must be.
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

/// A statement of a paper, before flap computes a number.
pub(crate) struct Said {
    place: &'static str,
    statement: String,
    published: String,
}

/// The statement `statement` at `place` of a paper, with the published number `published`.
pub(crate) fn said(place: &'static str, statement: impl Into<String>, published: impl Into<String>) -> Said {
    Said { place, statement: statement.into(), published: published.into() }
}

impl Said {
    /// The claim, with a comparison of the computed and the published number.
    pub(crate) fn is(self, expected: &Expected, computed: f64, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), expected.verdict(computed))
    }

    /// The claim, with the result whether the computed numbers fulfil the statement.
    pub(crate) fn holds(self, holds: bool, shown: impl Into<String>) -> Claim {
        self.claim(shown.into(), if holds { Verdict::Met } else { Verdict::NotReproduced })
    }

    /// The claim, if no number can be compared.
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
