//! Checked design spaces: their points, and the settings with which each point is run.
//!
//! - [`Plan`]: a design space that has passed every check, and the methods that change it
//! - [`axes`]: the values of varied parameters
//! - [`sample`]: points spread over a design space
//! - [`formula`]: derived parameters, conditions, measures of the user's own
//! - [`gradient`]: derivatives of measures
//! - [`uncertainty`]: standard errors of parameters
//! - [`selection`]: the points that are run

mod admission;
pub mod axes;
mod change;
pub mod formula;
pub mod gradient;
pub mod sample;
pub mod selection;
mod space;
pub mod uncertainty;
mod value;

pub use admission::Admission;
pub use axes::Along;
pub use change::ChangeError;
pub(crate) use space::Space;
pub use space::{Output, Plan, PointsFile, Robot, Source};
pub use value::Value;
pub(crate) use value::WithUnits;
