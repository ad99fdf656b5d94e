//! Signals of a model, and their measures over a drive period.

/// A signal of a model: a quantity as a function of time.
#[derive(Clone, Copy, Debug)]
pub struct Signal {
    /// Name of the signal, which is the first part of the names of its columns.
    pub name: &'static str,
    /// Unit of the columns of the signal.
    pub unit: Unit,
    /// Description of the signal, which is appended to words such as "mean".
    pub doc: &'static str,
    /// Measures of the signal over a drive period, one column for each measure. A signal without measures is used only
    /// in derived columns and has no column in trajectories.
    pub measures: &'static [Measure],
    /// Measures that are used only in derived columns.
    pub needed: &'static [Measure],
    /// Measure of the signal whose error contributes to the error estimate of a row, if the signal has such a measure.
    /// A model has at least one signal with such a measure.
    pub principal: Option<Principal>,
    /// Measures of a force for which the rows of a vehicle have one column per wing.
    pub of_wings: &'static [Measure],
}

/// Columns of the rows of a vehicle that correspond to one column of its wings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverWings {
    /// One column with the sum over all wings.
    Sum,
    /// One column for each wing.
    Each,
    /// No column.
    Omitted,
}

impl Signal {
    /// Returns a signal with these `measures` over a drive period.
    pub const fn new(
        name: &'static str,
        unit: Unit,
        doc: &'static str,
        measures: &'static [Measure],
    ) -> Signal {
        Signal { name, unit, doc, measures, needed: &[], principal: None, of_wings: &[] }
    }

    /// Returns the columns that the rows of a vehicle contain for a measure of this signal.
    ///
    /// For a mean power, the row contains the sum over all wings. Extrema and root mean squares of a sum depend on the
    /// phases between the wings, so each wing has its own column. Forces are omitted, because the force of the vehicle
    /// has separate columns.
    pub(crate) fn over_wings(&self, measure: Measure) -> OverWings {
        match (self.unit.name, measure) {
            _ if self.of_wings.contains(&measure) => OverWings::Each,
            (name, Measure::Mean | Measure::Supply) if name == Unit::MW.name => OverWings::Sum,
            (name, _) if name == Unit::MN.name => OverWings::Omitted,
            _ => OverWings::Each,
        }
    }

    /// Returns the name of the signal's column in a trajectory.
    pub fn column(&self) -> String {
        if self.unit.suffix.is_empty() {
            self.name.to_owned()
        } else {
            format!("{}_{}", self.name, self.unit.suffix)
        }
    }

    /// Returns true if the signal has columns.
    pub(crate) fn is_shown(&self) -> bool {
        !self.measures.is_empty()
    }

    /// Returns the quantities that the measures of the signal and the error of a row require.
    pub const fn statistics(&self) -> Statistics {
        let Signal { measures, needed, principal, .. } = *self;
        let mut statistics = Statistics::of(measures).or(Statistics::of(needed));
        if let Some(principal) = principal {
            statistics = statistics.or(Statistics::of(&[principal.measure()]));
            // The error is relative to the size of the signal, which is its root mean square if its range is not
            // computed.
            statistics.squared |= !statistics.ranged;
        }
        statistics
    }
}

/// Quantities of a signal that flap computes over a drive period, in addition to the mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is independent of the others")]
pub struct Statistics {
    /// The mean square.
    pub squared: bool,
    /// The mean of the positive part.
    pub rectified: bool,
    /// The first harmonic.
    pub harmonic: bool,
    /// The largest and the smallest value.
    pub ranged: bool,
}

impl Statistics {
    /// Returns the quantities that the `measures` require. The mean of the positive part also requires the largest and
    /// the smallest value.
    const fn of(measures: &[Measure]) -> Statistics {
        let mut statistics = Statistics { squared: false, rectified: false, harmonic: false, ranged: false };
        let mut i = 0;
        while i < measures.len() {
            let measure = measures[i];
            statistics.squared |= matches!(measure, Measure::Rms);
            statistics.rectified |= matches!(measure, Measure::Supply | Measure::Magnitude);
            statistics.harmonic |= matches!(measure, Measure::First);
            statistics.ranged |= !matches!(measure, Measure::Mean | Measure::Rms);
            i += 1;
        }
        statistics
    }

