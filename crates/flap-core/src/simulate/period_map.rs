//! The map from the state at the beginning of a drive period to the state at its end, near a fixed point.
//!
//! In the search for a symmetric orbit, the result of the map is the mirrored state in the middle of the
//! period. The map of a whole period applies the map of half a period twice, and both maps have the same
//! fixed point.

use super::linear::Lu;
use crate::measure::multipliers::{Matrix, is_stable};
use crate::measure::strobe::{distance, residual};

/// Largest number of steps of Broyden's method in the search for one fixed point. Usually, one to three steps
/// are sufficient.
const MAX_CHORD_STEPS: u32 = 6;

/// Factor by which the residual must decrease from one step of an iteration to the next.
pub(super) const PROGRESS: f64 = 0.5;

/// Largest allowed deviation of the march from the motion that the linear map of the orbit predicts. The
/// deviation is relative to the distance between the march and the orbit.
const LINEAR: f64 = 0.3;

/// A state on or near a periodic orbit, and the derivative of the period map at this state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit<const N: usize> {
    /// State at the beginning of a period.
    pub(super) y: [f64; N],
    /// Derivatives of the map's result with respect to `y`, in units of the states' typical sizes.
    pub(super) monodromy: Matrix<N>,
}

/// A part of a march, from one state to a later state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marched<const N: usize> {
    /// State at the beginning of this part of the march.
    pub(super) begin: [f64; N],
    /// State at the end of this part of the march.
    pub(super) end: [f64; N],
    /// Error of the states `begin` and `end`, in units of the states' typical sizes.
    pub(super) error: f64,
    /// Number of applications of the period map from `begin` to `end`.
    pub(super) maps: i32,
}

impl<const N: usize> Orbit<N> {
    /// Returns true if the orbit is stable, and if the march approaches the orbit as the linear map of the
    /// orbit predicts.
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

/// Broyden's method `y ← y + (I − M)⁻¹ (Φ(y) − y)` for a fixed point of the map Φ.
///
/// At the beginning, M is the monodromy matrix of a nearby orbit. After each step, Broyden's formula updates
/// M.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord<const N: usize> {
    /// Current state of the iteration, with the matrix M.
    pub(super) orbit: Orbit<N>,
    /// Residual of the last integrated period, see [`residual`].
    pub(super) residual: f64,
    scale: [f64; N],
    before: Option<[f64; N]>,
    steps: u32,
}

impl<const N: usize> Chord<N> {
    /// Returns an iteration of Broyden's method that begins at the state of `orbit`, with the monodromy
    /// matrix of `orbit`.
    pub(super) fn new(orbit: Orbit<N>, scale: &[f64; N]) -> Chord<N> {
        Chord { orbit, residual: f64::INFINITY, scale: *scale, before: None, steps: 0 }
    }

    /// Makes one step of the iteration. `end` is the state at the end of the period that begins at the
    /// current state.
    ///
    /// If the residual hardly decreases, too many steps were made, or the linear system is singular, the
    /// result is false. If the result is false, the state of the iteration does not change.
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

    /// Updates M by Broyden's formula from the last step.
    ///
    /// If M were exact, the step would end on the orbit, and the next period would not change the state. The
    /// change over the next period is therefore a measure of the error of M in the direction of the step.
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

/// Returns the fixed point of a linear map. The map takes the state of `near` to `end`, and the derivative of
/// the map is the monodromy matrix of `near`.
///
/// Returns `None` if the linear system is singular or not finite.
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
