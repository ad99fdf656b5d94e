//! Properties of pictures that are the same in the command line and in Python. The properties are measures, colours,
//! branches, statistics of a sample, and cells of points that form no grid.

pub mod branches;
pub mod colours;
pub mod measures;
pub mod sample;
