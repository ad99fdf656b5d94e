//! The equations of the four-bar model with the terms that the paper leaves out.
//!
//! The additional terms are motion of the body, higher harmonics of the attack angle, rotational circulation,
//! and nonlinear springs. If all additional terms are zero, [`super::rhs`] computes the same derivatives as
//! this module, apart from rounding errors.
//!
//! On a moving body, each strip has its own direction of flow, and the lifts of the strips jump at different
//! times. The aerodynamic functions of this module are not inlined into the code for the equations of the
//! paper. If the terms that the paper leaves out are all zero, the module needs no computing time.
//!
//! The pitch ψ in [`crate::body`] has the opposite sign of the pitch φ in the four-bar model: ψ = −φ.

use core::f64::consts::{FRAC_PI_2, PI};

use super::aerodynamics::{Aerodynamics, aerodynamics, coefficients, load_in, rotational_force};
use super::constants::Constants;
use super::rhs::{Transmission, balance_in};
use super::variant::FourBar;
use crate::aero::{Flow, NormalLoad, ObliqueForces, ObliqueStrip, oblique_forces};
use crate::body::{BodyTerms, Sections, Shoulder};
use crate::model::Load;
use crate::model::stroke_and_pitch::Balance;
use crate::num::{Lanes, Real};
use crate::ode::step::Attempt;

/// Limit of |u_C|/U. If |u_C|/U is below `GRAZING`, the `side` of the switching surface determines the
/// direction of the flow along the chord.
const GRAZING: f64 = 1e-9;

/// Returns the sign of u_C, which is the direction of the flow along the chord.
///
/// On the switching surface, u_C is zero apart from rounding errors. If u_C is almost zero, the function
/// returns the sign of −σ u_N (see [`side_of`](super::aerodynamics::side_of)).
#[inline(always)]
fn direction<R: Real>(side: R, flow: &Flow<R>) -> R {
    let Flow { normal, chordwise, speed } = *flow;
    let grazes = chordwise.abs().lt(speed * GRAZING);
    side.lit(1.0).copysign(R::select(grazes, -(side * normal), chordwise))
}

/// Returns the forces on a strip along the normal and the chord, divided by ½ρcΔr (m²/s²), with the
/// coefficients of Eqs. (9) and (10). The second result is the centre of pressure (chords).
///
/// ```text
/// F_N = U (C_l s u_C sign u_N + C_d u_N)     F_C = U (C_l s |u_N| − C_d u_C)     s = sign u_C
/// ```
///
/// As long as the `direction` s is constant, F_N and F_C are smooth at u_C = 0. If s changes its sign, the
/// force F_C along the chord jumps.
#[inline(always)]
fn law<R: Real>(c: &Constants<R>, direction: R, flow: &Flow<R>) -> ([R; 2], R) {
    let Flow { normal, chordwise, speed } = *flow;
    let attack = flow.attack();
    let forwards = direction.lit(0.0).lt(direction);
    let [c_l, c_d] = coefficients(&c.air, true, R::select(forwards, attack, -attack + PI));
    let lift = c_l * direction;
    let normal_force = lift * chordwise * direction.lit(1.0).copysign(normal) + c_d * normal;
    let chord_force = lift * normal.abs() - c_d * chordwise;
    let pressure = c.air.pressure_upright
        + c.air.pressure_slope * (attack - FRAC_PI_2)
        + c.air.harmonics.pressure(attack * 2.0);
    ([speed * normal_force, speed * chord_force], pressure)
}

/// Motion of a wing and of its sections at one state of the model.
#[derive(Clone, Copy)]
struct Motion<R> {
    stroke: R,
    shoulder: Shoulder<R>,
    /// Stroke rate φ̇ and pitch rate ψ̇, with the signs of the module [`crate::body`].
    rates: [R; 2],
    sections: Sections<R>,
    /// Sine and cosine of ψ.
    pitch: [R; 2],
}

impl<R: Real> Motion<R> {
    #[inline(always)]
    fn at(c: &Constants<R>, y: &[R; 4]) -> Motion<R> {
        Motion::with(c.moving.motion.along(y[0]), y)
    }

    #[inline(always)]
    fn with(shoulder: Shoulder<R>, y: &[R; 4]) -> Motion<R> {
        let [theta, phi, theta_dot, phi_dot] = *y;
        let (sin, cos) = phi.sin_cos();
        let rates = [theta_dot, -phi_dot];
        let sections = shoulder.sections(rates[0], rates[1], cos);
        Motion { stroke: theta, shoulder, rates, sections, pitch: [-sin, cos] }
    }

