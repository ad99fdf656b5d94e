#![doc = include_str!("../README.md")]
//!
//! # Rooms
//!
//! Each room uses only those above it:
//!
//! - [`page`]: pages for a browser, each in one text with its style, code and data
//! - `request`: requests of the live page
//! - `latest`: newer requests cancel older ones of their kind
//! - `rows`: rows of a sweep as JSON
//! - `opened`: the design that the page begins with, and grid files of what the page shows
//! - `description`: parameters, measures and the first view, for the page
//! - `answer`: one file for each kind of request
//! - `guard`: tokens, and the hosts and origins that may ask
//! - `server`: the HTTP server

pub mod page;

#[cfg(feature = "server")]
mod answer;
#[cfg(feature = "server")]
mod description;
#[cfg(feature = "server")]
mod guard;
#[cfg(feature = "server")]
mod latest;
#[cfg(feature = "server")]
mod opened;
#[cfg(feature = "server")]
mod request;
#[cfg(feature = "server")]
mod rows;
#[cfg(feature = "server")]
mod server;

#[cfg(feature = "server")]
pub use server::{LiveOptions, Server, StartError};
