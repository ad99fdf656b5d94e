//! The parameter that rises and falls in a response, and the values that it takes.

/// The parameter that rises and falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Its index in the model's parameter table.
    pub parameter: usize,
    /// Its values, rising; two or more.
    pub values: Vec<f64>,
    /// Largest error of the ends of bistable bands, more than zero.
    pub tolerance: f64,
    /// True if the unstable orbits of bistable bands are looked for.
    pub unstable: bool,
}
