//! One-line summary of a response: hysteresis or no hysteresis, with the bistable bands.

use std::fmt;
use std::mem::discriminant;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Row, Status};

use super::curve::{Comparison, Curve};
use crate::plan::Along;
use crate::table::labels::{self, Scale};

/// Summary of a response, which can be printed as one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Smallest and largest value of the parameter of the response.
    pub range: [f64; 2],
    /// Unit of the parameter of the response.
    pub unit: &'static str,
    /// Longest step between neighbouring values of the parameter. A band of hysteresis that is narrower than
    /// this step may not be found.
    pub step: f64,
    /// Upper limit of the length of steps in which a state component changes by more than a tenth of its
    /// size. flap halves such a step if the step is longer than this limit.
    pub steep_step: f64,
    /// Largest difference of the peak-to-peak stroke between the branches (deg), outside of the bands with
    /// different motions.
    pub difference: f64,
    /// Bands in which the two branches have different motions, or motions that do not repeat every drive
    /// period. The bands are in ascending order of the parameter.
    pub bands: Vec<Band>,
    /// Reason why the design has no response.
    pub invalid: Option<String>,
}

/// A band of parameter values at which the two branches have different motions, or motions that do not repeat
/// every drive period.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// First and last value of the parameter in the band.
    pub range: [f64; 2],
    /// Kind of the motions in the band.
    pub kind: BandKind,
}

/// Kind of the motions in a band in which the two branches do not have one common orbit.
#[derive(Clone, Debug, PartialEq)]
pub enum BandKind {
    /// The upward and the downward branch have two different motions.
    Bistable {
        /// Largest difference of the peak-to-peak stroke between the two motions (deg). `None` if at every
        /// value in the band at least one motion does not repeat every drive period.
        jump: Option<f64>,
    },
    /// Neither the upward nor the downward branch repeats every drive period.
    Irregular {
        /// The different kinds of motion in the band, each with its status and its period (in drive periods).
        what: Vec<(Status, u32)>,
    },
}

impl Verdict {
    /// Returns the summary of the response `curve` over `parameter`. `stroke` is the index of the measure
    /// that contains the stroke amplitude (deg).
    pub fn new(curve: &Curve, along: &Along, parameter: &Parameter<'_>, stroke: usize) -> Verdict {
        let steps = curve.up.windows(2).map(|two| two[1].value - two[0].value);
        let step = steps.fold(0.0, f64::max);
        let ends = [curve.up.first(), curve.up.last()];
        let mut verdict = Verdict {
            range: ends.map(|end| end.map_or(f64::NAN, |step| step.value)),
            unit: parameter.unit,
            step,
            steep_step: along.tolerance.min(step),
            difference: 0.0,
            bands: Vec::new(),
            invalid: curve.invalid().map(str::to_owned),
        };
        let stroke_pp = |row: &Row| row.measures.get(stroke).map(|amplitude| 2.0 * amplitude);
        let mut open = false;
        for ((up, down), comparison) in curve.up.iter().zip(&curve.down).zip(&curve.comparisons) {
            let strokes = stroke_pp(&up.row).zip(stroke_pp(&down.row));
            let difference = strokes.map(|(up, down)| (up - down).abs());
            let kind = match comparison {
                Comparison::Same => {
                    verdict.difference = verdict.difference.max(difference.unwrap_or(0.0));
                    open = false;
                    continue;
                }
                Comparison::Different => BandKind::Bistable { jump: difference },
                Comparison::Irregular => BandKind::irregular(&up.row, &down.row),
            };
            let is_same = |band: &&mut Band| discriminant(&band.kind) == discriminant(&kind);
            match verdict.bands.last_mut().filter(|band| open && is_same(band)) {
                Some(band) => {
                    band.range[1] = up.value;
                    band.kind.add(kind);
                }
                None => verdict.bands.push(Band { range: [up.value; 2], kind }),
            }
            open = true;
        }
        verdict
    }

