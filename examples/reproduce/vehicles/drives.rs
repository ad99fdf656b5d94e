//! Claims about the torque that each drive input of a vehicle produces.

use flap_core::drive::Shape;

use super::flier::{Flier, rounded, shown, torques};
use crate::claim::{Claim, between, said};
use crate::points::Settled;

/// Change of each drive input, as a fraction of the drive amplitude.
const SHARE: f64 = 0.2;
const SENSOR: &str = "Finio and others, I";
const TORQUE: &str = "torque of a robotic fly with asymmetric flapping";

pub(super) fn claims() -> Vec<Claim> {
    let pair = Flier::pair();
    let volts = pair.value("drive_voltage_pp");
    // The amplitude is half the voltage peak to peak; half the difference is added on the left.
    let difference = 2.0 * SHARE * volts;
    let bias = SHARE * 0.5 * volts;
    let rolling = rolls(&pair, difference);
    let roll = torques(&rolling[0]);
    let pitch = torques(&pair.point(&[("drive_offset", bias)]));
    let (phase, yaw) = split_cycle();
    let largest = |torques: [f64; 3], of: usize| (0..3).all(|i| torques[i].abs() <= torques[of].abs());
    vec![
        said(
            "Ma and others, abstract",
            "two wings with independent drives can make a roll torque",
            "roll torque",
        )
        .holds(
            largest(roll, 0) && roll[0] > 0.0,
            format!("{} with {difference:.0} V more on the left wing", shown(roll)),
        ),
        said(
            "Ma and others, abstract",
            "two wings with independent drives can make a pitch torque",
            "pitch torque",
        )
        .holds(
            largest(pitch, 1) && pitch[1] < 0.0,
            format!(
                "{} with a bias voltage of {bias:.0} V. The strokes of both wings move forward and the \
                 nose of the vehicle rises",
                shown(pitch)
            ),
        ),
        said(
            "Ma and others, abstract",
            "two wings with independent drives can make a yaw torque by split cycles",
            "yaw torque",
        )
        .holds(
            largest(yaw, 2),
            format!(
                "{} with a second harmonic of {SHARE} times the amplitude that leads by {phase:.0}°",
                shown(yaw)
            ),
        ),
        said("Ma and others", "sizes of the roll, pitch and yaw torques", "drawn").cannot_be_checked(
            "the available text of the papers gives neither sizes of torques nor voltages",
            "",
        ),
        said(
            "Ma and others, abstract",
            "peak lift of the robot of Ma and others with a mass of 70 mg",
            "1.3 mN",
        )
        .cannot_be_checked(
            "the available text gives no voltage, and the robot has other wings and actuators \
             than the simulated vehicle",
            format!(
                "lift of the simulated vehicle {:.2} mN at {volts:.0} V",
                pair.point(&[]).get("force_up_mn")
            ),
        ),
        of_size("roll", roll[0], &with_less(&rolling, difference)),
        of_size("pitch", pitch[1], ""),
        of_size("yaw", yaw[2], ""),
    ]
}

/// Returns a claim about the magnitude of a torque.
fn of_size(name: &str, torque: f64, besides: &str) -> Claim {
    said(SENSOR, format!("predicted {name} {TORQUE}"), "1 to 10 µN·m").is(
        &between(1.0, 10.0),
        torque.abs(),
        format!("{name} torque {} µN·m{besides}", rounded(torque.abs())),
    )
}

/// Fractions of a voltage difference. The roll torque is also computed for each fraction of the difference.
const PARTS: [f64; 3] = [0.5, 0.625, 0.75];

/// Returns settled motions with a difference between the drive voltages of the two wings: first the whole
/// difference, then fractions of the difference.
fn rolls(pair: &Flier, difference: f64) -> Vec<Settled> {
    let points =
        [1.0].iter().chain(&PARTS).map(|part| vec![("difference_drive_voltage_pp", part * difference)]);
    pair.settle(&points.collect::<Vec<_>>())
}

/// Returns a text with the roll torques at fractions of the voltage difference. The text also contains the
/// lift of the wing that has the smaller drive voltage.
fn with_less(points: &[Settled], difference: f64) -> String {
    let parts = PARTS.iter().zip(&points[1..]);
    let torques = parts
        .map(|(part, point)| format!("{} µN·m with {:.0} V", rounded(torques(point)[0]), part * difference));
    let lift = |point: &Settled| rounded(point.get("right_lift_mean_mn"));
    format!(
        " with {difference:.0} V more on the left wing. The lift of the right wing drops steeply from {} mN with a \
         difference of {:.0} V to {} mN with {difference:.0} V. Roll torques with smaller differences are {}",
        lift(&points[1]),
        PARTS[0] * difference,
        lift(&points[0]),
        torques.collect::<Vec<_>>().join(", ")
    )
}

/// Returns the phase (degrees, in steps of 15) at which a second harmonic produces the largest yaw torque.
/// Also returns the roll, pitch and yaw torque at this phase.
fn split_cycle() -> (f64, [f64; 3]) {
    let pair = Flier::pair().choose("drive_shape", Shape::Harmonics as usize);
    let phases: Vec<f64> = (0..24).map(|i| 15.0 * f64::from(i)).collect();
    let points: Vec<_> = phases
        .iter()
        .map(|phase| {
            vec![
                ("difference_drive_second_harmonic", 2.0 * SHARE),
                ("drive_second_phase", phase.to_radians()),
            ]
        })
        .collect();
    let settled = pair.settle(&points);
    let found = phases.into_iter().zip(settled.iter().map(torques));
    found.max_by(|a, b| a.1[2].total_cmp(&b.1[2])).expect("there are phases")
}
