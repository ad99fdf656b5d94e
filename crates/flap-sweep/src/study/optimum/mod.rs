//! Finds the best design within the ranges of a plan's axes.
//!
//! Among the points that satisfy all conditions, the best design has the largest or the smallest value of an
//! expression.
//!
//! The searches start from the best points of the plan's grid. Each search uses sequential quadratic
//! programming with the exact derivatives of the rows. As in a sweep, the motion of every row is computed
//! from rest.
//!
//! ```
//! use flap_sweep::grid;
//! use flap_sweep::study::optimum::{Aim, Problem, Settings, optimise};
//!
//! let grid = "
//!     preset = \"ozaki2018-large\"
//!     [axes]
//!     drive_frequency = { from = \"100 Hz\", to = \"130 Hz\", n = 4 }
//! ";
//! let plan = grid::parse("grid", grid, flap_core::simulate::all()).unwrap();
//! let conditions = ["stroke_pp_deg < 60 deg".to_owned()];
//! let problem = Problem::new(plan, "lift_mean_mn", Aim::Largest, &conditions).unwrap();
//! let best = optimise(&problem, &Settings::default(), &|_, _| false).unwrap().unwrap();
//! assert!(best.is_feasible());
//! ```

mod answer;
mod evaluate;
mod front;
mod limit;
mod problem;
mod refine;
mod region;
mod search;
mod sensitivity;
mod starts;

pub use answer::{Active, Edge, LimitAt, LocalOptimum, Optimum, Status};
pub use front::{Front, FrontError, FrontPoint, Goal, front};
pub use problem::{Aim, Problem, ProblemError, ProblemPart};
pub use search::{Settings, optimise, optimise_from};