    #[inline(always)]
    fn flow(&self, strip: &ObliqueStrip<R>) -> Flow<R> {
        Flow::past(&self.sections, strip, self.pitch)
    }

    /// Returns −|φ̇|φ̇ (rad²/s²), where φ̇ is the pitch rate relative to still air.
    #[inline(always)]
    fn rotation(&self) -> R {
        let rate = self.shoulder.pitch_rate(self.rates[1]);
        rate.abs() * rate
    }

    /// Returns the aerodynamic forces and moments without the added mass, given the [`direction`] of the flow
    /// past each strip.
    #[inline(always)]
    fn aerodynamics(
        &self,
        c: &Constants<R>,
        direction: impl Fn(&ObliqueStrip<R>, &Flow<R>) -> R,
    ) -> Aerodynamics<R> {
        let forces = oblique_forces(
            c.strips.oblique(c.moving.behind),
            &self.sections,
            self.pitch,
            #[inline(always)]
            |strip, flow| law(c, direction(strip, flow), flow),
        );
        let [lift, drag] = forces.lift_and_drag(self.pitch);
        let [lift_moment, drag_moment] = forces.moments(self.pitch);
        let rotation = rotational_force(&c.air, self.rotation());
        Aerodynamics {
            lift,
            drag,
            stroke_moment: -drag_moment,
            lift_moment,
            pitch_moment: -forces.pitch_moment,
            rotation: rotation.plus(&self.circulation(c)),
        }
    }

    /// Returns the force and the moments of the rotational circulation.
    #[inline(always)]
    fn circulation(&self, c: &Constants<R>) -> NormalLoad<R> {
        c.circulation.load(&self.sections, self.shoulder.pitch_rate(self.rates[1]), self.pitch)
    }

    /// Returns the part of the added-mass lift that is due to the motion of the body (N).
    #[inline(always)]
    fn added_mass_lift(&self, c: &Constants<R>) -> R {
        let [e_0, e_1, e_2] = self.shoulder.accelerations(self.rates, self.pitch);
        (c.air.added_stroke * e_1 - c.air.added_pitch * e_2 + c.moving.added * e_0) * self.pitch[0]
    }

    /// Returns the aerodynamic force and moment on the wing. The forces of the added mass include the normal
    /// accelerations of [`Shoulder::accelerations`].
    #[inline(always)]
    fn load(&self, c: &Constants<R>, air: &Aerodynamics<R>, y: &[R; 4], dy: &[R; 4]) -> Load<R> {
        let [e_0, e_1, e_2] = self.shoulder.accelerations(self.rates, self.pitch);
        let [sin, cos] = [-self.pitch[0], self.pitch[1]];
        let normal = dy[2] * cos - dy[0] * dy[1] * sin;
        let load = load_in(c, air, y, [normal + e_1, dy[3] - e_2], [sin, cos]);
        // The constant part e₀ acts on the whole added mass, its first moment, and its depth behind the axis.
        let (force, moment) = (c.moving.added * e_0, c.air.added_stroke * e_0);
        Load {
            lift: load.lift - force * sin,
            drag: load.drag + force * cos,
            lift_moment: load.lift_moment - moment * sin,
            drag_moment: load.drag_moment + moment * cos,
            span_moment: load.span_moment + c.air.added_pitch * e_0,
            ..load
        }
    }
}

/// Returns the motion of the wing at the state `y`, and the aerodynamic forces and moments without the added
/// mass.
#[inline(always)]
fn motion_in_air<R: Real>(
    c: &Constants<R>,
    body_moves: bool,
    side: R,
    y: &[R; 4],
) -> (Motion<R>, Aerodynamics<R>) {
    side.outlined(
        #[inline(always)]
        || motion_in_air_inlined(c, body_moves, side, y),
    )
}

#[inline(always)]
fn motion_in_air_inlined<R: Real>(
    c: &Constants<R>,
    body_moves: bool,
    side: R,
    y: &[R; 4],
) -> (Motion<R>, Aerodynamics<R>) {
    if body_moves {
        let motion = Motion::at(c, y);
        let air = motion.aerodynamics(
            c,
            #[inline(always)]
            |_, flow| direction(side, flow),
        );
        return (motion, air);
    }
    let motion = Motion::with(Shoulder::rest(side), y);
    let air = aerodynamics(c, true, side, y, -motion.pitch[0], motion.pitch[1]);
    let rotation = air.rotation.plus(&motion.circulation(c));
    (motion, Aerodynamics { rotation, ..air })
}

