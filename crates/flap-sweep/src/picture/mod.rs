//! Choices for pictures that the command line and Python share: measures, colours, branches, scales of axes,
//! and statistics of a sample.

pub mod branches;
pub mod colours;
pub mod measures;
pub mod sample;
pub mod scale;
