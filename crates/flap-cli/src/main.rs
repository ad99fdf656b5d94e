//! The `flap` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    flap_cli::run(flap_core::simulate::all().to_vec())
}
