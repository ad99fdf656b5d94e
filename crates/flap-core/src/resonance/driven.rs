//! The drive frequency at which the settled stroke is largest.
//!
//! A grid over the range finds the highest peaks; finer and finer grids around each of them follow. Every number
//! reported comes from a point that was run.

use crate::num::InstructionSet;
use crate::parameter::{Invalid, Kind, Parameter};
use crate::simulate::{Interrupt, Point, Simulator, SolverSettings, Status, Unfinished, run_list};

/// Intervals of the first grid.
const COARSE: u32 = 160;

/// Intervals that replace the two around a peak on the next finer grid: as many new points as keep lanes busy.
const FINER: u32 = 16;

/// Peaks looked for.
const PEAKS: usize = 2;

/// The range and the precision of a search for peaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeakSearch {
    /// Lowest drive frequency (Hz).
    pub from: f64,
    /// Highest drive frequency (Hz).
    pub to: f64,
    /// The finest grid's points are no further apart than this (Hz).
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
    /// The peaks, the highest first; at most two.
    pub peaks: Vec<DrivenPeak>,
    /// The end of the range (Hz) at which the stroke is larger than at any peak, if it is.
    pub larger_at: Option<f64>,
    /// Points run.
    pub points: usize,
    /// Frequencies at which the motion did not become periodic, rising.
    pub gaps: Vec<Gap>,
}

/// Neighbouring drive frequencies at which the motion did not become periodic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Lowest of them (Hz).
    pub from: f64,
    /// Highest of them (Hz).
    pub to: f64,
    /// Number of points among them.
    pub points: usize,
    /// The status of all these points.
    pub status: Status,
}

/// Looks for the drive frequencies at which the stroke of a point is largest.
///
/// # Errors
/// [`Unfinished`] if it is interrupted, or the values are impossible together or the search is.
pub fn search(
    simulator: &dyn Simulator,
    set: InstructionSet,
    solver: &SolverSettings,
    values: &[f64],
    search: &PeakSearch,
    interrupted: Interrupt<'_>,
) -> Result<DrivenPeaks, Unfinished> {
    let PeakSearch { from, to, tolerance } = *search;
    if !(from > 0.0 && from < to && to.is_finite()) {
        return Err(Invalid::new(format!(
            "there are no drive frequencies from {from} to {to} Hz: the first must be more than zero, and less than \
             the last"
        ))
        .into());
    }
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(Invalid::new(format!(
            "a peak cannot be found to {tolerance} Hz, only to more than zero"
        ))
        .into());
    }
    if has_prescribed_stroke(simulator.parameters(), values) {
        return Err(Invalid::new(
            "stroke_mode is \"prescribed\": such a stroke is the same at every frequency, set it to free",
        )
        .into());
    }
    let mut response = Response::new(simulator, values, interrupted)?;
    let mut spacing = (to - from) / f64::from(COARSE);
    response.add(set, solver, (0..=COARSE).map(|i| from + spacing * f64::from(i)).collect())?;
    let mut tops = response.peaks();
    tops.truncate(PEAKS);
    // The parts of a step of the grid that a double cannot tell apart would refine for ever.
    while !tops.is_empty() && spacing > tolerance.max(1e-12 * to) {
        let finer = 2.0 * spacing / f64::from(FINER);
        let inside = |top: &DrivenPeak| {
            let (begin, middle) = (top.frequency - spacing, FINER / 2);
            (1..FINER).filter(move |&i| i != middle).map(move |i| begin + finer * f64::from(i))
        };
        response.add(set, solver, tops.iter().flat_map(inside).collect())?;
        for top in &mut tops {
            *top = response.highest_within(top, spacing);
        }
        spacing = finer;
    }
    tops.sort_by(|one, other| other.stroke_pp.total_cmp(&one.stroke_pp));
    Ok(response.finish(tops))
}

/// True if the stroke of a point is prescribed, and so the same at every frequency.
pub fn has_prescribed_stroke(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).any(|(parameter, &value)| {
        let Kind::Choice(options) = parameter.kind else { return false };
        let option = (0_u32..).map(f64::from).zip(options).find(|(index, _)| *index == value);
        parameter.name == "stroke_mode" && option.is_some_and(|(_, option)| *option == "prescribed")
    })
}

