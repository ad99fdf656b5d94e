//! Motion of the body through still air, and the resulting motion of the sections of a wing.
//!
//! While the motion of the wings settles, the velocity and the angular velocity of the body are constant in
//! body axes. `docs/models/body-motion.md` derives the equations.

use crate::num::Real;
use crate::parameter::Kind::{Choice, Number};
use crate::parameter::Range::Any;
use crate::parameter::{Invalid, Parameter};

/// Name of the parameter that selects whether the wings respond to the motion of the body.
const RESPONSE: &str = "body_response";

crate::choice! {
    /// Response of the wings to the motion of the body.
    pub enum BodyResponse {
        /// The motion of the body changes the motion of the wings.
        Passive = "passive",
        /// The wings move as if the body were at rest. The motion of the body changes only the load on the body.
        Frozen = "frozen",
    }
}

crate::parameters! {
    /// Velocity and angular velocity of the body relative to still air, in body axes.
    pub struct BodyParameters {
        ["body motion"]
        /// Forward velocity of the body through still air, at the reference point of the torques. For a
        /// single wing, the parameter is the velocity of the shoulder along its forward axis. At zero stroke,
        /// the wing moves along this axis when the stroke increases.
        body_velocity_forward: f64 = ("m/s", "u", Number(Any), default: 0.0),
        /// Velocity of the body to the left. For a single wing, the parameter is the velocity of the shoulder
        /// along the span.
        body_velocity_left: f64 = ("m/s", "v", Number(Any), default: 0.0),
        /// Upward velocity of the body. For a single wing, the parameter is the velocity of the shoulder
        /// along the stroke axis.
        body_velocity_up: f64 = ("m/s", "w", Number(Any), default: 0.0),
        /// Roll rate of the body. A positive rate lifts the left side of the body. For a single wing, the
        /// parameter is the angular velocity of the shoulder about its forward axis. At zero stroke, the wing
        /// moves along this axis when the stroke increases.
        body_rate_roll: f64 = ("rad/s", "p", Number(Any), default: 0.0),
        /// Pitch rate of the body. A positive rate lowers the nose of the body. For a single wing, the
        /// parameter is the angular velocity of the shoulder about the span at zero stroke.
        body_rate_pitch: f64 = ("rad/s", "q", Number(Any), default: 0.0),
        /// Yaw rate of the body. A positive rate turns the nose of the body to the left. For a single wing,
        /// the parameter is the angular velocity of the shoulder about the stroke axis.
        body_rate_yaw: f64 = ("rad/s", "r", Number(Any), default: 0.0),
        /// Response of the wings to the motion of the body. With "passive", stroke and pitch respond to the
        /// motion of the body. With "frozen", the wings move as if the body were at rest, and only the loads
        /// on the body change. If the body moves, the option "frozen" requires a vehicle.
        body_response: BodyResponse = ("", "", Choice(BodyResponse::NAMES)),
    }
}

impl BodyParameters {
    /// A body at rest.
    pub const REST: BodyParameters = BodyParameters {
        body_velocity_forward: 0.0,
        body_velocity_left: 0.0,
        body_velocity_up: 0.0,
        body_rate_roll: 0.0,
        body_rate_pitch: 0.0,
        body_rate_yaw: 0.0,
        body_response: BodyResponse::Passive,
    };

    /// Names of the six parameters for the velocity and the angular velocity of the body, in the order of the
    /// parameter table.
    pub const MOTION: [&'static str; 6] = [
        "body_velocity_forward",
        "body_velocity_left",
        "body_velocity_up",
        "body_rate_roll",
        "body_rate_pitch",
        "body_rate_yaw",
    ];

    /// Returns which equations of a wing contain the motion of the body: none, only the equations for the
    /// loads, or all.
    pub fn terms(&self) -> BodyTerms {
        let BodyMotion { velocity, rate } = self.motion();
        if velocity.into_iter().chain(rate).all(|component| component == 0.0) {
            return BodyTerms::None;
        }
        match self.body_response {
            BodyResponse::Passive => BodyTerms::All,
            BodyResponse::Frozen => BodyTerms::Loads,
        }
    }

    /// Returns the velocity vector and the angular velocity vector of the body.
    pub fn motion(&self) -> BodyMotion<f64> {
        BodyMotion {
            velocity: [self.body_velocity_forward, self.body_velocity_left, self.body_velocity_up],
            rate: [self.body_rate_roll, self.body_rate_pitch, self.body_rate_yaw],
        }
    }

