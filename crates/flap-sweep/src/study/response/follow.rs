//! The way up and the way down a curve.
//!
//! Both go step by step at the same time. Where they have come to different motions at one end of a step and to the
//! same at the other, the step is halved, each half from its neighbour on its own way, until it is short.

use flap_core::simulate::{Point, Row, Status};

use super::{Along, Curve, Step, values};
use crate::plan::Plan;
use crate::resonance::study::{Probe, Study};

/// Periodic motions are different if a component of the state at the beginning of a period differs by more than this, as a
/// share of the largest that the component is anywhere on the curve.
const DIFFERENT: f64 = 1e-2;

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

/// What is being done.
enum Stage {
    /// Going up and down.
    Steps,
    /// Halving steps with an end of a bistable band in them.
    Edges(Vec<Edge>),
    /// Nothing.
    Done,
}

/// A step at one end of which the two ways have come to the same motion, and at the other not.
#[derive(Clone, Debug)]
struct Edge {
    /// Its ends, with the motion of the way up at the lower one, and that of the way down at the upper one.
    low: Step,
    high: Step,
    /// Whether the motions are the same at the lower end.
    same_below: bool,
}

/// How two motions at the same drive compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    /// The same orbit.
    Same,
    /// Two orbits, or an orbit and a motion that is not periodic with the drive.
    Different,
    /// Neither is periodic with the drive.
    Irregular,
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
    fn probe(&self, value: f64, from: Option<&Step>) -> Probe {
        let values = values(self.plan, self.along, &self.design, value);
        let begin = from.and_then(|step| match step.row.status {
            Status::Periodic | Status::Unstable | Status::Subharmonic | Status::Unsettled => {
                Some(step.row.state.clone())
            }
            Status::Diverged | Status::StepLimit | Status::Invalid => None,
        });
        Probe { values, begin: begin.filter(|state| !state.is_empty()) }
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

    /// Those of `edges` that are not short enough, or the end.
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
    fn probes(&mut self) -> Vec<Probe> {
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

/// How large the components of the state are on a curve.
pub(super) fn sizes(up: &[Step], down: &[Step]) -> Vec<f64> {
    let mut sizes: Vec<f64> = Vec::new();
    for step in up.iter().chain(down).filter(|step| step.row.status == Status::Periodic) {
        sizes.resize(sizes.len().max(step.row.state.len()), 0.0);
        for (size, y) in sizes.iter_mut().zip(&step.row.state) {
            *size = size.max(y.abs());
        }
    }
    sizes
}

/// Compares two motions at the same drive, given how large the components of the state are.
pub(super) fn compare(up: &Row, down: &Row, sizes: &[f64]) -> Comparison {
    match (up.status, down.status) {
        (Status::Periodic, Status::Periodic) => {
            let pairs = up.state.iter().zip(&down.state).zip(sizes);
            let same = pairs.into_iter().all(|((up, down), size)| (up - down).abs() <= DIFFERENT * size);
            if same { Comparison::Same } else { Comparison::Different }
        }
        (Status::Periodic, _) | (_, Status::Periodic) => Comparison::Different,
        _ => Comparison::Irregular,
    }
}
