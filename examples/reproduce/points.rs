//! Settled motions of design points, and responses over a parameter.

use flap_core::num::Backend;
use flap_core::simulate::{
    Experiments, Motions, Point, Simulator, SolverSettings, Status, by_name, never, run_list,
};

/// A model, and the solver settings of its simulations.
pub(crate) struct Bench {
    pub(crate) model: &'static dyn Simulator,
    pub(crate) solver: SolverSettings,
}

/// The settled motion of a design point.
pub(crate) struct Settled {
    model: &'static dyn Simulator,
    measures: Vec<f64>,
}

/// A response: settled motions at several values of a parameter.
pub(crate) struct Response {
    points: Vec<(f64, Settled)>,
}

impl Bench {
    /// Returns the model `name` with solver settings. `settle_tol` is a setting of [`SolverSettings`]. The
    /// tolerance of the integrator is ten times smaller than the default, so that the printed digits do not
    /// depend on the tolerance.
    pub(crate) fn new(name: &str, settle_tol: f64) -> Bench {
        let model = by_name(name).expect("flap has this model");
        let solver = SolverSettings {
            rtol: 1e-7,
            atol: 1e-9,
            settle_tol,
            max_cycles: 4000,
            ..SolverSettings::default()
        };
        Bench { model, solver }
    }

    /// Returns the interface for single motions of the model.
    pub(crate) fn motions(&self) -> &'static dyn Motions {
        self.model.motions().expect("models of the papers have single motions")
    }

    /// Returns the interface for experiments with the model.
    pub(crate) fn experiments(&self) -> &'static dyn Experiments {
        self.model.experiments().expect("models of the papers know experiments")
    }

    /// Returns the settled motion of each design point. A point is given as a list of parameter values.
    pub(crate) fn settle(&self, points: Vec<Vec<f64>>) -> Vec<Settled> {
        let points = points.into_iter().map(|values| Point::at_rest(0, values)).collect();
        let rows = run_list(self.model, Backend::best(), &self.solver, points, &never);
        rows.expect("every point has a row")
            .into_iter()
            .map(|row| {
                assert!(
                    row.status == Status::Periodic,
                    "a point of {} does not settle: {row:?}",
                    self.model.name()
                );
                Settled { model: self.model, measures: row.measures }
            })
            .collect()
    }

    /// Returns the settled motion of one design point with the given parameter values.
    pub(crate) fn point(&self, values: Vec<f64>) -> Settled {
        self.settle(vec![values]).remove(0)
    }

    /// Returns the response at the values `xs` of a parameter. The function `values` returns all parameter
    /// values of a point for an element of `xs`.
    pub(crate) fn response(&self, xs: &[f64], values: impl Fn(f64) -> Vec<f64>) -> Response {
        let settled = self.settle(xs.iter().map(|&x| values(x)).collect());
        Response { points: xs.iter().copied().zip(settled).collect() }
    }
}

/// Returns numbers from `from` to `to` in steps of `step`.
pub(crate) fn steps(from: f64, to: f64, step: f64) -> Vec<f64> {
    let last = to + 0.5 * step;
    (0..10_000).map(|i| from + f64::from(i) * step).take_while(|x| *x < last).collect()
}

impl Settled {
    /// Returns the measure with the name `column`.
    pub(crate) fn get(&self, column: &str) -> f64 {
        let index = self.model.columns().iter().position(|one| one.name == column);
        self.measures[index.unwrap_or_else(|| panic!("{} has no column {column}", self.model.name()))]
    }
}

impl Response {
    /// Returns the values of a column over the response. Each value is paired with the value of the varied
    /// parameter.
    pub(crate) fn column(&self, column: &str) -> Vec<(f64, f64)> {
        self.points.iter().map(|(x, point)| (*x, point.get(column))).collect()
    }

    /// Returns the point at which a column is largest, and the value of the varied parameter at this point.
    pub(crate) fn peak(&self, column: &str) -> (f64, &Settled) {
        let largest = self.points.iter().max_by(|a, b| a.1.get(column).total_cmp(&b.1.get(column)));
        largest.map(|(x, point)| (*x, point)).expect("a response has points")
    }

    /// Returns the values of the varied parameter at which a column is larger than at the two neighbouring
    /// points.
    pub(crate) fn humps(&self, column: &str) -> Vec<f64> {
        let values = self.column(column);
        let tops = values.windows(3).filter(|three| three[1].1 > three[0].1 && three[1].1 > three[2].1);
        tops.map(|three| three[1].0).collect()
    }
}
