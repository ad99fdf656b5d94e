//! Settings of the integrator and of the search for orbits: defaults and allowed values.

use crate::ode::Tolerances;

/// Settings of the integrator, and the conditions for a settled point.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a setting of its own")]
pub struct SolverSettings {
    /// Relative tolerance of the integrator, per step and component.
    pub rtol: f64,
    /// Absolute tolerance, in units of each state's typical size in the model.
    pub atol: f64,
    /// Largest change of the state per drive period of a settled motion, in units of each state's typical size.
    pub settle_tol: f64,
    /// Number of drive periods after which a point counts as unsettled.
    pub max_cycles: u32,
    /// Largest number of integration steps within one drive period.
    pub max_steps: u32,
    /// Largest [`error_estimate`](super::Row::error_estimate) and energy audit of a row.
    ///
    /// A point whose row exceeds the accuracy is integrated again with tighter tolerances, up to a limit.
    pub accuracy: f64,
    /// True to use Newton's iteration on the period map to find the orbit that a motion approaches.
    ///
    /// If false, points settle by marching, to the same orbits in more periods. Newton's iteration then only improves
    /// the settled orbit.
    pub newton: bool,
    /// True to begin Newton's iteration at looser tolerances.
    pub progressive: bool,
    /// True to find and measure the orbits of symmetric points over half periods.
    pub symmetry: bool,
    /// True to append the mean load of the air at the wing's shoulder (N and N·m) to the measures of rows.
    ///
    /// For the load see [`Load::at_shoulder`](crate::model::Load::at_shoulder). Vehicles use it; grid files cannot
    /// set it.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub loads: bool,
}

impl SolverSettings {
    /// The default settings.
    pub const DEFAULT: SolverSettings = SolverSettings {
        rtol: 1e-6,
        atol: 1e-8,
        settle_tol: 1e-6,
        max_cycles: 1000,
        max_steps: 20_000,
        accuracy: 1e-3,
        newton: true,
        progressive: true,
        symmetry: true,
        loads: false,
    };

    /// The settings by name, for grid files, the command line and Python.
    ///
    /// Apply values in this order: `rtol` comes first and changes the settings that follow it.
    pub const TABLE: &'static [Setting] = &[
        Setting::new(
            "rtol",
            number(0.1, |s| s.rtol, |s, rtol| *s = s.with_rtol(rtol)),
            "largest relative error of one integration step",
        ),
        Setting::new(
            "atol",
            number(f64::INFINITY, |s| s.atol, |s, atol| s.atol = atol),
            "largest absolute error of one integration step, in units of each state's typical size",
        )
        .following("rtol / 100"),
        Setting::new(
            "settle_tol",
            number(f64::INFINITY, |s| s.settle_tol, |s, settle_tol| s.settle_tol = settle_tol),
            "largest change of the state per drive period of a settled motion, in units of each state's typical size",
        ),
        Setting::new(
            "max_cycles",
            SettingKind::Count { get: |s| s.max_cycles, set: |s, max_cycles| s.max_cycles = max_cycles },
            "number of drive periods after which a motion that has not settled counts as unsettled",
        ),
        Setting::new(
            "max_steps",
            SettingKind::Count { get: |s| s.max_steps, set: |s, max_steps| s.max_steps = max_steps },
            "largest number of integration steps in one drive period",
        ),
        Setting::new(
            "accuracy",
            number(f64::INFINITY, |s| s.accuracy, |s, accuracy| s.accuracy = accuracy),
            "largest error_estimate and energy audit of a row; a point whose row exceeds the accuracy is integrated \
            again with tighter tolerances",
        )
        .following("1000 rtol, but at least 1e-3"),
        Setting::new(
            "newton",
            SettingKind::Flag { get: |s| s.newton, set: |s, newton| s.newton = newton },
            "true to find orbits by Newton's iteration; if false, flap integrates periods until the motion settles",
        ),
        Setting::new(
            "progressive",
            SettingKind::Flag { get: |s| s.progressive, set: |s, progressive| s.progressive = progressive },
            "true to begin the search for an orbit at looser tolerances; if false, the whole search is at rtol",
        ),
        Setting::new(
            "symmetry",
            SettingKind::Flag { get: |s| s.symmetry, set: |s, symmetry| s.symmetry = symmetry },
            "true to integrate half of a period if the second half of the orbit mirrors the first; if false, flap always \
             integrates whole periods",
        ),
    ];

    /// Returns these settings with another relative tolerance, and with the settings that follow it by default.
    ///
    /// These are `atol`, a hundredth of `rtol`, and `accuracy`, 1,000 times `rtol` but at least 1e-3.
    pub fn with_rtol(self, rtol: f64) -> SolverSettings {
        SolverSettings { rtol, atol: rtol / 100.0, accuracy: (1000.0 * rtol).max(1e-3), ..self }
    }

    /// Returns the tolerances and limits of the integrator.
    pub(crate) fn tolerances(&self) -> Tolerances {
        Tolerances { rtol: self.rtol, atol: self.atol, max_steps: self.max_steps }
    }
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings::DEFAULT
    }
}

/// One of the [`SolverSettings`]. Its default is its value in [`SolverSettings::DEFAULT`].
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Name in grid files, on the command line and in Python.
    pub name: &'static str,
    /// Allowed values, and access to the setting.
    pub kind: SettingKind,
    /// Default in words, if it depends on another setting.
    pub follows: Option<&'static str>,
    /// Description in one line.
    pub doc: &'static str,
}

impl Setting {
    const fn new(name: &'static str, kind: SettingKind, doc: &'static str) -> Setting {
        Setting { name, kind, follows: None, doc }
    }

    /// Returns the setting with a default that follows another setting, as described by `follows`.
    const fn following(self, follows: &'static str) -> Setting {
        Setting { follows: Some(follows), ..self }
    }
}

/// Returns the kind of a number that is more than zero and less than `below`.
const fn number(
    below: f64,
    get: fn(&SolverSettings) -> f64,
    set: fn(&mut SolverSettings, f64),
) -> SettingKind {
    SettingKind::Number { below, get, set }
}

/// Allowed values of a setting, with the functions that read and write it.
#[derive(Clone, Copy, Debug)]
pub enum SettingKind {
    /// A number more than zero and less than `below`.
    Number {
        /// Upper limit; infinite if any finite number more than zero is allowed.
        below: f64,
        /// Reads the setting.
        get: fn(&SolverSettings) -> f64,
        /// Writes the setting, and the settings that follow it.
        set: fn(&mut SolverSettings, f64),
    },
    /// A whole number, 1 or more.
    Count {
        /// Reads the setting.
        get: fn(&SolverSettings) -> u32,
        /// Writes the setting.
        set: fn(&mut SolverSettings, u32),
    },
    /// True or false.
    Flag {
        /// Reads the setting.
        get: fn(&SolverSettings) -> bool,
        /// Writes the setting.
        set: fn(&mut SolverSettings, bool),
    },
}
