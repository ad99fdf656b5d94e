//! Waveforms and motions from files.

use std::path::Path;

use flap_core::drive::{Repeat, Samples};
use flap_sweep::files::record::{self, Record};

use super::point::Chosen;
use crate::args::{PointArgs, RunArgs};
use crate::console;
use crate::failure::Failure;

/// Reads the waveform or the stroke that the command line gives, and adds it to the point.
pub(super) fn apply(chosen: &mut Chosen, point: &PointArgs, args: &RunArgs) -> Result<(), Failure> {
    let repeat = if args.once { Repeat::Once } else { Repeat::Periodic };
    let (path, quantity) = match (&args.waveform, &args.stroke) {
        (Some(path), _) => (path, record::WAVE),
        (None, Some(path)) => (path, record::STROKE),
        (None, None) if args.once => {
            return Err(Failure::usage("--once requires --waveform or --stroke"));
        }
        (None, None) => return Ok(()),
    };
    let samples = Record::read(path)?.samples(&quantity, repeat)?;
    warn_of_overshoot(&samples, path, if args.stroke.is_some() { " rad" } else { "" });
    if point.changes.all().all(|(_, name, _)| name != "drive_frequency") {
        chosen.put("drive_frequency", 1.0 / samples.duration());
    }
    if args.stroke.is_some() && !(chosen.put("stroke_mode", 1.0) && chosen.put("stroke_amplitude", 1.0)) {
        let message =
            format!("the stroke of the model {} cannot be prescribed", chosen.plan.simulator().name());
        return Err(Failure::usage(message).help("--stroke requires a model with the parameter stroke_mode"));
    }
    chosen.sampled = Some(chosen.plan.simulator().experiments()?.with_samples(samples));
    Ok(())
}

/// Largest excess of the spline over the range of the samples without a warning, as a fraction of the range.
const OVERSHOOT: f64 = 0.02;

/// Warns if the spline through the samples exceeds the range of the samples.
fn warn_of_overshoot(samples: &Samples, path: &Path, unit: &str) {
    let ([low, high], [from, to]) = (samples.range(), samples.sample_range());
    if (from - low).max(high - to) > OVERSHOOT * (to - from) {
        console::warn(&format!(
            "{}: the spline through the samples lies between {low:.3} and {high:.3}{unit}, but the samples between \
             {from:.3} and {to:.3}{unit}; add samples where the wave changes quickly",
            path.display()
        ));
    }
}
