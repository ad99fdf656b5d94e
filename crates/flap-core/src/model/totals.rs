//! Time integrals and extrema of a signal. If the second half of a period mirrors the first half, the first
//! half determines the integrals and extrema of the second half.

crate::per_lane! {
    /// Time integrals and extrema of a signal s over a part of a drive period.
    pub struct Totals<R> {
        /// Time integral of the signal, ∫ s dt.
        pub integral: R,
        /// Time integral of the square of the signal, ∫ s² dt.
        pub square: R,
        /// Time integral of the positive part of the signal, ∫ max(s, 0) dt.
        pub positive: R,
        /// Time integral of the signal times cos ωt, ∫ s cos ωt dt.
        pub cosine: R,
        /// Time integral of the signal times sin ωt, ∫ s sin ωt dt.
        pub sine: R,
        /// Largest value.
        pub max: R,
        /// Smallest value.
        pub min: R,
    }
}

impl Totals<f64> {
    /// Returns the integrals and extrema over the second half of a period, for a signal that is equal in both
    /// halves of the period.
    pub fn repeated(self) -> Self {
        Totals { cosine: -self.cosine, sine: -self.sine, ..self }
    }

    /// Returns the integrals and extrema over the second half of a period, for a signal with opposite signs
    /// in the two halves of the period.
    pub fn negated(self) -> Self {
        Totals {
            integral: -self.integral,
            positive: self.positive - self.integral,
            max: -self.min,
            min: -self.max,
            ..self
        }
    }

    /// Returns the integrals and extrema over both halves of a period.
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
