//! Waveforms and motions from files.

use std::path::Path;

use flap_core::drive::{Repeat, Samples};
use flap_sweep::files::record::{self, Record};

use crate::args::RunArgs;
use crate::console;
use crate::failure::Failure;

/// A waveform of the drive, or a prescribed stroke.
pub(super) struct DriveRecord {
    pub(super) samples: Samples,
    pub(super) is_stroke: bool,
}

impl DriveRecord {
    /// Returns the option that names the file of the record.
    pub(super) fn option(&self) -> &'static str {
        if self.is_stroke { "--stroke" } else { "--waveform" }
    }
}

/// Reads the waveform or the stroke that the command line gives.
pub(super) fn read(args: &RunArgs) -> Result<Option<DriveRecord>, Failure> {
    let repeat = if args.once { Repeat::Once } else { Repeat::Periodic };
    let (path, quantity) = match (&args.waveform, &args.stroke) {
        (Some(path), _) => (path, record::WAVE),
        (None, Some(path)) => (path, record::STROKE),
        (None, None) if args.once => {
            return Err(Failure::usage("--once requires --waveform or --stroke"));
        }
        (None, None) => return Ok(None),
    };
    let samples = Record::read(path)?.samples(&quantity, repeat)?;
    let is_stroke = args.stroke.is_some();
    warn_of_overshoot(&samples, path, if is_stroke { " rad" } else { "" });
    Ok(Some(DriveRecord { samples, is_stroke }))
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
