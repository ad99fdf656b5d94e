//! Responses: the motions of a design while one parameter, usually the drive frequency, rises and falls.
//!
//! Every point starts from the settled motion of its neighbour, so the response stays on a branch of orbits up to the
//! branch's end. At values where the upward and the downward branch differ, the design has two motions at the same
//! drive.
//!
//! - `along`: values of the parameter that rises and falls.
//! - `curve`: response of one design, its rows, and the comparison of its motions at the same drive.
//! - `follow`: one curve, with the upward and the downward branch and the ends of the bistable bands.
//! - `space`: space of states and parameters in which continuations follow curves of orbits.
//! - `continuation`: unstable orbits that connect the branches of a bistable band.
//! - `basin`: fractions of initial states whose motions settle on each branch.
//! - `edge`: ends of bands in the plane of two parameters, with rows and a summary.
//! - `edge_continuation`: continuation of the ends of bands.
//! - `verdict`: one-line summary of a curve.
//! - `run`: curves of all designs of a plan, in order.

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
