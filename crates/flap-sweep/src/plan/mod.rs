//! A plan contains the points of a checked grid file, and the settings for the computation of the points.
//!
//! - [`Plan`]: the checked contents of a grid file, and methods that return a changed plan.
//! - [`axes`]: values of varied parameters.
//! - [`sample`]: points that are spread over a design space.
//! - [`formula`]: derived parameters, conditions, the user's measures.
//! - [`gradient`]: derivatives of measures.
//! - [`refine`]: settings for the points that are added between the values of the axes.
//! - [`uncertainty`]: standard errors of parameters, and correlations between parameters.
//! - [`selection`]: selection of the points that flap computes.

mod admission;
pub mod axes;
mod change;
pub mod formula;
pub mod gradient;
pub mod refine;
mod robot;
pub mod sample;
pub mod selection;
mod space;
pub mod uncertainty;
mod value;

pub use admission::Admission;
pub(crate) use admission::not_allowed;
pub use axes::Along;
pub use change::{ChangeError, with_rtol};
pub(crate) use robot::Differences;
pub use robot::Robot;
pub(crate) use space::Space;
pub use space::{Output, Plan, PointsFile, Source};
pub use value::Value;
pub(crate) use value::WithUnits;
