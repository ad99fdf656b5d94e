//! Colours of numbers.

use flap_sweep::picture::colours::is_signed;
use kuva::plot::ColorMap;

/// The colours of numbers within a range.
pub(super) struct Shades {
    range: (f64, f64),
}

impl Shades {
    /// The colours of numbers from the first to the second of `range`.
    pub(super) fn of(range: (f64, f64)) -> Shades {
        Shades { range }
    }

    /// True for a diverging map, whose middle is zero.
    pub(super) fn is_signed(&self) -> bool {
        is_signed(self.range.0, self.range.1)
    }

    /// The colour of a number: blue below and red above zero if there are both signs, where equal sizes are equally strong;
    /// else even in lightness, dark to light.
    pub(super) fn colour(&self, value: f64) -> String {
        let (low, high) = self.range;
        if self.is_signed() {
            let size = high.max(-low);
            return ColorMap::RedBlue.map(0.5 - 0.5 * value / size);
        }
        sequential((value - low) / (high - low))
    }
}

/// A colour for `share` of the way from the smallest to the largest value: even in lightness, dark to light.
pub(super) fn sequential(share: f64) -> String {
    ColorMap::Viridis.map(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_is_the_middle_of_signed_numbers() {
        let lightness = |colour: &str| {
            let part = |at: usize| u32::from_str_radix(&colour[at..at + 2], 16).unwrap();
            (part(1) + part(3) + part(5), part(1) > part(5))
        };
        let shades = Shades::of((-1.0, 4.0));
        let (zero, below, above) = (shades.colour(0.0), shades.colour(-1.0), shades.colour(1.0));
        assert!(lightness(&zero).0 > lightness(&below).0 && lightness(&zero).0 > lightness(&above).0);
        assert!(!lightness(&below).1 && lightness(&above).1, "{below} is blue, {above} is red");
        assert_ne!(Shades::of((1.0, 4.0)).colour(4.0), shades.colour(4.0));
    }
}
