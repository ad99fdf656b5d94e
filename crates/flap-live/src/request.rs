//! Requests of the live page.

use std::collections::BTreeMap;

use serde::Deserialize;

/// Largest number of rows in one answer.
pub(crate) const MOST_ROWS: usize = 4000;

/// The parameters that differ from the opened design, by name. Null removes the value of a parameter, so that the
/// parameter is computed from other parameters.
pub(crate) type Design = BTreeMap<String, Option<Number>>;

/// A number in SI units, or text: a quantity with a unit, or an option.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Number {
    Si(f64),
    Text(String),
}

/// The parameter along the horizontal axis: `n` values from the first to the last, evenly spaced.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct XAxis {
    pub(crate) name: String,
    pub(crate) from: Number,
    pub(crate) to: Number,
    pub(crate) n: u32,
}

/// The parameter that distinguishes the lines: the chart has one line for each value of this parameter.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct By {
    pub(crate) name: String,
    pub(crate) values: Vec<Number>,
}

/// A request for a family of lines in a chart. The answer contains one row for each point of a line.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FamilyRequest {
    #[serde(default)]
    pub(crate) design: Design,
    pub(crate) x: XAxis,
    pub(crate) by: Option<By>,
}

/// A request for the numbers of a design, and for the derivatives of the measure whose name is in `gradient`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointRequest {
    #[serde(default)]
    pub(crate) design: Design,
    pub(crate) gradient: Option<String>,
}

/// A request for one period of a design's settled motion.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionRequest {
    #[serde(default)]
    pub(crate) design: Design,
    pub(crate) samples: u32,
    /// The state at the beginning of the period, from the answer to a [`HysteresisRequest`]. If the request
    /// contains no state, the motion starts from rest.
    pub(crate) begin: Option<Vec<f64>>,
}

/// A request for the response of a design to a parameter that rises and falls.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HysteresisRequest {
    #[serde(default)]
    pub(crate) design: Design,
    pub(crate) x: XAxis,
}

/// A request for a text that the user can save.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SaveRequest {
    pub(crate) kind: SaveKind,
    #[serde(default)]
    pub(crate) design: Design,
    pub(crate) x: Option<XAxis>,
    pub(crate) by: Option<By>,
    /// True for the response to a parameter along x that rises and falls, false for the rows of a sweep.
    #[serde(default)]
    pub(crate) updown: bool,
}

/// The kind of text to save.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SaveKind {
    Grid,
    Device,
    Python,
}

/// The reason why a request has no answer.
#[derive(Debug)]
pub(crate) enum Refused {
    /// The request does not have the form of a request of the page.
    Malformed(String),
    /// The values in the request are impossible. The fields contain the reason, advice, and the parameter
    /// with the impossible value.
    Impossible { error: String, help: Option<String>, parameter: Option<String> },
    /// The connection was closed, so nobody waits for the answer.
    Cancelled,
    /// An internal error in flap.
    Fault(String),
}

impl Refused {
    /// Returns the refusal of impossible values, with the given reason.
    pub(crate) fn impossible(error: impl Into<String>) -> Refused {
        Refused::Impossible { error: error.into(), help: None, parameter: None }
    }
}