/// Returns the aerodynamic forces and moments on the wing without the added mass.
///
/// The second result is the part of the added-mass lift that is due to the motion of the body (N).
#[inline(always)]
pub(super) fn air<R: Real>(c: &Constants<R>, model: &FourBar, side: R, y: &[R; 4]) -> (Aerodynamics<R>, R) {
    let (motion, air) = motion_in_air(c, model.terms.body == BodyTerms::All, side, y);
    (air, motion.added_mass_lift(c))
}

/// Returns the mass matrix and the generalised forces. The generalised forces include the nonlinear moments
/// of the springs, and the inertial moments that result from the rotation of the body. The mass matrix
/// includes the added mass, and does not depend on the velocity of the body.
#[inline(always)]
pub(super) fn balance<R: Real>(
    c: &Constants<R>,
    model: &FourBar,
    links: &Transmission<R>,
    side: R,
    y: &[R; 4],
) -> Balance<R> {
    let (motion, air) = motion_in_air(c, model.terms.body == BodyTerms::All, side, y);
    let Motion { shoulder, rates: [theta_dot, psi_dot], pitch, .. } = motion;
    let gyroscopic = shoulder.gyroscopic(c.wing.j_difference, c.wing.coupling, pitch);
    let at = [-pitch[0], pitch[1]];
    let Balance { mass, stroke_moment, pitch_moment } = balance_in(c, links, &air, y, at);
    Balance {
        mass,
        stroke_moment: stroke_moment + gyroscopic * psi_dot - c.stiffening.stroke_moment(y[0]),
        pitch_moment: pitch_moment + gyroscopic * theta_dot - c.stiffening.hinge_moment(y[1]),
    }
}

/// Returns the aerodynamic force and moment on the wing at the state `y` with the derivative `dy`.
#[inline(always)]
pub(super) fn load<R: Real>(c: &Constants<R>, model: &FourBar, side: R, y: &[R; 4], dy: &[R; 4]) -> Load<R> {
    let (motion, air) = motion_in_air(c, model.terms.body != BodyTerms::None, side, y);
    motion.load(c, &air, y, dy)
}

/// Number of iterations in the search for the time of a jump. The search uses regula falsi with the Illinois
/// rule.
const SEARCH: usize = 5;

/// Nodes and weights of the Gauss-Legendre rule on [0, 1].
const GAUSS: [[f64; 2]; 3] =
    [[0.112_701_665_379_258_31, 5.0 / 18.0], [0.5, 8.0 / 18.0], [0.887_298_334_620_741_7, 5.0 / 18.0]];

/// Returns the motion of the wing at the fraction `theta` of a step.
#[inline(always)]
fn motion_within<R: Real>(
    c: &Constants<R>,
    attempt: &Attempt<'_, R, 4>,
    state: &impl Fn(R, &[R; 4]) -> [R; 4],
    theta: R,
) -> Motion<R> {
    let Attempt { t, h, step, .. } = *attempt;
    Motion::at(c, &state(theta.mul_add(h, t), &step.interpolate(h, theta)))
}

