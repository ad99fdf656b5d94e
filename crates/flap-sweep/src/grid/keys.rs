//! The keys of a grid file.

/// The keys at the top of a grid file.
pub(super) const KEYS: [&str; 16] = [
    "description",
    "preset",
    "device",
    "params",
    "correlation",
    "vehicle",
    "resonance",
    "axes",
    "zip",
    "sample",
    "derived",
    "where",
    "measure",
    "gradient",
    "solver",
    "output",
];
