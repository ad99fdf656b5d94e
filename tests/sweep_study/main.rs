//! Studies on the real models: designs at their resonances, and responses up and down.

mod driven;
mod resonance;
mod response;
mod support;
