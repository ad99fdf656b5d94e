//! Free motions after an impulse.

use std::f64::consts::TAU;

use flap_core::drive::Wave;
use flap_core::model::ExperimentModel;
use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::DirectDrive;
use flap_core::model::four_bar::FourBar;
use flap_core::num::Backend;
use flap_core::ode::Ode;
use flap_core::simulate::{ImpulseRequest, PointRun, SolverSettings, all, by_name};

use crate::bimorph::plates_under;
use crate::by_name::design;
use crate::probe::modes;

fn assert_near(actual: f64, expected: f64, distance: f64, what: &str) {
    assert!((actual - expected).abs() <= distance, "{what}: {actual} is not {expected}");
}

/// The state after an impulse, and the derivative at rest with a constant drive.
fn released<M: ExperimentModel<4>>(model: &M, values: &[f64]) -> (M::Constants<f64>, [f64; 4], [f64; 4]) {
    let start = model.start(values).unwrap();
    let (still, c, y) = model.variant(values).released(&start.constants, 2.0);
    // At any time: the drive does not change.
    let rest = still.rhs(&c, &still.input(&c, 0.123), 1.0, &[0.0; 4]);
    (c, y, rest)
}

/// An impulse is the limit of a short and strong torque. The rates after the impulse therefore have the ratio of the
/// accelerations with which a drive moves the resting wing. After the impulse no drive moves the wing.
#[test]
fn an_impulse_moves_the_pitch_as_a_drive_does() {
    for model in all() {
        for preset in model.presets() {
            let values = (preset.values)();
            let volts = |value| Wave::with_rate(value, 0.0);
            let (y, rest, driven) = match model.name() {
                "direct-drive" => {
                    let (c, y, rest) = released(&DirectDrive::SINE, &values);
                    (y, rest, DirectDrive::SINE.rhs(&c, &volts(30.0), 1.0, &[0.0; 4]))
                }
                "four-bar" => {
                    let (c, y, rest) = released(&FourBar::SINE, &values);
                    let drive = volts(c.actuator.rest_voltage + 30.0);
                    (y, rest, FourBar::SINE.rhs(&c, &drive, 1.0, &[0.0; 4]))
                }
                "bimorph" => {
                    let (c, y, rest) = released(&Bimorph::SINE, &values);
                    let plates = plates_under(&c, [volts(120.0), volts(80.0)]);
                    (y, rest, Bimorph::SINE.rhs(&c, &plates, 1.0, &[0.0; 4]))
                }
                other => panic!("no derivative of {other}"),
            };
            let rates = if model.name() == "bimorph" { [1, 3] } else { [2, 3] };
            let [stroke, pitch] = rates.map(|i| y[i]);
            let [stroke_driven, pitch_driven] = rates.map(|i| driven[i]);
            assert!(stroke != 0.0 && pitch != 0.0, "{}: {y:?}", preset.name);
            let error = (pitch / stroke) / (pitch_driven / stroke_driven) - 1.0;
            assert!(error.abs() < 1e-12, "{}: {y:?} against {driven:?}", preset.name);
            for i in 0..4 {
                assert!(rest[i].abs() < 1e-9 * driven[i].abs().max(1e-9), "{}: {rest:?}", preset.name);
            }
        }
    }
}

/// In a free motion, unequal plates and a bias between the plates leave the wing at rest with all angles zero.
#[test]
fn unequal_plates_rest_before_an_impulse() {
    for (offset, ratio) in [(0.0, 1.0), (40.0, 1.0), (0.0, 0.8), (-30.0, 1.3)] {
        let values = design("jafferis2016", &[("drive_offset", offset), ("plate_ratio", ratio)]).1;
        let (c, _, rest) = released(&Bimorph::SINE, &values);
        let plates = plates_under(&c, [120.0, 80.0].map(|volts| Wave::with_rate(volts, 0.0)));
        let driven = Bimorph::SINE.rhs(&c, &plates, 1.0, &[0.0; 4]);
        assert!(rest[1].abs() < 1e-12 * driven[1].abs(), "{offset}, {ratio}: {rest:?}, {driven:?}");
    }
}

