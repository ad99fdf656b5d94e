//! Derivatives of settled measures against differences of orbits that are converged far beyond.

use flap_core::num::InstructionSet;
use flap_core::parameter::Kind;
use flap_core::simulate::{
    Change, Gradient, NoSlope, Point, PointRun, Row, Simulator, SolverSettings, Status, all,
};

use crate::robustness::{self, Random};
use crate::rows;

/// Designs drawn of each model.
const DRAWN: usize = 20;

/// Parameters of each design along which derivatives are taken.
const PARAMETERS: usize = 8;

/// The share by which a parameter is changed for derivatives on given steps.
const CHANGE: f64 = 1e-8;

/// The largest share by which it is changed for differences of orbits.
const STEP: f64 = 8e-4;

fn solver() -> SolverSettings {
    SolverSettings { settle_tol: 1e-8, ..SolverSettings::DEFAULT }.with_rtol(1e-8)
}

fn exact() -> SolverSettings {
    SolverSettings { settle_tol: 1e-12, max_cycles: 3000, ..SolverSettings::DEFAULT }.with_rtol(1e-12)
}

/// The values with parameter `index` changed by a share of itself.
fn moved(values: &[f64], index: usize, share: f64) -> Vec<f64> {
    let mut values = values.to_vec();
    values[index] *= 1.0 + share;
    values
}

/// Numbers of the model that are not zero: parameters whose shares can change.
fn numbers(model: &dyn Simulator, values: &[f64]) -> Vec<usize> {
    let numbers = model.parameters().iter().zip(values).enumerate().filter(|(_, (parameter, value))| {
        matches!(parameter.kind, Kind::Number(_))
            && value.is_finite()
            && **value != 0.0
            && parameter.name != "strips"
            // It breaks the symmetry of the half strokes: largest values that both reach have a kink.
            && parameter.name != "plate_ratio"
    });
    numbers.map(|(index, _)| index).collect()
}

fn gradient(model: &dyn Simulator, values: &[f64], row: &Row, indices: &[usize]) -> Gradient {
    let changes = indices.iter().map(|&index| Change {
        ahead: moved(values, index, CHANGE),
        behind: moved(values, index, -CHANGE),
        size: CHANGE,
    });
    let changes: Vec<Change> = changes.collect();
    let solver = solver();
    let run = PointRun::new(InstructionSet::best(), &solver, values);
    model.motions().unwrap().gradient(&run, &row.state, &changes).unwrap()
}

/// Richardson's extrapolation of two-sided differences of converged orbits: the derivative by a share of the parameter, of each
/// measure.
fn differences(model: &dyn Simulator, values: &[f64], state: &[f64], index: usize) -> Option<Vec<f64>> {
    let designs = [1.0, -1.0, 0.5, -0.5, 0.25, -0.25].map(|share| moved(values, index, share * STEP));
    // From the orbit, lest motions from rest settle on another.
    let points = (0..).zip(designs);
    let points: Vec<Point> =
        points.map(|(index, values)| Point { index, values, begin: Some(state.to_vec()) }).collect();
    let rows = rows::of_points(model, &points, InstructionSet::best(), &exact());
    if !rows.iter().all(|row| row.status == Status::Periodic) {
        return None;
    }
    let column = |j: usize| {
        let m = [0, 1, 2, 3, 4, 5].map(|i| rows[i].measures[j]);
        let difference = |i: usize, share: f64| (m[2 * i] - m[2 * i + 1]) / (2.0 * share * STEP);
        let [wide, middle, narrow] = [difference(0, 1.0), difference(1, 0.5), difference(2, 0.25)];
        let [first, second] = [(4.0 * middle - wide) / 3.0, (4.0 * narrow - middle) / 3.0];
        (16.0 * second - first) / 15.0
    };
    Some((0..rows[0].measures.len()).map(column).collect())
}

/// Some of the numbers, at random; the first two of them always, which belong to the drive.
fn some(numbers: &[usize], random: &mut Random) -> Vec<usize> {
    let mut shuffled: Vec<(f64, usize)> = numbers[2..].iter().map(|&index| (random.next(), index)).collect();
    shuffled.sort_by(|one, other| one.0.total_cmp(&other.0));
    let others = shuffled.iter().map(|&(_, index)| index).take(PARAMETERS - 2);
    numbers[..2].iter().copied().chain(others).collect()
}

/// Columns that are zero for a symmetric motion, and audits, have no derivatives to speak of.
fn has_gradient(column: &str) -> bool {
    !column.ends_with("audit")
        && !column.ends_with("_mean_deg")
        && !["drag_mean_mn", "lift_rotational_mean_mn"].contains(&column)
}

