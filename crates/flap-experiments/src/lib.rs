#![doc = include_str!("../README.md")]

pub mod damped_sine;
pub mod free;
pub mod spectrum;
pub mod tracking;
