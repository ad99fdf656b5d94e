//! Grid files, plans and sweeps.
//!
//! The way of the data: grid file → [`spec`] → [`plan::Plan`] → points → rows → sink.

pub mod axis;
pub mod diagnostic;
pub mod plan;
pub mod spec;
pub mod units;
