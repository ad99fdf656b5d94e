//! Checked design spaces: their points, and the settings with which each point is run.
//!
//! - [`Plan`]: a design space that has passed every check, and the methods that change it
//! - [`axes`]: the values of varied parameters
//! - [`sample`]: points spread over a design space
//! - [`formula`]: derived parameters, conditions, measures of the user's own
//! - [`gradient`]: derivatives of measures
//! - [`uncertainty`]: standard errors of parameters
//! - [`selection`]: the points that are run

pub mod axes;
mod change;
mod files;
pub mod formula;
pub mod gradient;
mod robot;
pub mod sample;
pub mod selection;
mod space;
pub mod uncertainty;
mod value;
mod verdict;

pub use axes::Along;
pub use change::ChangeError;
pub use files::{Output, PointsFile, Source};
pub use robot::Robot;
pub use space::Plan;
pub(crate) use space::Space;
pub use value::Value;
pub(crate) use value::WithUnits;
pub use verdict::Verdict;
