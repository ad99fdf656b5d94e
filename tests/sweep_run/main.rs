//! From a plan to rows: order, bounded memory, interruption and failure, with a model made for the purpose.

mod failure;
mod fake;
mod files;
mod rows;
mod support;
