//! The map from the state at the beginning of a drive period to that at its end, near a fixed point.
//!
//! In the search for a symmetric orbit the map is that from the beginning to the middle of a period, mirrored. The map of the
//! period is the square of this one, and has the same fixed point.

use super::linear::Lu;
use crate::measure::multipliers::{Matrix, is_stable};

/// Chord steps after which an iteration is given up: one to three are usual.
const MAX_CHORD_STEPS: u32 = 6;

/// The factor by which the residual must at least fall from one step of an iteration to the next.
pub(super) const PROGRESS: f64 = 0.5;

/// The largest distance between a march and the prediction of the orbit's linear map, relative to the distance between march
/// and orbit.
const LINEAR: f64 = 0.3;

/// A periodic orbit of one drive period.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit<const N: usize> {
    /// The state at its beginning.
    pub(super) y: [f64; N],
    /// Responses of the state that the map leads to, to changes of `y`, in units of the states' typical sizes.
    pub(super) monodromy: Matrix<N>,
}

/// A part of a march.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marched<const N: usize> {
    /// The state at its beginning.
    pub(super) begin: [f64; N],
    /// The state at its end.
    pub(super) end: [f64; N],
    /// The error of both, in units of the states' typical sizes.
    pub(super) error: f64,
    /// The number of times that the map was applied in between.
    pub(super) maps: i32,
}

impl<const N: usize> Orbit<N> {
    /// True if the orbit is stable, and a march with this part is on its way to it: it moved as the orbit's linear map predicts.
    pub(super) fn attracts(&self, march: &Marched<N>, scale: &[f64; N]) -> bool {
        let offset = |state: &[f64; N]| core::array::from_fn(|i| (state[i] - self.y[i]) / scale[i]);
        let end: [f64; N] = offset(&march.end);
        let mut predicted: [f64; N] = offset(&march.begin);
        for _ in 0..march.maps {
            predicted = self.monodromy.map(|row| row.iter().zip(predicted).map(|(m, x)| m * x).sum());
        }
        let deviation = end.iter().zip(predicted).fold(0.0_f64, |most, (end, x)| most.max((end - x).abs()));
        let distance = distance(&march.begin, &self.y, scale);
        deviation <= LINEAR * distance + march.error && is_stable(&self.monodromy)
    }
}

/// The chord iteration `y ← y + (I − M)⁻¹ (Φ(y) − y)` for a fixed point of the map Φ: M is the monodromy matrix of an
/// orbit nearby, updated after each step by Broyden's formula.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord<const N: usize> {
    /// The state that the iteration has come to, with the matrix M.
    pub(super) orbit: Orbit<N>,
    /// The residual of the last period that was integrated, see [`residual`].
    pub(super) residual: f64,
    scale: [f64; N],
    before: Option<[f64; N]>,
    steps: u32,
}

impl<const N: usize> Chord<N> {
    /// The iteration that begins at `orbit`.
    pub(super) fn new(orbit: Orbit<N>, scale: &[f64; N]) -> Chord<N> {
        Chord { orbit, residual: f64::INFINITY, scale: *scale, before: None, steps: 0 }
    }

    /// Takes the end of the period from the present state and goes to the next state. False if it stays, because the residual
    /// hardly falls any more or the linear system is singular.
    pub(super) fn step(&mut self, end: &[f64; N]) -> bool {
        self.update(end);
        let residual = residual(&self.orbit.y, end, &self.scale);
        let slow = residual > PROGRESS * self.residual || self.steps == MAX_CHORD_STEPS;
        self.residual = residual;
        let next = fixed_point(&self.orbit, end, &self.scale).filter(|_| !slow);
        if let Some(next) = next {
            self.before = Some(self.orbit.y);
            self.orbit.y = next;
            self.steps += 1;
        }
        next.is_some()
    }

    /// Broyden's update of M by the last step, which should have ended on the orbit: the change over the period after it is
    /// the error of M along the step.
    fn update(&mut self, end: &[f64; N]) {
        let Some(before) = self.before else { return };
        let step: [f64; N] = core::array::from_fn(|i| (self.orbit.y[i] - before[i]) / self.scale[i]);
        let square: f64 = step.iter().map(|s| s * s).sum();
        if square == 0.0 {
            return;
        }
        for i in 0..N {
            let error = (end[i] - self.orbit.y[i]) / self.scale[i];
            for j in 0..N {
                self.orbit.monodromy[i][j] += error * step[j] / square;
            }
        }
    }
}

/// The distance of two states: its largest component, in units of the states' typical sizes.
pub(super) fn distance<const N: usize>(one: &[f64; N], other: &[f64; N], scale: &[f64; N]) -> f64 {
    (0..N).fold(0.0, |largest, i| largest.max((one[i] - other[i]).abs() / scale[i]))
}

/// The change of the state over a period from `y` to `end`: its largest component, in units of the states' typical sizes. In a
/// motion smaller than these, relative to its own size.
pub(super) fn residual<const N: usize>(y: &[f64; N], end: &[f64; N], scale: &[f64; N]) -> f64 {
    let change = distance(y, end, scale);
    let size = (0..N).fold(0.0_f64, |size, i| size.max(end[i].abs().max(y[i].abs()) / scale[i]));
    if change == 0.0 { 0.0 } else { change / size.min(1.0) }
}

/// The fixed point of the linear map that takes the beginning of `near` to `end` and has its monodromy matrix. `None` if the
/// linear system is singular or not finite.
pub(super) fn fixed_point<const N: usize>(
    near: &Orbit<N>,
    end: &[f64; N],
    scale: &[f64; N],
) -> Option<[f64; N]> {
    let Orbit { y, monodromy } = near;
    let change = core::array::from_fn(|i| (end[i] - y[i]) / scale[i]);
    let step = Lu::of_identity_minus(monodromy)?.solve(&change);
    step.iter().all(|step| step.is_finite()).then(|| core::array::from_fn(|i| y[i] + step[i] * scale[i]))
}