    /// Returns the bistable bands.
    pub fn bistable(&self) -> impl Iterator<Item = &Band> {
        self.bands.iter().filter(|band| matches!(band.kind, BandKind::Bistable { .. }))
    }
}

impl BandKind {
    fn irregular(up: &Row, down: &Row) -> BandKind {
        let mut kind = BandKind::Irregular { what: vec![(up.status, up.period)] };
        kind.add(BandKind::Irregular { what: vec![(down.status, down.period)] });
        kind
    }

    /// Adds the kind of motion at the next parameter value to the description of the band.
    fn add(&mut self, next: BandKind) {
        match (self, next) {
            (BandKind::Bistable { jump }, BandKind::Bistable { jump: next }) => {
                *jump = [*jump, next].into_iter().flatten().reduce(f64::max);
            }
            (BandKind::Irregular { what }, BandKind::Irregular { what: next }) => {
                for kind in next {
                    if !what.contains(&kind) {
                        what.push(kind);
                    }
                }
            }
            _ => {}
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(reason) = &self.invalid {
            return write!(f, "no response: {reason}");
        }
        if self.bistable().next().is_none() {
            let Verdict { range, step, steep_step, difference, unit, .. } = self;
            write!(f, "no hysteresis {} wider than {} (", span(*range, unit), length(*step, *range, unit))?;
            if steep_step < step {
                write!(f, "{} where the motion changes by a tenth; ", length(*steep_step, *range, unit))?;
            }
            write!(f, "branches agree to {} deg)", digits(*difference))?;
        }
        for (i, band) in self.bands.iter().enumerate() {
            if i > 0 || self.bistable().next().is_none() {
                write!(f, "; ")?;
            }
            let place = span(band.range, self.unit);
            match &band.kind {
                BandKind::Bistable { jump: Some(jump) } => {
                    write!(f, "bistable {place}, jump of {} deg", digits(*jump))?;
                }
                BandKind::Bistable { jump: None } => {
                    write!(f, "bistable {place}, one branch does not repeat every drive period")?;
                }
                BandKind::Irregular { what } => {
                    let what: Vec<String> = what.iter().map(|&kind| describe(kind)).collect();
                    write!(f, "does not repeat every drive period {place} ({})", what.join(", "))?;
                }
            }
        }
        Ok(())
    }
}

fn describe((status, period): (Status, u32)) -> String {
    match status {
        Status::Subharmonic => format!("period {period}"),
        status => status.name().to_owned(),
    }
}

/// Returns a value as text with its unit and at most six digits, such as `121.5 Hz`.
pub(super) fn at(value: f64, unit: &'static str) -> String {
    length(value, [value; 2], unit)
}

/// Returns a range as text, such as `from 121.5 to 136 Hz`. If the range has only one value, the text is for
/// example `at 14 mm`.
fn span([from, to]: [f64; 2], unit: &str) -> String {
    let Scale { factor, unit } = scale([from, to], unit);
    let [from, to] = [from, to].map(|value| six_digits(value * factor));
    let text = if from == to { format!("at {from} {unit}") } else { format!("from {from} to {to} {unit}") };
    text.trim_end().to_owned()
}

/// Returns the length of a step as text, such as `0.5 Hz`. The text has the unit prefix that flap prints for
/// the ends of `range`.
fn length(value: f64, range: [f64; 2], unit: &str) -> String {
    let Scale { factor, unit } = scale(range, unit);
    format!("{} {unit}", six_digits(value * factor)).trim_end().to_owned()
}

fn scale([from, to]: [f64; 2], unit: &str) -> Scale {
    labels::scale(unit, from.abs().max(to.abs()))
}

fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Returns a number as text: numbers below 0.1 with two significant digits, and larger numbers with two
/// decimals.
fn digits(x: f64) -> String {
    if x != 0.0 && x.abs() < 0.1 { format!("{x:.1e}") } else { format!("{x:.2}") }
}
