//! Units of the models' columns.

/// A unit of columns.
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
