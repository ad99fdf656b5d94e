//! The comparison of motions at the same drive.

use flap_core::simulate::{Row, Status};

use super::curve::Step;

/// Periodic motions are different if a component of the state at the beginning of a period differs by more than this, as a
/// share of the largest that the component is anywhere on the curve.
const DIFFERENT: f64 = 1e-2;

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

/// The sizes of the state's components: the largest value of each on a curve.
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

/// Compares two motions at the same drive, given the sizes of the state's components.
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
