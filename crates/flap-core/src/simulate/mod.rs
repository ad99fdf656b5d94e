//! Design points in, rows out: models as sweeps, the command line and Python see them.
//!
//! [`Rows`] and [`Simulator`] hide what differs between models; [`all`] lists them.

mod accuracy;
mod chirp;
mod imposed;
mod impulse;
mod lanes;
mod motion;
mod newton;
mod period;
mod row;
mod runner;
mod scalar;
mod search;
mod settle;
mod simulator;

pub use simulator::{
    ChirpRequest, ChirpResponse, Column, ImposedMotion, ImpulseRequest, Jobs, LaneUse, Period, Point, Row,
    Rows, Simulator, SolverSettings, Status, Trajectory, TrajectoryRequest, Unfinished,
};

pub use crate::ode::{Interrupt, never};

use crate::drive::Drive;
use crate::model::bimorph::Bimorph;
use crate::model::direct_drive::{DirectDrive, FlowDirection};
use crate::model::four_bar::FourBar;
use crate::parameter::Preset;
use runner::Runner;

static BIMORPH: Runner<Bimorph, 4, 20, 15> = Runner::new(Bimorph { drive: Drive::SINE });
static DIRECT_DRIVE: Runner<DirectDrive, 4, 20, 10> =
    Runner::new(DirectDrive { drive: Drive::SINE, flow: FlowDirection::Uniform });
static FOUR_BAR: Runner<FourBar, 4, 20, 17> = Runner::new(FourBar { drive: Drive::SINE });
static ALL: &[&dyn Simulator] = &[&BIMORPH, &DIRECT_DRIVE, &FOUR_BAR];

/// Every model, in the order `flap models` lists them.
pub fn all() -> &'static [&'static dyn Simulator] {
    ALL
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
