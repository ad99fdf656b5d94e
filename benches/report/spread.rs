//! Medians of rounds, with the least and the most.

use std::fmt;

/// The same quantity in every round.
pub(crate) struct Spread(Vec<f64>);

impl Spread {
    pub(crate) fn of(values: impl IntoIterator<Item = f64>) -> Spread {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        Spread(values)
    }

    /// Ratios round by round.
    pub(crate) fn of_ratios(above: &[f64], below: &[f64]) -> Spread {
        Spread::of(above.iter().zip(below).map(|(above, below)| above / below))
    }

    pub(crate) fn median(&self) -> f64 {
        self.0.get(self.0.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [Some(least), Some(most)] = [self.0.first(), self.0.last()] else { return f.write_str("–") };
        write!(f, "{} ({} – {})", digits(self.median()), digits(*least), digits(*most))
    }
}

/// Three digits, or all before the point.
pub(crate) fn digits(value: f64) -> String {
    let places = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else {
        2
    };
    format!("{value:.places$}")
}
