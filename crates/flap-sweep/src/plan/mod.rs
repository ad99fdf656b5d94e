//! Checked design spaces: the points of a design space, and the settings for running each point.
//!
//! - [`Plan`]: a checked design space, and methods that change it.
//! - [`axes`]: values of varied parameters.
//! - [`sample`]: points that are spread over a design space.
//! - [`formula`]: derived parameters, conditions, the user's measures.
//! - [`gradient`]: derivatives of measures.
//! - [`refine`]: refinement of a grid.
//! - [`uncertainty`]: standard errors of parameters.
//! - [`selection`]: points to run.

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
