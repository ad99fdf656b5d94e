//! Studies of a plan: response curves, deviations of parameters, linked parameters.
//!
//! Further studies are the most important parameters, effects of terms, surveys, optima, and quadratic maps of
//! vehicles. The module also contains experiments on single points, and the inputs of vehicles that users name.

pub mod deviation;
pub mod experiment;
pub mod inputs;
pub mod linked;
pub mod optimum;
pub mod response;
pub mod strongest;
pub mod survey;
pub mod terms;
pub mod wrench_map;
