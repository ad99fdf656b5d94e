//! Columns of a vehicle's rows, derived from the columns of its wings.

use super::geometry::{FORCES, TORQUES, Wrench};
use super::mount::Mount;
use super::parameters::MassProperties;
use crate::model::OverWings;
use crate::model::readings::{efficiency, grams_force};
use crate::simulate::Column;

/// Columns of a vehicle, and the source of each column.
pub(super) struct Columns {
    pub(super) all: Vec<Column>,
    sources: Vec<Source>,
}

/// Source of a column.
enum Source {
    /// Component of the force (mN) or the torque (uN·m) of the vehicle, with the index of the component.
    Wrench(usize),
    /// Lift of the vehicle, divided by the weight of the vehicle.
    LiftToWeight,
    /// Efficiency in grams-force per watt, with the index of the wings' power column.
    Efficiency(usize),
    /// Sum over the wings of the column with the given index.
    Sum(usize),
    /// Column of one wing, with the index of the wing and of the column.
    Wing(usize, usize),
}

impl Columns {
    pub(super) fn new(model: &[Column], mounts: &[Mount]) -> Columns {
        let mut columns = Columns { all: Vec::new(), sources: Vec::new() };
        let words = [
            "mean forward force of the air on all wings",
            "mean force of the air on all wings to the left",
            "mean upward force of the air on all wings",
            "mean torque of the air on all wings about the x axis; positive values lift the left side",
            "mean torque of the air on all wings about the y axis; positive values lower the nose",
            "mean torque of the air on all wings about the z axis; positive values turn the nose to the left",
        ];
        for (i, (name, doc)) in FORCES.into_iter().chain(TORQUES).zip(words).enumerate() {
            columns.add(name, if i < 3 { "mN" } else { "uN*m" }, doc, Source::Wrench(i));
        }
        let doc = "force_up_mn divided by the weight of total_mass; empty if total_mass is not set";
        columns.add("lift_to_weight", "", doc, Source::LiftToWeight);
        for (i, column) in model.iter().enumerate() {
            if column.over_wings == OverWings::Sum {
                let doc = format!("sum over all wings: {}", column.doc);
                columns.add(&*column.name, column.unit, doc, Source::Sum(i));
            }
        }
        if let Some(power) = model.iter().position(|column| column.name == "power_mean_mw") {
            let doc =
                "force_up_mn in grams-force, divided by power_mean_mw; empty if the power is zero or less";
            columns.add("efficiency_gf_per_w", "gf/W", doc, Source::Efficiency(power));
        }
        for (wing, mount) in mounts.iter().enumerate() {
            for (i, column) in model.iter().enumerate() {
                if column.over_wings == OverWings::Each {
                    let name = format!("{}_{}", mount.name, column.name);
                    let doc = format!("wing {}: {}", mount.name, column.doc);
                    columns.add(name, column.unit, doc, Source::Wing(wing, i));
                }
            }
        }
        columns
    }

    /// Returns the values of a vehicle's columns, from the vehicle's force and torque and from the measures
    /// of its wings.
    pub(super) fn values(&self, wrench: &Wrench, body: &MassProperties, wings: &[&[f64]]) -> Vec<f64> {
        let Wrench { force, torque } = wrench;
        let sum = |column: usize| wings.iter().map(|measures| measures[column]).sum::<f64>();
        let value = |source: &Source| match *source {
            Source::Wrench(i) if i < 3 => force[i] * 1e3,
            Source::Wrench(i) => torque[i - 3] * 1e6,
            Source::LiftToWeight => force[2] / (body.mass * body.gravity),
            Source::Efficiency(power) => efficiency(grams_force(force[2]), sum(power) * 1e-3),
            Source::Sum(column) => sum(column),
            Source::Wing(wing, column) => wings[wing][column],
        };
        self.sources.iter().map(value).collect()
    }

    fn add(&mut self, name: impl Into<String>, unit: &'static str, doc: impl Into<String>, source: Source) {
        let (name, doc) = (name.into(), doc.into());
        self.all.push(Column { name, unit, doc, over_wings: OverWings::Omitted });
        self.sources.push(source);
    }
}
