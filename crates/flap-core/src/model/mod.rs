//! Models as a sweep sees them: parameters, presets, columns, and a way to run points.
//!
//! Each paper has a folder of its own. [`all`] lists them behind the object-safe trait [`Simulator`],
//! which is all that the layers above need to know.

mod parameter;
mod simulator;

pub use parameter::{Kind, Parameter, Preset, Range};
pub use simulator::{
    Column, Invalid, Jobs, Point, Row, Simulator, SolverSettings, Status, Trajectory, TrajectoryRequest,
};

/// Every model, in the order `flap models` lists them.
pub fn all() -> &'static [&'static dyn Simulator] {
    &[]
}

/// The model called `name`.
pub fn by_name(name: &str) -> Option<&'static dyn Simulator> {
    all().iter().copied().find(|model| model.name() == name)
}

/// The preset called `name`, with the model it belongs to.
pub fn preset(name: &str) -> Option<(&'static dyn Simulator, &'static Preset)> {
    all().iter().find_map(|&model| {
        let preset = model.presets().iter().find(|preset| preset.name == name)?;
        Some((model, preset))
    })
}
