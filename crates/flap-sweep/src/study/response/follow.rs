//! The way up and the way down a curve.
//!
//! Both go step by step at the same time. Where they have come to different motions at one end of a step and to the
//! same at the other, the step is halved, each half from its neighbour on its own way, until it is short.

use flap_core::simulate::{Point, Row, Status};

use super::compare::{Comparison, compare, sizes};
use super::curve::{Curve, Step};
use crate::plan::{Along, Plan};
use crate::resonance::study::Study;

/// A curve that is being followed.
pub(super) struct Follow<'a> {
    plan: &'a Plan,
    along: &'a Along,
    design: Point,
    /// Motions on the way up and on the way down, in the order in which they were run.
    up: Vec<Step>,
    down: Vec<Step>,
    stage: Stage,
}

/// The stage of the work.
enum Stage {
    /// Going up and down.
    Steps,
    /// Halving steps with an end of a bistable band in them.
    Edges(Vec<Edge>),
    /// The curve is complete.
    Done,
}

/// A step at one end of which the two ways have come to the same motion, and at the other not.
#[derive(Clone, Debug)]
struct Edge {
    /// The ends of the step, with the motion of the way up at the lower one, and that of the way down at the upper one.
    low: Step,
    high: Step,
    /// True if the motions are the same at the lower end.
    same_below: bool,
}

impl<'a> Follow<'a> {
    pub(super) fn new(plan: &'a Plan, along: &'a Along, design: Point) -> Follow<'a> {
        Follow { plan, along, design, up: Vec::new(), down: Vec::new(), stage: Stage::Steps }
    }

    pub(super) fn finish(mut self) -> Curve {
        for way in [&mut self.up, &mut self.down] {
            way.sort_by(|a, b| a.value.total_cmp(&b.value));
        }
        Curve { design: self.design, up: self.up, down: self.down, unstable: Vec::new() }
    }

    /// The point at `value`, begun where the motion of `from` has ended.
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

    /// The values of the next step up and down; `None` after the last.
    fn next_values(&self) -> Option<[f64; 2]> {
        let values = &self.along.values;
        let done = self.up.len();
        Some([*values.get(done)?, values[values.len() - 1 - done]])
    }

    /// The steps with an end of a bistable band in them.
    fn edges(&self) -> Vec<Edge> {
        let sizes = sizes(&self.up, &self.down);
        let down = || self.down.iter().rev();
        let compared: Vec<Comparison> =
            self.up.iter().zip(down()).map(|(up, down)| compare(&up.row, &down.row, &sizes)).collect();
        let down: Vec<&Step> = down().collect();
        let edge = |i: usize| {
            let ends = [compared[i], compared[i + 1]];
            let same_below = ends == [Comparison::Same, Comparison::Different];
            let is_edge = same_below || ends == [Comparison::Different, Comparison::Same];
            is_edge.then(|| Edge { low: self.up[i].clone(), high: down[i + 1].clone(), same_below })
        };
        (0..compared.len().saturating_sub(1)).filter_map(edge).collect()
    }

    /// The stage for those of `edges` that are not short enough; the last one if there are none.
    fn halve(&self, edges: Vec<Edge>) -> Stage {
        let long = |edge: &Edge| {
            let middle = edge.middle();
            // No finer than doubles can tell apart.
            let inside = edge.low.value < middle && middle < edge.high.value;
            inside && edge.high.value - edge.low.value > self.along.tolerance
        };
        let edges: Vec<Edge> = edges.into_iter().filter(long).collect();
        if edges.is_empty() { Stage::Done } else { Stage::Edges(edges) }
    }
}

impl Edge {
    fn middle(&self) -> f64 {
        0.5 * (self.low.value + self.high.value)
    }

    /// The half in which the end of the band is, given the motions in the middle.
    fn half(self, up: &Step, down: &Step, sizes: &[f64]) -> Edge {
        let same = compare(&up.row, &down.row, sizes) == Comparison::Same;
        if same == self.same_below {
            Edge { low: up.clone(), ..self }
        } else {
            Edge { high: down.clone(), ..self }
        }
    }
}

impl Study for Follow<'_> {
    fn probes(&mut self) -> Vec<Point> {
        match &self.stage {
            Stage::Steps => {
                let Some([up, down]) = self.next_values() else { return Vec::new() };
                vec![self.probe(up, self.up.last()), self.probe(down, self.down.last())]
            }
            Stage::Edges(edges) => {
                let both = |edge: &Edge| {
                    let middle = edge.middle();
                    [self.probe(middle, Some(&edge.low)), self.probe(middle, Some(&edge.high))]
                };
                edges.iter().flat_map(both).collect()
            }
            Stage::Done => Vec::new(),
        }
    }

    fn take(&mut self, rows: Vec<Row>) {
        let mut rows = rows.into_iter();
        match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Steps => {
                let Some([up, down]) = self.next_values() else { return };
                self.up.extend(rows.next().map(|row| Step { value: up, row }));
                self.down.extend(rows.next().map(|row| Step { value: down, row }));
                let last = self.next_values().is_none();
                self.stage = if last { self.halve(self.edges()) } else { Stage::Steps };
            }
            Stage::Edges(edges) => {
                let sizes = sizes(&self.up, &self.down);
                let mut halves = Vec::new();
                for edge in edges {
                    let value = edge.middle();
                    let (Some(up), Some(down)) = (rows.next(), rows.next()) else { return };
                    let [up, down] = [Step { value, row: up }, Step { value, row: down }];
                    halves.push(edge.half(&up, &down, &sizes));
                    self.up.push(up);
                    self.down.push(down);
                }
                self.stage = self.halve(halves);
            }
            Stage::Done => {}
        }
    }
}
