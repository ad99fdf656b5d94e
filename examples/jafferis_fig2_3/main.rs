//! Figures 2 and 3 of Jafferis, Graule and Wood (2016): why a passive hinge makes the resonance of a wing sharp.
//!
//! ```sh
//! cargo run --release -p flap-core --example jafferis_fig2_3              # what the figures say
//! cargo run --release -p flap-core --example jafferis_fig2_3 fig2 > fig2.csv
//! cargo run --release -p flap-core --example jafferis_fig2_3 fig3 > fig3.csv
//! ```
//!
//! `oscillators.rs` shows how to integrate your own equations, and `response.rs` shows how to reach a settled motion.

#![expect(clippy::print_stdout, reason = "an example prints what it finds")]

mod coefficients;
mod oscillators;
mod response;

use std::process::ExitCode;

use coefficients::{FIG_3, highest};
use oscillators::{DAMPING, HeldWing, Linear, TABLE_I};
use response::{Response, peaks, response};

/// Amplitudes of the drive force, at which the wing with a hinge has motions of different kinds.
const FORCES: [f64; 4] = [0.2, 0.3, 0.4, 0.5];

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        None => summary(),
        Some("fig2") => figure_2(),
        Some("fig3") => figure_3(),
        Some(_) => {
            println!("the argument is fig2 or fig3, or there is none");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Prints the stroke per force of each oscillator over the frequency, with one row per force and frequency.
fn figure_2() {
    println!("oscillator,force,frequency_ratio,stroke_per_force,hinge_amplitude_deg");
    for force in FORCES {
        print_curve("linear", force, &response(Linear, force, DAMPING), false);
        print_curve("held at 0 deg", force, &response(HeldWing::at(0.0), force, DAMPING), false);
        print_curve("held at 75 deg", force, &response(HeldWing::at(75.0), force, DAMPING), false);
        print_curve("turning", force, &response(TABLE_I, force, DAMPING), true);
    }
}

fn print_curve(name: &str, force: f64, curve: &[Response], hinge: bool) {
    for point in curve {
        let angle = if hinge { format!("{:.3}", point.second.to_degrees()) } else { String::new() };
        println!("{name},{force},{:.2},{:.5},{angle}", point.frequency, point.stroke);
    }
}

/// Prints the lift and drag coefficients over the pitch.
fn figure_3() {
    println!("hinge_angle_deg,lift_coefficient,drag_coefficient,lift_to_drag");
    for degrees in 0..=90 {
        let degrees = f64::from(degrees);
        let (sin_2psi, cos_2psi) = (2.0 * degrees).to_radians().sin_cos();
        let [lift, drag] = [FIG_3.lift(sin_2psi), FIG_3.drag(cos_2psi)];
        println!("{degrees},{lift:.5},{drag:.5},{:.5}", FIG_3.lift_to_drag(degrees));
    }
}

/// Prints statements from the text of the paper with the numbers that this program computes.
fn summary() {
    let (angle, ratio) = highest(|degrees| FIG_3.lift_to_drag(degrees));
    println!("lift over drag is largest at a pitch of {angle:.2} deg: {ratio:.3} (paper: about 70 deg)");
    let (angle, lift) = highest(|degrees| FIG_3.mean_lift(degrees));
    println!("mean lift is largest where the hinge reaches {angle:.2} deg: {lift:.3} (paper: 51 deg)");
    for force in FORCES {
        let found: Vec<String> = peaks(&response(TABLE_I, force, DAMPING))
            .iter()
            .map(|peak| {
                let degrees = peak.second.to_degrees();
                format!("{:.3} at {:.2} (hinge {degrees:.0} deg)", peak.stroke, peak.frequency)
            })
            .collect();
        println!("force {force}: stroke per force peaks with {}", found.join(" and "));
    }
}
