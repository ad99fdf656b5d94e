//! Searches for the drive frequencies at which the settled stroke of one design is largest. The module also
//! checks the size of an impulse for free motions.

use std::f64::consts::PI;

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, PointRun, Row, Simulator, Status, Unfinished, run_list};

use super::search::{Found, Peaks, Search, Seen};
use super::target::{Objective, Range, Target, has_prescribed_stroke, prescribed};
use crate::notation::UserError;

/// Largest number of reported peaks.
const PEAKS: usize = 2;

/// A local maximum of the stroke over the drive frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenPeak {
    /// Drive frequency (Hz).
    pub frequency: f64,
    /// Peak-to-peak stroke at this frequency (deg).
    pub stroke_pp: f64,
    /// Peak-to-peak pitch at this frequency (deg).
    pub pitch_pp: f64,
}

/// Result of a search for the peaks of the stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenPeaks {
    /// Lowest and highest frequency of the searched range (Hz).
    pub range: [f64; 2],
    /// At most two peaks inside the searched range, beginning with the highest peak.
    pub peaks: Vec<DrivenPeak>,
    /// End of the searched range (Hz) at which the stroke is larger than at every peak, if there is such an
    /// end.
    pub larger_at: Option<f64>,
    /// Number of points that the search has computed.
    pub points: usize,
    /// Intervals of frequencies without a periodic motion, in ascending order.
    pub gaps: Vec<Gap>,
}

/// An interval of drive frequencies at which the search found no periodic motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Lowest frequency of the interval (Hz).
    pub from: f64,
    /// Highest frequency of the interval (Hz).
    pub to: f64,
    /// Number of frequencies in the interval at which the search has computed a point.
    pub points: usize,
    /// Status that the motions have at all frequencies of the interval.
    pub status: Status,
}

/// Searches for the drive frequencies at which the stroke of a design has its highest peaks.
///
/// The stroke and the pitch of each peak are measured on the motion that begins at rest. The field `range.of`
/// is ignored. `update` computes the values that depend on the drive frequency, and returns the reason if a
/// point with the new values cannot be simulated.
///
/// # Errors
/// - [`Unfinished::Interrupted`] if the search is interrupted.
/// - [`Unfinished::Invalid`] if the parameter values are impossible, or if the range, the stroke mode or the
///   model allows no search.
pub fn search(
    model: &'static dyn Simulator,
    run: &PointRun<'_>,
    range: &Range,
    update: impl Fn(&mut [f64]) -> Option<Invalid>,
) -> Result<DrivenPeaks, Unfinished> {
    let PointRun { backend, solver, values, interrupted } = *run;
    let tolerance = range.tolerance;
    if tolerance.is_nan() || tolerance <= 0.0 {
        let message = format!("the tolerance must be more than zero, not {tolerance} Hz");
        return Err(Invalid::new(message).into());
    }
    if has_prescribed_stroke(model.parameters(), values) {
        return Err(prescribed("set stroke_mode to free").into());
    }
    let lacks = |what: &str| Invalid::new(format!("the model {what}"));
    let target = Target::new(model, Range { of: Objective::Stroke, ..*range })
        .ok_or_else(|| lacks("has no drive frequency or measures no stroke"))?;
    let pitch = model.columns().iter().position(|column| column.name == "pitch_amplitude_deg");
    let pitch = pitch.ok_or_else(|| lacks("measures no pitch"))?;
    let search = Search::new(&target, Point::at_rest(0, values.to_vec()), Peaks::ALL);
    let searched = search.sequence().run(|mut points| {
        let invalid: Vec<_> = points.iter_mut().map(|point| update(&mut point.values)).collect();
        let possible = points.into_iter().zip(&invalid).filter(|(_, invalid)| invalid.is_none());
        let possible = possible.map(|(point, _)| point).collect();
        let mut rows = run_list(model, backend, solver, possible, interrupted)?.into_iter();
        let row = |invalid: Option<Invalid>| invalid.map(Row::invalid).or_else(|| rows.next());
        Ok::<_, Unfinished>(invalid.into_iter().filter_map(row).collect())
    });
    let (found, seen) = searched?.into_peaks()?;
    Ok(peaks(&found, &seen, tolerance, [target.objective, pitch]))
}

/// Returns the peaks that the search found. `amplitudes` contains the indices of the stroke amplitude and the
/// pitch amplitude among the measures.
fn peaks(found: &Found, seen: &[Seen], tolerance: f64, amplitudes: [usize; 2]) -> DrivenPeaks {
    let [from, to] = found.ends;
    let mut tops: Vec<DrivenPeak> =
        found.peaks.iter().filter_map(|([frequency, _], row)| peak(*frequency, row, amplitudes)).collect();
    tops.sort_by(|one, other| other.stroke_pp.total_cmp(&one.stroke_pp));
    let end_of =
        |top: &DrivenPeak| [from, to].into_iter().find(|end| (top.frequency - end).abs() <= tolerance);
    let larger_at = tops.first().and_then(end_of);
    tops.retain(|top| end_of(top).is_none());
    tops.truncate(PEAKS);
    DrivenPeaks { range: found.ends, peaks: tops, larger_at, points: seen.len(), gaps: gaps(seen) }
}

/// Returns a peak with the stroke and the pitch of `row`. If the motion is not periodic, returns `None`.
fn peak(frequency: f64, row: &Row, amplitudes: [usize; 2]) -> Option<DrivenPeak> {
    let [stroke, pitch] = amplitudes.map(|index| row.measures.get(index).map(|amplitude| 2.0 * amplitude));
    Some(DrivenPeak { frequency, stroke_pp: stroke?, pitch_pp: pitch? })
}

/// Returns the intervals of frequencies without a periodic motion.
fn gaps(seen: &[Seen]) -> Vec<Gap> {
    let mut seen: Vec<(f64, Status)> = seen.iter().map(|seen| (seen.frequency, seen.status)).collect();
    seen.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut gaps: Vec<Gap> = Vec::new();
    let mut open = false;
    for (frequency, status) in seen {
        let gap = gaps.last_mut().filter(|gap| open && gap.status == status);
        open = status != Status::Periodic;
        match gap {
            Some(gap) => {
                gap.to = frequency;
                gap.points += 1;
            }
            None if open => gaps.push(Gap { from: frequency, to: frequency, points: 1, status }),
            None => {}
        }
    }
    gaps
}

/// Checks that the amplitude of an impulse (rad) is at most 180°, and returns the amplitude. With a larger
/// impulse, the wing would pass through the body.
///
/// # Errors
/// Returns an error with advice if the magnitude of the amplitude is larger than π, or NaN.
pub fn impulse(amplitude: f64) -> Result<f64, UserError> {
    if amplitude.abs() <= PI {
        return Ok(amplitude);
    }
    let degrees = amplitude.to_degrees();
    let message = format!("an impulse of {degrees:.1} deg ({amplitude} rad) is larger than 180 deg");
    Err(UserError::new(message, Some("give at most 180 deg, such as \"20 deg\"")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_is_at_most_half_a_turn() {
        assert_eq!(impulse(-PI), Ok(-PI));
        let refused = impulse(20.0).map_err(|error| error.to_string());
        assert_eq!(refused, Err("an impulse of 1145.9 deg (20 rad) is larger than 180 deg".to_owned()));
        assert!(impulse(f64::NAN).is_err());
    }
}
