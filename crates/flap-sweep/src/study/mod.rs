//! Studies of a plan: response curves, control effectiveness of vehicles, deviations of parameters, strongest parameters,
//! surveys.

pub mod control;
pub mod deviation;
pub mod response;
pub mod strongest;
pub mod survey;
