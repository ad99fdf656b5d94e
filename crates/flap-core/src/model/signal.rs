//! Signals of a model, and their measures over a drive period.

/// A quantity followed along the motion.
#[derive(Clone, Copy, Debug)]
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
    /// The measure whose error counts for the error of a row, if there is one. A model has at least one such signal.
    pub principal: Option<Principal>,
    /// Measures of a force that rows of a vehicle have of each wing.
    pub of_wings: &'static [Measure],
}

/// The way in which the rows of a vehicle have a column of its wings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverWings {
    /// The sum over the wings.
    Sum,
    /// A column of each wing.
    Each,
    /// No column.
    Omitted,
}

impl Signal {
    /// A signal of which all `measures` are taken over a drive period.
    pub const fn new(
        name: &'static str,
        unit: Unit,
        doc: &'static str,
        measures: &'static [Measure],
    ) -> Signal {
        Signal { name, unit, doc, measures, needed: &[], principal: None, of_wings: &[] }
    }

    /// The way in which the rows of a vehicle have a measure of this signal.
    ///
    /// Mean powers add up. The extrema and the root mean square of a sum depend on the times at which the wings have theirs,
    /// so rows have them of each wing. Vehicles have columns of their own for forces.
    pub(crate) fn over_wings(&self, measure: Measure) -> OverWings {
        match (self.unit.name, measure) {
            _ if self.of_wings.contains(&measure) => OverWings::Each,
            (name, Measure::Mean | Measure::Supply) if name == Unit::MW.name => OverWings::Sum,
            (name, _) if name == Unit::MN.name => OverWings::Omitted,
            _ => OverWings::Each,
        }
    }

    /// The name of its column in a trajectory.
    pub fn column(&self) -> String {
        if self.unit.suffix.is_empty() {
            self.name.to_owned()
        } else {
            format!("{}_{}", self.name, self.unit.suffix)
        }
    }

    /// True if it has columns of its own.
    pub(crate) fn is_shown(&self) -> bool {
        !self.measures.is_empty()
    }

    /// The quantities that the measures of the signal and the error of a row require.
    pub const fn taken(&self) -> Taken {
        let Signal { measures, needed, principal, .. } = *self;
        let mut taken = Taken::of(measures).and(Taken::of(needed));
        if let Some(principal) = principal {
            taken = taken.and(Taken::of(&[principal.measure()]));
            // The error is relative to the size of the signal: its root mean square, if its range is not known.
            taken.squared |= !taken.ranged;
        }
        taken
    }
}

/// Quantities of a signal that are integrated or searched for over a drive period, besides the mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is independent of the others")]
pub struct Taken {
    /// The mean square.
    pub squared: bool,
    /// The mean of the positive part.
    pub rectified: bool,
    /// The first harmonic.
    pub harmonic: bool,
    /// The largest and the smallest value.
    pub ranged: bool,
}

impl Taken {
    /// The quantities that the `measures` require. The sign of a positive part requires the range.
    const fn of(measures: &[Measure]) -> Taken {
        let mut taken = Taken { squared: false, rectified: false, harmonic: false, ranged: false };
        let mut i = 0;
        while i < measures.len() {
            let measure = measures[i];
            taken.squared |= matches!(measure, Measure::Rms);
            taken.rectified |= matches!(measure, Measure::Supply | Measure::Magnitude);
            taken.harmonic |= matches!(measure, Measure::First);
            taken.ranged |= !matches!(measure, Measure::Mean | Measure::Rms);
            i += 1;
        }
        taken
    }

    /// The quantities of both.
    const fn and(self, other: Taken) -> Taken {
        Taken {
            squared: self.squared | other.squared,
            rectified: self.rectified | other.rectified,
            harmonic: self.harmonic | other.harmonic,
            ranged: self.ranged | other.ranged,
        }
    }
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

    /// In words, to be followed by the signal's description.
    pub(crate) fn describe(self) -> &'static str {
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
    /// Replaces the mean of this power by the sum of the means of its `losses`. A mean that is not a number stays so.
    ///
    /// Both means are equal over a periodic orbit, since capacitance, springs and inertia give back all energy. In a motion
    /// of small losses, or far from resonance, the error of the quadrature of that exchange may exceed the mean of the power.
    pub fn balance(&mut self, losses: &[SignalCycle]) {
        if !self.mean.is_nan() {
            self.mean = losses.iter().map(|loss| loss.mean).sum();
        }
    }

    /// The relative difference of another signal's mean from this one's.
    pub fn audit(&self, other: &SignalCycle) -> f64 {
        (other.mean - self.mean) / self.mean
    }

    /// The size of the signal: the largest magnitude of what is known of it.
    pub(crate) fn size(&self) -> f64 {
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

/// A unit of columns. Besides the constants below, a model may declare its own.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    /// Its name in words, such as `mN`.
    pub name: &'static str,
    /// Its name as the last part of column names, such as `mn`.
    pub suffix: &'static str,
    /// Factor from the SI unit.
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

/// Standard gravity (m/s²): newtons per kilogram-force.
pub(crate) const GRAVITY: f64 = 9.80665;
