//! From a plan to rows: order, bounded memory, interruption and failure, with a model that is made for these tests.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

mod chunks;
mod curves;
mod failure;
mod fake;
mod files;
mod formulas;
mod journal;
mod layout;
mod refine;
mod rows;
mod support;
