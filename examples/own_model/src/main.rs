//! The `flap` command with one additional model: the motor-driven wing in the module `motor_wing`.
//!
//! ```sh
//! cargo run --release -p own-model -- sweep examples/own_model/grid.toml --out own.csv
//! ```

mod motor_wing;

use std::process::ExitCode;

use flap_core::simulate::{self, Runner, Simulator};

/// The model of the motor-driven wing, whose motion has three states.
static MOTOR_WING: Runner<motor_wing::MotorWing, 3> = Runner::new(motor_wing::MotorWing);

fn main() -> ExitCode {
    let own: &[&'static dyn Simulator] = &[&MOTOR_WING];
    flap_cli::run([simulate::all(), own].concat())
}
