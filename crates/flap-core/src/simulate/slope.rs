//! A change of a point, and the derivative of a measure along it, or the reason why there is none.

/// The share by which the two halves of a difference may differ. They differ by far less where a measure is smooth.
const SMOOTH: f64 = 1e-3;

/// The part of a measure that rounding may change.
const ROUNDING: f64 = 1e-13;

/// A quantity to which derivatives are taken: the point's values with more and with less of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// One value per parameter, with the quantity larger by `size`.
    pub ahead: Vec<f64>,
    /// The same, smaller by `size`; or the values of the point itself, for a one-sided difference where less is impossible.
    pub behind: Vec<f64>,
    /// The size of the change: [`Change::SHARE`] of the quantity, in whatever unit derivatives are to have.
    pub size: f64,
}

impl Change {
    /// The share of a quantity by which it is best changed: its square is negligible, and it stands above rounding.
    pub const SHARE: f64 = 1e-8;

    /// True if it changes nothing. NaN stands for a parameter that follows others.
    pub(crate) fn is_none(&self) -> bool {
        let mut both = self.ahead.iter().zip(&self.behind);
        both.all(|(ahead, behind)| ahead.total_cmp(behind).is_eq())
    }
}

/// The reason why a derivative is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoSlope {
    /// The orbit is too near to a fold, where it would change without bounds.
    Fold,
    /// The motion slides along its switching surface, or touches it.
    Sliding,
    /// A parameter is at an end of its range, or the changed point is impossible.
    Edge,
    /// The quantity is zero, so that a share of it changes nothing.
    Zero,
    /// The period cannot be integrated with tighter tolerances, within the limits on steps.
    Lost,
    /// The measure has a kink: its derivatives to both sides differ, or it cannot be told.
    Kink,
    /// The measure itself is not known.
    Missing,
}

impl NoSlope {
    /// All reasons.
    pub const ALL: [NoSlope; 7] = [
        NoSlope::Fold,
        NoSlope::Sliding,
        NoSlope::Edge,
        NoSlope::Zero,
        NoSlope::Lost,
        NoSlope::Kink,
        NoSlope::Missing,
    ];

    /// The word for it in rows.
    pub fn name(self) -> &'static str {
        match self {
            NoSlope::Fold => "fold",
            NoSlope::Sliding => "sliding",
            NoSlope::Edge => "edge",
            NoSlope::Zero => "zero",
            NoSlope::Lost => "lost",
            NoSlope::Kink => "kink",
            NoSlope::Missing => "missing",
        }
    }
}

/// The changes of a measure behind and ahead of a point.
#[derive(Clone, Copy)]
pub(super) struct Halves {
    backward: f64,
    forward: f64,
}

impl Halves {
    pub(super) fn of([behind, here, ahead]: [f64; 3]) -> Halves {
        Halves { backward: here - behind, forward: ahead - here }
    }

    /// True if both are known, and differ by no more than a share of them and `tolerance`.
    fn agree(self, tolerance: f64) -> bool {
        let Halves { backward, forward } = self;
        (forward - backward).abs() <= SMOOTH * forward.abs().max(backward.abs()) + tolerance
    }

    /// The derivative of a measure of some size.
    pub(super) fn slope(self, of: f64, size: f64) -> Result<f64, NoSlope> {
        let known = self.agree(ROUNDING * of);
        if known { Ok((self.backward + self.forward) / (2.0 * size)) } else { Err(NoSlope::Kink) }
    }

    /// True if a measure of some size, of extrema that were made equal, has a kink: its derivatives to both sides differ by more
    /// than their `error`, per relative change and as a share of the measure.
    pub(super) fn has_corner(self, of: f64, error: f64) -> bool {
        !self.agree((error * Change::SHARE + ROUNDING) * of)
    }
}

/// The derivative of a measure from its values at and ahead of a point.
pub(super) fn forward(here: f64, ahead: f64, size: f64) -> Result<f64, NoSlope> {
    if ahead.is_nan() { Err(NoSlope::Kink) } else { Ok((ahead - here) / size) }
}
