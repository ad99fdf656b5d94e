//! A wing whose shoulder moves in any way: its equations and its load at an instant.

use crate::body::BodyMotion;
use crate::model::{Instant, Model};
use crate::ode::Start;
use crate::parameter::Invalid;

/// The equations of a wing's motion with given values of its parameters, for any motion of its shoulder.
///
/// The equations are those for a shoulder with constant velocity and rates. Its acceleration has no effect.
pub trait MovingWing {
    /// Returns the drive period (s). A period begins at time zero, with the phase zero of the drive.
    fn period(&self) -> f64;

    /// Returns the typical size of each state.
    fn scale(&self) -> &[f64];

    /// Computes the derivative of the state `y` at time `t` (s), for this motion of the shoulder.
    ///
    /// Returns force (N) and moment (N·m) at the shoulder, see [`Load::at_shoulder`](crate::model::Load::at_shoulder).
    /// `y` and `dy` have one number for each state. The side of the switching surface is the sign of
    /// [`Ode::switch`](crate::ode::Ode::switch).
    ///
    /// # Panics
    /// If `y` or `dy` has another length.
    fn derivative(&self, t: f64, y: &[f64], motion: BodyMotion<f64>, dy: &mut [f64]) -> [f64; 6];
}

/// A wing of a model with N states.
struct Wing<M: Model<N>, const N: usize> {
    model: M,
    start: Start<M::Constants<f64>, N>,
}

/// Returns the wing with these values. Its equations contain the terms of the motion in `values`, which must not be
/// zero.
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
