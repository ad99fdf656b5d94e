//! A number type that consists of two groups of lanes, and thus has twice as many lanes as one group.
//!
//! A right-hand side is a long chain of dependent operations. While an operation on one group of lanes waits
//! for an earlier result, the processor computes operations on the other group of lanes.

use core::ops::{BitAnd, BitOr, Not};

use super::lanes::{Bits, Lanes};
use super::macros::{constants_on_the_right, functions_of_lanes, of_both, operator};
use super::real::Real;

/// Two groups of lanes that the processor computes at the same time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<L> {
    lo: L,
    hi: L,
}

/// Result of a comparison in each lane of a [`Pair`].
#[derive(Clone, Copy)]
pub(super) struct PairMask<M> {
    lo: M,
    hi: M,
}

operator!([L: Lanes] Pair<L>, Add::add, |a, b| Pair { lo: a.lo + b.lo, hi: a.hi + b.hi });
operator!([L: Lanes] Pair<L>, Sub::sub, |a, b| Pair { lo: a.lo - b.lo, hi: a.hi - b.hi });
operator!([L: Lanes] Pair<L>, Mul::mul, |a, b| Pair { lo: a.lo * b.lo, hi: a.hi * b.hi });
operator!([L: Lanes] Pair<L>, Div::div, |a, b| Pair { lo: a.lo / b.lo, hi: a.hi / b.hi });
operator!([L: Lanes] Pair<L>, Neg::neg, |a| Pair { lo: -a.lo, hi: -a.hi });
constants_on_the_right!([L: Lanes] Pair<L>);

operator!([M: BitAnd<Output = M>] PairMask<M>, BitAnd::bitand, |a, b| PairMask { lo: a.lo & b.lo, hi: a.hi & b.hi });
operator!([M: BitOr<Output = M>] PairMask<M>, BitOr::bitor, |a, b| PairMask { lo: a.lo | b.lo, hi: a.hi | b.hi });
operator!([M: Not<Output = M>] PairMask<M>, Not::not, |a| PairMask { lo: !a.lo, hi: !a.hi });

impl<L: Lanes> Real for Pair<L> {
    type Mask = PairMask<L::Mask>;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        let half = self.lo.lit(c);
        Pair { lo: half, hi: half }
    }

    of_both!(Pair: mul_add(a, b), abs(), sqrt(), copysign(sign), min(other), max(other));

    functions_of_lanes!();

    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        PairMask { lo: self.lo.lt(other.lo), hi: self.hi.lt(other.hi) }
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Pair { lo: L::select(mask.lo, yes.lo, no.lo), hi: L::select(mask.hi, yes.hi, no.hi) }
    }

    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        self.lo.outlined(work)
    }
}

impl<L: Lanes> Lanes for Pair<L> {
    const LANES: usize = 2 * L::LANES;
    type Token = L::Token;

    #[inline(always)]
    fn splat(token: L::Token, c: f64) -> Self {
        let half = L::splat(token, c);
        Pair { lo: half, hi: half }
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < L::LANES { self.lo.lane(lane) } else { self.hi.lane(lane - L::LANES) }
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        if lane < L::LANES {
            self.lo.set_lane(lane, value);
        } else {
            self.hi.set_lane(lane - L::LANES, value);
        }
    }

    #[inline(always)]
    fn mask(token: L::Token, bits: u64) -> Self::Mask {
        let low = (1_u64 << L::LANES) - 1;
        PairMask { lo: L::mask(token, bits & low), hi: L::mask(token, (bits >> L::LANES) & low) }
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        L::bits(mask.lo) | (L::bits(mask.hi) << L::LANES)
    }
}

impl<L: Lanes> Bits for Pair<L> {
    of_both!(Pair: flip_sign_by_lowest_bit(selector), linear_log2(), reciprocal_guess(), times_power_of_two(k));

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let (lo, hi) = (self.lo.exponent_and_mantissa(), self.hi.exponent_and_mantissa());
        (Pair { lo: lo.0, hi: hi.0 }, Pair { lo: lo.1, hi: hi.1 })
    }
}
