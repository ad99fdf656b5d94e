//! Equations of the wings of a vehicle for any motion of the body, and the force and torque of the wings at an instant.

use super::geometry::{Place, Wrench};
use super::layout::Vehicle;
use crate::body::BodyMotion;
use crate::parameter::Invalid;
use crate::simulate::{MovingWing, Unfinished};

/// The wings of a vehicle with given parameter values, for any motion of the body.
pub struct MovingWings {
    wings: Vec<Mounted>,
    /// Reference point of the torques and of the body motion (m).
    about: [f64; 3],
}

struct Mounted {
    wing: Box<dyn MovingWing>,
    place: Place,
    mirrored: bool,
}

impl Vehicle {
    /// Returns the wings for the given `values` of the vehicle's parameters. The velocity and the rates of the body in
    /// `values` have no effect.
    ///
    /// If the model has no parameters for the motion of the body, the motion has no effect.
    ///
    /// # Errors
    /// An error if the combination of values is impossible, or if the model computes only rows.
    pub fn moving_wings(&self, values: &[f64]) -> Result<MovingWings, Unfinished> {
        // Any motion selects the equations of moving wings.
        let moving = self.table.in_motion(values);
        let motions = self.model.motions()?;
        let mut wings = Vec::with_capacity(self.mounts.len());
        for (i, mount) in self.mounts.iter().enumerate() {
            let of_wing = |invalid: Invalid| Invalid::new(format!("wing {}: {invalid}", mount.name));
            let own = self.table.of_wing(&moving, i).map_err(of_wing)?;
            let wing = motions.moving_wing(&own).map_err(of_wing)?;
            wings.push(Mounted { wing, place: self.table.place(values, i), mirrored: mount.mirrored });
        }
        Ok(MovingWings { wings, about: self.table.about(values) })
    }
}

impl MovingWings {
    /// Returns the drive period (s), which all wings share. A period begins at time zero.
    pub fn period(&self) -> f64 {
        self.wings[0].wing.period()
    }

    /// Returns the typical size of each state, in the order of the wings.
    pub fn scale(&self) -> Vec<f64> {
        self.wings.iter().flat_map(|mounted| mounted.wing.scale().iter().copied()).collect()
    }

    /// Computes the derivative of the states `y` of all wings at time `t` (s), for the given `motion` of the body.
    ///
    /// `motion` contains the velocity (m/s) and the rates (rad/s) of the body in body axes. Returns the force (N) and
    /// the torque (N·m) of the air in body axes. Torque and velocity refer to the reference point of the vehicle.
    ///
    /// # Panics
    /// Panics if `y` or `dy` does not have one number for each state.
    pub fn derivative(&self, t: f64, y: &[f64], motion: &[f64; 6], dy: &mut [f64]) -> [f64; 6] {
        let mut wrench = Wrench::ZERO;
        let mut begin = 0;
        for Mounted { wing, place, mirrored } in &self.wings {
            let [x, y_left, z, p, q, r] = place.motion(motion, self.about, *mirrored);
            let shoulder = BodyMotion { velocity: [x, y_left, z], rate: [p, q, r] };
            let end = begin + wing.scale().len();
            let load = wing.derivative(t, &y[begin..end], shoulder, &mut dy[begin..end]);
            wrench = wrench + Wrench::of_wing(&load, place, *mirrored);
            begin = end;
        }
        let Wrench { force, torque } = wrench.about(self.about);
        [force.x, force.y, force.z, torque.x, torque.y, torque.z]
    }
}
