//! Sums over a signal, and the sums over the second half of a period that mirrors the first.

crate::per_lane! {
    /// Sums over a signal in a part of a drive period.
    pub struct Totals<R> {
        /// ∫ s dt.
        pub integral: R,
        /// ∫ s² dt.
        pub square: R,
        /// ∫ max(s, 0) dt.
        pub positive: R,
        /// ∫ s cos ωt dt.
        pub cosine: R,
        /// ∫ s sin ωt dt.
        pub sine: R,
        /// Largest value.
        pub max: R,
        /// Smallest value.
        pub min: R,
    }
}

impl Totals<f64> {
    /// Returns the sums over the second half of a period, for a signal whose second half equals its first half.
    pub fn repeated(self) -> Self {
        Totals { cosine: -self.cosine, sine: -self.sine, ..self }
    }

    /// Returns the sums over the second half of a period, for a signal whose second half is the negative of its first
    /// half.
    pub fn negated(self) -> Self {
        Totals {
            integral: -self.integral,
            positive: self.positive - self.integral,
            max: -self.min,
            min: -self.max,
            ..self
        }
    }

    /// Returns the sums over both halves of a period.
    pub(crate) fn with(self, second: Self) -> Self {
        Totals {
            integral: self.integral + second.integral,
            square: self.square + second.square,
            positive: self.positive + second.positive,
            cosine: self.cosine + second.cosine,
            sine: self.sine + second.sine,
            max: self.max.max(second.max),
            min: self.min.min(second.min),
        }
    }
}
