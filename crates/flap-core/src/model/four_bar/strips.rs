//! The wing as a row of strips, and the sums over them.

use crate::num::{Lanes, PerLane, Real};

/// The largest number of strips.
pub const MAX_STRIPS: usize = 64;

crate::per_lane! {
    /// One strip of width Δr at the radius r, where the chord is c. With a = ½ρcΔr:
    pub struct Strip<R> {
        /// Velocity per stroke rate, weighted: √a r.
        pub stroke: R,
        /// Velocity per sweep rate φ̇ cos φ, weighted: √a κc.
        pub sweep: R,
        /// Radius r (m).
        pub radius: R,
        /// Chord c (m).
        pub chord: R,
    }
}

/// The strips of a wing.
///
/// All lanes run through as many strips as the one that has the most. What a lane has too many weighs nothing:
/// it adds zeros, which change no bit of its sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strips<R> {
    count: usize,
    strips: [Strip<R>; MAX_STRIPS],
}

impl Strips<f64> {
    /// A wing of these strips, of which there are at most [`MAX_STRIPS`].
    pub fn new(strips: &[Strip<f64>]) -> Strips<f64> {
        let nothing = Strip { stroke: 0.0, sweep: 0.0, radius: 0.0, chord: 0.0 };
        let mut all = [nothing; MAX_STRIPS];
        all[..strips.len()].copy_from_slice(strips);
        Strips { count: strips.len(), strips: all }
    }
}

/// Sums over the strips of ½ρ U|U| c Δr, where U is the strip's velocity.
#[derive(Clone, Copy, Debug)]
pub struct StripSums<R> {
    /// Σ ½ρ U|U| c Δr (N).
    pub force: R,
    /// Σ r ½ρ U|U| c Δr (N·m).
    pub radius: R,
    /// Σ c ½ρ U|U| c Δr (N·m).
    pub chord: R,
}

impl<R: Real> Strips<R> {
    /// The sums at a stroke rate θ̇ and a sweep rate φ̇ cos φ; Arabagi 2013, (5), (8).
    ///
    /// ```text
    /// U = r θ̇ + κ c φ̇ cos φ
    /// ```
    ///
    /// As every term carries U|U|, the sums serve both directions of flow at once, strip by strip.
    #[inline(always)]
    pub fn sums(&self, stroke_rate: R, sweep_rate: R) -> StripSums<R> {
        let zero = stroke_rate.lit(0.0);
        let mut sums = StripSums { force: zero, radius: zero, chord: zero };
        for i in 0..self.count.min(MAX_STRIPS) {
            let strip = &self.strips[i];
            let u = strip.stroke.mul_add(stroke_rate, strip.sweep * sweep_rate);
            let force = u * u.abs();
            sums.force = sums.force + force;
            sums.radius = strip.radius.mul_add(force, sums.radius);
            sums.chord = strip.chord.mul_add(force, sums.chord);
        }
        sums
    }
}

impl<R: Lanes> PerLane<R> for Strips<R> {
    type One = Strips<f64>;

    #[inline(always)]
    fn fill(token: R::Token, one: &Strips<f64>) -> Self {
        Strips { count: one.count, strips: PerLane::fill(token, &one.strips) }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Strips<f64>) {
        self.count = self.count.max(one.count);
        self.strips.set(lane, &one.strips);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Strips<f64> {
        Strips { count: self.count, strips: self.strips.get(lane) }
    }

    #[inline(always)]
    fn is_finite(one: &Strips<f64>) -> bool {
        <[Strip<R>; MAX_STRIPS] as PerLane<R>>::is_finite(&one.strips)
    }
}