    /// Checks that the `values` of a single wing do not combine a motion of the body with the response "frozen".
    ///
    /// With "frozen", the motion of the body changes only the loads on a vehicle, and has no effect on a
    /// single wing.
    ///
    /// # Errors
    /// An error if the body moves and the response is "frozen".
    pub(crate) fn check_single(parameters: &[Parameter<'_>], values: &[f64]) -> Result<(), Invalid> {
        let value = |name: &str| Parameter::index(parameters, name).map_or(0.0, |index| values[index]);
        let is_frozen = value(RESPONSE) == f64::from(BodyResponse::Frozen as u8);
        if is_frozen && BodyParameters::MOTION.into_iter().any(|name| value(name) != 0.0) {
            return Err(Invalid::new(
                "body_response = \"frozen\" needs a vehicle, because the motion of the body then changes only the loads \
                 on the vehicle: add [vehicle], or set body_response to \"passive\"",
            ));
        }
        Ok(())
    }

    /// Returns a copy of `values` in which the response is "passive". With "passive", the motion of the body
    /// changes lift and drag.
    pub(crate) fn passive(parameters: &[Parameter<'_>], values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        if let Some(index) = Parameter::index(parameters, RESPONSE) {
            values[index] = f64::from(BodyResponse::Passive as u8);
        }
        values
    }
}

/// Terms that the motion of the body adds to the equations of a wing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyTerms {
    /// The body is at rest.
    None,
    /// Only the equations for the loads contain the motion of the body.
    Loads,
    /// The equations of motion and the equations for the loads contain the motion of the body.
    All,
}

crate::per_lane! {
    /// Velocity (m/s) and angular velocity (rad/s) of a wing's shoulder relative to still air.
    ///
    /// The components are along three axes: the forward axis, the span at zero stroke, and the stroke axis.
    /// At zero stroke, the wing moves along the forward axis when the stroke increases.
    pub struct BodyMotion<R> {
        /// Velocity V.
        pub velocity: [R; 3],
        /// Angular velocity Ω.
        pub rate: [R; 3],
    }
}

impl BodyMotion<f64> {
    /// A body at rest.
    pub(crate) const REST: BodyMotion<f64> = BodyMotion { velocity: [0.0; 3], rate: [0.0; 3] };
}

impl<R: Real> BodyMotion<R> {
    /// Returns the motion of the shoulder along the axes of the wing at a stroke angle (rad). The axes rotate
    /// with the stroke.
    ///
    /// ```text
    /// e_s = (sin φ, cos φ, 0)     e_t = (cos φ, −sin φ, 0)
    /// ```
    #[inline(always)]
    pub fn along(&self, stroke: R) -> Shoulder<R> {
        let (sin, cos) = stroke.sin_cos();
        let ([v_x, v_y, v_z], [r_x, r_y, r_z]) = (self.velocity, self.rate);
        Shoulder {
            velocity_t: v_x * cos - v_y * sin,
            velocity_s: v_x * sin + v_y * cos,
            velocity_z: v_z,
            rate_t: r_x * cos - r_y * sin,
            rate_s: r_x * sin + r_y * cos,
            rate_z: r_z,
        }
    }
}

/// Motion of a wing's shoulder along the axes of the wing: e_t, e_s (span) and e_z (stroke axis). The wing
/// moves along the axis e_t when the stroke increases.
#[derive(Clone, Copy, Debug)]
pub struct Shoulder<R> {
    /// Component of the shoulder's velocity along the axis e_t (m/s).
    pub velocity_t: R,
    /// Component of the shoulder's velocity along the axis e_s (m/s).
    pub velocity_s: R,
    /// Component of the shoulder's velocity along the axis e_z (m/s).
    pub velocity_z: R,
    /// Angular velocity of the shoulder about the axis e_t (rad/s).
    pub rate_t: R,
    /// Angular velocity of the shoulder about the axis e_s (rad/s).
    pub rate_s: R,
    /// Angular velocity of the shoulder about the axis e_z (rad/s).
    pub rate_z: R,
}

