//! The table of solver settings.

use flap_core::simulate::{SettingKind, SolverSettings};

const NAMES: [&str; 9] = [
    "rtol",
    "atol",
    "settle_tol",
    "max_cycles",
    "max_steps",
    "accuracy",
    "newton",
    "progressive",
    "symmetry",
];

/// Settings that all differ from their defaults and do not follow from each other.
const OTHERS: SolverSettings = SolverSettings {
    rtol: 1e-4,
    atol: 2e-5,
    settle_tol: 3e-5,
    max_cycles: 4,
    max_steps: 5,
    accuracy: 6e-2,
    newton: false,
    progressive: false,
    symmetry: false,
    loads: false,
};

#[test]
fn every_setting_is_in_the_table_once() {
    let names: Vec<&str> = SolverSettings::TABLE.iter().map(|setting| setting.name).collect();
    assert_eq!(names, NAMES);
}

#[test]
fn the_table_in_its_order_sets_all() {
    let mut settings = SolverSettings::DEFAULT;
    for setting in SolverSettings::TABLE {
        let before = settings;
        match setting.kind {
            SettingKind::Number { get, set, .. } => set(&mut settings, get(&OTHERS)),
            SettingKind::Count { get, set } => set(&mut settings, get(&OTHERS)),
            SettingKind::Flag { get, set } => set(&mut settings, get(&OTHERS)),
        }
        assert_ne!(settings, before, "{}", setting.name);
    }
    assert_eq!(settings, OTHERS);
}

#[test]
fn settings_follow_rtol_as_the_table_says() {
    let followers: Vec<&str> = SolverSettings::TABLE
        .iter()
        .filter(|setting| setting.follows.is_some())
        .map(|one| one.name)
        .collect();
    assert_eq!(followers, ["atol", "accuracy"]);
    let settings = SolverSettings::DEFAULT.with_rtol(1e-4);
    assert_eq!((settings.atol, settings.accuracy), (1e-6, 0.1));
    assert_eq!(SolverSettings::DEFAULT.with_rtol(1e-6), SolverSettings::DEFAULT);
}

#[test]
fn defaults_are_allowed() {
    for setting in SolverSettings::TABLE {
        match setting.kind {
            SettingKind::Number { below, get, .. } => {
                let default = get(&SolverSettings::DEFAULT);
                assert!(default > 0.0 && default < below, "{}", setting.name);
            }
            SettingKind::Count { get, .. } => assert!(get(&SolverSettings::DEFAULT) >= 1, "{}", setting.name),
            SettingKind::Flag { .. } => {}
        }
    }
}
