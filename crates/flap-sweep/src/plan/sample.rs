//! Samples of a design space: points spread over it by chance, or more evenly than chance does.
//!
//! A [`Design`] spreads points over the unit cube, a [`Distribution`] carries each coordinate over to a parameter. Any
//! point is computed in constant time and depends on the seed and its index alone.

mod distribution;
mod joe_kuo;
mod latin;
mod normal;
mod random;
mod sobol;

pub use distribution::Distribution;
use latin::Permutation;
pub(crate) use normal::quantile as normal_quantile;
use sobol::Sobol;

/// The method by which points are spread over the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Sobol' sequence with direction numbers by Joe and Kuo, scrambled after Owen by a hash of the digits.
    Sobol,
    /// Latin hypercube: along every dimension, each of `count` equal intervals has one point, at random within it.
    LatinHypercube,
    /// Independent random points.
    Random,
}

/// Points spread over the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    seed: u64,
    count: u64,
    kind: Kind,
}

/// The data of each method, for each dimension.
#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Sobol(Vec<Sobol>),
    LatinHypercube(Vec<Permutation>),
    Random,
}

impl Design {
    /// The largest number of points: 2^32.
    pub const MAX_POINTS: u64 = 1 << 32;

    /// The largest number of dimensions.
    pub const MAX_DIMENSIONS: usize = joe_kuo::DIRECTIONS.len() + 1;

    /// `count` points over `dimensions` dimensions; at most [`Design::MAX_POINTS`] and [`Design::MAX_DIMENSIONS`].
    pub fn new(method: Method, seed: u64, count: u64, dimensions: usize) -> Design {
        let kind = match method {
            Method::Sobol => {
                Kind::Sobol((0..dimensions).map(|d| Sobol::new(d, random::key(seed, d))).collect())
            }
            Method::LatinHypercube => {
                let permutation = |d| Permutation::new(count, random::key(seed, d));
                Kind::LatinHypercube((0..dimensions).map(permutation).collect())
            }
            Method::Random => Kind::Random,
        };
        Design { seed, count, kind }
    }

    /// The method by which points are spread.
    pub fn method(&self) -> Method {
        match self.kind {
            Kind::Sobol(_) => Method::Sobol,
            Kind::LatinHypercube(_) => Method::LatinHypercube,
            Kind::Random => Method::Random,
        }
    }

    /// The seed of the random numbers.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of points.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The coordinate of a point along a dimension: more than 0 and less than 1.
    pub fn coordinate(&self, index: u64, dimension: usize) -> f64 {
        match &self.kind {
            Kind::Sobol(dimensions) => dimensions[dimension].coordinate(index),
            Kind::LatinHypercube(permutations) => {
                let interval = permutations[dimension].get(index) as f64;
                let within = random::coordinate(self.seed, dimension, index);
                // In the last interval the sum may be rounded to the very end.
                ((interval + within) / self.count as f64).min(1.0 - f64::EPSILON)
            }
            Kind::Random => random::coordinate(self.seed, dimension, index),
        }
    }
}

#[cfg(test)]
mod tests;
