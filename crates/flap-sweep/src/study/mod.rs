//! Studies of a plan: response curves, comparisons with the preset, and parameters that should change
//! together.
//!
//! Further studies compute the most important parameters, effects of terms, excluded points, optima, and
//! quadratic maps of vehicles. The module also contains experiments on single points, and finds inputs of
//! vehicles by their names.

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