/// The stroke and pitch of a point by drive frequency, as far as they are known.
struct Response<'a> {
    simulator: &'a dyn Simulator,
    values: &'a [f64],
    interrupted: Interrupt<'a>,
    /// Positions of the drive frequency among the parameters, and of the amplitudes among the measures.
    frequency: usize,
    stroke: usize,
    pitch: usize,
    /// Periodic points, by rising frequency.
    settled: Vec<DrivenPeak>,
    /// The other points, by rising frequency, with their statuses.
    unsettled: Vec<(f64, Status)>,
}

impl<'a> Response<'a> {
    fn new(
        simulator: &'a dyn Simulator,
        values: &'a [f64],
        interrupted: Interrupt<'a>,
    ) -> Result<Response<'a>, Invalid> {
        let missing = |name: &str| Invalid::new(format!("the model has no {name}"));
        let column = |name: &str| {
            let index = simulator.columns().iter().position(|column| column.name == name);
            index.ok_or_else(|| missing(name))
        };
        let frequency =
            simulator.parameters().iter().position(|parameter| parameter.name == "drive_frequency");
        Ok(Response {
            simulator,
            values,
            interrupted,
            frequency: frequency.ok_or_else(|| missing("drive_frequency"))?,
            stroke: column("stroke_amplitude_deg")?,
            pitch: column("pitch_amplitude_deg")?,
            settled: Vec::new(),
            unsettled: Vec::new(),
        })
    }

    /// Runs the point at more drive frequencies.
    fn add(
        &mut self,
        set: InstructionSet,
        solver: &SolverSettings,
        frequencies: Vec<f64>,
    ) -> Result<(), Unfinished> {
        let points = frequencies.iter().map(|&frequency| {
            let mut values = self.values.to_vec();
            values[self.frequency] = frequency;
            Point::at_rest(0, values)
        });
        let rows = run_list(self.simulator, set, solver, points.collect(), self.interrupted)?;
        for (frequency, row) in frequencies.into_iter().zip(rows) {
            match row.status {
                Status::Periodic => self.settled.push(DrivenPeak {
                    frequency,
                    stroke_pp: 2.0 * row.measures[self.stroke],
                    pitch_pp: 2.0 * row.measures[self.pitch],
                }),
                Status::Invalid => return Err(Invalid::new(row.reason.unwrap_or_default()).into()),
                status => self.unsettled.push((frequency, status)),
            }
        }
        self.settled.sort_by(|one, other| one.frequency.total_cmp(&other.frequency));
        self.unsettled.sort_by(|one, other| one.0.total_cmp(&other.0));
        Ok(())
    }

    /// The peaks between the ends, the highest first.
    fn peaks(&self) -> Vec<DrivenPeak> {
        let windows = self.settled.windows(3);
        let tops = windows.filter(|three| {
            three[0].stroke_pp < three[1].stroke_pp && three[1].stroke_pp >= three[2].stroke_pp
        });
        let mut tops: Vec<DrivenPeak> = tops.map(|three| three[1]).collect();
        tops.sort_by(|one, other| other.stroke_pp.total_cmp(&one.stroke_pp));
        tops
    }

    /// The highest point at most `distance` (Hz) from another.
    fn highest_within(&self, top: &DrivenPeak, distance: f64) -> DrivenPeak {
        let near = self.settled.iter().filter(|one| (one.frequency - top.frequency).abs() <= distance);
        near.fold(*top, |highest, &one| if one.stroke_pp > highest.stroke_pp { one } else { highest })
    }

    /// Frequencies at which the motion did not become periodic, rising.
    fn gaps(&self) -> Vec<Gap> {
        let settled_between = |from: f64, to: f64| {
            self.settled.iter().any(|point| point.frequency > from && point.frequency < to)
        };
        let mut gaps: Vec<Gap> = Vec::new();
        for &(frequency, status) in &self.unsettled {
            match gaps.last_mut() {
                Some(gap) if gap.status == status && !settled_between(gap.to, frequency) => {
                    gap.to = frequency;
                    gap.points += 1;
                }
                _ => gaps.push(Gap { from: frequency, to: frequency, points: 1, status }),
            }
        }
        gaps
    }

    fn finish(self, peaks: Vec<DrivenPeak>) -> DrivenPeaks {
        let highest = peaks.first().map_or(f64::NEG_INFINITY, |peak| peak.stroke_pp);
        let ends = [self.settled.first(), self.settled.last()].into_iter().flatten();
        let end = ends.max_by(|one, other| one.stroke_pp.total_cmp(&other.stroke_pp));
        DrivenPeaks {
            peaks,
            larger_at: end.filter(|end| end.stroke_pp > highest).map(|end| end.frequency),
            points: self.settled.len() + self.unsettled.len(),
            gaps: self.gaps(),
        }
    }
}
