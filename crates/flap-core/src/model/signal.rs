//! Signals of a model, and their measures over a drive period.

use super::units::Unit;

/// A quantity followed along the motion.
#[derive(Debug)]
pub struct Signal {
    /// Name, the first part of its column names.
    pub name: &'static str,
    /// Unit of its columns.
    pub unit: Unit,
    /// Meaning, to follow words such as "mean of".
    pub doc: &'static str,
    /// Its measures over a drive period. A signal without measures serves derived columns alone, and has no column in
    /// trajectories either.
    pub measures: &'static [Measure],
    /// Measures that only derived columns use.
    pub needed: &'static [Measure],
    /// The measure whose error counts for the error of a row, if there is one.
    pub principal: Option<Principal>,
}

impl Signal {
    /// A signal of which all `measures` are taken over a drive period.
    pub const fn new(
        name: &'static str,
        unit: Unit,
        doc: &'static str,
        measures: &'static [Measure],
    ) -> Signal {
        Signal { name, unit, doc, measures, needed: &[], principal: None }
    }

    /// The same signal, with a measure whose error counts for the error of a row. A model has at least one.
    #[must_use]
    pub const fn principal(self, measure: Principal) -> Signal {
        Signal { principal: Some(measure), ..self }
    }

    /// The same signal, of which derived columns use these measures besides.
    #[must_use]
    pub const fn needs(self, needed: &'static [Measure]) -> Signal {
        Signal { needed, ..self }
    }

    /// True if it has columns of its own.
    pub fn is_shown(&self) -> bool {
        !self.measures.is_empty()
    }

    /// True if one of these `measures` is taken, as a column or for the error of a row.
    pub(crate) const fn takes_one_of(&self, measures: &[Measure]) -> bool {
        let mut i = 0;
        while i < measures.len() {
            if self.is_judged_by(measures[i])
                || has(self.measures, measures[i])
                || has(self.needed, measures[i])
            {
                return true;
            }
            i += 1;
        }
        false
    }

    /// True if the error of a row takes this measure: the principal one and, unless the signal's range is followed anyway, the
    /// root mean square for the size of the signal.
    const fn is_judged_by(&self, measure: Measure) -> bool {
        let Some(principal) = self.principal else { return false };
        let principal = principal.measure();
        let is_size = measure as u8 == Measure::Rms as u8;
        measure as u8 == principal as u8
            || is_size
                && !has(RANGED, principal)
                && !meet(self.measures, RANGED)
                && !meet(self.needed, RANGED)
    }
}

/// The measures for which the largest and the smallest value of a signal are found. Positive parts need their signs.
pub(crate) const RANGED: &[Measure] = &[
    Measure::Amplitude,
    Measure::PeakToPeak,
    Measure::Max,
    Measure::Min,
    Measure::Peak,
    Measure::First,
    Measure::Supply,
    Measure::Magnitude,
];

/// True if both lists have a measure in common.
const fn meet(one: &[Measure], other: &[Measure]) -> bool {
    let mut i = 0;
    while i < one.len() {
        if has(other, one[i]) {
            return true;
        }
        i += 1;
    }
    false
}

/// True if `measures` has this one.
const fn has(measures: &[Measure], one: Measure) -> bool {
    let mut i = 0;
    while i < measures.len() {
        if measures[i] as u8 == one as u8 {
            return true;
        }
        i += 1;
    }
    false
}

/// The position of the signal called `name`.
///
/// # Panics
/// If there is none: for constants, where that does not compile.
pub const fn position(signals: &[Signal], name: &str) -> usize {
    let mut position = 0;
    while position < signals.len() {
        if is_same(signals[position].name, name) {
            return position;
        }
        position += 1;
    }
    panic!("no signal has this name")
}

const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut i = 0;
    while i < one.len() && i < other.len() && one[i] == other[i] {
        i += 1;
    }
    i == one.len() && i == other.len()
}

/// A measure whose error counts for the error of a row: one that a second integration at coarser tolerances computes too.
/// That integration leaves out extrema and positive parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Principal {
    /// Mean.
    Mean,
    /// Amplitude of the first harmonic.
    First,
}

impl Principal {
    /// The measure.
    pub const fn measure(self) -> Measure {
        match self {
            Principal::Mean => Measure::Mean,
            Principal::First => Measure::First,
        }
    }
}

/// A measure of a signal over one drive period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Half of largest minus smallest value.
    Amplitude,
    /// Largest minus smallest value.
    PeakToPeak,
    /// Mean.
    Mean,
    /// Largest value.
    Max,
    /// Smallest value.
    Min,
    /// Amplitude of the first harmonic.
    First,
    /// Root mean square.
    Rms,
    /// Largest magnitude.
    Peak,
    /// Mean of the positive part.
    Supply,
    /// Mean magnitude.
    Magnitude,
}

impl Measure {
    /// The middle part of column names.
    pub fn name(self) -> &'static str {
        match self {
            Measure::Amplitude => "amplitude",
            Measure::PeakToPeak => "pp",
            Measure::Mean => "mean",
            Measure::Max => "max",
            Measure::Min => "min",
            Measure::First => "first",
            Measure::Rms => "rms",
            Measure::Peak => "peak",
            Measure::Supply => "supply",
            Measure::Magnitude => "magnitude",
        }
    }

    /// In words, to be followed by the signal's description.
    pub fn describe(self) -> &'static str {
        match self {
            Measure::Amplitude => "half of largest minus smallest",
            Measure::PeakToPeak => "largest minus smallest",
            Measure::Mean => "mean",
            Measure::Max => "largest",
            Measure::Min => "smallest",
            Measure::First => "amplitude of the first harmonic of the",
            Measure::Rms => "root mean square",
            Measure::Peak => "largest magnitude of the",
            Measure::Supply => "mean of the positive part of the",
            Measure::Magnitude => "mean magnitude of the",
        }
    }
}

/// A signal over one drive period, in SI units: its mean, and what its measures need. The rest is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalCycle {
    /// Mean.
    pub mean: f64,
    /// Mean of the square.
    pub mean_square: f64,
    /// Mean of the positive part.
    pub positive_mean: f64,
    /// First harmonic X of x = Re(X e^{iωt}), real and imaginary part; t = 0 where the drive's sine rises.
    pub first: [f64; 2],
    /// Largest value.
    pub max: f64,
    /// Smallest value.
    pub min: f64,
}

impl SignalCycle {
    /// The relative difference of another signal's mean from this one's.
    pub fn audit(&self, other: &SignalCycle) -> f64 {
        (other.mean - self.mean) / self.mean
    }

    /// The size of the signal: the largest magnitude of what is known of it.
    pub fn size(&self) -> f64 {
        let known = [self.mean, self.max, self.min, self.positive_mean, self.mean_square.sqrt()];
        known.iter().fold(0.0, |size, value| value.abs().max(size))
    }

    /// The measure in SI units.
    pub fn measure(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Amplitude => 0.5 * (self.max - self.min),
            Measure::PeakToPeak => self.max - self.min,
            Measure::Mean => self.mean,
            Measure::Max => self.max,
            Measure::Min => self.min,
            Measure::First => (self.first[0] * self.first[0] + self.first[1] * self.first[1]).sqrt(),
            Measure::Rms => self.mean_square.sqrt(),
            Measure::Peak => self.max.max(-self.min),
            Measure::Supply => self.positive_mean,
            Measure::Magnitude => 2.0 * self.positive_mean - self.mean,
        }
    }

    /// Phase of the first harmonic (rad), in (−π, π].
    pub fn phase(&self) -> f64 {
        libm::atan2(self.first[1], self.first[0])
    }
}
