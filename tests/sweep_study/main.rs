//! Studies on the real models: designs at their resonances, responses up and down, and optima.

mod basins;
mod driven;
mod edges;
mod optimum;
mod resonance;
mod response;
mod support;
