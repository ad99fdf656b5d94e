//! The interface through which sweeps, the command line and Python use models. The input consists of design
//! points, and the output consists of rows.
//!
//! A sweep uses the trait [`Simulator`] of a model. The trait [`Gradients`] computes derivatives of rows, and
//! the traits [`Motions`] and [`Experiments`] compute single motions. [`Runner`] implements all four traits
//! for a [`Model`](crate::model::Model). [`all`] lists the models of this crate.

mod experiments;
mod gradient;
mod jobs;
mod lanes;
mod linear;
mod march;
mod moving_wing;
mod orbit_row;
mod period_map;
mod periods;
mod request;
mod row;
mod runner;
mod sampler;
mod search;
mod settings;
mod simulator;
mod single;
mod start;

pub use gradient::{Change, Gradient, NoSlope};
pub use jobs::{Jobs, LaneUse, Point};
pub use moving_wing::MovingWing;
pub(crate) use request::cannot_begin;
pub use request::{
    ChirpRequest, ChirpResponse, ImposedMotion, ImpulseRequest, Period, Trajectory, TrajectoryRequest,
    Unfinished,
};
pub use row::{Column, Row, Status};
pub use runner::Runner;
pub use settings::{Setting, SettingKind, SolverSettings};
pub use simulator::{Experiments, Gradients, Motions, Rows, Simulator, run_list};
pub use single::PointRun;

pub use crate::ode::{Interrupt, never};

use crate::model::bimorph::Bimorph;
use crate::model::direct_drive::DirectDrive;
use crate::model::four_bar::FourBar;
use crate::parameter::Preset;

static BIMORPH: Runner<Bimorph, 4> = Runner::with_experiments(Bimorph::SINE);
static DIRECT_DRIVE: Runner<DirectDrive, 4> = Runner::with_experiments(DirectDrive::SINE);
static FOUR_BAR: Runner<FourBar, 4> = Runner::with_experiments(FourBar::SINE);
static ALL: &[&dyn Simulator] = &[&BIMORPH, &DIRECT_DRIVE, &FOUR_BAR];

/// Returns all models of this crate, in the order in which `flap models` lists the models.
pub fn all() -> &'static [&'static dyn Simulator] {
    ALL
}

/// Returns the model of this crate with the given name.
pub fn by_name(name: &str) -> Option<&'static dyn Simulator> {
    find(all(), name)
}

/// Returns the preset of this crate with the given name, and the model of the preset.
pub fn preset(name: &str) -> Option<(&'static dyn Simulator, &'static Preset)> {
    find_preset(all(), name)
}

/// Returns the model with the given name among `models`.
pub fn find(models: &[&'static dyn Simulator], name: &str) -> Option<&'static dyn Simulator> {
    models.iter().copied().find(|model| model.name() == name)
}

/// Returns the preset with the given name among the presets of `models`, and the model of the preset.
pub fn find_preset(
    models: &[&'static dyn Simulator],
    name: &str,
) -> Option<(&'static dyn Simulator, &'static Preset)> {
    models.iter().find_map(|&model| {
        let preset = model.presets().iter().find(|preset| preset.name == name)?;
        Some((model, preset))
    })
}
