//! Error estimates of rows, for designs that differ much from the published designs.

use flap_core::num::Backend;
use flap_core::parameter::{Kind, Preset};
use flap_core::simulate::{Row, Simulator, SolverSettings, Status, all, preset};

use crate::robustness::Random;
use crate::rows::{self, worse};
use crate::terms::is_left_out;

/// Number of random designs of each preset, and number of these designs that are integrated again at the tolerance of
/// [`exact`].
const DRAWN: usize = 2000;
const COMPARED: usize = 300;

/// The measures whose errors `error_estimate` bounds.
const PRINCIPAL: [&str; 4] = ["stroke_amplitude_deg", "pitch_amplitude_deg", "lift_mean_mn", "power_mean_mw"];

/// At most 100 drive periods: few points settle after more periods, and the other points would take much time.
fn solver() -> SolverSettings {
    SolverSettings { max_cycles: 100, ..SolverSettings::default() }
}

fn exact() -> SolverSettings {
    SolverSettings { atol: 1e-17, settle_tol: 1e-9, max_steps: 200_000, ..solver().with_rtol(1e-11) }
}

/// Random designs: each number of the preset times a factor from 0.2 to 1.8. Choices keep the value of the preset.
pub(crate) fn designs(model: &dyn Simulator, preset: &Preset) -> Vec<Vec<f64>> {
    let mut random = Random(14);
    let mut design = || {
        let mut values = (preset.values)();
        let numbers = values.iter_mut().zip(model.parameters());
        for (value, parameter) in numbers.filter(|(value, parameter)| !is_left_out(parameter, **value)) {
            let factor = 0.2 + 1.6 * random.next();
            if !matches!(parameter.kind, Kind::Choice(_)) {
                *value *= factor;
            }
            if parameter.name == "strips" {
                *value = value.round().max(1.0);
            }
        }
        values
    };
    (0..DRAWN).map(|_| design()).collect()
}

fn measure(model: &dyn Simulator, row: &Row, name: &str) -> f64 {
    let column = model.columns().iter().position(|column| column.name == name).expect("a column");
    row.measures[column]
}

fn is_above(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

/// The largest relative error of the principal measures.
fn error(model: &dyn Simulator, row: &Row, exact: &Row) -> f64 {
    let relative = |name: &str| (measure(model, row, name) / measure(model, exact, name) - 1.0).abs();
    PRINCIPAL.iter().map(|name| relative(name)).fold(0.0, worse)
}

#[test]
fn rows_of_random_designs_know_their_error() {
    let accuracy = solver().accuracy;
    let (mut all_underestimated, mut all_compared) = (0, 0);
    let names = all().iter().flat_map(|model| model.presets()).map(|preset| preset.name);
    for name in names.filter(|name| !name.ends_with("kw-swapped")) {
        let (model, preset) = preset(name).expect("a preset");
        let designs = designs(model, preset);
        let set = Backend::best();
        let rows = rows::of(model, &designs, set, &solver());
        let periodic: Vec<usize> = (0..DRAWN).filter(|&i| rows[i].status == Status::Periodic).collect();

        let audits =
            periodic.iter().filter(|&&i| is_above(measure(model, &rows[i], "energy_audit").abs(), accuracy));
        let (audits, doubtful): (Vec<_>, Vec<_>) = (
            audits.collect(),
            periodic.iter().filter(|&&i| is_above(rows[i].error_estimate, accuracy)).collect(),
        );

        let compared: Vec<usize> = periodic.iter().copied().take(COMPARED).collect();
        let chosen: Vec<Vec<f64>> = compared.iter().map(|&i| designs[i].clone()).collect();
        let truth = rows::of(model, &chosen, set, &exact());
        // Where several orbits attract, tolerances may decide between them: rows are compared on the same one.
        let errors: Vec<(usize, f64)> = compared
            .iter()
            .zip(&truth)
            .filter(|(_, truth)| truth.status == Status::Periodic)
            .map(|(&i, truth)| (i, error(model, &rows[i], truth)))
            .filter(|&(i, _)| !OTHER_ORBITS.contains(&(name, i)))
            .collect();
        let underestimated: Vec<_> =
            errors.iter().filter(|&&(i, error)| is_above(error, 3.0 * rows[i].error_estimate)).collect();
        let unsaid: Vec<_> = errors
            .iter()
            .filter(|&&(i, error)| is_above(error, 1e-2) && rows[i].error_estimate < accuracy)
            .collect();
        println!(
            "{name}: of {DRAWN} designs {} are periodic; {} with an energy audit above {accuracy}, {} with an \
             estimate above it; of {} compared {} have errors above three times the estimate",
            periodic.len(),
            audits.len(),
            doubtful.len(),
            errors.len(),
            underestimated.len(),
        );
        assert!(errors.len() >= 250, "{name}: {} rows are compared", errors.len());
        assert!(audits.len() <= 2, "{name}: audits of {audits:?}");
        assert!(doubtful.len() * 200 <= periodic.len(), "{name}: {doubtful:?} are not accurate");
        assert!(underestimated.len() * 50 <= errors.len(), "{name}: {underestimated:?} are underestimated");
        all_underestimated += underestimated.len();
        all_compared += errors.len();
        assert!(unsaid.is_empty(), "{name}: {unsaid:?} err by more than 1 % and do not say so");
    }
    assert!(
        all_underestimated * 100 <= all_compared,
        "{all_underestimated} of {all_compared} are underestimated"
    );
}

/// Random designs that settle on different orbits at the default tolerance and at a finer tolerance.
const OTHER_ORBITS: [(&str, usize); 1] = [("arabagi2013-30hz", 1749)];
