//! Fields of a parameter struct as values of a design point.

/// A field of a parameter struct, as values of a design point: one, or those of a struct of parameters.
pub trait Slot {
    /// The field from the next of a point's values. Those that are missing count as not set.
    fn take(values: &mut impl Iterator<Item = f64>) -> Self;

    /// Appends the point's values for the field.
    fn put(&self, values: &mut Vec<f64>);
}

impl Slot for f64 {
    fn take(values: &mut impl Iterator<Item = f64>) -> f64 {
        values.next().unwrap_or(f64::NAN)
    }

    fn put(&self, values: &mut Vec<f64>) {
        values.push(*self);
    }
}

impl Slot for Option<f64> {
    fn take(values: &mut impl Iterator<Item = f64>) -> Option<f64> {
        values.next().filter(|value| !value.is_nan())
    }

    fn put(&self, values: &mut Vec<f64>) {
        values.push(self.unwrap_or(f64::NAN));
    }
}