impl<R: Real> Shoulder<R> {
    /// Returns the motion of a shoulder at rest: all components are zero, of the same number type as
    /// `number`.
    #[inline(always)]
    pub fn rest(number: R) -> Shoulder<R> {
        let zero = number.lit(0.0);
        Shoulder {
            velocity_t: zero,
            velocity_s: zero,
            velocity_z: zero,
            rate_t: zero,
            rate_s: zero,
            rate_z: zero,
        }
    }

    /// Returns the motion of the wing's sections relative to still air. `stroke_rate` and `pitch_rate` are φ̇
    /// and ψ̇ (rad/s), and `cos` is the cosine of the pitch ψ.
    #[inline(always)]
    pub fn sections(&self, stroke_rate: R, pitch_rate: R, cos: R) -> Sections<R> {
        Sections {
            stroke_rate: stroke_rate - self.rate_z,
            sweep_rate: self.pitch_rate(pitch_rate) * cos,
            along: self.velocity_t,
            up: self.velocity_z,
            tilt_rate: self.rate_t,
        }
    }

    /// Returns the pitch rate relative to still air: ψ̇ + Ω_s (rad/s).
    #[inline(always)]
    pub fn pitch_rate(&self, pitch_rate: R) -> R {
        pitch_rate + self.rate_s
    }

    /// Returns the factor g (N·m·s) of the gyroscopic moments on a thin wing, if the body has the angular
    /// velocity Ω. Terms of second order in Ω are neglected. `inertia` is ∫ d² dm and `product` is ∫ r d dm
    /// (kg·m²), with the radius r and the distance d behind the pitch axis.
    ///
    /// The gyroscopic moment is −g φ̇ about the pitch axis and g ψ̇ about the stroke axis. The total power of
    /// the two gyroscopic moments is zero.
    ///
    /// ```text
    /// g = 2 sin ψ (I (Ω_t sin ψ + Ω_z cos ψ) − I_xz Ω_s)
    /// ```
    #[inline(always)]
    pub fn gyroscopic(&self, inertia: R, product: R, [sin, cos]: [R; 2]) -> R {
        sin * (inertia * (self.rate_t * sin + self.rate_z * cos) - product * self.rate_s) * 2.0
    }

    /// Returns the changes [e₀, e₁, e₂] that the motion of the body causes in the normal acceleration of the wing's
    /// sections.
    ///
    /// At the radius r and the distance d behind the pitch axis, the normal acceleration changes by e₀ + r e₁
    /// − d e₂. The first argument contains the stroke rate φ̇ and the pitch rate ψ̇ (rad/s).
    ///
    /// ```text
    /// u̇_n = r (A + e₁) + e₀ − d (ψ̈ + e₂)
    /// e₁ = (Ω_z ψ̇ + Ω_s φ̇) sin ψ − Ω_t ψ̇ cos ψ     e₂ = Ω_t φ̇
    /// e₀ = −(v_s φ̇ + V_z ψ̇) cos ψ − a ψ̇ sin ψ
    /// ```
    #[inline(always)]
    pub fn accelerations(&self, [phi_dot, psi_dot]: [R; 2], [sin, cos]: [R; 2]) -> [R; 3] {
        let e_1 = (self.rate_z * psi_dot + self.rate_s * phi_dot) * sin - self.rate_t * psi_dot * cos;
        let e_0 = -((self.velocity_s * phi_dot + self.velocity_z * psi_dot) * cos)
            - self.velocity_t * psi_dot * sin;
        [e_0, e_1, self.rate_t * phi_dot]
    }
}

/// Motion of the sections of a wing relative to still air, in the plane of the axes e_t and e_z.
///
/// At the radius r and the distance d behind the pitch axis, the velocity of the section has these components:
///
/// ```text
/// u = r (φ̇ − Ω_z) + a − d (ψ̇ + Ω_s) cos ψ     w = V_z + r Ω_t
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sections<R> {
    /// Stroke rate relative to still air, φ̇ − Ω_z (rad/s).
    pub stroke_rate: R,
    /// Sweep rate relative to still air, (ψ̇ + Ω_s) cos ψ (rad/s).
    pub sweep_rate: R,
    /// Component a of the shoulder's velocity along the axis e_t (m/s). The velocity a is equal for all
    /// sections.
    pub along: R,
    /// Component V_z of the shoulder's velocity along the stroke axis (m/s).
    pub up: R,
    /// Angular velocity Ω_t of the shoulder about the axis e_t (rad/s).
    pub tilt_rate: R,
}
