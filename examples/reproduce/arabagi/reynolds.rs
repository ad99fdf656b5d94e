//! Claims about the Reynolds number (section II-C).

use flap_core::model::four_bar::Params;
use flap_core::num::Backend;
use flap_core::simulate::{PointRun, TrajectoryRequest};

use super::{bench, system_30, system_75};
use crate::claim::{Claim, assumed, said};

/// Kinematic viscosity of air (m²/s).
const VISCOSITY: f64 = 1.5e-5;

pub(super) fn claims() -> Vec<Claim> {
    [system_75(), system_30()]
        .map(|system| {
            let reynolds = strip_average(&system.params) * largest_rate(&system.params);
            let statement =
                format!("Reynolds number of the {}, averaged over the strips of the wing", system.name);
            said("II-C", statement, "2800").is(
                &assumed(2800.0, 50.0),
                reynolds,
                format!(
                    "Reynolds number of the {} {:.0} at the largest stroke rate",
                    system.name,
                    10.0 * (reynolds / 10.0).round()
                ),
            )
        })
        .into()
}

/// Returns the mean of r c / ν along the span (s), with the radius r, the chord c and the kinematic viscosity
/// ν.
fn strip_average(p: &Params) -> f64 {
    let n = 1000;
    let strips = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
    strips.map(|x| (p.wing_offset + x * p.wing_length) * p.chord(x)).sum::<f64>() / f64::from(n) / VISCOSITY
}

/// Returns the largest stroke rate of the settled motion (rad/s).
fn largest_rate(p: &Params) -> f64 {
    let bench = bench();
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: 400, settled: true };
    let motion =
        bench.motions().trajectory(&PointRun::new(Backend::best(), &bench.solver, &p.to_values()), &request);
    let motion = motion.expect("the motion settles");
    let rate = motion.columns.iter().position(|column| column == "stroke_rate_rad_s").expect("it is a state");
    motion.rows.iter().map(|row| row[rate].abs()).fold(0.0, f64::max)
}
