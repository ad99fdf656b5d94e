//! Answers to requests, one file for each kind.

mod context;
mod family;
mod hysteresis;
mod motion;
mod point;
mod save;

pub(crate) use context::AnswerContext;
pub(crate) use family::family;
pub(crate) use hysteresis::hysteresis;
pub(crate) use motion::motion;
pub(crate) use point::point;
pub(crate) use save::save;
