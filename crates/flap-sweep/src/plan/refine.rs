//! Adaptive refinement of a grid: settings of [`crate::refine`].

use flap_core::parameter::{Kind, Parameter, Range};

use super::axes::{Axis, Values};

/// Refinement of a grid: after the points of the axes, points are added where interpolation between rows has a large
/// error.
#[derive(Clone, Debug, PartialEq)]
pub struct Refine {
    /// Measures whose interpolation error is limited; at least one measure.
    pub measures: Vec<Limit>,
    /// Indices of the refined axes, in ascending order; at least one axis. Every combination of the other axes is a
    /// separate map.
    pub along: Vec<usize>,
    /// Largest number of points, including the points of the axes.
    pub max_points: u64,
    /// Largest number of halvings of a cell of the axes along each axis.
    pub halvings: u32,
}

impl Refine {
    /// Largest accepted number of points. The number of points is limited because all points are held in memory.
    pub const MOST_POINTS: u64 = 1_000_000;

    /// Largest number of refined axes: with six axes, a box has 2^6 corners.
    pub const MOST_AXES: usize = 6;

    /// Largest accepted number of halvings.
    pub const MOST_HALVINGS: u32 = 20;

    /// Default number of halvings: to 1/64 of a cell.
    pub const HALVINGS: u32 = 6;
}

/// A measure and the largest allowed error of its interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the column.
    pub column: String,
    /// Largest error.
    pub error: Error,
}

/// Largest error of an interpolated measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error {
    /// Fraction of the range of the measure over all rows.
    Share(f64),
    /// Number in the unit of the column.
    Absolute(f64),
}

/// Returns the reason why no points can be added along an axis, in words; `None` if points can be added.
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