/// The equations of motion, linearised at rest by differences, have the natural frequencies of the modes.
#[test]
fn modes_are_those_of_the_equations() {
    fn frequencies<M: ExperimentModel<4>>(
        model: &M,
        values: &[f64],
        [positions, rates]: [[usize; 2]; 2],
    ) -> [[f64; 2]; 2] {
        let constants = model.start(values).unwrap().constants;
        let (still, c, _) = model.variant(values).released(&constants, 1.0);
        let at = |place: usize, change: f64| {
            let mut y = [0.0; 4];
            y[positions[place]] = change;
            still.rhs(&c, &still.input(&c, 0.0), 1.0, &y)
        };
        // The first position of the bimorph is a displacement (m).
        let sizes = if positions[1] == 2 { [1e-9, 1e-6] } else { [1e-6; 2] };
        let [[a, b], [d, e]] = [0, 1].map(|i: usize| {
            [0, 1].map(|j: usize| (at(j, sizes[j])[rates[i]] - at(j, -sizes[j])[rates[i]]) / (2.0 * sizes[j]))
        });
        let (sum, root) = (-(a + e), ((a - e).powi(2) + 4.0 * b * d).sqrt());
        let mut found = modes::<M>(&constants);
        found.sort_by(f64::total_cmp);
        [found, [0.5 * (sum - root), 0.5 * (sum + root)].map(|square| square.sqrt() / TAU)]
    }
    let coupled = [("added_mass_factor", 1.0), ("added_inertia_stroke", 0.0), ("force_strain_slope", 0.0)];
    for (name, set) in [("jafferis2016", &coupled[2..]), ("jafferis2016", &coupled)] {
        let [found, expected] = frequencies(&Bimorph::SINE, &design(name, set).1, [[0, 2], [1, 3]]);
        (0..2).for_each(|i| assert_near(found[i], expected[i], 1e-4 * expected[i], name));
    }
    for name in ["ozaki2018-large", "ozaki2018-small"] {
        let [found, expected] = frequencies(&DirectDrive::SINE, &design(name, &[]).1, [[0, 1], [2, 3]]);
        (0..2).for_each(|i| assert_near(found[i], expected[i], 1e-4 * expected[i], name));
    }
    for name in ["arabagi2013-75hz", "arabagi2013-30hz"] {
        let [found, expected] = frequencies(&FourBar::SINE, &design(name, &[]).1, [[0, 1], [2, 3]]);
        (0..2).for_each(|i| assert_near(found[i], expected[i], 1e-4 * expected[i], name));
    }
}

#[test]
fn impulses_that_mean_nothing_are_refused() {
    let model = by_name("bimorph").unwrap();
    let values = design("jafferis2016", &[]).1;
    let good = ImpulseRequest { stroke_rate: 1.0, duration: 0.01, intervals: 10 };
    for (request, reason) in [
        (ImpulseRequest { stroke_rate: 0.0, ..good }, "finite and not zero, not 0 rad/s"),
        (ImpulseRequest { stroke_rate: f64::NAN, ..good }, "finite and not zero, not NaN rad/s"),
        (ImpulseRequest { duration: 0.0, ..good }, "not 0 s and 10 intervals"),
        (ImpulseRequest { duration: f64::INFINITY, ..good }, "not inf s and 10 intervals"),
        (ImpulseRequest { intervals: 0, ..good }, "0.01 s and 0 intervals"),
    ] {
        let solver = SolverSettings::default();
        let refused = model
            .experiments()
            .unwrap()
            .free_response(&PointRun::new(Backend::best(), &solver, &values), &request)
            .unwrap_err();
        assert!(refused.to_string().contains(reason), "{refused}");
    }
}

/// The number of intervals does not change the states at the same times.
#[test]
fn a_free_motion_does_not_depend_on_how_it_is_sampled() {
    let model = by_name("direct-drive").unwrap();
    let values = design("ozaki2018-large", &[]).1;
    let solver = SolverSettings { rtol: 1e-9, atol: 1e-11, ..SolverSettings::default() };
    let run = |intervals| {
        let request = ImpulseRequest { stroke_rate: 200.0, duration: 0.05, intervals };
        model
            .experiments()
            .unwrap()
            .free_response(&PointRun::new(Backend::best(), &solver, &values), &request)
            .unwrap()
            .rows
    };
    let (coarse, fine) = (run(7), run(7 * 131));
    assert_eq!(coarse.len(), 8);
    assert_eq!(fine.len(), 7 * 131 + 1);
    for (one, other) in coarse.iter().zip(fine.iter().step_by(131)) {
        assert_near(one[0], other[0], 1e-15, "time");
        assert_near(one[1], other[1], 1e-7, "stroke");
        assert_near(one[2], other[2], 1e-7, "pitch");
    }
    assert_near(coarse[7][0], 0.05, 1e-15, "end");
}
