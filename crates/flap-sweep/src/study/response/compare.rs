//! The comparison of motions, which decides where a design is bistable.

use flap_core::simulate::{Row, Status};

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
