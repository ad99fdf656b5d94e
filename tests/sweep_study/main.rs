//! Studies on the real models: designs at their resonances, responses up and down, optima, and maps of vehicles.

mod basins;
mod driven;
mod edges;
mod flight;
mod hover;
mod optimum;
mod resonance;
mod response;
mod support;
mod wrench_map;
