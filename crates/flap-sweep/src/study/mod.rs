//! Studies of a plan: response curves, comparisons with the preset, and parameters that should change
//! together.
//!
//! The module also finds the parameters with the largest effects on a measure, computes the effects of terms
//! in the equations, and counts excluded points. It computes optima, and quadratic maps of the force and
//! torque of vehicles. It simulates experiments with one design point, and finds inputs of vehicles by their
//! names.

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
