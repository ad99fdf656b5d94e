//! A run together with its response to small changes of its initial state.

use super::{Ode, slope};
use crate::num::{Lanes, Real};

/// Size of the changes that are followed, relative to [`initial`]'s scales: their squares, which are neglected, and
/// rounding, which is magnified, are both far below any tolerance.
const SMALL: f64 = 1e-7;

/// N states and N responses to changes of them, each of N components: K = N (N + 1) in all.
///
/// Step sizes are chosen for states and responses: where a force has a kink, its derivative jumps, and responses err by more than
/// states. Slopes of responses are forward differences of the right-hand side, with changes of 1e-7 of the states' scales: they
/// err by about 1e-7 of the second derivative, and by rounding of about 1e-9. Where the right-hand side jumps, the responses
/// jump too, as a changed motion reaches the surface earlier or later.
#[derive(Clone, Copy, Debug)]
pub struct Variation<'a, O, const N: usize>(pub &'a O);

/// The states `y`, and responses to changes of each component by its `scale`.
pub fn initial<const N: usize, const K: usize>(y: &[f64; N], scale: &[f64; N]) -> [f64; K] {
    const { assert!(K == N * (N + 1)) }
    let mut all = [0.0; K];
    all[..N].copy_from_slice(y);
    for i in 0..N {
        all[(i + 1) * N + i] = scale[i];
    }
    all
}

/// The response to a change of one component by its scale.
pub fn response<const N: usize, const K: usize>(all: &[f64; K], component: usize) -> [f64; N] {
    core::array::from_fn(|i| all[(component + 1) * N + i])
}

impl<O: Ode<N>, const N: usize, const K: usize> Ode<K> for Variation<'_, O, N> {
    type Constants<R: Real> = O::Constants<R>;
    type Input<R: Real> = O::Input<R>;

    const SWITCHES: bool = O::SWITCHES;

    #[inline(always)]
    fn input<R: Real>(&self, c: &O::Constants<R>, t: R) -> O::Input<R> {
        self.0.input(c, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &O::Constants<R>, u: &O::Input<R>, side: R, all: &[R; K]) -> [R; K] {
        let y = states(all);
        let mut f = y;
        let mut out = *all;
        // A loop, so that the right-hand side is compiled once, as in a step.
        for i in 0..=N {
            let moved = if i == 0 { y } else { changed(&y, all, i) };
            let slope = self.0.rhs(c, u, side, &moved);
            if i == 0 {
                f = slope;
            }
            for j in 0..N {
                out[i * N + j] = if i == 0 { slope[j] } else { (slope[j] - f[j]) * (1.0 / SMALL) };
            }
        }
        out
    }

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &O::Constants<R>, t: R) -> R {
        self.0.next_break(c, t)
    }

    #[inline(always)]
    fn switch<R: Real>(&self, c: &O::Constants<R>, all: &[R; K], dy: &[R; K]) -> [R; 2] {
        self.0.switch(c, &states(all), &states(dy))
    }

    /// A change w that alters the switching function by dg moves the crossing by −dg/ġ; in between, the changed motion
    /// has the slope of the other side:
    ///
    /// ```text
    /// w⁺ = w + (f⁺ − f⁻) dg/ġ⁻
    /// ```
    #[inline(always)]
    fn crossed<R: Lanes>(&self, c: &O::Constants<R>, u: &O::Input<R>, side: R, all: &[R; K]) -> [R; K] {
        let y = states(all);
        let [before, after] = [slope(self.0, c, u, -side, &y), slope(self.0, c, u, side, &y)];
        let [value, rate] = self.0.switch(c, &y, &before);
        let mut out = *all;
        for i in 1..=N {
            let [moved, _] = self.0.switch(c, &changed(&y, all, i), &before);
            let earlier = (moved - value) * (1.0 / SMALL) / rate;
            for j in 0..N {
                out[i * N + j] = all[i * N + j] + (after[j] - before[j]) * earlier;
            }
        }
        out
    }
}

#[inline(always)]
fn states<R: Real, const N: usize, const K: usize>(all: &[R; K]) -> [R; N] {
    core::array::from_fn(
        #[inline(always)]
        |i| all[i],
    )
}

/// The states with the `i`-th change, counted from 1.
#[inline(always)]
fn changed<R: Real, const N: usize, const K: usize>(y: &[R; N], all: &[R; K], i: usize) -> [R; N] {
    let mut out = *y;
    for j in 0..N {
        out[j] = all[i * N + j].mul_add(y[j].lit(SMALL), y[j]);
    }
    out
}
