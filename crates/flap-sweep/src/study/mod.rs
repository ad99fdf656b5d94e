//! Studies of a plan: response curves, deviations of parameters, surveys.

pub mod deviation;
pub mod response;
pub mod survey;
