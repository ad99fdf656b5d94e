//! Experiments on single points, with limits on the length and with finite results: chirps, and forces along an imposed
//! motion.

use flap_core::simulate::{
    ChirpRequest, ChirpResponse, Experiments, ImposedMotion, PointRun, Trajectory, Unfinished,
};
use flap_experiments::free::INTERVALS_MAX;

/// Largest number of drive periods of a chirp.
pub const CYCLES_MAX: f64 = 100_000.0;

/// Reason why an experiment has no results.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExperimentError {
    /// The motion is incomplete.
    #[error(transparent)]
    Unfinished(#[from] Unfinished),
    /// A chirp has too many drive periods.
    #[error(
        "a chirp from {from:?} Hz to {to:?} Hz at {rate:?} Hz/s lasts {duration:.3e} s, which is {cycles:.3e} drive periods: \
         at most {CYCLES_MAX} are allowed"
    )]
    LongChirp {
        /// Frequency at the beginning (Hz).
        from: f64,
        /// Frequency at the end (Hz).
        to: f64,
        /// Rate of change of the frequency (Hz/s).
        rate: f64,
        /// Duration (s).
        duration: f64,
        /// Number of drive periods.
        cycles: f64,
    },
    /// The motion of a chirp has too many samples.
    #[error(
        "a chirp of {cycles:.0} drive periods with {samples} samples each has {:.0} samples: at most {INTERVALS_MAX} are allowed",
        cycles * f64::from(*samples)
    )]
    ManySamples {
        /// Number of drive periods.
        cycles: f64,
        /// Samples per drive period.
        samples: u32,
    },
    /// A force is infinite or NaN.
    #[error(
        "{column} is {value} at {time:?} s: the forces along this motion are too large for 64-bit floats"
    )]
    NotFinite {
        /// Column.
        column: String,
        /// Time (s).
        time: f64,
        /// Value, infinite or NaN.
        value: f64,
    },
}

impl ExperimentError {
    /// Returns advice for the user, if there is advice for this mistake.
    pub fn help(&self) -> Option<String> {
        match self {
            ExperimentError::Unfinished(_) => None,
            ExperimentError::LongChirp { from, to, .. } => {
                let least = (to - from) * (0.5 * (to + from)) / CYCLES_MAX;
                Some(if least.is_finite() {
                    format!("sweep at {least:.3e} Hz/s or faster, or over a smaller range of frequencies")
                } else {
                    "sweep over a smaller range of frequencies".to_owned()
                })
            }
            ExperimentError::ManySamples { cycles, .. } => Some(format!(
                "take at most {:.0} samples per drive period",
                (f64::from(INTERVALS_MAX) / cycles).floor()
            )),
            ExperimentError::NotFinite { .. } => Some(
                "compare the parameters with the preset: `flap check` lists large differences".to_owned(),
            ),
        }
    }
}

/// Runs a chirp. The chirp must have at most [`CYCLES_MAX`] drive periods.
///
/// # Errors
/// - [`ExperimentError::LongChirp`] and [`ExperimentError::ManySamples`] if the chirp is too long
/// - [`ExperimentError::Unfinished`] for the errors of [`Experiments::chirp`]
pub fn chirp(
    model: &dyn Experiments,
    run: &PointRun<'_>,
    request: &ChirpRequest,
) -> Result<ChirpResponse, ExperimentError> {
    let ChirpRequest { from, to, rate, samples_per_cycle: samples } = *request;
    let duration = (to - from) / rate;
    // The integral of the frequency over time.
    let cycles = duration * (0.5 * from + 0.5 * to);
    // The model rejects frequencies and rates that do not form a chirp.
    if cycles > CYCLES_MAX {
        return Err(ExperimentError::LongChirp { from, to, rate, duration, cycles });
    }
    if cycles * f64::from(samples) > f64::from(INTERVALS_MAX) {
        return Err(ExperimentError::ManySamples { cycles, samples });
    }
    Ok(model.chirp(run, request)?)
}

/// Returns the forces along an imposed motion, without the columns that the motion does not determine.
///
/// # Errors
/// - [`ExperimentError::NotFinite`] if a force is infinite or NaN
/// - [`ExperimentError::Unfinished`] for the errors of [`Experiments::imposed`]
pub fn forces(
    model: &dyn Experiments,
    values: &[f64],
    motion: &ImposedMotion,
) -> Result<Trajectory, ExperimentError> {
    let Trajectory { columns, rows } = model.imposed(values, motion)?;
    let known: Vec<usize> =
        (0..columns.len()).filter(|&column| rows.iter().any(|row| !row[column].is_nan())).collect();
    for row in &rows {
        if let Some(&column) = known.iter().find(|&&column| !row[column].is_finite()) {
            let (column, value) = (columns[column].clone(), row[column]);
            return Err(ExperimentError::NotFinite { column, time: row[0], value });
        }
    }
    let kept = |row: &Vec<f64>| known.iter().map(|&column| row[column]).collect();
    Ok(Trajectory {
        rows: rows.iter().map(kept).collect(),
        columns: known.iter().map(|&column| columns[column].clone()).collect(),
    })
}
