//! Grid files, plans and sweeps.
//!
//! The way of the data: grid file → [`spec`] → [`plan::Plan`] → points → [`run`] → rows → [`sink`].

pub mod axis;
pub mod csv_sink;
pub mod deviation;
pub mod diagnostic;
pub mod expression;
pub mod formula;
pub mod identity;
pub mod inputs;
pub mod integrity;
pub mod job;
pub mod journal;
pub mod layout;
mod lines;
pub mod merge;
pub mod output;
pub mod plan;
pub mod record;
mod replaced;
pub mod rerun;
pub mod resonance;
pub mod response;
pub mod results;
pub mod run;
pub mod sample;
pub mod selection;
pub mod session;
pub mod sidecar;
pub mod sink;
pub mod spec;
pub mod study;
pub mod survey;
pub mod text;
pub mod time;
pub mod units;
