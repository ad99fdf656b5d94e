//! Properties of pictures that are the same in the command line and in Python: measures, colours, branches, scales of
//! axes, and statistics of a sample.

pub mod branches;
pub mod colours;
pub mod measures;
pub mod sample;
pub mod scale;
