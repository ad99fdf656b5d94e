//! Rows of a vehicle, computed from the rows of its wings.

use std::collections::{HashMap, VecDeque};

use super::layout::Vehicle;
use super::mount::MOST_WINGS;
use crate::model::Description;
use crate::num::Backend;
use crate::parameter::Invalid;
use crate::simulate::{
    Column, Experiments, Gradients, Jobs, LaneUse, Motions, Point, PointRun, Row, Rows, Simulator,
    SolverSettings, Status, Unfinished,
};

impl Rows for Vehicle {
    fn columns(&self) -> &[Column] {
        &self.columns.all
    }

    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        let solver = SolverSettings { loads: true, ..*solver };
        let mut wings =
            WingJobs { vehicle: self, jobs, waiting: VecDeque::new(), begun: HashMap::new(), next: 0 };
        self.model.run(backend, &solver, &mut wings);
    }

    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row {
        let mut wings = match Wings::new(self, run.values.to_vec(), begin) {
            Ok(wings) => wings,
            Err(invalid) => return Row::invalid(invalid),
        };
        let solver = SolverSettings { loads: true, ..*run.solver };
        for design in 0..wings.designs.len() {
            let Design { values, begin, .. } = &wings.designs[design];
            let run = PointRun { solver: &solver, values, ..*run };
            wings.designs[design].row = Some(self.model.run_point(&run, begin.as_deref()));
        }
        wings.row(self).unwrap_or_else(|| Row::invalid("interrupted"))
    }
}

impl Simulator for Vehicle {
    /// The presets are the presets of the model. The presets do not set the parameters that the vehicle adds,
    /// so these parameters have their defaults.
    fn description(&self) -> Description<'_> {
        Description {
            parameters: self.table.parameters(),
            loads: false,
            wing: None,
            ..self.model.description()
        }
    }

    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        Ok(self)
    }

    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        Err(Unfinished::no_motions("of a vehicle"))
    }

    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        Err(Unfinished::no_experiments("of a vehicle"))
    }
}

/// Parameter values of one wing, or of several equal wings, of a vehicle at a point.
struct Design {
    values: Vec<f64>,
    begin: Option<Vec<f64>>,
    row: Option<Row>,
}

/// Wings of a vehicle at a point.
struct Wings {
    values: Vec<f64>,
    designs: Vec<Design>,
    /// For each wing, the index of its design in `designs`.
    of_wing: Vec<usize>,
}

impl Wings {
    /// Returns the wings of a vehicle at a point. Wings with equal parameter values share one design.
    fn new(vehicle: &Vehicle, values: Vec<f64>, begin: Option<&[f64]>) -> Result<Wings, Invalid> {
        let states = vehicle.states.len() / vehicle.mounts.len();
        let mut wings = Wings { values, designs: Vec::new(), of_wing: Vec::new() };
        for (wing, mount) in vehicle.mounts.iter().enumerate() {
            let values = vehicle.table.of_wing(&wings.values, wing);
            let values = values.map_err(|invalid| Invalid::new(format!("wing {}: {invalid}", mount.name)))?;
            let begin = begin.map(|all| all.iter().copied().skip(wing * states).take(states).collect());
            let design = Design { values, begin, row: None };
            let same = wings.designs.iter().position(|other| other.is(&design));
            wings.of_wing.push(same.unwrap_or(wings.designs.len()));
            if same.is_none() {
                wings.designs.push(design);
            }
        }
        Ok(wings)
    }

