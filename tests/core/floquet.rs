//! Responses to changes of the initial state, against Floquet multipliers of reference orbits.

use flap_core::model::Model;
use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::num::Backend;
use flap_core::ode::{Start, Tolerances};
use flap_core::parameter::Parameter;
use flap_core::simulate::{Period, PointRun, Row, SolverSettings, all, by_name, preset};
use nalgebra::Matrix4;

use crate::data::{Record, assert_close, table};
use crate::{rows, span};

const TOLERANCES: Tolerances = Tolerances { rtol: 1e-8, atol: 1e-10, max_steps: 20_000 };

/// The state at the end of a period that begins at `y`, in units of the typical sizes.
fn end<M: Model<4>>(model: &M, values: &[f64], y: [f64; 4]) -> [f64; 4] {
    let model = &model.variant(values);
    let start = Start { y, ..model.start(values).unwrap() };
    let end = span::end(model, &TOLERANCES, &start);
    std::array::from_fn(|i| end[i] / start.scale[i])
}

/// The period that begins at `y`, with responses to changes of `y`.
fn period<M: Model<4>>(values: &[f64], y: [f64; 4]) -> Period {
    let Tolerances { rtol, atol, max_steps } = TOLERANCES;
    let solver = SolverSettings { rtol, atol, max_steps, ..SolverSettings::DEFAULT };
    let motions = by_name(M::DESCRIPTION.name).unwrap().motions().unwrap();
    motions.period(&PointRun::new(Backend::best(), &solver, values), &y).unwrap()
}

/// The largest modulus of the multipliers, from the responses of a period.
fn largest_multiplier(responses: &[Vec<f64>]) -> f64 {
    let monodromy = Matrix4::from_fn(|i, j| responses[j][i]);
    monodromy.complex_eigenvalues().iter().fold(0.0, |largest, multiplier| multiplier.norm().max(largest))
}

/// Compares the largest multiplier of the orbit through the states in `states` with the column `multiplier`.
fn check<M: Model<4>>(model: &M, values: &[f64], record: &Record, states: [&str; 4], multiplier: &str) {
    let y = states.map(|column| record.number(column));
    let Period { end: varied, responses, scale, floquet_max, .. } = period::<M>(values, y);
    for (one, other) in
        end(model, values, y).into_iter().zip(varied.iter().zip(&scale).map(|(y, scale)| y / scale))
    {
        assert!(
            (one - other).abs() < 1e-6 * (1.0 + one.abs()),
            "the responses do not change the states: {one} and {other}"
        );
    }
    assert_close(largest_multiplier(&responses), record.number(multiplier), 1e-4, &record.name);
    assert_close(floquet_max, record.number(multiplier), 1e-4, &record.name);
}

#[test]
fn multipliers_of_direct_drive_orbits_equal_the_reference() {
    for record in table("direct-drive/steady_cases.csv") {
        let p = direct_drive::Params {
            drive_voltage_pp: 2.0 * record.number("V0_V"),
            drive_frequency: record.number("f_Hz"),
            ..crate::direct_drive::params(record.text("type"))
        };
        let states = ["x_phi0", "x_psi0", "x_phidot0", "x_psidot0"];
        check(&DirectDrive::SINE, &p.to_values(), &record, states, "floquet_max");
    }
}

#[test]
fn multipliers_of_bimorph_orbits_equal_the_reference() {
    for record in table("bimorph/steady_cases.csv") {
        let p = crate::bimorph::driven(&crate::bimorph::params(record.text("set")), &record);
        let states = ["x0_m", "v0_m_per_s", "psi0_rad", "psidot0_rad_per_s"];
        check(&Bimorph::SINE, &p.to_values(), &record, states, "floquet_abs_max");
    }
}

/// Rows of a preset from 0.3 to 1.1 of its voltage and from 0.5 to 1.7 of its frequency.
fn rows_around(name: &str, solver: &SolverSettings) -> Vec<Row> {
    let (model, preset) = preset(name).unwrap();
    let index = |name| Parameter::index(model.parameters(), name).unwrap();
    let (voltage, frequency) = (index("drive_voltage_pp"), index("drive_frequency"));
    let mut designs = Vec::new();
    for i in 0..9 {
        for j in 0..29 {
            let mut values = (preset.values)();
            values[voltage] *= 0.3 + 0.1 * f64::from(i);
            values[frequency] *= 0.5 + 1.2 * f64::from(j) / 28.0;
            designs.push(values);
        }
    }
    rows::of(model, &designs, Backend::best(), solver)
}

/// The largest error of `floquet_max` with the default search does not exceed the error in the documentation.
#[test]
fn multipliers_of_rows_are_as_accurate_as_documented() {
    let solver = |rtol: f64| SolverSettings { settle_tol: rtol, ..SolverSettings::DEFAULT }.with_rtol(rtol);
    let exact = SolverSettings { progressive: false, max_steps: 200_000, ..solver(1e-10) };
    let presets = all().iter().flat_map(|model| model.presets()).map(|preset| preset.name);
    for name in presets.filter(|name| !name.ends_with("kw-swapped")) {
        let truth = rows_around(name, &exact);
        for (rtol, bound) in [(1e-6, 1e-3), (1e-8, 2e-4)] {
            let found = rows_around(name, &solver(rtol));
            // Between folds, tolerances may decide between two orbits.
            let same = |one: &Row, other: &Row| {
                one.period == 1
                    && other.period == 1
                    && (one.measures[0] / other.measures[0] - 1.0).abs() < 1e-3
            };
            let both = found.iter().zip(&truth).filter(|(found, truth)| same(found, truth));
            let mut errors: Vec<f64> =
                both.map(|(found, truth)| (found.floquet_max - truth.floquet_max).abs()).collect();
            errors.sort_by(f64::total_cmp);
            assert!(errors.len() > 250, "{name}: {} rows are compared", errors.len());
            let percentile = |percent: usize| errors[(errors.len() - 1) * percent / 100];
            println!(
                "{name}, rtol {rtol:e}: floquet_max of {} rows errs by {:.1e} (median), {:.1e} (99 %), {:.1e} (all)",
                errors.len(),
                percentile(50),
                percentile(99),
                percentile(100)
            );
            assert!(percentile(100) < bound, "{name} at {rtol:e}: {:e}", percentile(100));
            assert!(percentile(50) < 0.1 * bound, "{name} at {rtol:e}: {:e}", percentile(50));
        }
    }
}
