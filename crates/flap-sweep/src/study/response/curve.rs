//! The response of one design.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

use super::compare::{self, Comparison, compare};
use crate::plan::Along;
use crate::table::layout::{Cell, Layout, Place};

/// A motion on a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Value of the parameter that rises and falls.
    pub value: f64,
    /// The motion.
    pub row: Row,
}

/// The response of one design.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The design.
    pub design: Point,
    /// The motions on the way up, by rising value.
    pub up: Vec<Step>,
    /// The motions on the way down, by rising value too: at the values of `up`.
    pub down: Vec<Step>,
    /// Unstable orbits, if they were looked for: for each bistable band, from the end of the upward branch to that of the
    /// downward one. Values fall and may turn.
    pub unstable: Vec<Step>,
}

/// The sizes of the state's components on the ways up and down.
pub(super) fn component_sizes(up: &[Step], down: &[Step]) -> Vec<f64> {
    compare::sizes(up.iter().chain(down).map(|step| &step.row))
}

impl Curve {
    /// The curve of a design that cannot be run.
    pub(super) fn impossible(along: &Along, design: Point, reason: &Invalid) -> Curve {
        let step = |value: &f64| Step { value: *value, row: Row::invalid(reason.clone()) };
        let up: Vec<Step> = along.values.iter().map(step).collect();
        Curve { design, down: up.clone(), up, unstable: Vec::new() }
    }

    /// The reason for which the design has no response, if its parameters are impossible together.
    pub fn invalid(&self) -> Option<&str> {
        let first = &self.up.first()?.row;
        if first.status == Status::Invalid { first.reason.as_deref() } else { None }
    }

    /// The motions with their cells under the columns of `layout`: the way up, by rising value, then the way down, by falling
    /// value, then the unstable orbits.
    pub fn rows(&self, layout: &Layout<'_>) -> impl Iterator<Item = (Vec<Cell<'static>>, &Row)> {
        let bistable = self.bistable();
        let up = self.up.iter().zip(bistable.clone()).map(|(step, bistable)| ("up", step, bistable));
        let down = self.down.iter().zip(bistable).rev().map(|(step, bistable)| ("down", step, bistable));
        let unstable = self.unstable.iter().map(|step| ("unstable", step, None));
        up.chain(down).chain(unstable).map(|(branch, Step { value, row }, bistable)| {
            let place = Place { branch, value: *value, bistable };
            (layout.cells_at(&self.design, Some(place), row), row)
        })
    }

    /// For each value, true if the two ways have different motions there; none if neither is periodic with the drive.
    fn bistable(&self) -> Vec<Option<bool>> {
        let sizes = component_sizes(&self.up, &self.down);
        let pairs = self.up.iter().zip(&self.down);
        pairs
            .map(|(up, down)| match compare(&up.row, &down.row, &sizes) {
                Comparison::Same => Some(false),
                Comparison::Different => Some(true),
                Comparison::Irregular => None,
            })
            .collect()
    }
}
