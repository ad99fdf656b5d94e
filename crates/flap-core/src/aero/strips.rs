//! Strips of a wing, and sums of forces over all strips.

use super::oblique::ObliqueStrip;
use crate::num::{Lanes, PerLane, Real};
use crate::parameter::Invalid;
use crate::quadrature::Node;

/// Position and size of a strip of a wing, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    /// Distance r of the strip from the stroke axis.
    pub(crate) radius: f64,
    /// Chord c.
    pub(crate) chord: f64,
    /// Width Δr of the strip along the span.
    pub(crate) width: f64,
}

/// Cuts a wing of the given `length` (m) into one strip for each node of a quadrature rule.
///
/// The wing begins at the distance `offset` (m) from the stroke axis. The function `chord` returns the chord
/// (m) at a position from 0 at the root to 1 at the tip.
pub(crate) fn cut(rule: &[Node], offset: f64, length: f64, chord: impl Fn(f64) -> f64) -> Vec<Cut> {
    let cut = |node: &Node| Cut {
        radius: offset + length * node.x,
        chord: chord(node.x),
        width: length * node.weight,
    };
    rule.iter().map(cut).collect()
}

/// Checks that no chord is negative. `parameters` contains the names of the parameters that describe the
/// chord. The error message contains the first and the last name in `parameters`.
pub(crate) fn check_chords(cuts: &[Cut], parameters: &[&str]) -> Result<(), Invalid> {
    let Some(cut) = cuts.iter().find(|cut| cut.chord < 0.0) else { return Ok(()) };
    let (first, last) = (parameters[0], parameters[parameters.len() - 1]);
    let place = cut.radius;
    Err(Invalid::new(format!(
        "the chord is negative {place} m from the stroke axis: {first} to {last} must give a chord of zero or more"
    )))
}

/// Returns the sum of f(r, c) Δr over all strips, with the radius r, the chord c and the width Δr of each
/// strip.
pub(crate) fn sum(cuts: &[Cut], f: impl Fn(f64, f64) -> f64) -> f64 {
    cuts.iter().map(|cut| f(cut.radius, cut.chord) * cut.width).sum()
}

/// The strips of a wing. The number of strips is at most `MAX`.
///
/// All lanes compute as many strips as the lane with the most strips. In lanes with fewer strips, the surplus
/// strips have a weight of zero and do not change the sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strips<R, const MAX: usize> {
    count: usize,
    /// Four numbers for each strip: √a r, √a κc, radius r (m) and chord c (m). Here a is ½ρcΔr, and κ is the
    /// argument `lever` of [`Strips::new`]. The velocity of the strip times √a is the sum of √a r times the
    /// stroke rate and √a κc times the sweep rate.
    strips: [[R; 4]; MAX],
}

impl<const MAX: usize> Strips<f64, MAX> {
    /// Returns the strips of a wing in air of the density `air_density` (kg/m³). If `cuts` has more than
    /// `MAX` entries, only the first `MAX` entries are used.
    ///
    /// The velocity of a strip is computed at the distance `lever` (κ) times the chord from the pitch axis.
    pub(crate) fn new(cuts: &[Cut], air_density: f64, lever: f64) -> Strips<f64, MAX> {
        let mut strips = [[0.0; 4]; MAX];
        for (strip, &Cut { radius, chord, width }) in strips.iter_mut().zip(cuts) {
            let weight = (0.5 * air_density * chord * width).sqrt();
            *strip = [weight * radius, weight * lever * chord, radius, chord];
        }
        Strips { count: cuts.len().min(MAX), strips }
    }
}

/// Sums of ½ρ u|u| c Δr over all strips of a wing, where u is the velocity of the strip.
#[derive(Clone, Copy, Debug)]
pub struct StripSums<R> {
    /// Sum of ½ρ u|u| c Δr over all strips (N).
    pub force: R,
    /// Sum of r ½ρ u|u| c Δr over all strips, where r is the radius of the strip (N·m).
    pub radius: R,
    /// Sum of c ½ρ u|u| c Δr over all strips, where c is the chord of the strip (N·m).
    pub chord: R,
}

impl<R: Real, const MAX: usize> Strips<R, MAX> {
    /// Returns the strips as values of the type [`ObliqueStrip`], for a flow with a component along the
    /// stroke axis. The velocity of each strip is computed at the distance `behind` (κ) times the chord
    /// behind the pitch axis.
    #[inline(always)]
    pub(crate) fn oblique(&self, behind: R) -> impl Iterator<Item = ObliqueStrip<R>> + '_ {
        self.strips[..self.count.min(MAX)].iter().map(
            #[inline(always)]
            move |&[stroke, _, radius, chord]| {
                let zero = radius.lit(0.0);
                // Surplus strips of a lane have no radius.
                let known = zero.lt(radius.abs());
                let root = R::select(known, stroke / R::select(known, radius, radius + 1.0), zero);
                ObliqueStrip { weight: root * root, radius, lever: radius, behind: behind * chord, chord }
            },
        )
    }

    /// Returns the sums of ½ρ u|u| c Δr over all strips, for the given stroke rate and sweep rate (rad/s).
    /// The sweep rate is the pitch rate times the cosine of the pitch.
    ///
    /// ```text
    /// u = r · stroke rate + κ c · sweep rate
    /// ```
    ///
    /// Each term contains u|u|, which changes its sign with u. The sums are therefore correct even if the
    /// flow past some strips is reversed.
    #[inline(always)]
    pub fn sums(&self, stroke_rate: R, sweep_rate: R) -> StripSums<R> {
        let zero = stroke_rate.lit(0.0);
        let mut sums = StripSums { force: zero, radius: zero, chord: zero };
        for i in 0..self.count.min(MAX) {
            let [stroke, sweep, radius, chord] = self.strips[i];
            let u = stroke.mul_add(stroke_rate, sweep * sweep_rate);
            let force = u * u.abs();
            sums.force = sums.force + force;
            sums.radius = radius.mul_add(force, sums.radius);
            sums.chord = chord.mul_add(force, sums.chord);
        }
        sums
    }
}

impl<R: Real, const MAX: usize> PerLane<R> for Strips<R, MAX> {
    type One = Strips<f64, MAX>;

    #[inline(always)]
    fn fill(like: R, one: &Self::One) -> Self {
        Strips { count: one.count, strips: PerLane::fill(like, &one.strips) }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Self::One)
    where
        R: Lanes,
    {
        self.count = self.count.max(one.count);
        self.strips.set(lane, &one.strips);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Self::One
    where
        R: Lanes,
    {
        Strips { count: self.count, strips: self.strips.get(lane) }
    }

    #[inline(always)]
    fn is_finite(one: &Self::One) -> bool {
        <[[R; 4]; MAX] as PerLane<R>>::is_finite(&one.strips)
    }
}
