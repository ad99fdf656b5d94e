//! Response of one design, and the comparison of the two motions at the same drive.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status};

use crate::plan::{Along, Plan};
use crate::table::layout::{Cell, Layout, Place};

/// A motion on a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Value of the followed parameter.
    pub value: f64,
    /// Row of the motion.
    pub row: Row,
}

/// Response of one design.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Design.
    pub design: Point,
    /// Motions on the upward branch, in ascending order of the parameter.
    pub up: Vec<Step>,
    /// Motions on the downward branch at the values of `up`, also in ascending order.
    pub down: Vec<Step>,
    /// Unstable orbits, if computed. For each bistable band, the orbits lead from the end of the upward branch to the
    /// end of the downward branch. Along these orbits, the parameter decreases, and may increase again where the branch
    /// turns back.
    pub unstable: Vec<Step>,
    /// Sizes of the state's components, see [`component_sizes`].
    pub(super) sizes: Vec<f64>,
    /// Comparison of the motions of `up` and `down` at each value.
    pub(super) comparisons: Vec<Comparison>,
}

/// Returns the sizes of the state's components: the largest magnitude of each component on both branches.
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
    /// Returns the curve with the given branches, without unstable orbits. Both branches are in ascending order of the
    /// parameter.
    pub(super) fn new(design: Point, up: Vec<Step>, down: Vec<Step>) -> Curve {
        let sizes = component_sizes(&up, &down);
        let pairs = up.iter().zip(&down);
        let comparisons = pairs.map(|(up, down)| compare(&up.row, &down.row, &sizes)).collect();
        Curve { design, up, down, unstable: Vec::new(), sizes, comparisons }
    }

    /// Returns the curve of a design that cannot be run.
    pub(super) fn impossible(along: &Along, design: Point, reason: &Invalid) -> Curve {
        let step = |value: &f64| Step { value: *value, row: Row::invalid(reason.clone()) };
        let up: Vec<Step> = along.values.iter().map(step).collect();
        Curve::new(design, up.clone(), up)
    }

    /// Returns the reason why the design has no response, if the combination of its parameters is impossible at every
    /// value of the followed parameter.
    pub fn invalid(&self) -> Option<&str> {
        let all = self.up.iter().all(|step| step.row.status == Status::Invalid);
        self.up.first().filter(|_| all)?.row.reason.as_deref()
    }

    /// Returns the motions with the cells of the columns of `layout`, the layout of `plan`. Derived parameters have
    /// their values at each motion.
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

    /// Returns for each value true if the two branches have different motions; `None` if neither motion is periodic
    /// with the drive.
    fn bistable(&self) -> Vec<Option<bool>> {
        let bistable = |comparison: &Comparison| match comparison {
            Comparison::Same => Some(false),
            Comparison::Different => Some(true),
            Comparison::Irregular => None,
        };
        self.comparisons.iter().map(bistable).collect()
    }
}

/// Largest difference between equal periodic motions: of a state component at the beginning of a period, relative to
/// the component's largest magnitude on the curve.
///
/// This comparison is the only definition of bistability. The column `bistable` of the rows contains the result, which
/// pictures and the live page show. The comparison uses states, because a measure may have the same value in two
/// motions.
const DIFFERENT: f64 = 1e-2;

/// Relative change of a state component in one step, above which the response is steep.
const STEEP: f64 = 0.1;

/// Comparison of two motions at the same drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    /// Both motions are the same orbit.
    Same,
    /// The motions are two orbits, or an orbit and a motion that is not periodic with the drive.
    Different,
    /// Neither motion is periodic with the drive.
    Irregular,
}

/// Compares two motions at the same drive. `sizes` are the sizes of the state's components.
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

/// Returns true if the response is steep between two motions. `sizes` are the sizes of the state's components.
pub(super) fn is_steep(low: &Row, high: &Row, sizes: &[f64]) -> bool {
    differ(low, high, sizes, STEEP)
}

/// Returns true if a component of the states differs by more than a fraction of the component's size.
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
