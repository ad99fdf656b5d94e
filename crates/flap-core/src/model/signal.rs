//! What is measured of a model, and which columns come of it.

/// A quantity followed along the motion.
#[derive(Debug)]
pub struct Signal {
    /// Name, the first part of its column names.
    pub name: &'static str,
    /// Unit of its columns in words, such as `mN`.
    pub unit: &'static str,
    /// The unit as the last part of column names, such as `mn`.
    pub suffix: &'static str,
    /// Factor from SI to `unit`.
    pub factor: f64,
    /// What it is, to follow words such as "mean of".
    pub doc: &'static str,
    /// What is measured of it over a drive period. A signal without measures serves derived columns alone, and has
    /// no column in trajectories either.
    pub measures: &'static [Measure],
}

impl Signal {
    /// Whether it has columns of its own.
    pub fn is_shown(&self) -> bool {
        !self.measures.is_empty()
    }
}

/// A column computed from several signals.
#[derive(Debug)]
pub struct Derived {
    /// Column name.
    pub name: &'static str,
    /// Unit in words.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: &'static str,
}

/// What is measured of a signal over one drive period.
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

/// A signal over one drive period, in SI units.
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
    /// How far another way to the mean is from it, relative to it: zero but for the integration's error.
    pub fn audit(&self, other_way: &SignalCycle) -> f64 {
        (other_way.mean - self.mean) / self.mean
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
