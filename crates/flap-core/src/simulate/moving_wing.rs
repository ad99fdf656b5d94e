//! Equations of a wing whose shoulder moves in any way, and the load on this wing at an instant.

use crate::body::BodyMotion;
use crate::model::{Instant, Model};
use crate::ode::Start;
use crate::parameter::Invalid;

/// Equations of motion of a wing with given parameter values, for any motion of the wing's shoulder.
///
/// At each instant, the equations assume that the velocity and the rates of the shoulder are constant. The
/// acceleration of the shoulder therefore has no effect.
pub trait MovingWing {
    /// Returns the drive period (s). At time zero, a period begins and the phase of the drive is zero.
    fn period(&self) -> f64;

    /// Returns the typical size of each state.
    fn scale(&self) -> &[f64];

    /// Computes the derivative `dy` of the state `y` at time `t` (s), for the given `motion` of the shoulder.
    ///
    /// Returns the force (N) and the moment (N·m) of the air at the shoulder, see
    /// [`Load::at_shoulder`](crate::model::Load::at_shoulder). `y` and `dy` have one number for each state.
    /// If the model has a switching surface, the sign of [`Ode::switch`](crate::ode::Ode::switch) determines
    /// the side of the surface.
    ///
    /// # Panics
    /// Panics if `y` or `dy` does not have one number for each state.
    fn derivative(&self, t: f64, y: &[f64], motion: BodyMotion<f64>, dy: &mut [f64]) -> [f64; 6];
}

/// A wing of a model with N states.
struct Wing<M: Model<N>, const N: usize> {
    model: M,
    start: Start<M::Constants<f64>, N>,
}

/// Returns a wing with the given parameter values. The motion of the body in `values` must not be zero,
/// because the equations contain the terms of body motion only for a nonzero motion.
pub(super) fn moving_wing<M: Model<N>, const N: usize>(
    model: &M,
    values: &[f64],
) -> Result<Box<dyn MovingWing>, Invalid> {
    let model = model.variant(values);
    let start = model.start(values)?;
    Ok(Box::new(Wing { model, start }))
}

impl<M: Model<N>, const N: usize> MovingWing for Wing<M, N> {
    fn period(&self) -> f64 {
        self.start.span
    }

    fn scale(&self) -> &[f64] {
        &self.start.scale
    }

    fn derivative(&self, t: f64, y: &[f64], motion: BodyMotion<f64>, dy: &mut [f64]) -> [f64; 6] {
        let mut state = [0.0; N];
        state.copy_from_slice(y);
        let model = &self.model;
        let c = &M::with_motion(&self.start.constants, motion);
        let input = &model.input(c, t);
        let side = if M::SWITCHES { 1.0_f64.copysign(model.switch(c, &state, &[0.0; N])[0]) } else { 1.0 };
        let slope = model.rhs(c, input, side, &state);
        dy.copy_from_slice(&slope);
        model.load(c, Instant { input, side, y: &state, dy: &slope }).at_shoulder()
    }
}
