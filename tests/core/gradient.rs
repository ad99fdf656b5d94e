//! Derivatives of settled measures against differences of orbits with much smaller tolerances.

use std::slice;

use flap_core::num::Backend;
use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{
    Change, Gradient, NoSlope, Point, PointRun, Row, Simulator, SolverSettings, Status, all, preset,
};

use crate::robustness::{self, Random};
use crate::rows;

/// Number of random designs of each model.
const DRAWN: usize = 20;

/// Number of parameters of each design along which flap computes derivatives.
const PARAMETERS: usize = 8;

/// The relative change of a parameter for derivatives on given steps.
const CHANGE: f64 = 1e-8;

/// The largest relative change of a parameter for differences of orbits.
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

/// Indices of number parameters that are not zero, so that a relative change changes them.
fn numbers(model: &dyn Simulator, values: &[f64]) -> Vec<usize> {
    let numbers = model.parameters().iter().zip(values).enumerate().filter(|(_, (parameter, value))| {
        matches!(parameter.kind, Kind::Number(_))
            && value.is_finite()
            && **value != 0.0
            && parameter.name != "strips"
            // It breaks the symmetry of the half strokes: extrema that both reach have a kink and no derivative.
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
    let run = PointRun::new(Backend::best(), &solver, values);
    model.motions().unwrap().gradient(&run, &row.state, &changes).unwrap()
}

/// Derivatives of each measure with respect to the relative change of each of the parameters `indices`, by Richardson
/// extrapolation. The extrapolation uses two-sided differences of converged orbits.
fn differences(
    model: &dyn Simulator,
    values: &[f64],
    state: &[f64],
    indices: &[usize],
) -> Option<Vec<Vec<f64>>> {
    let shares = [1.0, -1.0, 0.5, -0.5, 0.25, -0.25];
    let designs = indices.iter().flat_map(|&index| shares.map(|share| moved(values, index, share * STEP)));
    // From the orbit, lest motions from rest settle on another.
    let points = (0..).zip(designs);
    let points: Vec<Point> =
        points.map(|(index, values)| Point { index, values, begin: Some(state.to_vec()) }).collect();
    let rows = rows::of_points(model, &points, Backend::best(), &exact());
    if !rows.iter().all(|row| row.status == Status::Periodic) {
        return None;
    }
    let column = |rows: &[Row], j: usize| {
        let difference = |i: usize, share: f64| {
            (rows[2 * i].measures[j] - rows[2 * i + 1].measures[j]) / (2.0 * share * STEP)
        };
        let [wide, middle, narrow] = [difference(0, 1.0), difference(1, 0.5), difference(2, 0.25)];
        let [first, second] = [(4.0 * middle - wide) / 3.0, (4.0 * narrow - middle) / 3.0];
        (16.0 * second - first) / 15.0
    };
    let columns = 0..rows[0].measures.len();
    Some(rows.chunks(shares.len()).map(|rows| columns.clone().map(|j| column(rows, j)).collect()).collect())
}

/// Some of `numbers`: the first two numbers, which belong to the drive, and random others of `numbers`.
fn some(numbers: &[usize], random: &mut Random) -> Vec<usize> {
    let mut shuffled: Vec<(f64, usize)> = numbers[2..].iter().map(|&index| (random.next(), index)).collect();
    shuffled.sort_by(|one, other| one.0.total_cmp(&other.0));
    let others = shuffled.iter().map(|&(_, index)| index).take(PARAMETERS - 2);
    numbers[..2].iter().copied().chain(others).collect()
}

/// False for columns that are zero for a symmetric motion, and for audits: the test compares no derivatives of these
/// columns.
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
        let rows = rows::of(model, &designs, Backend::best(), &solver());
        let settled = designs.iter().zip(&rows).filter(|(_, row)| row.status == Status::Periodic);
        let (mut errors, mut unknown, mut drawn) = (Vec::new(), 0, 0);
        for (values, row) in settled {
            let indices = some(&numbers(model, values), &mut random);
            let found = gradient(model, values, row, &indices);
            let folded = found.slopes.iter().flatten().any(|slope| slope == &Err(NoSlope::Fold));
            let exact = differences(model, values, &row.state, &indices);
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
                        Err(NoSlope::Missing) => assert!(row.measures[j].is_nan(), "{}", column.name),
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

/// In a symmetric motion both half strokes have the same largest lift. A parameter that changes the half strokes
/// differently has derivatives of the means, but not of the extrema. A parameter that changes both half strokes equally
/// has all derivatives.
#[test]
fn equal_extrema_of_both_half_strokes_have_a_kink() {
    let (model, preset) = preset("jafferis2016").unwrap();
    let index = |name: &str| Parameter::index(model.parameters(), name).unwrap();
    let column = |name: &str| model.columns().iter().position(|column| column.name == name).unwrap();
    for voltage in [10.0, 100.0, 200.0] {
        let mut values = (preset.values)();
        values[index("drive_voltage_pp")] = voltage;
        let rows = rows::of(model, slice::from_ref(&values), Backend::best(), &solver());
        let indices = ["plate_ratio", "hinge_stiffness", "drive_frequency"].map(index);
        let found = gradient(model, &values, &rows[0], &indices);
        let [plate_ratio, others @ ..] = &found.slopes[..] else { unreachable!() };
        for name in ["lift_max_mn", "pitch_peak_deg"] {
            assert_eq!(plate_ratio[column(name)], Err(NoSlope::Kink), "{name} at {voltage} V");
        }
        for name in ["lift_mean_mn", "stroke_pp_deg", "stroke_mean_deg", "pitch_max_deg", "power_mean_mw"] {
            assert!(plate_ratio[column(name)].is_ok(), "{name} at {voltage} V");
        }
        for slopes in others {
            for ((slope, column), value) in slopes.iter().zip(model.columns()).zip(&rows[0].measures) {
                let is_known = slope.is_ok() || value.is_nan() && slope == &Err(NoSlope::Missing);
                assert!(is_known || !has_gradient(&column.name), "{} at {voltage} V", column.name);
            }
        }
    }
}

/// With linear damping, tiny motions are proportional to the voltage, and so are the derivatives of these motions.
#[test]
fn tiny_motions_have_derivatives_as_accurate_as_others() {
    let (model, preset) = preset("ozaki2018-large").unwrap();
    let index = |name: &str| Parameter::index(model.parameters(), name).unwrap();
    let stroke = model.columns().iter().position(|column| column.name == "stroke_first_deg").unwrap();
    let [large, tiny] = [1e-3, 1e-7].map(|voltage| {
        let mut values = (preset.values)();
        for (name, value) in
            [("drive_voltage_pp", voltage), ("stroke_damping", 2e-7), ("hinge_damping", 1e-8)]
        {
            values[index(name)] = value;
        }
        let rows = rows::of(model, slice::from_ref(&values), Backend::best(), &solver());
        let found = gradient(model, &values, &rows[0], &[index("drive_frequency")]);
        found.slopes[0][stroke].unwrap() / rows[0].measures[stroke]
    });
    assert!((tiny / large - 1.0).abs() < 1e-4, "{tiny}, not {large}");
}

/// If a parameter of a term is zero, flap leaves out the term. The derivative with respect to the parameter contains the term.
#[test]
fn a_term_that_is_zero_has_a_derivative() {
    assert_slope("jafferis2016", "transmission_growth", [10.0, 2e7]);
    assert_slope("jafferis2016", "lift_term_2", [1e-8, 4e-3]);
    assert_slope("ozaki2018-large", "drag_term_1", [1e-8, 4e-3]);
    assert_slope("arabagi2013-75hz", "pressure_term_0", [1e-9, 4e-4]);
}

/// Asserts that derivatives at a parameter value of zero agree with differences. `size` is the change for the
/// derivatives, and `step` the change for the differences.
fn assert_slope(name: &str, parameter: &str, [size, step]: [f64; 2]) {
    let (model, preset) = preset(name).unwrap();
    let index = Parameter::index(model.parameters(), parameter).unwrap();
    let values = (preset.values)();
    let solver = solver();
    let run = PointRun::new(Backend::best(), &solver, &values);
    let row = rows::of(model, slice::from_ref(&values), Backend::best(), &solver).remove(0);
    let at = |value: f64| {
        let mut values = values.clone();
        values[index] = value;
        values
    };
    let change = Change { ahead: at(size), behind: at(-size), size };
    let found = model.motions().unwrap().gradient(&run, &row.state, &[change]).unwrap();
    let points = [step, -step, 0.5 * step, -0.5 * step].map(at);
    let points: Vec<Point> = (0..)
        .zip(points)
        .map(|(index, values)| Point { index, values, begin: Some(row.state.clone()) })
        .collect();
    // Here the period map of the finest tolerances jumps by more than 1e-12.
    let exact = SolverSettings { settle_tol: 1e-11, ..exact() };
    let rows = rows::of_points(model, &points, Backend::best(), &exact);
    for column in ["stroke_pp_deg", "pitch_pp_deg", "lift_mean_mn", "power_mean_mw", "tip_pp_um"] {
        let Some(j) = model.columns().iter().position(|one| one.name == column) else {
            assert_eq!(column, "tip_pp_um", "{name}");
            continue;
        };
        let m = [0, 1, 2, 3].map(|i| rows[i].measures[j]);
        let difference = (4.0 * (m[2] - m[3]) / step - (m[0] - m[1]) / (2.0 * step)) / 3.0;
        let slope = found.slopes[0][j].unwrap();
        // A hundredth of the measure is nothing, for a change of the parameter by 250 steps.
        let scale = difference.abs().max(1e-2 * row.measures[j].abs() / (250.0 * step));
        assert!(
            (slope - difference).abs() < 5e-5 * scale,
            "{name}, {parameter}, {column}: {slope:e}, {difference:e}"
        );
    }
}

/// A parameter at the end of its range has a reason instead of a derivative, and other parameters keep their
/// derivatives.
#[test]
fn a_changed_point_that_is_impossible_is_told() {
    let (model, preset) = flap_core::simulate::preset("ozaki2018-large").unwrap();
    let values = (preset.values)();
    let solver = solver();
    let run = PointRun::new(Backend::best(), &solver, &values);
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
    for (slope, column) in found.slopes[0].iter().zip(model.columns()) {
        // The preset does not know its hinge's size.
        let reason = if column.name == "hinge_strain_max" { NoSlope::Missing } else { NoSlope::Edge };
        assert_eq!(slope, &Err(reason), "{}", column.name);
    }
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
        let best = Backend::best();
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
        let slopes = |backend: Backend, changes: &[Change]| {
            let run = PointRun::new(backend, &solver, &values);
            format!("{:?}", motions.gradient(&run, &row.state, changes).unwrap().slopes)
        };
        let all = slopes(best, &changes);
        for backend in Backend::available() {
            if backend.arithmetic() == best.arithmetic() {
                assert_eq!(slopes(backend, &changes), all, "{} {backend}", model.name());
            }
        }
        let last = slopes(best, &changes[changes.len() - 1..]);
        assert!(all.ends_with(&last[1..]), "{}", model.name());
    }
}

/// Near a fold, a row has exact derivatives or the reason `fold`, because the error of an orbit changes (I − M)⁻¹. The
/// test follows rows to the fold from the states of their neighbours.
#[test]
fn derivatives_towards_a_fold_are_right_or_not_given() {
    let (model, preset) = flap_core::simulate::preset("jafferis2016").unwrap();
    let index = |name: &str| model.parameters().iter().position(|p| p.name == name).unwrap();
    let [frequency, stiffness, voltage] =
        ["drive_frequency", "hinge_stiffness", "drive_voltage_pp"].map(index);
    let stroke = model.columns().iter().position(|column| column.name == "stroke_pp_deg").unwrap();
    let at = |value: f64, begin: Option<Vec<f64>>, solver: &SolverSettings| {
        let mut values = (preset.values)();
        (values[frequency], values[stiffness], values[voltage]) = (value, 0.7486e-6, 160.0);
        let point = Point { index: 0, values: values.clone(), begin };
        let mut rows = rows::of_points(model, &[point], Backend::best(), solver);
        (values, rows.remove(0))
    };
    let solver = SolverSettings::DEFAULT;
    let fine = SolverSettings { settle_tol: 1e-9, ..solver }.with_rtol(1e-10);
    for (start, mut step) in [(135.0, -1.0), (120.0, 1.0)] {
        let (mut here, mut last) = (start, at(start, None, &solver).1);
        let (mut given, mut folded, mut steepest, mut most_periods) = (0, 0, 0.0_f64, [0, 0]);
        while f64::abs(step) > 1e-9 {
            let (values, row) = at(here + step, Some(last.state.clone()), &solver);
            let jumps =
                row.status != Status::Periodic || (row.measures[stroke] - last.measures[stroke]).abs() > 8.0;
            if jumps {
                step *= 0.5;
                continue;
            }
            here += step;
            let change = |share: f64| {
                values.iter().enumerate().map(|(i, v)| if i == frequency { v + share } else { *v }).collect()
            };
            let size = CHANGE * here;
            let change = Change { ahead: change(size), behind: change(-size), size };
            let run = PointRun::new(Backend::best(), &solver, &values);
            let gradient =
                |changes: &[Change]| model.motions().unwrap().gradient(&run, &row.state, changes).unwrap();
            let found = gradient(slice::from_ref(&change));
            let more_evals = gradient(&[change.clone(), change]).rhs_evals - found.rhs_evals;
            match found.slopes[0][stroke] {
                Ok(slope) => {
                    let side = |share: f64| {
                        at(here * (1.0 + share), Some(row.state.clone()), &fine)
                            .1
                            .measures
                            .get(stroke)
                            .copied()
                    };
                    let [Some(more), Some(less)] = [1e-7, -1e-7].map(side) else {
                        panic!("{here} Hz: {slope} deg/Hz, and no orbit beside it")
                    };
                    let exact = (more - less) / (2e-7 * here);
                    println!("{here:.9} Hz: {slope:.2}, {exact:.2}");
                    assert!((slope / exact - 1.0).abs() < 0.05, "{here} Hz: {slope} {exact} deg/Hz");
                    given += 1;
                    steepest = steepest.max(slope.abs());
                    // Another derivative takes three more periods.
                    most_periods[0] = most_periods[0].max(3 * found.rhs_evals / more_evals);
                }
                Err(reason) => {
                    assert_eq!(reason, NoSlope::Fold);
                    folded += 1;
                    // The one period that shows the fold.
                    most_periods[1] = most_periods[1].max(found.rhs_evals / more_evals);
                }
            }
            last = row;
        }
        println!(
            "from {start} Hz: {given} given, up to {steepest:.0} deg/Hz, {folded} too near to the fold at {here} Hz"
        );
        assert!(given > 8 && folded > 3 && steepest > 30.0, "{given} {folded} {steepest}");
        // The record and nine periods, and five more beside the fold; without derivatives three less.
        assert!(most_periods[0] >= 14 && most_periods[1] >= 11, "{most_periods:?}");
    }
}
