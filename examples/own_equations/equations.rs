//! The equations of motion and the measures of this example. The model is a bimorph of Jafferis, Graule and
//! Wood (2016) with constant stiffness and a sinusoidal force. The equations are Eqs. (1), (2) and (8) to
//! (11) of the paper, with the numbers of its Table I.

#[path = "constants.rs"]
mod constants;

use core::f64::consts::FRAC_1_PI;

use flap_core::num::{Lanes, Real};
use flap_core::ode::Ode;
use flap_core::ode::ensemble::Observer;
use flap_core::ode::step::Attempt;
use flap_core::ode::tableau::B;

pub(crate) use constants::SCALE;
use constants::{
    COUPLING, DRAG_MEAN, DRAG_SWING, HINGE, HINGE_DRAG, INERTIA, LIFT, MASS, MOMENT, PRESSURE, STIFFNESS,
    TIP_DRAG, TRANSMISSION,
};

// What a point of the grid has of its own. The macro makes a struct of numbers `R`: one per SIMD lane.
flap_core::per_lane! {
    /// The drive.
    pub struct Drive<R> {
        /// Amplitude of the force divided by the mass (m/s²).
        pub force: R,
        /// Angular frequency (rad/s).
        pub frequency: R,
    }
}

impl Drive<f64> {
    /// Returns the drive constants of a force with the amplitude `force` (N) and the frequency `frequency`
    /// (Hz).
    pub(crate) fn new(force: f64, frequency: f64) -> Drive<f64> {
        Drive { force: force / MASS, frequency: core::f64::consts::TAU * frequency }
    }
}

/// The model. The states are the displacement (m) and the speed of the actuator's tip, the pitch (rad) and
/// the pitch rate.
pub(crate) struct Wing;

impl Ode<4> for Wing {
    type Constants<R: Real> = Drive<R>;
    type Input<R: Real> = R;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Drive<R>, t: R) -> R {
        c.force * (c.frequency * t).sin()
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, _c: &Drive<R>, force: &R, _side: R, y: &[R; 4]) -> [R; 4] {
        let [x, v, psi, w] = *y;
        let (sin, cos) = psi.sin_cos();
        let sin_squared = sin * sin;
        let speed = v * v.abs();
        // C_D / D₀, and (C_D cos ψ + C_L sin ψ) / cos ψ, of cos 2ψ = 1 - 2 sin² ψ and sin 2ψ = 2 sin ψ cos ψ.
        let drag = sin_squared.mul_add(x.lit(-2.0 * DRAG_SWING), x.lit(DRAG_MEAN + DRAG_SWING));
        let force_on_hinge =
            sin_squared.mul_add(x.lit(2.0 * (LIFT - DRAG_SWING)), x.lit(DRAG_MEAN + DRAG_SWING));
        let a = (drag * speed).mul_add(x.lit(-TIP_DRAG / MASS), x.mul_add(x.lit(-STIFFNESS / MASS), *force));
        // The centre of pressure moves with the angle of attack.
        let arm = psi.abs().mul_add(x.lit(-2.0 * FRAC_1_PI), x.lit(1.0)).abs();
        let arm = arm.mul_add(x.lit((0.151 - 0.132) * (MOMENT / INERTIA)), x.lit(0.132 * (MOMENT / INERTIA)));
        let swing = a
            .mul_add(x.lit(COUPLING * TRANSMISSION / INERTIA), v * v * (sin * (TRANSMISSION * TRANSMISSION)));
        let on_hinge = (arm * speed).mul_add(force_on_hinge, swing);
        let spring = psi.mul_add(x.lit(HINGE / INERTIA), w * w.abs() * (HINGE_DRAG / INERTIA));
        [v, a, w, on_hinge.mul_add(cos, -spring)]
    }
}

flap_core::per_lane! {
    /// The measures.
    #[derive(Default)]
    pub struct Sums<R> {
        /// Largest |x| (m).
        pub tip: R,
        /// Largest |ψ| (rad).
        pub psi: R,
        /// ∫ lift dt (N s).
        pub lift: R,
    }
}

/// Computes the largest displacement, the largest pitch and the integral of the lift.
pub(crate) struct Measured;

impl Observer<Wing, 4> for Measured {
    type Totals<R: Lanes> = Sums<R>;

    fn nothing(&self) -> Sums<f64> {
        Sums { tip: 0.0, psi: 0.0, lift: 0.0 }
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        _c: &Drive<R>,
        attempt: &Attempt<'_, R, 4>,
        accepted: R::Mask,
        sums: &mut Sums<R>,
    ) {
        let Attempt { h, step, .. } = *attempt;
        // A quadrature with the stages of the step.
        let mut lift = sums.lift;
        for stage in [0, 2, 3, 4, 5] {
            let [_, v, psi, _] = step.y[stage];
            lift = (v * v.abs() * (psi * 2.0).sin() * (LIFT * PRESSURE)).mul_add(h * B[stage], lift);
        }
        sums.lift = R::select(accepted, lift, sums.lift);
        let tip = peak(attempt, accepted, 0, 1, sums.tip);
        sums.tip = tip;
        sums.psi = peak(attempt, accepted, 2, 3, sums.psi);
    }
}

/// Returns the larger of `so_far` and the peak of a state in this step. The state has a peak where its rate
/// changes sign.
#[inline(always)]
fn peak<R: Lanes>(attempt: &Attempt<'_, R, 4>, accepted: R::Mask, state: usize, rate: usize, so_far: R) -> R {
    let Attempt { h, step, .. } = *attempt;
    let (begin, end) = (step.y[0][rate], step.y[6][rate]);
    let turns = accepted & (begin * end).lt(h.lit(0.0));
    if R::bits(turns) == 0 {
        return so_far;
    }
    // Where the rate is zero: the chord, then Newton's iteration with the chord's slope.
    let slope = R::select(turns, end - begin, h.lit(1.0));
    let mut at = -begin / slope;
    for _ in 0..3 {
        at = (at - step.interpolate(h, at)[rate] / slope).max(h.lit(0.0)).min(h.lit(1.0));
    }
    R::select(turns, step.interpolate(h, at)[state].abs().max(so_far), so_far)
}
