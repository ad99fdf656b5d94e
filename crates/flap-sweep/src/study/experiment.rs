//! Computes chirps, and the forces along imposed motions. Chirps that are too long, and results that are not
//! finite, are errors.

use flap_core::simulate::{
    ChirpRequest, ChirpResponse, Experiments, ImposedMotion, PointRun, Trajectory, Unfinished,
};
use flap_experiments::free::INTERVALS_MAX;

use crate::notation::UserError;

/// Largest number of drive periods that a chirp may have.
pub const CYCLES_MAX: f64 = 100_000.0;

impl From<Unfinished> for UserError {
    fn from(unfinished: Unfinished) -> UserError {
        UserError::new(unfinished.to_string(), None)
    }
}

/// Computes the motion during a chirp. A chirp must have at least 1 and at most [`CYCLES_MAX`] drive periods.
///
/// # Errors
/// An error if the chirp has too few or too many drive periods, or too many samples, and the errors of
/// [`Experiments::chirp`].
pub fn chirp(
    model: &dyn Experiments,
    run: &PointRun<'_>,
    request: &ChirpRequest,
) -> Result<ChirpResponse, UserError> {
    let ChirpRequest { from, to, rate, samples_per_cycle: samples } = *request;
    let duration = (to - from) / rate;
    // The integral of the frequency over time.
    let cycles = duration * (0.5 * from + 0.5 * to);
    // The model rejects frequencies and rates that do not form a chirp.
    if cycles > CYCLES_MAX {
        let message = format!(
            "a chirp from {from:?} Hz to {to:?} Hz at {rate:?} Hz/s lasts {duration:.3e} s, which is {cycles:.3e} drive periods: \
             at most {CYCLES_MAX} are allowed"
        );
        let least = (to - from) * (0.5 * (to + from)) / CYCLES_MAX;
        let help = if least.is_finite() {
            format!("sweep at {least:.3e} Hz/s or faster, or over a smaller range of frequencies")
        } else {
            "sweep over a smaller range of frequencies".to_owned()
        };
        return Err(UserError { message, help: Some(help) });
    }
    if cycles > 0.0 && cycles < 1.0 {
        let message = format!(
            "a chirp from {from:?} Hz to {to:?} Hz at {rate:?} Hz/s lasts {duration:.3e} s, which is {cycles:.3e} drive periods: \
             at least 1 is needed"
        );
        let help =
            format!("sweep at {:.3e} Hz/s or slower, or over a larger range of frequencies", cycles * rate);
        return Err(UserError { message, help: Some(help) });
    }
    let all = cycles * f64::from(samples);
    if all > f64::from(INTERVALS_MAX) {
        let message = format!(
            "a chirp of {cycles:.0} drive periods with {samples} samples each has {all:.0} samples: at most {INTERVALS_MAX} are allowed"
        );
        let most = (f64::from(INTERVALS_MAX) / cycles).floor();
        let help = format!("take at most {most:.0} samples per drive period");
        return Err(UserError { message, help: Some(help) });
    }
    Ok(model.chirp(run, request)?)
}

/// Returns the forces along an imposed motion. Columns that cannot be computed from the given motion are left
/// out.
///
/// # Errors
/// An error if the number of samples is too large or a force is infinite or NaN, and the errors of
/// [`Experiments::imposed`].
pub fn forces(
    model: &dyn Experiments,
    run: &PointRun<'_>,
    motion: &ImposedMotion,
) -> Result<Trajectory, UserError> {
    if motion.samples > INTERVALS_MAX {
        let message = format!("{} samples are too many: at most {INTERVALS_MAX} are allowed", motion.samples);
        return Err(UserError::new(message, None));
    }
    let Trajectory { columns, rows } = model.imposed(run, motion)?;
    let known: Vec<usize> =
        (0..columns.len()).filter(|&column| rows.iter().any(|row| !row[column].is_nan())).collect();
    for row in &rows {
        if let Some(&column) = known.iter().find(|&&column| !row[column].is_finite()) {
            let (name, value, time) = (&columns[column], row[column], row[0]);
            let message = format!(
                "{name} is {value} at {time:?} s: the forces along this motion are too large for 64-bit floats"
            );
            let help = "compare the parameters with the preset: `flap check` lists large differences";
            return Err(UserError::new(message, Some(help)));
        }
    }
    let kept = |row: &Vec<f64>| known.iter().map(|&column| row[column]).collect();
    Ok(Trajectory {
        rows: rows.iter().map(kept).collect(),
        columns: known.iter().map(|&column| columns[column].clone()).collect(),
    })
}
