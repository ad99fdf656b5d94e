//! Forces and torques of wings in the body axes.

use core::ops::Add;

use nalgebra::{Rotation3, Vector3};

/// Names of the columns of the force along the body axes (mN).
pub const FORCES: [&str; 3] = ["force_forward_mn", "force_left_mn", "force_up_mn"];
/// Names of the columns of the torque about the body axes (uN·m).
pub const TORQUES: [&str; 3] = ["torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm"];

/// Position of a wing: its shoulder and its stroke plane.
pub(super) struct Place {
    /// Position of the shoulder (m).
    pub(super) position: [f64; 3],
    /// Roll, pitch and yaw of the stroke plane (rad).
    pub(super) plane: [f64; 3],
}

impl Place {
    /// Returns the rotation of the stroke plane, Q = R_z(yaw) R_y(pitch) R_x(roll).
    fn turned(&self) -> Rotation3<f64> {
        let [roll, pitch, yaw] = self.plane;
        Rotation3::from_euler_angles(roll, pitch, yaw)
    }

    /// Returns the velocity (m/s) and the angular velocity (rad/s) of the shoulder, in the axes of the wing.
    ///
    /// `body` contains the velocity (m/s) of the body at the point `about` (m), and the rates of the body (rad/s).
    ///
    /// ```text
    /// V = Qᵀ (v + Ω × (p − a))     Ω_wing = Qᵀ Ω
    /// ```
    ///
    /// For a mirrored wing, the function first mirrors the motion of the body and the point `about` in the x-z plane.
    pub(super) fn motion(&self, body: &[f64; 6], about: [f64; 3], mirrored: bool) -> [f64; 6] {
        let [u, v, w, p, q, r] = *body;
        let side = if mirrored { -1.0 } else { 1.0 };
        let velocity = Vector3::new(u, side * v, w);
        let rate = Vector3::new(side * p, q, side * r);
        let [x, y, z] = about;
        let arm = Vector3::from(self.position) - Vector3::new(x, side * y, z);
        let back = self.turned().inverse();
        let (velocity, rate) = (back * (velocity + rate.cross(&arm)), back * rate);
        [velocity.x, velocity.y, velocity.z, rate.x, rate.y, rate.z]
    }
}

/// A force (N) and a torque (N·m).
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrench {
    pub(super) force: Vector3<f64>,
    pub(super) torque: Vector3<f64>,
}

impl Wrench {
    /// No force and no torque.
    pub(super) const ZERO: Wrench =
        Wrench { force: Vector3::new(0.0, 0.0, 0.0), torque: Vector3::new(0.0, 0.0, 0.0) };

    /// Converts the load at the shoulder of a wing to a force, and a torque about the origin of the body
    /// axes.
    ///
    /// ```text
    /// F = Q f     M = Q m + p × F     Q = R_z(yaw) R_y(pitch) R_x(roll)
    /// ```
    ///
    /// If `mirrored` is true, the wing is the mirror image, in the x-z plane, of a wing at `place`.
    pub(super) fn of_wing(load: &[f64; 6], place: &Place, mirrored: bool) -> Wrench {
        let turned = place.turned();
        let force = turned * Vector3::new(load[0], load[1], load[2]);
        let torque =
            turned * Vector3::new(load[3], load[4], load[5]) + Vector3::from(place.position).cross(&force);
        if mirrored {
            let image = Vector3::new(1.0, -1.0, 1.0);
            Wrench { force: force.component_mul(&image), torque: -torque.component_mul(&image) }
        } else {
            Wrench { force, torque }
        }
    }

    /// Returns this force, with the torque about the given `point` (m) of the body instead of the origin.
    pub(super) fn about(self, point: [f64; 3]) -> Wrench {
        Wrench { force: self.force, torque: self.torque - Vector3::from(point).cross(&self.force) }
    }
}

impl Add for Wrench {
    type Output = Wrench;

    fn add(self, other: Wrench) -> Wrench {
        Wrench { force: self.force + other.force, torque: self.torque + other.torque }
    }
}
