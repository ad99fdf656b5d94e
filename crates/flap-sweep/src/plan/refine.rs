//! Settings of the adaptive refinement of a grid. The module [`crate::refine`] computes the refinement.

use flap_core::parameter::{Kind, Parameter, Range};

use super::axes::{Axis, Values};

/// Settings of a refinement, which adds points where linear interpolation between rows has a large error.
#[derive(Clone, Debug, PartialEq)]
pub struct Refine {
    /// Measures whose interpolation error is limited. The list contains at least one measure.
    pub measures: Vec<Limit>,
    /// Indices of the axes along which points are added, in ascending order. For every combination of values
    /// of the axes that are not in this list, points are added separately.
    pub along: Vec<usize>,
    /// Largest number of points, including the points of the axes.
    pub max_points: u64,
    /// Largest number of times that the interval between two neighbouring values of an axis is halved.
    pub halvings: u32,
}

impl Refine {
    /// Largest accepted number of points. The number of points is limited because all points are stored in
    /// memory.
    pub const MOST_POINTS: u64 = 1_000_000;

    /// Largest number of axes along which points are added. A box with six axes has 2^6 = 64 corners, and
    /// each corner is a point.
    pub const MOST_AXES: usize = 6;

    /// Largest allowed value of `halvings`.
    pub const MOST_HALVINGS: u32 = 20;

    /// Default number of halvings. Six halvings divide the interval between two values of an axis into 64
    /// parts.
    pub const HALVINGS: u32 = 6;
}

/// A measure and the largest allowed error of its interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the column.
    pub column: String,
    /// Largest allowed error of the interpolation.
    pub error: Error,
}

/// Largest allowed error of an interpolated measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error {
    /// The largest allowed error is a fraction of the difference between the largest and the smallest value
    /// of the measure in all rows.
    Share(f64),
    /// The largest allowed error is a number in the unit of the measure.
    Absolute(f64),
}

/// Returns text with the reason why no points can be added along an axis. If points can be added, returns
/// `None`.
pub fn not_refined(axis: &Axis, parameters: &[Parameter<'_>]) -> Option<&'static str> {
    const ORDER: &str = "its axis needs two or more values that rise or fall";
    let [(parameter, values)] = axis.parameters() else {
        return Some("it varies together with other parameters");
    };
    match parameters[*parameter].kind {
        Kind::Choice(_) => return Some("its values are options"),
        Kind::Number(Range::Whole(..)) | Kind::Following(Range::Whole(..), _) => {
            return Some("its values are whole numbers");
        }
        Kind::Number(_) | Kind::Following(..) => {}
    }
    match values {
        Values::Sampled { .. } | Values::Correlated { .. } | Values::Unchecked(_) => Some("it is sampled"),
        Values::List(list) => {
            let ordered = list.is_sorted_by(|a, b| a < b) || list.is_sorted_by(|a, b| a > b);
            (list.len() < 2 || !ordered).then_some(ORDER)
        }
        Values::Linear { .. } | Values::Step { .. } | Values::Log { .. } => {
            (values.len() < 2).then_some(ORDER)
        }
    }
}