#[test]
fn derivatives_are_those_of_converged_orbits() {
    for &model in all() {
        let mut random = Random(18);
        let designs = robustness::designs(model, 4 * DRAWN);
        let rows = rows::of(model, &designs, InstructionSet::best(), &solver());
        let settled = designs.iter().zip(&rows).filter(|(_, row)| row.status == Status::Periodic);
        let (mut errors, mut unknown, mut drawn) = (Vec::new(), 0, 0);
        for (values, row) in settled {
            let indices = some(&numbers(model, values), &mut random);
            let found = gradient(model, values, row, &indices);
            let folded = found.slopes.iter().flatten().any(|slope| slope == &Err(NoSlope::Fold));
            let exact: Option<Vec<Vec<f64>>> =
                indices.iter().map(|&index| differences(model, values, &row.state, index)).collect();
            let Some(exact) = exact.filter(|_| !folded) else { continue };
            drawn += 1;
            for (j, column) in model.columns().iter().enumerate() {
                if !has_gradient(&column.name) {
                    continue;
                }
                let size = exact.iter().map(|d| d[j] * d[j]).sum::<f64>().sqrt();
                // A hundredth of the measure, for a change of the parameter by as much as itself, is nothing.
                let size = size.max(1e-2 * row.measures[j].abs());
                for (found, exact) in found.slopes.iter().zip(&exact) {
                    match found[j] {
                        Ok(slope) if size > 0.0 => errors.push((slope - exact[j]).abs() / size),
                        Ok(_) => {}
                        Err(_) => unknown += 1,
                    }
                }
            }
            if drawn == DRAWN {
                break;
            }
        }
        errors.sort_by(f64::total_cmp);
        let [most, all] = [errors[errors.len() * 99 / 100], errors[errors.len() - 1]];
        println!(
            "{}: {} derivatives of {drawn} designs differ by at most {most:.1e} (99 %), {all:.1e} (all) of the \
             gradient's size; {unknown} are not known",
            model.name(),
            errors.len()
        );
        assert_eq!(drawn, DRAWN, "{}", model.name());
        assert!(most < 2e-5 && all < 5e-4, "{}", model.name());
        assert!(unknown * 200 < errors.len(), "{}", model.name());
    }
}

/// At the end of its range a parameter has no derivative, and says why; the others have theirs.
#[test]
fn a_changed_point_that_is_impossible_is_told() {
    let (model, preset) = flap_core::simulate::preset("ozaki2018-large").unwrap();
    let values = (preset.values)();
    let solver = solver();
    let run = PointRun::new(InstructionSet::best(), &solver, &values);
    let row = model.run_point(&run, None);
    let stiffness = model.parameters().iter().position(|p| p.name == "hinge_stiffness").unwrap();
    let possible = |share: f64| Change {
        ahead: moved(&values, stiffness, share),
        behind: moved(&values, stiffness, -share),
        size: share,
    };
    let impossible = Change { behind: moved(&values, stiffness, -2.0), ..possible(CHANGE) };
    let motions = model.motions().unwrap();
    let found = motions.gradient(&run, &row.state, &[impossible, possible(CHANGE)]).unwrap();
    assert!(found.slopes[0].iter().all(|slope| slope == &Err(NoSlope::Edge)), "{:?}", found.slopes[0]);
    let alone = motions.gradient(&run, &row.state, &[possible(CHANGE)]).unwrap();
    assert_eq!(format!("{:?}", found.slopes[1]), format!("{:?}", alone.slopes[0]));
    assert!(alone.rhs_evals > 6 * 3 * 40, "{}", alone.rhs_evals);
}

/// Derivatives depend neither on the lanes nor on other derivatives.
#[test]
fn derivatives_are_the_same_in_all_lanes_of_an_arithmetic() {
    for &model in all() {
        let values = (model.presets()[0].values)();
        let solver = SolverSettings::DEFAULT;
        let best = InstructionSet::best();
        let row = model.run_point(&PointRun::new(best, &solver, &values), None);
        let indices = numbers(model, &values);
        let changes: Vec<Change> = indices
            .iter()
            .map(|&i| Change {
                ahead: moved(&values, i, CHANGE),
                behind: moved(&values, i, -CHANGE),
                size: CHANGE,
            })
            .collect();
        let motions = model.motions().unwrap();
        let slopes = |set: InstructionSet, changes: &[Change]| {
            let run = PointRun::new(set, &solver, &values);
            format!("{:?}", motions.gradient(&run, &row.state, changes).unwrap().slopes)
        };
        let all = slopes(best, &changes);
        for set in InstructionSet::available() {
            if set.arithmetic() == best.arithmetic() {
                assert_eq!(slopes(set, &changes), all, "{} {set}", model.name());
            }
        }
        let last = slopes(best, &changes[changes.len() - 1..]);
        assert!(all.ends_with(&last[1..]), "{}", model.name());
    }
}