    /// Returns the row of the vehicle, or `None` if the row of a wing is still missing.
    fn row(&self, vehicle: &Vehicle) -> Option<Row> {
        let rows: Option<Vec<&Row>> =
            self.of_wing.iter().map(|&design| self.designs[design].row.as_ref()).collect();
        let rows = rows?;
        let severity = |row: &Row| Status::ALL.iter().position(|status| *status == row.status);
        // The first of the wings with the worst status.
        let worst = (0..rows.len()).rev().max_by_key(|&wing| severity(rows[wing]))?;
        let largest = |value: fn(&Row) -> f64| rows.iter().map(|row| value(row)).fold(f64::NAN, f64::max);
        let settled = rows.iter().all(|row| !row.measures.is_empty());
        let known = rows.iter().all(|row| !row.state.is_empty());
        let longest = rows.iter().map(|row| row.period).max()?;
        // The motion of the vehicle repeats after the least common multiple of the periods of its wings.
        let is_common =
            |period: &u32| rows.iter().all(|row| row.period > 0 && period.is_multiple_of(row.period));
        let period = (1..=longest.pow(3)).map(|count| count * longest).find(is_common);
        let all = |is_known: bool, value: fn(&Row) -> f64| if is_known { largest(value) } else { f64::NAN };
        let measures: Vec<&[f64]> = rows.iter().map(|row| row.measures.as_slice()).collect();
        let designs = || self.designs.iter().filter_map(|design| design.row.as_ref());
        let reason = rows[worst].reason.as_ref();
        Some(Row {
            status: rows[worst].status,
            measures: if settled { vehicle.measures(&self.values, &measures) } else { Vec::new() },
            cycles: designs().map(|row| row.cycles).sum(),
            residual: all(known, |row| row.residual),
            period: period.unwrap_or(0),
            floquet_max: all(settled, |row| row.floquet_max),
            error_estimate: all(settled, |row| row.error_estimate),
            state: rows.iter().filter(|_| known).flat_map(|row| row.state.iter().copied()).collect(),
            rhs_evals: designs().map(|row| row.rhs_evals).sum(),
            reason: reason.map(|reason| format!("wing {}: {reason}", vehicle.mounts[worst].name)),
        })
    }
}

impl Design {
    /// Returns true if the values of both designs are equal to the last bit.
    fn is(&self, other: &Design) -> bool {
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
        bits(&self.values) == bits(&other.values)
            && self.begin.as_deref().map(bits) == other.begin.as_deref().map(bits)
    }
}

/// Source of the points that the wings' model computes. Each point of the vehicle needs one point for each
/// set of wings with equal parameter values.
struct WingJobs<'a> {
    vehicle: &'a Vehicle,
    jobs: &'a mut dyn Jobs,
    /// Points of wings that are not yet simulated. The index of a wing's point is composed of the number of the
    /// vehicle's point and the index of the design.
    waiting: VecDeque<Point>,
    /// Points of the vehicle whose row is not finished, by the number of the point. Each entry contains the
    /// wings of the point, and the index that `jobs` gave to the point.
    begun: HashMap<u64, (u64, Wings)>,
    /// Number of the next point of the vehicle.
    next: u64,
}

impl Jobs for WingJobs<'_> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        while self.waiting.is_empty() {
            let Point { index, values, begin } = self.jobs.next(idle)?;
            let wings = match Wings::new(self.vehicle, values, begin.as_deref()) {
                Ok(wings) => wings,
                Err(invalid) => {
                    self.jobs.done(index, Row::invalid(invalid));
                    continue;
                }
            };
            let first = self.next * MOST_WINGS as u64;
            for (number, design) in (first..).zip(&wings.designs) {
                let Design { values, begin, .. } = design;
                self.waiting.push_back(Point { index: number, values: values.clone(), begin: begin.clone() });
            }
            self.begun.insert(self.next, (index, wings));
            self.next += 1;
        }
        self.waiting.pop_front()
    }

    fn done(&mut self, index: u64, row: Row) {
        let most = MOST_WINGS as u64;
        let number = index / most;
        let Some((index_there, wings)) = self.begun.get_mut(&number) else { return };
        if let Some(design) =
            usize::try_from(index % most).ok().and_then(|design| wings.designs.get_mut(design))
        {
            design.row = Some(row);
        }
        if let Some(row) = wings.row(self.vehicle) {
            let index_there = *index_there;
            self.begun.remove(&number);
            self.jobs.done(index_there, row);
        }
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }

    fn occupied(&mut self, lanes: &LaneUse) {
        self.jobs.occupied(lanes);
    }
}
