#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each module uses only modules above it in this list:
//!
//! - [`page`]: pages for a browser, each in one text with its style, code and data
//! - `request`: requests of the live page
//! - `rows`: rows of a sweep as JSON
//! - `opened`: the design that was opened, and the grid files from which the contents of the page are
//!   computed
//! - `description`: parameters, measures and the first chart, as data for the page
//! - `answer`: one file for each kind of request
//! - `guard`: checks the token, the host and the origin of requests
//! - `server`: the HTTP server

pub mod page;

#[cfg(feature = "server")]
mod answer;
#[cfg(feature = "server")]
mod description;
#[cfg(feature = "server")]
mod guard;
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
