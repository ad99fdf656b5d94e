//! The drive frequencies at which the settled stroke of one design is largest, and its free motion after an impulse.

use std::f64::consts::PI;

use flap_core::simulate::{Point, PointRun, Row, Simulator, Status, run_list};

use super::search::{Found, Peaks, Search, Seen};
use super::sequence::PointSequence as _;
use super::target::{Objective, Range, SearchError, Target, has_prescribed_stroke};

/// Most peaks that are reported.
const PEAKS: usize = 2;

/// The range of a search for peaks, and its accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeakSearch {
    /// Lowest drive frequency (Hz); half of the lower natural frequency if `None`.
    pub from: Option<f64>,
    /// Highest drive frequency (Hz); one and a half times the upper natural frequency if `None`.
    pub to: Option<f64>,
    /// Largest error of a peak's frequency (Hz), more than zero.
    pub tolerance: f64,
}

/// A frequency at which the stroke is larger than on either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenPeak {
    /// Drive frequency (Hz).
    pub frequency: f64,
    /// Stroke, peak to peak (deg).
    pub stroke_pp: f64,
    /// Pitch, peak to peak (deg).
    pub pitch_pp: f64,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenPeaks {
    /// Lowest and highest frequency of the range (Hz).
    pub range: [f64; 2],
    /// The peaks between its ends, the highest first; at most two.
    pub peaks: Vec<DrivenPeak>,
    /// The end of the range (Hz) at which the stroke is larger than at any peak, if it is.
    pub larger_at: Option<f64>,
    /// Points run.
    pub points: usize,
    /// The frequencies at which the motion did not become periodic, rising.
    pub gaps: Vec<Gap>,
}

/// Neighbouring drive frequencies at which the motion did not become periodic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Lowest of them (Hz).
    pub from: f64,
    /// Highest of them (Hz).
    pub to: f64,
    /// Number of them.
    pub points: usize,
    /// The status of the motion at all of them.
    pub status: Status,
}

/// Looks for the drive frequencies at which the stroke of a point is largest. Stroke and pitch of a peak are those of the
/// motion from rest.
///
/// # Errors
/// - [`SearchError::Unfinished`] if it is interrupted, or the values are impossible together
/// - another [`SearchError`] if the search is impossible
pub fn search(
    model: &'static dyn Simulator,
    run: &PointRun<'_>,
    search: &PeakSearch,
) -> Result<DrivenPeaks, SearchError> {
    let PointRun { backend, solver, values, interrupted } = *run;
    let PeakSearch { from, to, tolerance } = *search;
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(SearchError::Tolerance(tolerance));
    }
    if has_prescribed_stroke(model.parameters(), values) {
        return Err(SearchError::Prescribed("set it to free"));
    }
    let range = Range { of: Objective::Stroke, from, to, tolerance };
    let target = Target::new(model, range)
        .ok_or(SearchError::Model("has no drive frequency or measures no stroke"))?;
    let pitch = model.columns().iter().position(|column| column.name == "pitch_amplitude_deg");
    let pitch = pitch.ok_or(SearchError::Model("measures no pitch"))?;
    let mut design = Search::new(&target, Point::at_rest(0, values.to_vec()), Peaks::ALL);
    loop {
        let probes = design.probes();
        if probes.is_empty() {
            break;
        }
        design.take(run_list(model, backend, solver, probes, interrupted)?);
    }
    let (found, seen) = design.into_peaks()?;
    Ok(peaks(&found, &seen, tolerance, [target.objective, pitch]))
}

/// The peaks that were found, given the indices of the amplitudes of stroke and pitch among the measures.
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

/// The peak at which the motion of `row` is; `None` if that is not periodic.
fn peak(frequency: f64, row: &Row, amplitudes: [usize; 2]) -> Option<DrivenPeak> {
    let [stroke, pitch] = amplitudes.map(|index| row.measures.get(index).map(|amplitude| 2.0 * amplitude));
    Some(DrivenPeak { frequency, stroke_pp: stroke?, pitch_pp: pitch? })
}

/// The frequencies at which the motion did not become periodic.
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

/// An impulse whose amplitude no wing can reach.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("an impulse of {:.1} deg ({amplitude} rad) is larger than half a turn", amplitude.to_degrees())]
pub struct LargeImpulse {
    /// The amplitude (rad).
    amplitude: f64,
}

impl LargeImpulse {
    /// The remedy.
    pub const HELP: &str = "give at most 180 deg, such as \"20 deg\"";
}

/// The amplitude (rad) of an impulse, if it is at most half a turn: a wing that turns further passes through the body.
///
/// # Errors
/// [`LargeImpulse`] for a larger amplitude.
pub fn impulse(amplitude: f64) -> Result<f64, LargeImpulse> {
    if amplitude.abs() <= PI { Ok(amplitude) } else { Err(LargeImpulse { amplitude }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_is_at_most_half_a_turn() {
        assert_eq!(impulse(-PI), Ok(-PI));
        let refused = impulse(20.0).map_err(|error| error.to_string());
        assert_eq!(refused, Err("an impulse of 1145.9 deg (20 rad) is larger than half a turn".to_owned()));
        assert!(impulse(f64::NAN).is_err());
    }
}
