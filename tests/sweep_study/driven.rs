//! The peaks of the settled stroke of one design.

use flap_core::num::Backend;
use flap_core::parameter::Invalid;
use flap_core::simulate::{PointRun, Simulator, SolverSettings, Status, Unfinished, preset};
use flap_sweep::resonance::Range;
use flap_sweep::resonance::driven::{self, DrivenPeaks};

/// The peaks of a design without values that depend on the drive frequency.
fn search(
    model: &'static dyn Simulator,
    run: &PointRun<'_>,
    range: &Range,
) -> Result<DrivenPeaks, Unfinished> {
    driven::search(model, run, range, |_| None)
}

/// The values of a preset with the values of `set`.
fn values(name: &str, set: &[(&str, f64)]) -> Vec<f64> {
    let (model, preset) = preset(name).expect("a preset");
    let mut values = (preset.values)();
    for (name, value) in set {
        let index = model.parameters().iter().position(|parameter| parameter.name == *name);
        let index = index.expect("a parameter");
        values[index] = *value;
    }
    values
}

fn assert_near(actual: f64, expected: f64, distance: f64, what: &str) {
    assert!((actual - expected).abs() <= distance, "{what}: {actual} is not {expected}");
}

fn driven(name: &str, set: &[(&str, f64)], from: f64, to: f64) -> DrivenPeaks {
    let (model, _) = preset(name).expect("a preset");
    let range = Range { from: Some(from), to: Some(to), tolerance: 0.05, ..Range::default() };
    let found = search(
        model,
        &PointRun::new(Backend::best(), &SolverSettings::default(), &values(name, set)),
        &range,
    );
    found.expect("a range")
}

#[test]
fn driven_peaks_are_where_the_reference_has_them() {
    for (name, volts, [from, to], expected) in [
        ("ozaki2018-small", 30.0, [150.0, 250.0], 196.1),
        ("ozaki2018-large", 50.0, [60.0, 160.0], 110.7),
        ("jafferis2016", 160.0, [60.0, 260.0], 128.0),
    ] {
        let volts = if name.starts_with("ozaki") { 2.0 * volts } else { volts };
        let found = driven(name, &[("drive_voltage_pp", volts)], from, to);
        assert_near(found.peaks[0].frequency, expected, 0.5, name);
        assert_eq!(found.larger_at, None);
    }
    let found = driven("arabagi2013-75hz", &[], 39.0, 194.0);
    assert_near(found.peaks[0].frequency, 75.0, 0.5, "first peak");
    assert_near(found.peaks[0].stroke_pp, 35.5, 0.05, "its stroke");
    assert_near(found.peaks[1].frequency, 116.0, 0.5, "second peak");
    assert_near(found.peaks[1].stroke_pp, 24.3, 0.05, "its stroke");
    let found = driven("arabagi2013-30hz", &[], 15.0, 80.0);
    assert_near(found.peaks[0].frequency, 30.0, 0.5, "only peak");
    assert_eq!(found.peaks.len(), 1);
}

#[test]
fn motions_that_do_not_settle_are_named() {
    // A soft hinge, which flutters: at 240 V there is no motion of the drive's period from 64.5 to 80 Hz.
    let (model, _) = preset("jafferis2016").unwrap();
    let values = values("jafferis2016", &[("hinge_stiffness", 0.7486e-6), ("drive_voltage_pp", 240.0)]);
    let range = Range { from: Some(55.0), to: Some(95.0), tolerance: 0.5, ..Range::default() };
    let solver = SolverSettings { max_cycles: 100, settle_tol: 1e-4, ..SolverSettings::default() };
    let found = search(model, &PointRun::new(Backend::best(), &solver, &values), &range).unwrap();
    let unsettled: usize = found.gaps.iter().map(|gap| gap.points).sum();
    println!("{found:?}");
    assert!(unsettled > 0 && unsettled < found.points, "{found:?}");
    assert!(found.gaps.iter().any(|gap| gap.status == Status::Unsettled));
    for gap in &found.gaps {
        assert_ne!(gap.status, Status::Periodic);
        assert!(gap.from <= gap.to && gap.from >= 60.0 && gap.to <= 85.0, "{gap:?}");
    }
}

