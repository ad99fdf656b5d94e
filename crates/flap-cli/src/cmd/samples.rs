//! Reads a waveform of the drive, or a prescribed stroke, from a file.

use flap_core::drive::{Repeat, Samples};
use flap_sweep::files::record::{self, Record};

use crate::args::RunArgs;
use crate::console;
use crate::failure::Failure;

/// The samples of a drive waveform or of a prescribed stroke.
pub(super) struct DriveRecord {
    pub(super) samples: Samples,
    pub(super) is_stroke: bool,
}

impl DriveRecord {
    /// Returns the command-line option that contains the name of the file: `--stroke` or `--waveform`.
    pub(super) fn option(&self) -> &'static str {
        if self.is_stroke { "--stroke" } else { "--waveform" }
    }
}

/// Reads the file of `--waveform` or `--stroke`. The result is `None` if the user gave neither option.
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
    let record = Record::read(path)?;
    let samples = record.samples(&quantity, repeat)?;
    let is_stroke = args.stroke.is_some();
    if let Some(warning) = record.overshoot(&samples, if is_stroke { " rad" } else { "" }) {
        console::warn(&warning);
    }
    Ok(Some(DriveRecord { samples, is_stroke }))
}
