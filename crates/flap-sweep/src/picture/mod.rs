//! Choices that are the same in the pictures of the command and of Python. The choices are measures, colours, branches,
//! statistics of a sample, and cells of points that form no grid.

pub mod branches;
pub mod colours;
pub mod measures;
pub mod sample;