/// A voltage that rises with the frequency moves the peak; frequencies without a possible voltage are a gap.
#[test]
fn values_that_depend_on_the_frequency_are_updated() {
    let (model, _) = preset("ozaki2018-large").unwrap();
    let index = |name: &str| model.parameters().iter().position(|known| known.name == name).unwrap();
    let (frequency, voltage) = (index("drive_frequency"), index("drive_voltage_pp"));
    let range = Range { from: Some(95.0), to: Some(125.0), tolerance: 0.05, ..Range::default() };
    let (values, solver) = (values("ozaki2018-large", &[]), SolverSettings::default());
    let run = PointRun::new(Backend::best(), &solver, &values);
    let constant = search(model, &run, &range).unwrap();
    let update = |values: &mut [f64]| {
        values[voltage] = 80.0 + 4.0 * (values[frequency] - 105.0);
        (values[frequency] < 97.0).then(|| Invalid::new("too slow"))
    };
    let rising = driven::search(model, &run, &range, update).unwrap();
    let peak = rising.peaks[0];
    assert!(peak.frequency > constant.peaks[0].frequency + 0.5, "{peak:?}");
    assert!(rising.gaps[0].status == Status::Invalid && rising.gaps[0].to < 97.0, "{:?}", rising.gaps);
    let mut values = values.clone();
    values[frequency] = peak.frequency;
    assert_eq!(update(&mut values), None);
    let row = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
    let stroke = model.columns().iter().position(|column| column.name == "stroke_pp_deg").unwrap();
    assert!((row.measures[stroke] / peak.stroke_pp - 1.0).abs() < 1e-3, "{peak:?}");
}

#[test]
fn searches_that_mean_nothing_are_refused() {
    let (model, _) = preset("ozaki2018-large").unwrap();
    let values = values("ozaki2018-large", &[]);
    let good = Range { from: Some(100.0), to: Some(120.0), tolerance: 0.5, ..Range::default() };
    for range in [
        Range { from: Some(0.0), ..good },
        Range { to: Some(100.0), ..good },
        Range { to: Some(f64::INFINITY), ..good },
        Range { from: Some(f64::NAN), ..good },
        Range { tolerance: 0.0, ..good },
        Range { tolerance: f64::NAN, ..good },
    ] {
        let refused =
            search(model, &PointRun::new(Backend::best(), &SolverSettings::default(), &values), &range);
        assert!(refused.is_err(), "{range:?}");
    }
}

/// Lanes and scalars have the same peaks, and a peak equals the motion from rest at its frequency.
#[test]
fn a_peak_is_a_motion_from_rest() {
    let (model, _) = preset("arabagi2013-75hz").unwrap();
    let found = driven("arabagi2013-75hz", &[], 60.0, 130.0);
    assert_eq!(found.peaks.len(), 2);
    let place = |name: &str| model.columns().iter().position(|column| column.name == name).unwrap();
    for peak in found.peaks {
        let values = values("arabagi2013-75hz", &[("drive_frequency", peak.frequency)]);
        let row = model.run_point(&PointRun::new(Backend::best(), &SolverSettings::default(), &values), None);
        assert_eq!(peak.stroke_pp, row.measures[place("stroke_pp_deg")]);
        assert_eq!(peak.pitch_pp, row.measures[place("pitch_pp_deg")]);
    }
}

#[test]
fn an_interrupted_search_says_so() {
    let (model, _) = preset("ozaki2018-small").unwrap();
    let range = Range { from: Some(90.0), to: Some(110.0), tolerance: 0.1, ..Range::default() };
    let endless = SolverSettings {
        newton: false,
        max_cycles: 1_000_000_000,
        settle_tol: 1e-300,
        ..SolverSettings::default()
    };
    let values = values("ozaki2018-small", &[]);
    let found = search(model, &PointRun::new(Backend::best(), &endless, &values).until(&|| true), &range);
    assert_eq!(found.err(), Some(Unfinished::Interrupted));
}