    /// Returns the union of both sets of quantities.
    const fn or(self, other: Statistics) -> Statistics {
        Statistics {
            squared: self.squared | other.squared,
            rectified: self.rectified | other.rectified,
            harmonic: self.harmonic | other.harmonic,
            ranged: self.ranged | other.ranged,
        }
    }
}

/// Measure whose error contributes to the error estimate of a row.
///
/// For the error estimate, a second integration with larger tolerances computes means and first harmonics, but no
/// extrema and positive parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Principal {
    /// Mean.
    Mean,
    /// Amplitude of the first harmonic.
    First,
}

impl Principal {
    /// Returns the measure.
    pub(crate) const fn measure(self) -> Measure {
        match self {
            Principal::Mean => Measure::Mean,
            Principal::First => Measure::First,
        }
    }
}

/// A measure of a signal over one drive period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Half of the difference between the largest and the smallest value.
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
    /// Returns the name of the measure, which is the middle part of column names.
    pub(crate) fn name(self) -> &'static str {
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

    /// Returns the words for the measure, to which the description of the signal is appended.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Measure::Amplitude => "half of the difference between the largest and the smallest",
            Measure::PeakToPeak => "difference between the largest and the smallest",
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

/// Quantities of a signal over one drive period, in SI units, from which its measures are computed. Quantities that no
/// measure requires are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalCycle {
    /// Mean.
    pub mean: f64,
    /// Mean of the square.
    pub mean_square: f64,
    /// Mean of the positive part.
    pub positive_mean: f64,
    /// Real and imaginary part of the first harmonic X in x = Re(X e^{iωt}). At t = 0, the sine of the drive rises
    /// through zero.
    pub first: [f64; 2],
    /// Largest value.
    pub max: f64,
    /// Smallest value.
    pub min: f64,
}

impl SignalCycle {
    /// Replaces the mean of this power by the sum of the mean `losses`, unless the mean is NaN.
    ///
    /// In a periodic orbit, the mean power equals the sum of the mean losses, because capacitance, springs and inertia
    /// return all their energy. If losses are small or the motion is far from resonance, the quadrature error of the
    /// exchanged power can exceed the mean power.
    pub fn balance(&mut self, losses: &[SignalCycle]) {
        if !self.mean.is_nan() {
            self.mean = losses.iter().map(|loss| loss.mean).sum();
        }
    }

    /// Returns the relative difference between the means of this signal and `other`.
    pub fn audit(&self, other: &SignalCycle) -> f64 {
        (other.mean - self.mean) / self.mean
    }

    /// Returns the largest magnitude among the known quantities of the signal.
    pub(crate) fn size(&self) -> f64 {
        let known = [self.mean, self.max, self.min, self.positive_mean, self.mean_square.sqrt()];
        known.iter().fold(0.0, |size, value| value.abs().max(size))
    }

    /// Returns the value of a measure in SI units.
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

    /// Returns the phase of the first harmonic (rad), in (−π, π].
    pub fn phase(&self) -> f64 {
        libm::atan2(self.first[1], self.first[0])
    }
}

/// A unit of columns. A model may declare further units.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    /// Symbol of the unit, such as `mN`.
    pub name: &'static str,
    /// Last part of column names, such as `mn`.
    pub suffix: &'static str,
    /// Factor that converts a value in the SI unit to this unit.
    pub factor: f64,
}

impl Unit {
    /// Degrees, for angles (rad).
    pub const DEG: Unit = Unit { name: "deg", suffix: "deg", factor: DEGREES };
    /// Millinewtons, for forces (N).
    pub const MN: Unit = Unit { name: "mN", suffix: "mn", factor: 1e3 };
    /// Milliwatts, for powers (W).
    pub const MW: Unit = Unit { name: "mW", suffix: "mw", factor: 1e3 };
    /// Milliamperes, for currents (A).
    pub const MA: Unit = Unit { name: "mA", suffix: "ma", factor: 1e3 };
    /// Micrometres, for lengths (m).
    pub const UM: Unit = Unit { name: "um", suffix: "um", factor: 1e6 };
}

/// Degrees per radian.
pub(super) const DEGREES: f64 = 180.0 / core::f64::consts::PI;

/// Standard gravity (m/s²), which is the number of newtons per kilogram-force.
pub(crate) const GRAVITY: f64 = 9.80665;