/// Returns the time integral of the load at the shoulder over a step.
///
/// First, the function integrates a smooth load: it assumes that the flow past each strip does not change its
/// direction within the step. If the flow past a strip reverses within the step, the function adds the
/// integral of the change of the load that the reversal causes.
///
/// The function `state` converts the state of the integrator at a time to the state of the wing. The function
/// `slope` converts the derivative of the integrator's state to the derivative of the wing's state.
#[inline(always)]
pub(super) fn impulse<R: Lanes>(
    c: &Constants<R>,
    attempt: &Attempt<'_, R, 4>,
    state: impl Fn(R, &[R; 4]) -> [R; 4],
    slope: impl Fn(R, &[R; 4]) -> [R; 4],
) -> [R; 6] {
    let Attempt { t, h, side, step } = *attempt;
    let begin = Motion::at(c, &state(t, &step.y[0]));
    let mut sums = attempt.integral(
        #[inline(always)]
        |stage, time| {
            let (y, dy) = (state(time, &step.y[stage]), slope(time, &step.k[stage]));
            let motion = Motion::at(c, &y);
            let air = motion.aerodynamics(
                c,
                #[inline(always)]
                |strip, _| direction(side, &begin.flow(strip)),
            );
            motion.load(c, &air, &y, &dy).at_shoulder()
        },
    );
    let quarters: [Motion<R>; PARTS + 1] = core::array::from_fn(
        #[inline(always)]
        |i| match i {
            0 => begin,
            PARTS => Motion::at(c, &state(t + h, &step.y[6])),
            _ => motion_within(c, attempt, &state, h.lit(i as f64 / PARTS as f64)),
        },
    );
    for strip in c.strips.oblique(c.moving.behind) {
        let first = direction(side, &begin.flow(&strip));
        let mut low = first * begin.flow(&strip).chordwise;
        low = low.max(low.lit(0.0));
        for part in 0..PARTS {
            // Components of the flow along the first direction.
            let last = quarters[part + 1].flow(&strip);
            let high = first * last.chordwise;
            let grazes = high.abs().lt(last.speed * GRAZING);
            let high = R::select(grazes, h.lit(0.0).copysign(low), high);
            let start = part as f64 / PARTS as f64;
            let [from, to] = reversed(
                start,
                [low, high],
                #[inline(always)]
                |theta| first * motion_within(c, attempt, &state, theta).flow(&strip).chordwise,
            );
            low = high;
            let length = to - from;
            if R::bits(h.lit(0.0).lt(length)) == 0 {
                continue;
            }
            for [node, weight] in GAUSS {
                let motion = motion_within(c, attempt, &state, length.mul_add(h.lit(node), from));
                let flow = motion.flow(&strip);
                let ([n_before, c_before], _) = law(c, first, &flow);
                let ([n_after, c_after], pressure) = law(c, -first, &flow);
                let mut change = ObliqueForces::none(h);
                change.add(&strip, ([n_after - n_before, c_after - c_before], pressure));
                let [lift, drag] = change.lift_and_drag(motion.pitch);
                let [lift_moment, drag_moment] = change.moments(motion.pitch);
                let span_moment = change.pitch_moment;
                let load = Load { stroke: motion.stroke, lift, drag, lift_moment, drag_moment, span_moment };
                let load = load.at_shoulder();
                for i in 0..6 {
                    sums[i] = load[i].mul_add(length * h * weight, sums[i]);
                }
            }
        }
    }
    sums
}

/// Number of parts into which each integration step is divided. The search for jumps assumes that the flow
/// past a strip reverses at most once in each part of a step.
const PARTS: usize = 4;

/// Returns the interval within one part of a step in which the flow is reversed, as fractions of the step. If
/// the flow is not reversed, the interval is empty.
///
/// The part begins at the fraction `begin` of the step. `f_low` and `f_high` are the flow components along
/// the initial direction of the flow, at the beginning and at the end of the part. The function `value`
/// returns the flow component along the initial direction at a given fraction of the step.
#[inline(always)]
fn reversed<R: Lanes>(begin: f64, [mut f_low, mut f_high]: [R; 2], value: impl Fn(R) -> R) -> [R; 2] {
    let (zero, one) = (f_low.lit(0.0), f_low.lit(1.0));
    let (begin, end) = (f_low.lit(begin), f_low.lit(begin + 1.0 / PARTS as f64));
    let negative = |number: R| one.copysign(number).lt(zero);
    let (reversed, returns) = (negative(f_low), !negative(f_high));
    let turns = (reversed & returns) | (!reversed & !returns);
    let mut turn = end;
    if R::bits(turns) != 0 {
        let (mut low, mut high) = (begin, end);
        let mut kept = zero;
        for _ in 0..SEARCH {
            let span = R::select(turns, f_low - f_high, one);
            turn = R::select(turns, low + (high - low) * (f_low / span), end);
            let found = value(turn);
            let is_high = (negative(found) & !reversed) | (!negative(found) & reversed);
            // An end that is kept twice in a row counts half.
            let (low_kept, high_kept) = (zero.lt(kept), kept.lt(zero));
            f_low = R::select(is_high, R::select(low_kept, f_low * 0.5, f_low), found);
            f_high = R::select(is_high, found, R::select(high_kept, f_high * 0.5, f_high));
            (low, high) = (R::select(is_high, low, turn), R::select(is_high, turn, high));
            kept = R::select(is_high, one, -one);
        }
    }
    let from = R::select(reversed, begin, R::select(turns, turn, end));
    [from, R::select(reversed & turns, turn, end)]
}
