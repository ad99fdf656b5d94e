//! Native part of the `flapwing` Python package.
