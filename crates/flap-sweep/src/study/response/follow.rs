//! The upward and the downward branch of a curve.
//!
//! The upward and the downward branch advance step by step at the same time. Afterwards, two kinds of steps are halved
//! until the steps are short. Each half of a step starts from the neighbouring motion on the same branch. The two
//! kinds of steps are:
//!
//! - Steps with equal motions of both branches at one end only.
//! - Steps in which the response is steep, because such steps may contain a narrow band of hysteresis.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

use super::curve::{Comparison, Curve, Step, compare, component_sizes, is_steep};
use crate::plan::{Along, Plan};
use crate::resonance::sequence::PointSequence;

/// The computation of a curve that is in progress.
pub(super) struct Follow<'a> {
    plan: &'a Plan,
    along: &'a Along,
    design: Point,
    /// Motions on the upward and the downward branch, in the order in which the motions were run.
    up: Vec<Step>,
    down: Vec<Step>,
    stage: Stage,
    /// For each of the latest points, the reason why the point cannot be run.
    invalid: Vec<Option<Invalid>>,
}

/// Stage of the computation of a curve.
enum Stage {
    /// The computation advances along both branches.
    Steps,
    /// Halving steps.
    Halves(Vec<Interval>),
    /// The curve is complete.
    Done,
}

/// A step between neighbouring values.
#[derive(Clone, Debug)]
struct Interval {
    /// Ends of the step, with the motion of the upward branch at the lower end and of the downward branch at the
    /// upper end.
    low: Step,
    high: Step,
    /// True for each end of the step at which both branches have the same motion.
    same: [bool; 2],
}

impl<'a> Follow<'a> {
    pub(super) fn new(plan: &'a Plan, along: &'a Along, design: Point) -> Follow<'a> {
        let stage = Stage::Steps;
        Follow { plan, along, design, up: Vec::new(), down: Vec::new(), stage, invalid: Vec::new() }
    }

    pub(super) fn finish(mut self) -> Curve {
        for way in [&mut self.up, &mut self.down] {
            way.sort_by(|a, b| a.value.total_cmp(&b.value));
        }
        Curve::new(self.design, self.up, self.down)
    }

    /// Returns the point at `value`, which begins at the final state of `from`.
    fn probe(&self, value: f64, from: Option<&Step>) -> Point {
        let values = self.along.values_at(self.plan, &self.design, value);
        let begin = from.and_then(|step| match step.row.status {
            Status::Periodic | Status::Unstable | Status::Subharmonic | Status::Unsettled => {
                Some(step.row.state.clone())
            }
            Status::Diverged | Status::StepLimit | Status::Invalid => None,
        });
        Point { begin: begin.filter(|state| !state.is_empty()), ..Point::at_rest(0, values) }
    }

    /// Returns the values of the next step up and down; `None` after the last step.
    fn next_values(&self) -> Option<[f64; 2]> {
        let values = &self.along.values;
        let done = self.up.len();
        Some([*values.get(done)?, values[values.len() - 1 - done]])
    }

    /// Returns the steps between the values, without steps next to motions that are not periodic with the drive.
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

    /// Returns the stage that halves the `intervals` that must be halved, or the last stage if no interval must be
    /// halved.
    fn halve(&self, mut intervals: Vec<Interval>) -> Stage {
        let sizes = component_sizes(&self.up, &self.down);
        intervals
            .retain(|interval| interval.is_open(&sizes) && interval.is_longer_than(self.along.tolerance));
        if intervals.is_empty() { Stage::Done } else { Stage::Halves(intervals) }
    }
}

impl Interval {
    fn middle(&self) -> f64 {
        0.5 * (self.low.value + self.high.value)
    }

    /// Returns true if the step contains an end of a bistable band, or may contain a band.
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

    /// Returns the two halves of the step, given the motions in the middle of the step.
    fn halves(self, up: &Step, down: &Step, sizes: &[f64]) -> [Interval; 2] {
        let same = compare(&up.row, &down.row, sizes) == Comparison::Same;
        let [below, above] = self.same;
        [
            Interval { low: self.low, high: down.clone(), same: [below, same] },
            Interval { low: up.clone(), high: self.high, same: [same, above] },
        ]
    }
}

impl Follow<'_> {
    /// Returns the points of the stage, including points that cannot be run.
    fn points(&self) -> Vec<Point> {
        match &self.stage {
            Stage::Steps => {
                let Some([up, down]) = self.next_values() else { return Vec::new() };
                vec![self.probe(up, self.up.last()), self.probe(down, self.down.last())]
            }
            Stage::Halves(intervals) => {
                let both = |interval: &Interval| {
                    let middle = interval.middle();
                    [self.probe(middle, Some(&interval.low)), self.probe(middle, Some(&interval.high))]
                };
                intervals.iter().flat_map(both).collect()
            }
            Stage::Done => Vec::new(),
        }
    }
}

impl PointSequence for Follow<'_> {
    fn probes(&mut self) -> Vec<Point> {
        loop {
            let points = self.points();
            self.invalid = points.iter().map(|point| self.plan.invalid(&point.values)).collect();
            let possible = points.into_iter().zip(&self.invalid).filter(|(_, invalid)| invalid.is_none());
            let possible: Vec<Point> = possible.map(|(point, _)| point).collect();
            if self.invalid.is_empty() || !possible.is_empty() {
                return possible;
            }
            self.take(Vec::new());
        }
    }

    /// `rows` has no rows for points that cannot be run.
    fn take(&mut self, rows: Vec<Row>) {
        let mut of_possible = rows.into_iter();
        let row = |invalid: Option<Invalid>| invalid.map(Row::invalid).or_else(|| of_possible.next());
        let mut rows = std::mem::take(&mut self.invalid).into_iter().map_while(row);
        match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Steps => {
                let Some([up, down]) = self.next_values() else { return };
                self.up.extend(rows.next().map(|row| Step { value: up, row }));
                self.down.extend(rows.next().map(|row| Step { value: down, row }));
                let last = self.next_values().is_none();
                self.stage = if last { self.halve(self.intervals()) } else { Stage::Steps };
            }
            Stage::Halves(intervals) => {
                let sizes = component_sizes(&self.up, &self.down);
                let mut halves = Vec::new();
                for interval in intervals {
                    let value = interval.middle();
                    let (Some(up), Some(down)) = (rows.next(), rows.next()) else { return };
                    let [up, down] = [Step { value, row: up }, Step { value, row: down }];
                    halves.extend(interval.halves(&up, &down, &sizes));
                    self.up.push(up);
                    self.down.push(down);
                }
                self.stage = self.halve(halves);
            }
            Stage::Done => {}
        }
    }
}
