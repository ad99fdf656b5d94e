//! The response of one design, and the comparison of the motions of the upward and the downward branch.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

use crate::plan::{Along, Plan};
use crate::table::layout::{Cell, Layout, Place};

/// One motion of a response, at one value of the parameter of the response.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Value of the parameter of the response.
    pub value: f64,
    /// Row with the status and the measures of the motion.
    pub row: Row,
}

/// The response of one design: its motions while a parameter rises and falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Parameter values of the design.
    pub design: Point,
    /// Motions on the upward branch, in ascending order of the parameter of the response.
    pub up: Vec<Step>,
    /// Motions on the downward branch at the same parameter values as `up`, also in ascending order.
    pub down: Vec<Step>,
    /// Unstable orbits, if the user requested them. In each bistable band, the unstable orbits begin near the
    /// end of the upward branch and end near the end of the downward branch. From orbit to orbit, the
    /// parameter usually decreases.
    pub unstable: Vec<Step>,
    /// Largest magnitude of each state component on both branches (see [`component_sizes`]).
    pub(super) sizes: Vec<f64>,
    /// For each value of the parameter, the result of comparing the motions of the upward and the downward
    /// branch.
    pub(super) comparisons: Vec<Comparison>,
}

/// Returns the size of each state component: its largest magnitude in the periodic motions of both branches.
pub(super) fn component_sizes(up: &[Step], down: &[Step]) -> Vec<f64> {
    let mut sizes: Vec<f64> = Vec::new();
    let motions = up.iter().chain(down).map(|step| &step.row);
    for row in motions.filter(|row| row.status == Status::Periodic) {
        sizes.resize(sizes.len().max(row.state.len()), 0.0);
        for (size, y) in sizes.iter_mut().zip(&row.state) {
            *size = size.max(y.abs());
        }
    }
    sizes
}

impl Curve {
    /// Returns a response with the given branches and without unstable orbits. The motions of both branches
    /// must be in ascending order of the parameter.
    pub(super) fn new(design: Point, up: Vec<Step>, down: Vec<Step>) -> Curve {
        let sizes = component_sizes(&up, &down);
        let pairs = up.iter().zip(&down);
        let comparisons = pairs.map(|(up, down)| compare(&up.row, &down.row, &sizes)).collect();
        Curve { design, up, down, unstable: Vec::new(), sizes, comparisons }
    }

    /// Returns the response of a design whose parameter values are impossible: all rows have the status
    /// `invalid`.
    pub(super) fn impossible(along: &Along, design: Point, reason: &Invalid) -> Curve {
        let step = |value: &f64| Step { value: *value, row: Row::invalid(reason.clone()) };
        let up: Vec<Step> = along.values.iter().map(step).collect();
        Curve::new(design, up.clone(), up)
    }

    /// If the parameter values of the design are impossible at every value of the parameter of the response,
    /// returns the reason.
    pub fn invalid(&self) -> Option<&str> {
        let all = self.up.iter().all(|step| step.row.status == Status::Invalid);
        self.up.first().filter(|_| all)?.row.reason.as_deref()
    }

    /// Returns the cells and the row of each motion, for the columns of `layout`. `layout` must be the layout
    /// of `plan`. Derived parameters are computed again for each motion.
    ///
    /// The upward branch comes first in ascending order, then the downward branch in descending order, then the
    /// unstable orbits.
    pub fn rows<'p>(&self, plan: &Plan, layout: &Layout<'p>) -> impl Iterator<Item = (Vec<Cell<'p>>, &Row)> {
        let bistable = self.bistable();
        let up = self.up.iter().zip(bistable.clone()).map(|(step, bistable)| ("up", step, bistable));
        let down = self.down.iter().zip(bistable).rev().map(|(step, bistable)| ("down", step, bistable));
        let unstable = self.unstable.iter().map(|step| ("unstable", step, None));
        up.chain(down).chain(unstable).map(move |(branch, Step { value, row }, bistable)| {
            let place = Place { branch, value: *value, bistable };
            let values = match plan.followed() {
                Some(along) => along.values_at(plan, &self.design, *value),
                None => self.design.values.clone(),
            };
            let point = Point::at_rest(self.design.index, values);
            (layout.cells_at(&point, Some(place), row), row)
        })
    }

    /// Returns one element for each parameter value: true if the two branches have different motions, and
    /// false if the motions are the same. The element is `None` if neither motion repeats every drive period.
    fn bistable(&self) -> Vec<Option<bool>> {
        let bistable = |comparison: &Comparison| match comparison {
            Comparison::Same => Some(false),
            Comparison::Different => Some(true),
            Comparison::Irregular => None,
        };
        self.comparisons.iter().map(bistable).collect()
    }
}

/// Two periodic motions count as the same motion if no state component differs by more than this fraction of
/// its largest magnitude. The states are compared at the beginning of a drive period.
///
/// flap reports bistability only if the states of the two motions differ. The column `bistable`, the pictures
/// and the live page show the result of comparing the states. The comparison uses states and not measures,
/// because two different motions may have equal values of a measure.
const DIFFERENT: f64 = 1e-2;

/// The step between two parameter values is steep if a state component changes by more than this fraction of
/// its largest magnitude.
const STEEP: f64 = 0.1;

/// Result of the comparison of two motions at the same drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    /// Both motions are the same orbit.
    Same,
    /// The motions are two different orbits, or only one of the two motions repeats every drive period.
    Different,
    /// Neither motion repeats every drive period.
    Irregular,
}

/// Compares two motions at the same drive. `sizes` contains the size of each state component.
pub(super) fn compare(up: &Row, down: &Row, sizes: &[f64]) -> Comparison {
    let are_near = || !differ(up, down, sizes, DIFFERENT);
    match (up.status, down.status) {
        // Near the end of a branch motions settle slowly. An unsettled motion close to an orbit counts as this orbit.
        (Status::Periodic, Status::Periodic | Status::Unsettled) | (Status::Unsettled, Status::Periodic)
            if are_near() =>
        {
            Comparison::Same
        }
        (Status::Periodic, _) | (_, Status::Periodic) => Comparison::Different,
        _ => Comparison::Irregular,
    }
}

/// Returns true if the response is steep between two motions: a state component changes by more than the
/// fraction [`STEEP`] of its size. `sizes` contains the size of each state component.
pub(super) fn is_steep(low: &Row, high: &Row, sizes: &[f64]) -> bool {
    differ(low, high, sizes, STEEP)
}

/// Returns true if a state component of two motions differs by more than the fraction `share` of its size.
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
