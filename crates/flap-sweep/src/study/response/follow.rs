//! Computes the upward and the downward branch of a response.
//!
//! First, both branches are computed at the given values of the parameter, one value after the other. Then
//! two kinds of steps between neighbouring values are halved, until each of these steps is at most as long as
//! the tolerance. At the value in the middle of a step, the motion of each branch starts from the
//! neighbouring motion on this branch. The following kinds of steps are halved:
//!
//! - Steps that contain an end of a bistable band, because both branches have the same motion at only one end
//!   of the step.
//! - Steps in which the state changes much, because these steps may contain a narrow band of hysteresis.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

use super::curve::{Comparison, Curve, Step, compare, component_sizes, is_steep};
use crate::plan::{Along, Plan};
use crate::resonance::sequence::{Exchange, Sequence};

/// Computes the response of one design.
pub(super) struct Follow<'a> {
    plan: &'a Plan,
    along: &'a Along,
    design: Point,
    /// Motions on the upward branch, in the order in which they were computed.
    up: Vec<Step>,
    /// Motions on the downward branch, in the order in which they were computed.
    down: Vec<Step>,
}

/// A step between two neighbouring values of the parameter of the response.
#[derive(Clone, Debug)]
struct Interval {
    /// The motion of the upward branch at the smaller of the two parameter values.
    low: Step,
    /// The motion of the downward branch at the larger of the two parameter values.
    high: Step,
    /// One flag for the smaller value and one for the larger value: true if both branches have the same
    /// motion at this value.
    same: [bool; 2],
}

impl<'a> Follow<'a> {
    pub(super) fn new(plan: &'a Plan, along: &'a Along, design: Point) -> Follow<'a> {
        Follow { plan, along, design, up: Vec::new(), down: Vec::new() }
    }

    /// Returns a computation of the response that can pause. The computation pauses while the lanes compute
    /// the rows of its next points.
    pub(super) fn sequence(self) -> Sequence<'a, Curve> {
        Sequence::new(|exchange| async move { self.run(&exchange).await })
    }

    async fn run(mut self, exchange: &Exchange) -> Curve {
        let values = &self.along.values;
        for (&up, &down) in values.iter().zip(values.iter().rev()) {
            let points = vec![self.point_at(up, self.up.last()), self.point_at(down, self.down.last())];
            let mut rows = self.rows(exchange, points).await.into_iter();
            self.up.extend(rows.next().map(|row| Step { value: up, row }));
            self.down.extend(rows.next().map(|row| Step { value: down, row }));
        }
        let mut intervals = self.intervals();
        loop {
            let sizes = component_sizes(&self.up, &self.down);
            intervals
                .retain(|interval| interval.is_open(&sizes) && interval.is_longer_than(self.along.tolerance));
            if intervals.is_empty() {
                break;
            }
            let both = |interval: &Interval| {
                [&interval.low, &interval.high].map(|end| self.point_at(interval.middle(), Some(end)))
            };
            let points = intervals.iter().flat_map(both).collect();
            let mut rows = self.rows(exchange, points).await.into_iter();
            let mut halves = Vec::new();
            for interval in intervals {
                let value = interval.middle();
                let Some((up, down)) = rows.next().zip(rows.next()) else { break };
                let [up, down] = [up, down].map(|row| Step { value, row });
                halves.extend(interval.halves(&up, &down, &sizes));
                self.up.push(up);
                self.down.push(down);
            }
            intervals = halves;
        }
        for way in [&mut self.up, &mut self.down] {
            way.sort_by(|a, b| a.value.total_cmp(&b.value));
        }
        Curve::new(self.design, self.up, self.down)
    }

    /// Computes the rows of points. If the parameter values of a point are impossible, its row contains the
    /// reason.
    async fn rows(&self, exchange: &Exchange, points: Vec<Point>) -> Vec<Row> {
        let invalid: Vec<_> = points.iter().map(|point| self.plan.invalid(&point.values)).collect();
        let possible = points.into_iter().zip(&invalid).filter(|(_, invalid)| invalid.is_none());
        let mut rows = exchange.rows(possible.map(|(point, _)| point).collect()).await.into_iter();
        let row = |invalid: Option<Invalid>| invalid.map(Row::invalid).or_else(|| rows.next());
        invalid.into_iter().filter_map(row).collect()
    }

    /// Returns the point at which the parameter of the response has the given value. The motion of the point
    /// starts from the settled state of the motion `from`.
    fn point_at(&self, value: f64, from: Option<&Step>) -> Point {
        let values = self.along.values_at(self.plan, &self.design, value);
        let begin = from.and_then(|step| match step.row.status {
            Status::Periodic | Status::Unstable | Status::Subharmonic | Status::Unsettled => {
                Some(step.row.state.clone())
            }
            Status::Diverged | Status::StepLimit | Status::Invalid => None,
        });
        Point { begin: begin.filter(|state| !state.is_empty()), ..Point::at_rest(0, values) }
    }

    /// Returns the steps between neighbouring values. A step is left out if it has an end at which neither
    /// the upward nor the downward branch repeats every drive period.
    fn intervals(&self) -> Vec<Interval> {
        let sizes = component_sizes(&self.up, &self.down);
        let places: Vec<(&Step, &Step, Comparison)> = (self.up.iter().zip(self.down.iter().rev()))
            .map(|(up, down)| (up, down, compare(&up.row, &down.row, &sizes)))
            .collect();
        let pairs = places.windows(2).filter(|ends| ends.iter().all(|end| end.2 != Comparison::Irregular));
        let interval = |ends: &[(&Step, &Step, Comparison)]| Interval {
            low: ends[0].0.clone(),
            high: ends[1].1.clone(),
            same: [0, 1].map(|end: usize| ends[end].2 == Comparison::Same),
        };
        pairs.map(interval).collect()
    }
}

impl Interval {
    fn middle(&self) -> f64 {
        0.5 * (self.low.value + self.high.value)
    }

    /// Returns true if the step contains an end of a bistable band, or may contain a whole band.
    fn is_open(&self, sizes: &[f64]) -> bool {
        match self.same {
            [true, true] => is_steep(&self.low.row, &self.high.row, sizes),
            [below, above] => below != above,
        }
    }

    fn is_longer_than(&self, tolerance: f64) -> bool {
        let (low, middle, high) = (self.low.value, self.middle(), self.high.value);
        // Limited by the resolution of doubles.
        low < middle && middle < high && high - low > tolerance
    }

    /// Divides the step into two halves. `up` and `down` are the motions of the upward and the downward
    /// branch in the middle of the step.
    fn halves(self, up: &Step, down: &Step, sizes: &[f64]) -> [Interval; 2] {
        let same = compare(&up.row, &down.row, sizes) == Comparison::Same;
        let [below, above] = self.same;
        [
            Interval { low: self.low, high: down.clone(), same: [below, same] },
            Interval { low: up.clone(), high: self.high, same: [same, above] },
        ]
    }
}
