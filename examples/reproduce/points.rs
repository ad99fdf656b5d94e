//! Design points, settled on lanes, and their responses to a parameter that is swept.

use flap_core::num::InstructionSet;
use flap_core::simulate::{Jobs, Point, Row, Simulator, SolverSettings, Status, by_name};

/// A model with the settings its points are run with.
pub(crate) struct Bench {
    pub(crate) model: &'static dyn Simulator,
    pub(crate) solver: SolverSettings,
}

/// A settled point.
pub(crate) struct Settled {
    model: &'static dyn Simulator,
    measures: Vec<f64>,
}

/// Settled points along a parameter.
pub(crate) struct Response {
    points: Vec<(f64, Settled)>,
}

impl Bench {
    /// The model called `name`. `settle_tol` is that of [`SolverSettings`]; the integrator is ten times stricter
    /// than by default, so that what is printed does not depend on it.
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

    /// The points with these parameter values, each settled.
    pub(crate) fn settle(&self, points: Vec<Vec<f64>>) -> Vec<Settled> {
        let mut list = List { rows: vec![None; points.len()], points: points.into_iter(), next: 0 };
        self.model.run(InstructionSet::best(), &self.solver, &mut list);
        list.rows
            .into_iter()
            .map(|row| {
                let row = row.expect("every point has a row");
                assert!(
                    row.status == Status::Periodic,
                    "a point of {} does not settle: {row:?}",
                    self.model.name()
                );
                Settled { model: self.model, measures: row.measures }
            })
            .collect()
    }

    /// One point.
    pub(crate) fn point(&self, values: Vec<f64>) -> Settled {
        self.settle(vec![values]).remove(0)
    }

    /// The response to `xs`, where `values` are the parameters for one of them.
    pub(crate) fn response(&self, xs: &[f64], values: impl Fn(f64) -> Vec<f64>) -> Response {
        let settled = self.settle(xs.iter().map(|&x| values(x)).collect());
        Response { points: xs.iter().copied().zip(settled).collect() }
    }
}

/// Numbers from `from` to `to` in steps.
pub(crate) fn steps(from: f64, to: f64, step: f64) -> Vec<f64> {
    let last = to + 0.5 * step;
    (0..10_000).map(|i| from + f64::from(i) * step).take_while(|x| *x < last).collect()
}

impl Settled {
    /// The measure in `column`.
    pub(crate) fn get(&self, column: &str) -> f64 {
        let index = self.model.columns().iter().position(|one| one.name == column);
        self.measures[index.unwrap_or_else(|| panic!("{} has no column {column}", self.model.name()))]
    }
}

impl Response {
    /// The values of a column with what they respond to.
    pub(crate) fn column(&self, column: &str) -> Vec<(f64, f64)> {
        self.points.iter().map(|(x, point)| (*x, point.get(column))).collect()
    }

    /// The point at which a column is largest, and its value along the axis.
    pub(crate) fn peak(&self, column: &str) -> (f64, &Settled) {
        let largest = self.points.iter().max_by(|a, b| a.1.get(column).total_cmp(&b.1.get(column)));
        largest.map(|(x, point)| (*x, point)).expect("a response has points")
    }

    /// The points at which a column is larger than at both neighbours.
    pub(crate) fn humps(&self, column: &str) -> Vec<f64> {
        let values = self.column(column);
        let tops = values.windows(3).filter(|three| three[1].1 > three[0].1 && three[1].1 > three[2].1);
        tops.map(|three| three[1].0).collect()
    }
}

/// Points given in order; rows kept by index.
struct List {
    points: std::vec::IntoIter<Vec<f64>>,
    next: u64,
    rows: Vec<Option<Row>>,
}

impl Jobs for List {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let values = self.points.next()?;
        self.next += 1;
        Some(Point::at_rest(self.next - 1, values))
    }

    fn done(&mut self, index: u64, row: Row) {
        self.rows[usize::try_from(index).expect("it is the index of a point")] = Some(row);
    }
}
