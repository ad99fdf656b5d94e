//! Responses: the motions of a design while one parameter, usually the drive frequency, rises and falls.
//!
//! The motion at each value of the parameter starts from the settled motion at the previous value. The
//! response therefore stays on a branch of orbits until the branch ends. At values at which the upward and
//! the downward branch differ, the design has two motions at the same drive.
//!
//! - `along` determines the values of the parameter that rises and falls.
//! - `curve` contains the response of one design and its rows, and compares the motions of the upward and the
//!   downward branch at the same drive.
//! - `follow` computes the upward and the downward branch of a response, and finds the ends of bistable
//!   bands.
//! - `space` defines the space of states and parameters in which curves of orbits are computed.
//! - `continuation` computes the unstable orbits in bistable bands.
//! - `basin` computes the fraction of initial states from which the motion settles on each branch.
//! - `edge` contains the edges of hysteresis in the plane of two parameters, their rows and a summary.
//! - `edge_continuation` computes the edges of hysteresis.
//! - `verdict` writes the one-line summary of a response.
//! - `run` computes the responses of all designs of a plan, in the order of the designs.

mod along;
mod basin;
mod continuation;
mod curve;
mod edge;
mod edge_continuation;
mod follow;
mod run;
mod space;
mod verdict;

pub use crate::plan::Along;
pub use basin::{Basin, Starts};
pub use curve::{Curve, Step};
pub use edge::{Edge, EdgeEnd, EdgeKind, EdgeMark, EdgePoint, EdgeRange, Edges};
pub use run::Responses;
pub use verdict::{Band, BandKind, Verdict};
