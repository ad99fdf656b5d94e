//! Computes the mean force and torque of a vehicle as quadratic polynomials of the vehicle's inputs, for
//! model-predictive controllers.
//!
//! ```text
//! W_i = c_0 + Σ c_j s_j + Σ_{j≤k} c_jk s_j s_k,   s = (input − centre) / half range
//! ```
//!
//! The coefficients are fitted to rows of the vehicle by least squares. Every fifth row is not part of the
//! fit and is used to test the map.

use flap_core::simulate::{Row, Status};
use nalgebra::{DMatrix, DVector};

use super::inputs;
use crate::notation::{UserError, text};
use crate::plan::Plan;
use crate::plan::sample::{Distribution, Method, SamplePoints};
use crate::run::{Outcome, Progress, RunError, RunOptions, rows};
use crate::vehicle::control::{COMPONENTS, Input, because, places};

/// Of each group of five rows, one row is left out of the fit, to test the map.
const LEFT_OUT: usize = 5;

/// Smallest number of samples. With ten samples, two rows are left out of the fit to test the map.
const FEWEST_SAMPLES: usize = 10;

/// The coefficients are unique if the smallest singular value of the fit's matrix is above this fraction of
/// the largest singular value.
const SMALLEST_SINGULAR: f64 = 1e-9;

/// If a component of the wrench changes by less than this fraction of the largest component, the component
/// counts as constant.
const CONSTANT: f64 = 1e-6;

/// If the coefficient of determination of a component is below this value, flap warns that the map of the
/// component is poor.
const POOR: f64 = 0.99;

/// If a Floquet multiplier is above this value, flap warns that a small change of an input may change the
/// motion much.
const STEEP: f64 = 0.7;

/// Advice for the user if the rows with periodic motions are too few, or do not determine the coefficients.
const NARROWER: &str = "choose narrower ranges around a settled motion, or more samples";

/// Seed of the random numbers with which the sample is scrambled.
const SEED: u64 = 0;

/// An input of a wrench map, with the range in which the map is fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct MapInput {
    /// Name of the input as the user gives it (see [`Input::of`]).
    pub name: String,
    /// Index of the input's parameter in the vehicle's parameter table.
    pub parameter: usize,
    /// Smallest value of the input (SI).
    pub from: f64,
    /// Largest value of the input (SI).
    pub to: f64,
}

impl MapInput {
    /// Returns `input` with the range from `from` to `to` (SI).
    ///
    /// # Errors
    /// An error if `from` is not less than `to`.
    pub fn new(input: &Input, from: f64, to: f64) -> Result<MapInput, UserError> {
        if from < to {
            return Ok(MapInput { name: input.name.clone(), parameter: input.parameter, from, to });
        }
        let mistake = if from == to { "is empty" } else { "ends below its beginning" };
        let help = "a range has its smaller end first, as in 180V:220V";
        Err(UserError::new(format!("the range of `{}` {mistake}", input.name), Some(help)))
    }

    /// Returns the centre of the input's range (SI).
    pub fn centre(&self) -> f64 {
        0.5 * (self.from + self.to)
    }

    /// Returns half the width of the input's range (SI).
    pub fn half_range(&self) -> f64 {
        0.5 * (self.to - self.from)
    }
}

