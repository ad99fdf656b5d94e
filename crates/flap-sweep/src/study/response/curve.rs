//! The response of one design, and the comparison of its motions at the same drive.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

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
    sizes(up.iter().chain(down).map(|step| &step.row))
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

/// Periodic motions are different if a component of the state at the beginning of a period differs by more than this, as a
/// share of the largest absolute value of the component on the curve.
///
/// This is the only definition of bistability: the column `bistable` of the rows has its result, which pictures and the
/// live page show. It compares states, because a measure may have the same value in two motions.
const DIFFERENT: f64 = 1e-2;

/// A response is steep in a step if a component of the state changes by more than this across the step, as the same share.
const STEEP: f64 = 0.1;

/// The comparison of two motions at the same drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    /// The same orbit.
    Same,
    /// Two orbits, or an orbit and a motion that is not periodic with the drive.
    Different,
    /// Neither is periodic with the drive.
    Irregular,
}

/// The sizes of the state's components: the largest absolute value of each in the motions of a curve.
pub(super) fn sizes<'a>(motions: impl Iterator<Item = &'a Row>) -> Vec<f64> {
    let mut sizes: Vec<f64> = Vec::new();
    for row in motions.filter(|row| row.status == Status::Periodic) {
        sizes.resize(sizes.len().max(row.state.len()), 0.0);
        for (size, y) in sizes.iter_mut().zip(&row.state) {
            *size = size.max(y.abs());
        }
    }
    sizes
}

/// Compares two motions at the same drive, given the sizes of the state's components.
pub(super) fn compare(up: &Row, down: &Row, sizes: &[f64]) -> Comparison {
    let are_near = || !differ(up, down, sizes, DIFFERENT);
    match (up.status, down.status) {
        // Near the end of a branch motions settle slowly: one that is close to an orbit is on its way to it.
        (Status::Periodic, Status::Periodic | Status::Unsettled) | (Status::Unsettled, Status::Periodic)
            if are_near() =>
        {
            Comparison::Same
        }
        (Status::Periodic, _) | (_, Status::Periodic) => Comparison::Different,
        _ => Comparison::Irregular,
    }
}

/// True if the response is steep between two motions, given the sizes of the state's components.
pub(super) fn is_steep(low: &Row, high: &Row, sizes: &[f64]) -> bool {
    differ(low, high, sizes, STEEP)
}

/// True if a component of the states differs by more than a share of its size.
fn differ(one: &Row, other: &Row, sizes: &[f64], share: f64) -> bool {
    let mut pairs = one.state.iter().zip(&other.state).zip(sizes);
    pairs.any(|((one, other), size)| (one - other).abs() > share * size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(status: Status, state: [f64; 2]) -> Row {
        Row { status, state: state.to_vec(), ..Row::invalid("") }
    }

    #[test]
    fn a_motion_that_still_approaches_an_orbit_is_no_second_motion() {
        let orbit = row(Status::Periodic, [1.0, 0.5]);
        let compared =
            |other: &Row| [compare(&orbit, other, &[1.0, 1.0]), compare(other, &orbit, &[1.0, 1.0])];
        for (status, state, expected) in [
            (Status::Periodic, [1.009, 0.5], Comparison::Same),
            (Status::Periodic, [1.0, 0.52], Comparison::Different),
            (Status::Unsettled, [1.009, 0.5], Comparison::Same),
            (Status::Unsettled, [1.0, 0.52], Comparison::Different),
            (Status::Subharmonic, [1.0, 0.5], Comparison::Different),
        ] {
            assert_eq!(compared(&row(status, state)), [expected; 2], "{status:?} {state:?}");
        }
        let unsettled = row(Status::Unsettled, [1.0, 0.5]);
        assert_eq!(compare(&unsettled, &unsettled, &[1.0, 1.0]), Comparison::Irregular);
    }
}
