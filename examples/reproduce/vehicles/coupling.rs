//! Claims about simultaneous commands for roll and pitch.

use super::flier::{Flier, torques};
use crate::claim::{Claim, assumed, between, said};

/// Commands for roll: differences between the drive voltages of the left and the right wing (V). The next
/// constant has the commands for pitch: bias voltages (V).
const DIFFERENCES: [f64; 5] = [-40.0, -20.0, 0.0, 20.0, 40.0];
const BIASES: [f64; 5] = [-20.0, -10.0, 0.0, 10.0, 20.0];

/// Two simultaneous commands (V), and the resulting torques and lift.
struct Commanded {
    difference: f64,
    bias: f64,
    roll: f64,
    pitch: f64,
    lift: f64,
}

pub(super) fn claims() -> Vec<Claim> {
    let all = commanded();
    let column = |value: fn(&Commanded) -> f64| -> Vec<f64> { all.iter().map(value).collect() };
    let (differences, biases) = (column(|one| one.difference), column(|one| one.bias));
    let (rolls, pitches, lifts) = (column(|one| one.roll), column(|one| one.pitch), column(|one| one.lift));
    let of_pitch = correlation(&biases, &pitches).powi(2);
    let of_roll = correlation(&differences, &rolls).powi(2);
    let cross = [correlation(&biases, &rolls), correlation(&differences, &pitches)];
    let mean = lifts.iter().sum::<f64>() / 25.0;
    let deviation = lifts.iter().map(|lift| 100.0 * (lift / mean - 1.0).abs()).fold(0.0, f64::max);
    // How far a torque moves with the other command, as a share of its range.
    let coupled = |torques: &[f64], same: fn(&Commanded, &Commanded) -> bool| {
        let moved = all.iter().zip(torques).flat_map(|(one, torque)| {
            let others = all.iter().zip(torques).filter(|(other, _)| same(one, other));
            others.map(|(_, other)| (torque - other).abs()).collect::<Vec<_>>()
        });
        100.0 * moved.fold(0.0, f64::max) / range(torques)
    };
    let roll_moved = coupled(&rolls, |a, b| a.difference == b.difference);
    let pitch_moved = coupled(&pitches, |a, b| a.bias == b.bias);
    vec![
        said(
            "2604.22121, abstract",
            "R² of a straight line through pitch torque against pitch command",
            "0.95",
        )
        .is(
            &assumed(0.95, 0.005),
            of_pitch,
            format!(
                "pitch torque against pitch command has R² = {of_pitch:.3}, which is {:.2} times the \
                 published R²",
                of_pitch / 0.95
            ),
        ),
        said(
            "2604.22121, abstract",
            "R² of a straight line through roll torque against roll command",
            "0.98",
        )
        .is(
            &assumed(0.98, 0.005),
            of_roll,
            format!(
                "roll torque against roll command has R² = {of_roll:.3}, which is {:.2} times the \
                 published R²",
                of_roll / 0.98
            ),
        ),
        said(
            "2604.22121, abstract",
            "correlations of the roll torque with the pitch command and of the pitch torque with \
             the roll command",
            "-0.001, -0.085",
        )
        .holds(
            cross.iter().all(|one| one.abs() < 0.0855),
            format!(
                "correlations with magnitudes {:.3} (roll torque) and {:.3} (pitch torque)",
                cross[0].abs(),
                cross[1].abs()
            ),
        ),
        said("2604.22121, abstract", "largest deviation of the thrust from the mean thrust", "5.8 %").is(
            &between(0.0, 5.8),
            deviation,
            format!("the thrust deviates by up to {deviation:.1} % from the mean thrust"),
        ),
        said(
            "2407.00217, abstract",
            "largest change of the roll torque with the pitch command, relative to the range of \
             the roll torque",
            "8.58 %",
        )
        .is(
            &between(0.0, 8.58),
            roll_moved,
            format!("largest change {roll_moved:.1} % of the range of the roll torque"),
        ),
        said(
            "2407.00217, abstract",
            "largest change of the pitch torque with the roll command, relative to the range of \
             the pitch torque",
            "17.24 %",
        )
        .is(
            &between(0.0, 17.24),
            pitch_moved,
            format!("largest change {pitch_moved:.1} % of the range of the pitch torque"),
        ),
        said("2407.00217, 2604.22121", "sizes of the roll and pitch torques in µN·m", "drawn")
            .cannot_be_checked(
                "the available text of the papers gives neither sizes of torques nor voltages",
                {
                    let [roll, pitch] = [&rolls, &pitches].map(|torques| range(torques));
                    format!(
                        "the roll torque has a range of {roll:.2} µN·m, and the pitch torque has a range of \
                         {pitch:.2} µN·m"
                    )
                },
            ),
    ]
}

fn commanded() -> Vec<Commanded> {
    let pair = Flier::pair();
    let commands: Vec<(f64, f64)> =
        DIFFERENCES.iter().flat_map(|&difference| BIASES.map(|bias| (difference, bias))).collect();
    let points: Vec<_> = commands
        .iter()
        .map(|&(difference, bias)| vec![("difference_drive_voltage_pp", difference), ("drive_offset", bias)])
        .collect();
    let settled = pair.settle(&points);
    let rows = commands.into_iter().zip(&settled);
    rows.map(|((difference, bias), point)| {
        let [roll, pitch, _] = torques(point);
        Commanded { difference, bias, roll, pitch, lift: point.get("force_up_mn") }
    })
    .collect()
}

/// Returns Pearson's correlation coefficient of two lists of numbers.
fn correlation(xs: &[f64], ys: &[f64]) -> f64 {
    let count = f64::from(u32::try_from(xs.len()).expect("commands are few"));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (x, y) = (mean(xs), mean(ys));
    let sum =
        |value: &dyn Fn(f64, f64) -> f64| xs.iter().zip(ys).map(|(a, b)| value(a - x, b - y)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

/// Returns the difference between the largest and the smallest number of a list.
fn range(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
}