/// The reason why a wrench map cannot be computed.
#[derive(Debug, thiserror::Error)]
pub enum WrenchMapError {
    /// An input, the number of samples or the plan is not allowed, or too few points have a periodic motion.
    #[error(transparent)]
    Mistake(#[from] UserError),
    /// The rows cannot be computed.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Returns the number of rows with each status as text, such as `3 unsettled, 1 invalid`.
fn statuses(unused: &[(Status, usize)]) -> String {
    let parts = unused.iter().map(|(status, rows)| format!("{rows} {}", status.name()));
    parts.collect::<Vec<_>>().join(", ")
}

/// A wrench map: the components of mean force (mN) and torque (uN·m) as quadratic polynomials of the inputs
/// (SI). [`COMPONENTS`] lists the components.
#[derive(Clone, Debug, PartialEq)]
pub struct WrenchMap {
    /// The inputs, each with the range in which the map is valid.
    pub inputs: Vec<MapInput>,
    /// Coefficients for scaled inputs, whose ranges are -1 to 1. The matrix has one row for each component
    /// and one column for each term (see [`terms`]).
    pub scaled: DMatrix<f64>,
    /// Coefficient of determination of each component, computed from the rows that were left out of the fit.
    /// NaN for a constant component.
    pub r_squared: [f64; 6],
    /// Largest error of the map for each component, among the rows that were left out of the fit (mN or
    /// uN·m).
    pub largest_error: [f64; 6],
    /// Number of rows to which the coefficients are fitted.
    pub fitted: usize,
    /// Number of rows that were left out of the fit to test the map.
    pub left_out: usize,
    /// Numbers of rows without a periodic motion, for each status. The fit does not use rows without a
    /// periodic motion.
    pub unused: Vec<(Status, usize)>,
    /// Largest magnitude of the Floquet multipliers among all rows with a periodic motion. NaN if unknown.
    pub floquet_max: f64,
    /// A warning that derived parameters were kept constant, if the plan has derived parameters.
    held_constant: Option<&'static str>,
}

impl WrenchMap {
    /// Largest number of inputs of a wrench map.
    pub const MOST_INPUTS: usize = 16;

    /// Largest number of samples of a wrench map. The rows of all samples are in memory at the same time.
    pub const MOST_SAMPLES: u32 = 1_000_000;

    /// Default number of samples of a wrench map.
    pub const SAMPLES: u32 = 400;

    /// Computes the wrench map for the vehicle of `plan`. The `inputs` vary in their ranges, and all
    /// parameters that are not inputs have their value in `values`.
    ///
    /// The inputs have the values of a scrambled Sobol' sequence with `samples` points. The map does not
    /// depend on the number of threads. During the computation, `stops` is called several times a second. If
    /// `stops` returns true, the result is `None`.
    ///
    /// # Errors
    /// [`WrenchMapError`] if the inputs or the number of samples are not allowed, or if too few points have a
    /// periodic motion.
    pub fn of(
        plan: &Plan,
        values: &[f64],
        inputs: Vec<MapInput>,
        samples: u32,
        options: &RunOptions,
        mut stops: impl FnMut(Progress) -> bool,
    ) -> Result<Option<WrenchMap>, WrenchMapError> {
        let places = places(inputs::vehicle(plan, "the design")?);
        check(&inputs, samples)?;
        let axis = sampled(&inputs, samples);
        let held_constant = inputs::held_constant(plan);
        let plan = plan.clone().of_point(values).without_hover().with_measures(Vec::new());
        let plan =
            plan.crossed_with(axis.clone()).map_err(|error| UserError::new(error.to_string(), None))?;
        let mut run = rows(&plan, options, 0);
        let mut found: Vec<Row> = Vec::new();
        while let Some(batch) = run.next_batch()? {
            found.extend(batch.into_iter().filter_map(|outcome| match outcome {
                Outcome::Ran(row) => Some(row),
                Outcome::Excluded(_) => None,
            }));
            if stops(run.progress()) {
                return Ok(None);
            }
        }
        let is_periodic = |(_, row): &(usize, &Row)| row.status == Status::Periodic;
        let periodic: Vec<(usize, &Row)> = found.iter().enumerate().filter(is_periodic).collect();
        let unused = unused(&found);
        let terms = terms(inputs.len()).len();
        if periodic.len() < needed(terms) {
            let rows = match periodic.len() {
                0 => format!("none of the {samples}"),
                some => format!("only {some} of the {samples}"),
            };
            let message = format!(
                "{rows} rows are periodic, too few for {terms} coefficients per component: {}{}",
                statuses(&unused),
                because(found.iter().find_map(|row| row.reason.as_deref()))
            );
            return Err(UserError::new(message, Some(NARROWER)).into());
        }
        let point = |(index, _): &(usize, &Row)| axis.iter().map(|(_, list)| list[*index]).collect();
        let points: Vec<Vec<f64>> = periodic.iter().map(point).collect();
        let wrench = |(_, row): &(usize, &Row)| places.map(|place| row.measures[place]);
        let wrenches: Vec<[f64; 6]> = periodic.iter().map(wrench).collect();
        let floquet_max = periodic.iter().map(|(_, row)| row.floquet_max).fold(f64::NAN, f64::max);
        let Some(map) = WrenchMap::fitted_to(inputs, &points, &wrenches) else {
            let message = "the periodic rows do not determine all coefficients".to_owned();
            return Err(UserError::new(message, Some(NARROWER)).into());
        };
        Ok(Some(WrenchMap { unused, floquet_max, held_constant, ..map }))
    }

    /// Fits a map to the forces and torques in `wrenches`. The `points` contain the values of the inputs
    /// (SI). Every fifth point is left out of the fit. Returns `None` if the points do not determine the
    /// coefficients.
    fn fitted_to(inputs: Vec<MapInput>, points: &[Vec<f64>], wrenches: &[[f64; 6]]) -> Option<WrenchMap> {
        let is_left_out = |place: &usize| place % LEFT_OUT == LEFT_OUT - 1;
        let (tested, fitted): (Vec<usize>, Vec<usize>) = (0..points.len()).partition(is_left_out);
        let count = terms(inputs.len()).len();
        let mut map = WrenchMap {
            inputs,
            scaled: DMatrix::zeros(6, count),
            r_squared: [f64::NAN; 6],
            largest_error: [0.0; 6],
            fitted: fitted.len(),
            left_out: tested.len(),
            unused: Vec::new(),
            floquet_max: f64::NAN,
            held_constant: None,
        };
        let lines: Vec<DVector<f64>> = fitted.iter().map(|&place| map.monomials(&points[place])).collect();
        let matrix = DMatrix::from_fn(fitted.len(), count, |i, j| lines[i][j]);
        let sides = DMatrix::from_fn(fitted.len(), 6, |i, j| wrenches[fitted[i]][j]);
        map.scaled = least_squares(matrix, &sides)?.transpose();
        let largest = wrenches.iter().flatten().fold(0.0, |one: f64, other| one.max(other.abs()));
        let computed: Vec<[f64; 6]> = tested.iter().map(|&place| map.evaluate(&points[place])).collect();
        for component in 0..6 {
            let exact: Vec<f64> = tested.iter().map(|&place| wrenches[place][component]).collect();
            let mean = exact.iter().sum::<f64>() / exact.len() as f64;
            let errors = computed.iter().zip(&exact).map(|(computed, exact)| computed[component] - exact);
            let errors: Vec<f64> = errors.collect();
            map.largest_error[component] = errors.iter().fold(0.0, |one: f64, error| one.max(error.abs()));
            let all = wrenches.iter().map(|wrench| wrench[component]);
            let spread = all.fold(0.0, |one: f64, value| one.max((value - mean).abs()));
            if spread > CONSTANT * largest {
                let total: f64 = exact.iter().map(|exact| (exact - mean) * (exact - mean)).sum();
                let squares: f64 = errors.iter().map(|error| error * error).sum();
                map.r_squared[component] = 1.0 - squares / total.max(f64::MIN_POSITIVE);
            }
        }
        Some(map)
    }

    /// Returns the mean force (mN) and torque (uN·m) that the map gives. `inputs` contains one value for each
    /// input (SI).
    ///
    /// If a value is outside of the input's range, the map extrapolates and may be inaccurate.
    pub fn evaluate(&self, inputs: &[f64]) -> [f64; 6] {
        let wrench = &self.scaled * self.monomials(inputs);
        core::array::from_fn(|component| wrench[component])
    }

    /// Returns the value of each polynomial term. `values` contains one value for each input (SI).
    fn monomials(&self, values: &[f64]) -> DVector<f64> {
        let scaled: Vec<f64> = (self.inputs.iter().zip(values))
            .map(|(input, value)| (value - input.centre()) / input.half_range())
            .collect();
        let terms = terms(self.inputs.len());
        DVector::from_iterator(
            terms.len(),
            terms.iter().map(|term| term.iter().map(|&input| scaled[input]).product()),
        )
    }

    /// Returns the coefficients for unscaled inputs in SI units. The order of the coefficients is the same as in
    /// [`WrenchMap::scaled`].
    pub fn physical(&self) -> DMatrix<f64> {
        let terms = terms(self.inputs.len());
        let place = |wanted: &[usize]| terms.iter().position(|term| term == wanted).unwrap_or_default();
        // s = slope * input + shift.
        let slope = |input: usize| 1.0 / self.inputs[input].half_range();
        let shift = |input: usize| -self.inputs[input].centre() / self.inputs[input].half_range();
        let mut physical = DMatrix::zeros(6, terms.len());
        for component in 0..6 {
            let mut add = |term: &[usize], number: f64| physical[(component, place(term))] += number;
            for (term, &number) in terms.iter().zip(self.scaled.row(component).iter()) {
                match **term {
                    [] => add(&[], number),
                    [j] => {
                        add(&[], number * shift(j));
                        add(&[j], number * slope(j));
                    }
                    [j, k] => {
                        add(&[], number * shift(j) * shift(k));
                        add(&[j], number * slope(j) * shift(k));
                        add(&[k], number * shift(j) * slope(k));
                        add(&[j, k], number * slope(j) * slope(k));
                    }
                    _ => {}
                }
            }
        }
        physical
    }

    /// Returns warnings for the user, for example about rows without a periodic motion, or about components
    /// for which the map is poor.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        warnings.extend(self.held_constant.map(str::to_owned));
        let unused: usize = self.unused.iter().map(|(_, rows)| rows).sum();
        if unused > 0 {
            warnings.push(format!(
                "{unused} of {} have no periodic motion and are not used: {}",
                text::count((self.fitted + self.left_out + unused) as u64, "row"),
                statuses(&self.unused)
            ));
        }
        let poor = COMPONENTS.into_iter().zip(self.r_squared).filter(|(_, r_squared)| *r_squared < POOR);
        let poor: Vec<&str> = poor.map(|(name, _)| name).collect();
        if !poor.is_empty() {
            let poor = poor.join(", ");
            warnings
                .push(format!("the map is poor, with R^2 below {POOR}, for {poor}: choose narrower ranges"));
        }
        if self.floquet_max > STEEP {
            warnings.push(format!(
                "the largest Floquet multiplier of the rows is {:.2}, more than {STEEP}: near a steep flank of the response, \
                 maps are poor",
                self.floquet_max
            ));
        }
        let terms = terms(self.inputs.len());
        let least = CONSTANT * self.scaled.amax();
        for (place, MapInput { name, .. }) in self.inputs.iter().enumerate() {
            let mut own =
                terms.iter().zip(self.scaled.column_iter()).filter(|(term, _)| term.contains(&place));
            if own.all(|(_, coefficients)| coefficients.amax() <= least) {
                warnings.push(format!("the input `{name}` changes neither force nor torque"));
            }
        }
        warnings
    }

    /// Returns one list for each polynomial term (see [`terms`]), with the exponent of each input in this
    /// term.
    pub fn powers(&self) -> Vec<Vec<usize>> {
        let inputs = 0..self.inputs.len();
        let power = |term: &[usize], input| term.iter().filter(|&&factor| factor == input).count();
        let powers = |term: &Vec<usize>| inputs.clone().map(|input| power(term, input)).collect();
        terms(inputs.len()).iter().map(powers).collect()
    }

    /// Returns the number of rows in the fit (`fitted`) and left out of the fit (`left_out`). The list
    /// continues with the number of unused rows for each status.
    pub fn rows(&self) -> Vec<(&'static str, usize)> {
        let unused = self.unused.iter().map(|(status, rows)| (status.name(), *rows));
        [("fitted", self.fitted), ("left_out", self.left_out)].into_iter().chain(unused).collect()
    }
}

/// Returns the terms of a quadratic polynomial. `inputs` is the number of variables. Each term is the list of
/// the variables that are multiplied.
///
/// The terms are in the order 1, s1, s2, ..., s1², s1 s2, s1 s3, ..., s2², s2 s3, ...
pub fn terms(inputs: usize) -> Vec<Vec<usize>> {
    let linear = (0..inputs).map(|j| vec![j]);
    let quadratic = (0..inputs).flat_map(|j| (j..inputs).map(move |k| vec![j, k]));
    std::iter::once(Vec::new()).chain(linear).chain(quadratic).collect()
}

/// Returns the smallest number of rows that is sufficient to fit and test a map with this number of terms.
fn needed(terms: usize) -> usize {
    // Of each LEFT_OUT rows, LEFT_OUT - 1 are in the fit.
    (terms + (terms - 1) / (LEFT_OUT - 1)).max(FEWEST_SAMPLES)
}

fn check(inputs: &[MapInput], samples: u32) -> Result<(), UserError> {
    let (most, given) = (WrenchMap::MOST_INPUTS, inputs.len());
    if given == 0 || given > most {
        return Err(UserError::new(format!("a wrench map needs 1 to {most} inputs, not {given}"), None));
    }
    for (place, input) in inputs.iter().enumerate() {
        if inputs[..place].iter().any(|other| other.parameter == input.parameter) {
            return Err(inputs::twice(&input.name));
        }
    }
    let most = WrenchMap::MOST_SAMPLES;
    if samples > most {
        let help = "a few hundred samples are usual for four inputs";
        let message = format!("{samples} samples are too many: at most {most} are allowed");
        return Err(UserError::new(message, Some(help)));
    }
    let terms = terms(given).len();
    let needed = needed(terms);
    if (samples as usize) < needed {
        let help = "compute more samples, or leave out inputs; 200 or more samples are usual for four inputs";
        let message = format!(
            "{samples} samples are too few for {terms} coefficients per component: at least {needed} are needed"
        );
        return Err(UserError::new(message, Some(help)));
    }
    Ok(())
}

/// Returns the parameter index of each input, with the values of the input in all samples.
fn sampled(inputs: &[MapInput], samples: u32) -> Vec<(usize, Vec<f64>)> {
    let sample = SamplePoints::new(Method::Sobol, SEED, samples.into(), inputs.len());
    let values = |dimension: usize, input: &MapInput| {
        let distribution = Distribution::Uniform { from: input.from, to: input.to };
        let coordinates = (0..sample.count()).map(|index| sample.coordinate(index, dimension));
        coordinates.map(|coordinate| distribution.quantile(coordinate)).collect()
    };
    inputs.iter().enumerate().map(|(place, input)| (input.parameter, values(place, input))).collect()
}

/// Counts the rows without a periodic motion, separately for each status.
fn unused(rows: &[Row]) -> Vec<(Status, usize)> {
    let others = Status::ALL.into_iter().filter(|status| *status != Status::Periodic);
    let counted = others.map(|status| (status, rows.iter().filter(|row| row.status == status).count()));
    counted.filter(|(_, rows)| *rows > 0).collect()
}

/// Returns the least-squares solution of an overdetermined linear system, or `None` if the solution is not
/// unique.
fn least_squares(matrix: DMatrix<f64>, sides: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let decomposed = matrix.svd(true, true);
    let singular = &decomposed.singular_values;
    let is_unique = singular.min() > SMALLEST_SINGULAR * singular.max();
    is_unique.then(|| decomposed.solve(sides, 0.0).ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs() -> Vec<MapInput> {
        let ranges = [(160.0, 200.0), (-20.0, 20.0), (-10.0, 30.0), (0.0, 0.1)];
        let input = |(parameter, (from, to))| MapInput { name: format!("s{parameter}"), parameter, from, to };
        ranges.into_iter().enumerate().map(input).collect()
    }

    fn points(inputs: &[MapInput], samples: u32) -> Vec<Vec<f64>> {
        let axis = sampled(inputs, samples);
        (0..samples as usize).map(|index| axis.iter().map(|(_, list)| list[index]).collect()).collect()
    }

    /// Returns a coefficient of a test polynomial, different for each component and term.
    fn quadratic(component: usize, term: usize) -> f64 {
        libm::sin(1.0 + 3.7 * component as f64 + 1.3 * term as f64)
    }

    #[test]
    fn terms_have_the_documented_order() {
        let order: [&[usize]; 6] = [&[], &[0], &[1], &[0, 0], &[0, 1], &[1, 1]];
        assert_eq!(terms(2), order);
        assert_eq!(terms(4).len(), 15);
        assert_eq!(terms(4)[5..10], [vec![0, 0], vec![0, 1], vec![0, 2], vec![0, 3], vec![1, 1]]);
    }

    #[test]
    fn a_quadratic_function_is_recovered() {
        let inputs = inputs();
        let points = points(&inputs, 200);
        let wrench = |point: &Vec<f64>| {
            let s: Vec<f64> =
                (inputs.iter().zip(point)).map(|(i, x)| (x - i.centre()) / i.half_range()).collect();
            core::array::from_fn(|component| {
                let values = terms(4).into_iter().enumerate();
                values
                    .map(|(place, term)| {
                        quadratic(component, place) * term.iter().map(|&j| s[j]).product::<f64>()
                    })
                    .sum()
            })
        };
        let wrenches: Vec<[f64; 6]> = points.iter().map(wrench).collect();
        let map = WrenchMap::fitted_to(inputs, &points, &wrenches).unwrap();
        assert_eq!((map.fitted, map.left_out), (160, 40));
        for component in 0..6 {
            for place in 0..15 {
                let error = map.scaled[(component, place)] - quadratic(component, place);
                assert!(error.abs() < 1e-12, "{component} {place}: {error}");
            }
        }
        assert!(map.r_squared.iter().all(|r_squared| (r_squared - 1.0).abs() < 1e-12));
        assert!(map.largest_error.iter().all(|error| *error < 1e-12));
    }

    #[test]
    fn physical_and_scaled_coefficients_give_the_same_values() {
        let inputs = inputs();
        let points = points(&inputs, 100);
        let scaled = DMatrix::from_fn(6, 15, quadratic);
        let map = WrenchMap {
            scaled,
            ..WrenchMap::fitted_to(inputs, &points, &vec![[1.0; 6]; points.len()]).unwrap()
        };
        let physical = map.physical();
        for point in &points {
            let monomials: Vec<f64> =
                terms(4).iter().map(|term| term.iter().map(|&j| point[j]).product()).collect();
            let wrench = map.evaluate(point);
            for (component, value) in wrench.iter().enumerate() {
                let other: f64 = physical.row(component).iter().zip(&monomials).map(|(c, x)| c * x).sum();
                assert!((other - value).abs() < 1e-11, "{component}: {other} {value}");
            }
        }
    }

    #[test]
    fn errors_come_from_rows_that_are_left_out() {
        let inputs = vec![MapInput { name: "s".to_owned(), parameter: 0, from: -1.0, to: 1.0 }];
        let points: Vec<Vec<f64>> = (0..10).map(|index| vec![f64::from(index) / 4.5 - 1.0]).collect();
        // Zero on the rows of the fit, but not on the others.
        let mut wrenches = vec![[0.0; 6]; 10];
        wrenches[4][0] = 3.0;
        wrenches[9][0] = 1.0;
        for wrench in &mut wrenches {
            wrench[1] = 2.0;
        }
        let map = WrenchMap::fitted_to(inputs, &points, &wrenches).unwrap();
        assert!(map.scaled.row(0).amax() < 1e-12);
        assert!((map.largest_error[0] - 3.0).abs() < 1e-12);
        // The mean is 2, so squares are 9 + 1 of the errors and 1 + 1 of the spread.
        assert!((map.r_squared[0] - (1.0 - 10.0 / 2.0)).abs() < 1e-12);
        // A constant component has no coefficient of determination.
        assert!(map.r_squared[1].is_nan());
        assert_eq!(
            map.warnings(),
            [
                "the map is poor, with R^2 below 0.99, for force_forward_mn: choose narrower ranges",
                "the input `s` changes neither force nor torque"
            ]
        );
    }

    /// A component is constant only if all rows are constant.
    #[test]
    fn a_component_that_is_constant_in_the_tested_rows_is_poor() {
        let inputs = vec![MapInput { name: "s".to_owned(), parameter: 0, from: -1.0, to: 1.0 }];
        let points: Vec<Vec<f64>> = (0..10).map(|index| vec![f64::from(index) / 4.5 - 1.0]).collect();
        let mut wrenches = vec![[0.0; 6]; 10];
        wrenches[2][0] = 3.0;
        wrenches[7][0] = -1.0;
        let map = WrenchMap::fitted_to(inputs, &points, &wrenches).unwrap();
        assert!(map.r_squared[0] < 0.0, "{}", map.r_squared[0]);
        assert!(map.r_squared[1].is_nan());
        assert!(map.warnings()[0].ends_with("for force_forward_mn: choose narrower ranges"));
    }

    #[test]
    fn points_on_a_line_do_not_determine_the_map() {
        let inputs: Vec<MapInput> = inputs().into_iter().take(2).collect();
        let points: Vec<Vec<f64>> = (0..50).map(|i| vec![160.0 + f64::from(i), f64::from(i)]).collect();
        assert!(WrenchMap::fitted_to(inputs, &points, &[[1.0; 6]; 50]).is_none());
    }

    #[test]
    fn the_smallest_number_of_samples_leaves_enough_rows_for_the_fit() {
        assert_eq!([3, 8, 9, 15, 28].map(needed), [10, 10, 11, 18, 34]);
    }
}
