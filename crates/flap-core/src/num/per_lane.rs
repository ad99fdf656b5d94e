//! Groups of numbers of which every lane has its own: constants of a point, totals of a cycle.

use super::lanes::Lanes;

/// A group of numbers, one set per lane.
///
/// Implemented by [`per_lane!`](crate::per_lane) for structs whose fields are all of one number type,
/// by arrays of such groups, and by `()` for none at all.
pub trait PerLane<R: Lanes>: Copy {
    /// One lane's set.
    type One: Copy;

    /// The same set in every lane.
    fn splat(token: R::Token, one: &Self::One) -> Self;

    /// Replaces one lane's set.
    fn set_lane(&mut self, lane: usize, one: &Self::One);

    /// One lane's set.
    fn lane(&self, lane: usize) -> Self::One;
}

impl<R: Lanes> PerLane<R> for () {
    type One = ();

    #[inline(always)]
    fn splat(_token: R::Token, (): &()) {}

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, (): &()) {}

    #[inline(always)]
    fn lane(&self, _lane: usize) {}
}

impl<R: Lanes, P: PerLane<R>, const N: usize> PerLane<R> for [P; N] {
    type One = [P::One; N];

    #[inline(always)]
    fn splat(token: R::Token, one: &Self::One) -> Self {
        core::array::from_fn(|i| P::splat(token, &one[i]))
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, one: &Self::One) {
        for i in 0..N {
            self[i].set_lane(lane, &one[i]);
        }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> Self::One {
        core::array::from_fn(|i| self[i].lane(lane))
    }
}

/// Declares a struct of numbers of one type `R`, with `Name<f64>` being one lane's set.
///
/// ```
/// flap_core::per_lane! {
///     /// A spring and a mass.
///     pub struct Oscillator {
///         /// Stiffness (N/m).
///         pub stiffness,
///         /// Mass (kg).
///         pub mass,
///     }
/// }
/// let one = Oscillator { stiffness: 4.0, mass: 1.0 };
/// assert_eq!(one.stiffness / one.mass, 4.0);
/// ```
#[macro_export]
macro_rules! per_lane {
    ($(#[$meta:meta])* pub struct $Name:ident { $($(#[$field_meta:meta])* pub $field:ident),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $Name<R> {
            $($(#[$field_meta])* pub $field: R,)*
        }

        impl $Name<f64> {
            /// Whether no number is infinite or NaN.
            pub fn is_finite(&self) -> bool {
                [$(self.$field),*].iter().all(|number| number.is_finite())
            }
        }

        impl<R: $crate::num::Lanes> $crate::num::PerLane<R> for $Name<R> {
            type One = $Name<f64>;

            #[inline(always)]
            fn splat(token: R::Token, one: &$Name<f64>) -> Self {
                $Name { $($field: R::splat(token, one.$field),)* }
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, one: &$Name<f64>) {
                $(self.$field.set_lane(lane, one.$field);)*
            }

            #[inline(always)]
            fn lane(&self, lane: usize) -> $Name<f64> {
                $Name { $($field: self.$field.lane(lane),)* }
            }
        }
    };
}
