//! Settings of the integrator and of the search for orbits, with their defaults and allowed values.

use crate::ode::Tolerances;

/// Settings of the integrator, and the conditions under which a point counts as settled.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a setting of its own")]
pub struct SolverSettings {
    /// Relative tolerance of the integrator, per step and component.
    pub rtol: f64,
    /// Absolute tolerance, in units of each state's typical size in the model.
    pub atol: f64,
    /// A point is settled when its state, strobed once per drive period, changes by less than this
    /// (in units of each state's typical size).
    pub settle_tol: f64,
    /// Drive periods after which a point counts as unsettled.
    pub max_cycles: u32,
    /// Integration steps within one drive period after which a point is given up.
    pub max_steps: u32,
    /// Largest [`error_estimate`](super::Row::error_estimate) and energy audit of a row. A point whose row exceeds it is
    /// integrated again with tighter tolerances, up to a limit.
    pub accuracy: f64,
    /// Newton's iteration on the period map looks for the orbit to which a motion is on its way. Without it, points
    /// settle by marching: to the same orbits, in more periods. Newton's iteration then only improves on the settled orbit.
    pub newton: bool,
    /// Newton's iteration begins at looser tolerances.
    pub progressive: bool,
    /// The orbits of symmetric points are searched for and measured over half periods.
    pub symmetry: bool,
    /// Rows have the mean load of the air at the wing's shoulder behind their measures, see
    /// [`Load::at_shoulder`](crate::model::Load::at_shoulder): N and N·m. For vehicles, not for grid files.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub loads: bool,
}

impl SolverSettings {
    /// The defaults.
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

    /// The settings by name. Grid files, the command line and Python accept these names.
    ///
    /// A reader that applies values in this order needs no other rule: `rtol` comes first and moves the settings that
    /// follow it.
    pub const TABLE: &'static [Setting] = &[
        Setting::new(
            "rtol",
            number(0.1, |s| s.rtol, |s, rtol| *s = s.with_rtol(rtol)),
            "relative error per integration step",
        ),
        Setting::new(
            "atol",
            number(f64::INFINITY, |s| s.atol, |s, atol| s.atol = atol),
            "absolute error per integration step, in units of each state's typical size",
        )
        .following("rtol / 100"),
        Setting::new(
            "settle_tol",
            number(f64::INFINITY, |s| s.settle_tol, |s, settle_tol| s.settle_tol = settle_tol),
            "change of the state per drive period, in units of each state's typical size, below which a motion has \
             settled",
        ),
        Setting::new(
            "max_cycles",
            SettingKind::Count { get: |s| s.max_cycles, set: |s, max_cycles| s.max_cycles = max_cycles },
            "drive periods marched after which a motion counts as unsettled",
        ),
        Setting::new(
            "max_steps",
            SettingKind::Count { get: |s| s.max_steps, set: |s, max_steps| s.max_steps = max_steps },
            "integration steps in one drive period after which a point is given up",
        ),
        Setting::new(
            "accuracy",
            number(f64::INFINITY, |s| s.accuracy, |s, accuracy| s.accuracy = accuracy),
            "largest error_estimate and energy audit of a row; a point whose row exceeds it is integrated again with \
             tighter tolerances",
        )
        .following("1000 rtol, but at least 1e-3"),
        Setting::new(
            "newton",
            SettingKind::Flag { get: |s| s.newton, set: |s, newton| s.newton = newton },
            "Newton's iteration looks for orbits; without it points settle by marching alone",
        ),
        Setting::new(
            "progressive",
            SettingKind::Flag { get: |s| s.progressive, set: |s, progressive| s.progressive = progressive },
            "the search for an orbit begins at looser tolerances and ends at rtol; without it the whole search is at rtol",
        ),
        Setting::new(
            "symmetry",
            SettingKind::Flag { get: |s| s.symmetry, set: |s, symmetry| s.symmetry = symmetry },
            "orbits whose second half mirrors the first are found and measured over half periods; without it all periods \
             are whole",
        ),
    ];

    /// These settings with another relative tolerance, and with the settings that follow it by default: `atol`, a
    /// hundredth of it, and `accuracy`, a thousand times as much but at least 1e-3.
    pub fn with_rtol(self, rtol: f64) -> SolverSettings {
        SolverSettings { rtol, atol: rtol / 100.0, accuracy: (1000.0 * rtol).max(1e-3), ..self }
    }

    /// The tolerances and limits of the integrator.
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
    /// Values that it takes, and access to it.
    pub kind: SettingKind,
    /// In words: the default where another setting is given that this one follows.
    pub follows: Option<&'static str>,
    /// One line of meaning.
    pub doc: &'static str,
}

impl Setting {
    const fn new(name: &'static str, kind: SettingKind, doc: &'static str) -> Setting {
        Setting { name, kind, follows: None, doc }
    }

    /// The setting, whose default follows another one as these words say.
    const fn following(self, follows: &'static str) -> Setting {
        Setting { follows: Some(follows), ..self }
    }
}

/// A number more than zero and less than `below`.
const fn number(
    below: f64,
    get: fn(&SolverSettings) -> f64,
    set: fn(&mut SolverSettings, f64),
) -> SettingKind {
    SettingKind::Number { below, get, set }
}

/// Values that a setting takes, with the functions that read and write it.
#[derive(Clone, Copy, Debug)]
pub enum SettingKind {
    /// A number more than zero and less than `below`.
    Number {
        /// The limit; infinite where any finite number more than zero is allowed.
        below: f64,
        /// Reads the setting.
        get: fn(&SolverSettings) -> f64,
        /// Writes the setting, and the settings that follow it.
        set: fn(&mut SolverSettings, f64),
    },
    /// A whole number from 1 on.
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
