//! Distributions of the values of sampled parameters.

use super::normal;

/// A distribution of values in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Equally likely values.
    Among(Vec<f64>),
    /// Between two values, all equally likely.
    Uniform {
        /// Smallest value.
        from: f64,
        /// Largest value.
        to: f64,
    },
    /// Between two values of the same sign, all equally likely on a logarithmic scale.
    LogUniform {
        /// The one end.
        from: f64,
        /// The other end.
        to: f64,
    },
    /// Normal, truncated where the bounds are finite.
    Normal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation.
        sd: f64,
        /// Smallest value; may be infinite.
        from: f64,
        /// Largest value; may be infinite.
        to: f64,
    },
}

impl Distribution {
    /// The value below which the share `u` of all values lies; `u` is more than 0 and less than 1.
    pub fn quantile(&self, u: f64) -> f64 {
        match self {
            Distribution::Among(values) => {
                let wanted = libm::floor(u * values.len() as f64);
                let found = values.iter().enumerate().take_while(|(place, _)| *place as f64 <= wanted).last();
                found.map_or(f64::NAN, |(_, value)| *value)
            }
            Distribution::Uniform { from, to } => from + (to - from) * u,
            Distribution::LogUniform { from, to } => from * libm::pow(to / from, u),
            Distribution::Normal { mean, sd, from, to } => {
                let (low, high) = ((from - mean) / sd, (to - mean) / sd);
                // Probabilities near 1 have few digits: the upper tail is taken as the lower one.
                let z = if low > 0.0 {
                    -normal::quantile(between(normal::cumulative(-low), normal::cumulative(-high), u))
                } else {
                    normal::quantile(between(normal::cumulative(low), normal::cumulative(high), u))
                };
                (mean + sd * z).clamp(*from, *to)
            }
        }
    }

    /// False if a truncated normal distribution has no probability between its bounds, to the precision of numbers.
    pub fn is_possible(&self) -> bool {
        match self {
            Distribution::Normal { mean, sd, from, to } => {
                let (low, high) = ((from - mean) / sd, (to - mean) / sd);
                normal::cumulative(high) - normal::cumulative(low) > 0.0
                    || normal::cumulative(-low) - normal::cumulative(-high) > 0.0
            }
            _ => true,
        }
    }
}

fn between(from: f64, to: f64, u: f64) -> f64 {
    from + (to - from) * u
}
