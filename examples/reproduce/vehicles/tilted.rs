//! Claims about vehicles with four wings.

use nalgebra::{Matrix4, Vector4};

use super::flier::{Flier, rounded, shown, torques};
use crate::claim::{Claim, said};

/// The names of the four wings, each with a flag that is true if the wing is mirrored.
const WINGS: [(&str, bool); 4] =
    [("front_left", false), ("front_right", true), ("back_left", false), ("back_right", true)];
/// The names of the parameters that contain the drive voltages of the four wings.
const VOLTAGES: [&str; 4] = [
    "front_left_drive_voltage_pp",
    "front_right_drive_voltage_pp",
    "back_left_drive_voltage_pp",
    "back_right_drive_voltage_pp",
];
/// The tilt of a wing (degrees).
const TILT: f64 = 10.0;
/// Standard gravity (m/s²).
const GRAVITY: f64 = 9.80665;

pub(super) fn claims() -> Vec<Claim> {
    let [flat, tilted] = [0.0, TILT].map(|tilt| effects(&direct_drive(tilt.to_radians())));
    // A volt more on one diagonal, a volt less on the other.
    let diagonals = Vector4::new(1.0, -1.0, -1.0, 1.0);
    let [of_flat, of_tilted] = [flat, tilted].map(|effects| effects * diagonals);
    let values = tilted.singular_values();
    let share = values.min() / values.max();
    let payload = payload();
    vec![
        said(
            "2407.06500, abstract",
            "in a vehicle with tilted wings, the drive amplitudes alone can make a yaw torque",
            "yaw torque",
        )
        .holds(
            of_tilted.iamax() == 3 && of_tilted[3].abs() > of_flat[3].abs(),
            format!(
                "one diagonal pair of wings has 1 V more, and the other pair has 1 V less. Changes: {}, lift \
                 {} mN. Without tilt, the yaw torque changes by {} µN·m",
                shown([of_tilted[1], of_tilted[2], of_tilted[3]]),
                rounded(of_tilted[0]),
                rounded(of_flat[3])
            ),
        ),
        said(
            "2407.06500, abstract",
            "four drive amplitudes control lift, roll, pitch and yaw at the same time",
            "four at the same time",
        )
        .holds(
            share > 1e-3,
            format!(
                "smallest singular value of the control matrix divided by the largest: {share:.3}, \
                 where 1 mN counts as 1 µN·m"
            ),
        ),
        said("2407.06500", "torques of the vehicle and tilt of the wings", "drawn")
            .cannot_be_checked("the available text gives neither torques nor tilt", ""),
        said("Fuller, abstract", "payload of the robot of Fuller with four wings", "> 260 mg")
            .holds(payload > 260.0, format!("payload of four wings {payload:.0} mg at 200 V and 120 Hz")),
    ]
}

/// Returns a vehicle with four direct-drive wings around the middle of the body. The angle `tilt` (rad) tilts
/// each stroke plane about the y-axis towards the middle.
fn direct_drive(tilt: f64) -> Flier {
    Flier::new("ozaki2018-large", &WINGS).with(&[
        ("front_left_position_x", 10e-3),
        ("front_right_position_x", 10e-3),
        ("back_left_position_x", -10e-3),
        ("back_right_position_x", -10e-3),
        ("front_left_position_y", 10e-3),
        ("front_right_position_y", 10e-3),
        ("back_left_position_y", 10e-3),
        ("back_right_position_y", 10e-3),
        ("front_left_plane_pitch", -tilt),
        ("front_right_plane_pitch", -tilt),
        ("back_left_plane_pitch", tilt),
        ("back_right_plane_pitch", tilt),
    ])
}

/// Returns the changes of lift (mN) and of the roll, pitch and yaw torque (µN·m) per volt. Each column of the
/// matrix contains the changes for the voltage of one wing.
fn effects(flier: &Flier) -> Matrix4<f64> {
    let volts = flier.value("drive_voltage_pp");
    let points: Vec<_> =
        VOLTAGES.iter().flat_map(|name| [-1.0, 1.0].map(|step| vec![(*name, volts + step)])).collect();
    let settled = flier.settle(&points);
    let of_point = |point: &crate::points::Settled| {
        let [roll, pitch, yaw] = torques(point);
        [point.get("force_up_mn"), roll, pitch, yaw]
    };
    Matrix4::from_fn(|row, wing| {
        let [less, more] = [0, 1].map(|side| of_point(&settled[2 * wing + side])[row]);
        0.5 * (more - less)
    })
}

/// Returns the payload (mg) of a vehicle with four bimorph wings and a mass of 143 mg.
fn payload() -> f64 {
    let lift = Flier::new("jafferis2016", &WINGS).point(&[]).get("force_up_mn");
    lift / GRAVITY * 1e3 - 143.0
}
