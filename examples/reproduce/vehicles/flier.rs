//! Vehicles whose wings are all copies of one preset.

use flap_core::parameter::Parameter;
use flap_core::simulate::{Simulator as _, preset};
use flap_core::vehicle::{Mount, TORQUES, Vehicle};

use crate::points::{Bench, Settled};

/// Names of parameters, each with a value that replaces the vehicle's value of the parameter.
pub(super) type Changes = Vec<(&'static str, f64)>;

/// A vehicle, and the values of all its parameters.
pub(super) struct Flier {
    bench: Bench,
    values: Vec<f64>,
}

impl Flier {
    /// Returns a vehicle with wings of the preset `name`. Each entry of `wings` contains the name of a wing,
    /// and a flag that is true if the wing is mirrored.
    pub(super) fn new(name: &str, wings: &[(&str, bool)]) -> Flier {
        let (model, preset) = preset(name).expect("flap has this preset");
        let mounts: Vec<Mount> =
            wings.iter().map(|&(name, mirrored)| Mount { name: name.to_owned(), mirrored }).collect();
        let vehicle = Vehicle::of(model, &mounts).expect("these wings make a vehicle");
        // A bench keeps its model until the program ends.
        let vehicle: &'static Vehicle = Box::leak(Box::new(vehicle));
        let mut values = (preset.values)();
        values.extend(vehicle.parameters()[values.len()..].iter().map(|parameter| parameter.default));
        // Kinks of the bimorph let a motion settle no further.
        Flier { bench: Bench { model: vehicle, ..Bench::new(model.name(), 1e-4) }, values }
    }

    /// Returns a vehicle with two wings of the preset `jafferis2016`.
    pub(super) fn pair() -> Flier {
        Flier::new("jafferis2016", &[("left", false), ("right", true)]).with(&[
            ("left_position_y", 1.5e-3),
            ("right_position_y", 1.5e-3),
            ("about_z", -2e-3),
        ])
    }

    /// Returns a copy of this vehicle with changed parameter values.
    pub(super) fn with(mut self, changes: &[(&str, f64)]) -> Flier {
        self.values = self.changed(changes);
        self
    }

    /// Returns a copy of this vehicle with a different option of the choice `name`.
    pub(super) fn choose(self, name: &'static str, option: usize) -> Flier {
        self.with(&[(name, f64::from(u32::try_from(option).expect("options are few")))])
    }

    /// Returns the value of the vehicle's parameter `name`.
    pub(super) fn value(&self, name: &str) -> f64 {
        self.values[self.place(name)]
    }

    /// Returns one settled motion of the vehicle for each list of changed parameters.
    pub(super) fn settle(&self, points: &[Changes]) -> Vec<Settled> {
        self.bench.settle(points.iter().map(|changes| self.changed(changes)).collect())
    }

    /// Returns the settled motion of the vehicle with one list of changed parameters.
    pub(super) fn point(&self, changes: &[(&'static str, f64)]) -> Settled {
        self.settle(&[changes.to_vec()]).remove(0)
    }

    fn changed(&self, changes: &[(&str, f64)]) -> Vec<f64> {
        let mut values = self.values.clone();
        for (name, value) in changes {
            values[self.place(name)] = *value;
        }
        values
    }

    fn place(&self, name: &str) -> usize {
        Parameter::index(self.bench.model.parameters(), name).unwrap_or_else(|| panic!("no parameter {name}"))
    }
}

/// Returns the roll, pitch and yaw torque of a settled motion (µN·m).
pub(super) fn torques(point: &Settled) -> [f64; 3] {
    TORQUES.map(|column| point.get(column))
}

/// Returns the roll, pitch and yaw torque as text.
pub(super) fn shown([roll, pitch, yaw]: [f64; 3]) -> String {
    format!(
        "roll torque {}, pitch torque {}, yaw torque {} µN·m",
        rounded(roll),
        rounded(pitch),
        rounded(yaw)
    )
}

/// Returns a torque as text with two decimals. A torque that rounds to zero is written without a sign.
pub(super) fn rounded(torque: f64) -> String {
    let text = format!("{torque:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}
