//! Signals of a model, and their measures over a drive period.

/// A signal of a model: a quantity as a function of time.
#[derive(Clone, Copy, Debug)]
pub struct Signal {
    /// Name of the signal, with which the names of the signal's columns begin.
    pub name: &'static str,
    /// Unit of the columns of the signal.
    pub unit: Unit,
    /// Description of the signal. The description of a column consists of words such as "mean" and the
    /// description of the signal.
    pub doc: &'static str,
    /// Measures of the signal over a drive period. Each measure is a column of the results. A signal without
    /// measures is used only in derived columns and has no column in trajectories.
    pub measures: &'static [Measure],
    /// Measures of the signal that have no columns, but are needed to compute derived columns.
    pub needed: &'static [Measure],
    /// The measure whose integration error contributes to the error estimate of a row. The value is `None` if
    /// the signal does not contribute to the error estimate. In each model, at least one signal contributes
    /// to the error estimate.
    pub principal: Option<Principal>,
    /// For a force: measures that have one column per wing in the rows of a vehicle.
    pub of_wings: &'static [Measure],
}

/// The columns that replace a column of a single wing in the rows of a vehicle.
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
    /// Returns a signal with the given `measures` over a drive period.
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
    /// For a mean power, the row of a vehicle contains the sum over all wings. The extrema and the root mean
    /// square of a sum over the wings depend on the phase differences between the wings. For extrema and root
    /// mean squares, the row therefore contains one column per wing. The row of a vehicle omits the forces of
    /// single wings, because the row contains the force on the whole vehicle.
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

    /// Returns true if the results contain columns for the signal.
    pub(crate) fn is_shown(&self) -> bool {
        !self.measures.is_empty()
    }

    /// Returns the quantities of the signal that the measures of the signal and the error estimate of a row
    /// require.
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
    /// The mean of the positive part of the signal.
    pub rectified: bool,
    /// The first harmonic.
    pub harmonic: bool,
    /// The largest and the smallest value of the signal.
    pub ranged: bool,
}

impl Statistics {
    /// Returns the quantities that the `measures` require. All measures except the mean and the root mean
    /// square also require the largest and the smallest value of the signal.
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

    /// Returns the quantities that are in `self` or in `other`.
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
/// For the error estimate, flap integrates again with larger tolerances. The second integration computes only
/// means and first harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Principal {
    /// Mean.
    Mean,
    /// Amplitude of the first harmonic of the signal.
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
    /// Half of the difference between the largest and the smallest value of the signal.
    Amplitude,
    /// Largest minus smallest value.
    PeakToPeak,
    /// Mean.
    Mean,
    /// Largest value.
    Max,
    /// Smallest value.
    Min,
    /// Amplitude of the first harmonic of the signal.
    First,
    /// Root mean square.
    Rms,
    /// Largest magnitude.
    Peak,
    /// Mean of the positive part of the signal.
    Supply,
    /// Mean magnitude.
    Magnitude,
}

impl Measure {
    /// Returns the name of the measure, for example `mean` in the column name `lift_mean_mn`.
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

    /// Returns the words with which the description of a column of this measure begins, such as "mean".
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

/// Quantities of a signal over one drive period, in SI units. flap computes the measures of the signal from
/// the quantities in this struct. Quantities that no measure requires are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalCycle {
    /// Mean.
    pub mean: f64,
    /// Mean of the square.
    pub mean_square: f64,
    /// Mean of the positive part of the signal.
    pub positive_mean: f64,
    /// Real and imaginary part of the amplitude X, where Re(X e^{iωt}) is the first harmonic of the signal.
    /// The time t is zero when the sine of the drive rises through zero.
    pub first: [f64; 2],
    /// Largest value.
    pub max: f64,
    /// Smallest value.
    pub min: f64,
}

impl SignalCycle {
    /// Sets the mean of a signal that is a power to the sum of the mean `losses`. If the mean power is NaN,
    /// the function does nothing.
    ///
    /// In a periodic orbit, the mean power equals the sum of the mean losses, because capacitance, springs
    /// and inertia return all stored energy. If the losses are small or the motion is far from resonance,
    /// most of the power is stored and returned. The quadrature error of the stored and returned power can
    /// exceed the mean power.
    pub fn balance(&mut self, losses: &[SignalCycle]) {
        if !self.mean.is_nan() {
            self.mean = losses.iter().map(|loss| loss.mean).sum();
        }
    }

    /// Returns the difference between the means of `other` and this signal, divided by the mean of this
    /// signal.
    pub fn audit(&self, other: &SignalCycle) -> f64 {
        (other.mean - self.mean) / self.mean
    }

    /// Returns the largest magnitude among the mean, the extrema, the mean of the positive part and the root
    /// mean square. Quantities that are NaN are ignored.
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

/// A unit of columns. A model may also declare units that are not among the constants of `Unit`.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    /// Symbol of the unit, such as `mN`.
    pub name: &'static str,
    /// Abbreviation of the unit at the end of column names, such as `mn`.
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
