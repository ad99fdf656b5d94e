//! Settings of the integrator and of the search for orbits: defaults and allowed values.

use crate::ode::Tolerances;

/// Settings of the integrator and of the search for a settled motion.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a setting of its own")]
pub struct SolverSettings {
    /// Relative tolerance of one integration step, for each component of the state.
    pub rtol: f64,
    /// Absolute tolerance of one integration step, in units of each state's typical size.
    pub atol: f64,
    /// A motion has settled if its state changes by at most this amount per drive period, in units of each
    /// state's typical size.
    pub settle_tol: f64,
    /// Number of drive periods after which a motion that has not settled counts as unsettled.
    pub max_cycles: u32,
    /// Largest number of integration steps within one drive period.
    pub max_steps: u32,
    /// Largest allowed [`error_estimate`](super::Row::error_estimate) and energy audit of a row.
    ///
    /// If the error estimate or the energy audit of a row exceeds `accuracy`, flap computes the row again
    /// with smaller tolerances. flap computes a row again only a few times.
    pub accuracy: f64,
    /// True to use Newton's iteration on the period map to find the orbit that a motion approaches.
    ///
    /// If false, flap integrates drive periods until the motion has settled, which leads to the same orbit
    /// but needs more periods. If false, Newton's iteration only improves the orbit of the settled motion.
    pub newton: bool,
    /// True to begin the search for an orbit with larger tolerances than `rtol` and `atol`.
    pub progressive: bool,
    /// True to integrate only half of a period if the second half of the orbit mirrors the first half.
    pub symmetry: bool,
    /// True to append the mean load of the air at the wing's shoulder (N and N·m) to the measures of rows.
    ///
    /// For the load see [`Load::at_shoulder`](crate::model::Load::at_shoulder). Vehicles use this setting,
    /// and grid files cannot change it.
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

    /// The settings that grid files, the command line and Python can change, with their names.
    ///
    /// Change the settings in the order of this table: a change of `rtol`, the first setting, also changes
    /// `atol` and `accuracy`.
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

    /// Returns a copy of these settings with the relative tolerance `rtol`, and with the default `atol` and
    /// `accuracy` for this `rtol`.
    ///
    /// The default `atol` is a hundredth of `rtol`. The default `accuracy` is 1,000 times `rtol`, but at
    /// least 1e-3.
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

/// The description of one setting of [`SolverSettings`]. The default of a setting is its value in
/// [`SolverSettings::DEFAULT`].
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Name of the setting in grid files, on the command line and in Python.
    pub name: &'static str,
    /// Allowed values of the setting, and functions that read and change the setting.
    pub kind: SettingKind,
    /// Formula of the default value, if the default value depends on another setting.
    pub follows: Option<&'static str>,
    /// Description in one line.
    pub doc: &'static str,
}

impl Setting {
    const fn new(name: &'static str, kind: SettingKind, doc: &'static str) -> Setting {
        Setting { name, kind, follows: None, doc }
    }

    /// Returns a setting whose default depends on another setting. `follows` is the formula of the default.
    const fn following(self, follows: &'static str) -> Setting {
        Setting { follows: Some(follows), ..self }
    }
}

/// Returns the [`SettingKind`] of a setting whose value is more than zero and less than `below`.
const fn number(
    below: f64,
    get: fn(&SolverSettings) -> f64,
    set: fn(&mut SolverSettings, f64),
) -> SettingKind {
    SettingKind::Number { below, get, set }
}

/// Allowed values of a setting, with the functions that read and change the setting.
#[derive(Clone, Copy, Debug)]
pub enum SettingKind {
    /// A number more than zero and less than `below`.
    Number {
        /// Upper limit of the number. The limit is infinite if all finite numbers more than zero are allowed.
        below: f64,
        /// Reads the setting.
        get: fn(&SolverSettings) -> f64,
        /// Changes the setting, and the settings whose defaults depend on it.
        set: fn(&mut SolverSettings, f64),
    },
    /// A whole number, 1 or more.
    Count {
        /// Reads the setting.
        get: fn(&SolverSettings) -> u32,
        /// Changes the setting.
        set: fn(&mut SolverSettings, u32),
    },
    /// True or false.
    Flag {
        /// Reads the setting.
        get: fn(&SolverSettings) -> bool,
        /// Changes the setting.
        set: fn(&mut SolverSettings, bool),
    },
}
