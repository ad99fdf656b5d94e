//! A motion that is given, stroke and pitch: nothing to integrate, forces to evaluate.

use crate::model::Motions;
use crate::simulate::{ImposedMotion, RequestError, Trajectory, Unfinished, shown, trajectory_columns};

/// States and signals along a given motion, at equal distances from its first sample to its last.
pub(super) fn follow<M: Motions<N>, const N: usize>(
    model: &M,
    values: &[f64],
    motion: &ImposedMotion,
) -> Result<Trajectory, Unfinished> {
    let ImposedMotion { stroke, pitch, samples } = motion;
    let (duration, other) = (stroke.duration(), pitch.duration());
    if (duration - other).abs() > 1e-9 * duration {
        return Err(RequestError::Durations { stroke: duration, pitch: other }.into());
    }
    let model = &model.variant(values);
    let constants = model.start(values)?.constants;
    let rows = (0..=*samples).map(|i| {
        let time = duration * (f64::from(i) / f64::from((*samples).max(1)));
        let (y, signals) = model.imposed(&constants, stroke.motion(time), pitch.motion(time));
        let mut row = vec![time];
        row.extend(y);
        row.extend(shown::<M::Signals>(&signals));
        row
    });
    Ok(Trajectory { columns: trajectory_columns::<M, N>(), rows: rows.collect() })
}
