//! `flap vehicle --fly`: simulates a flight of a vehicle over time.

use flap_core::simulate::Trajectory;
use flap_sweep::notation::units;
use flap_sweep::vehicle::control::{Input, VehicleRun};
use flap_sweep::vehicle::flight::{FED_BACK, FlightError, FlightRequest, fly};
use flap_sweep::vehicle::hover::STATES;

use crate::args::VehicleArgs;
use crate::cmd::point;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;

/// Simulates and prints the flight of a vehicle whose parameters have the given values.
pub(super) fn run(
    args: &VehicleArgs,
    seconds: f64,
    vehicle_run: &VehicleRun<'_>,
    values: &[f64],
    inputs: &[Input],
) -> Result<Exit, Failure> {
    let request = FlightRequest {
        seconds,
        disturbance: disturbance(&args.disturb)?,
        inputs: inputs.to_vec(),
        gains: None,
        is_averaged: false,
        samples: None,
    };
    let record = fly(vehicle_run, values, &request).map_err(|error| match error {
        FlightError::Hover(error) => error.into(),
        FlightError::Request(mistake) => Failure::usage(format!("--fly: {mistake}")),
    })?;
    if let Some(reason) = record.end {
        console::warn(&format!("the flight ends early: {reason}"));
    }
    print::motion(args.format, &Trajectory { columns: record.columns, rows: record.rows })?;
    Ok(Exit::Done)
}

/// Returns the initial velocities, angular rates and angles of the body that `--disturb` gives.
fn disturbance(given: &[(String, String)]) -> Result<[f64; FED_BACK], Failure> {
    let mut disturbance = [0.0; FED_BACK];
    for (place, (name, value)) in given.iter().enumerate() {
        if given[..place].iter().any(|(other, _)| other == name) {
            return Err(point::twice("--disturb", name));
        }
        let states = &STATES[..FED_BACK];
        let Some(state) = states.iter().position(|(state, _)| state == name) else {
            let failure = Failure::usage(format!("--disturb: no state is called `{name}`"));
            let known = states.iter().map(|(state, _)| *state);
            return Err(failure.nearest(name, known, "states are velocity_forward to angle_yaw"));
        };
        disturbance[state] = units::parse_or_si(value, states[state].1).map_err(|error| {
            let failure = Failure::usage(error.message(&format!("--disturb {name}={value}")));
            failure.helps(error.help())
        })?;
    }
    Ok(disturbance)
}
