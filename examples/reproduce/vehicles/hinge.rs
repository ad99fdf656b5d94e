//! Claims about the yaw torque of split-cycle drives as a function of the hinge stiffness.

use core::f64::consts::FRAC_PI_2;

use flap_core::drive::Shape;

use super::flier::{Flier, rounded, torques};
use crate::claim::{Claim, said};

/// Hinge stiffnesses, each divided by the hinge stiffness of the preset.
const FACTORS: [f64; 7] = [0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 3.0];

pub(super) fn claims() -> Vec<Claim> {
    let pair = Flier::pair()
        .choose("drive_shape", Shape::Harmonics as usize)
        .with(&[("difference_drive_second_harmonic", 0.4), ("drive_second_phase", FRAC_PI_2)]);
    let stiffness = pair.value("hinge_stiffness");
    let points: Vec<_> = FACTORS.iter().map(|factor| vec![("hinge_stiffness", factor * stiffness)]).collect();
    let yaws: Vec<f64> = pair.settle(&points).iter().map(|point| torques(point)[2]).collect();
    let largest = yaws.iter().map(|yaw| yaw.abs()).fold(0.0, f64::max);
    let smallest = yaws.iter().map(|yaw| yaw.abs()).fold(f64::MAX, f64::min);
    let turned: Vec<usize> = (1..yaws.len()).filter(|&i| yaws[i - 1] * yaws[i] < 0.0).collect();
    let list = |values: Vec<String>| values.join(", ");
    let shown = format!(
        "yaw torques {} µN·m at {} times the preset's hinge stiffness",
        list(yaws.iter().map(|yaw| rounded(*yaw)).collect()),
        list(FACTORS.iter().map(f64::to_string).collect())
    );
    let place = match turned[..] {
        [place] => {
            format!(
                "the yaw torque changes its sign between {} and {} times the hinge stiffness of the preset",
                FACTORS[place - 1],
                FACTORS[place]
            )
        }
        _ => format!("the yaw torque changes its sign {} times", turned.len()),
    };
    vec![
        said("abstract", "the yaw torque depends strongly on the stiffness of the wing hinge", "strongly")
            .holds(largest > 2.0 * smallest, shown),
        said(
            "abstract",
            "the relation between yaw torque and split cycle changes at a critical stiffness of \
             the wing hinge",
            "one critical stiffness",
        )
        .holds(turned.len() == 1, place),
    ]
}
