//! Choices that the pictures of the command and of Python share: measures, colours, branches, statistics of a sample,
//! cells of points that form no grid.

pub mod branches;
pub mod colours;
pub mod measures;
pub mod sample;
