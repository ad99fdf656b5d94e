//! Studies of a plan: response curves, comparisons with the preset, and parameters that should change
//! together.
//!
//! The module also computes the parameters with the largest effects, the effects of terms in the equations,
//! excluded points, optima, and quadratic maps of vehicles. The module simulates experiments for single
//! points, and finds inputs of vehicles by their names.

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
