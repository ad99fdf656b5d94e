//! Groups of numbers with separate values in each lane, such as the constants of a point or the sums over a
//! cycle.

use super::lanes::Lanes;
use super::real::Real;

/// A group of numbers with separate values in each lane.
///
/// The trait is implemented for numbers, for structs declared by [`per_lane!`](crate::per_lane), and for arrays and
/// pairs of groups. The type `()` is the empty group.
pub trait PerLane<R: Real>: Copy {
    /// Values of the group in one lane.
    type One: Copy;

    /// Returns a group of the number type of `like`, with the values `one` in every lane.
    fn fill(like: R, one: &Self::One) -> Self;

    /// Replaces the values of the group in one lane.
    fn set(&mut self, lane: usize, one: &Self::One)
    where
        R: Lanes;

    /// Returns the values of the group in one lane.
    fn get(&self, lane: usize) -> Self::One
    where
        R: Lanes;

    /// Returns true if all values in `one` are finite.
    fn is_finite(one: &Self::One) -> bool;
}

impl<R: Real> PerLane<R> for R {
    type One = f64;

    #[inline(always)]
    fn fill(like: R, one: &f64) -> R {
        like.lit(*one)
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &f64)
    where
        R: Lanes,
    {
        self.set_lane(lane, *one);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> f64
    where
        R: Lanes,
    {
        self.lane(lane)
    }

    #[inline(always)]
    fn is_finite(one: &f64) -> bool {
        one.is_finite()
    }
}

impl<R: Real> PerLane<R> for () {
    type One = ();

    #[inline(always)]
    fn fill(_like: R, (): &()) {}

    #[inline(always)]
    fn set(&mut self, _lane: usize, (): &()) {}

    #[inline(always)]
    fn get(&self, _lane: usize)
    where
        R: Lanes,
    {
    }

    #[inline(always)]
    fn is_finite((): &()) -> bool {
        true
    }
}

impl<R: Real, P: PerLane<R>, Q: PerLane<R>> PerLane<R> for (P, Q) {
    type One = (P::One, Q::One);

    #[inline(always)]
    fn fill(like: R, one: &Self::One) -> Self {
        (P::fill(like, &one.0), Q::fill(like, &one.1))
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Self::One)
    where
        R: Lanes,
    {
        self.0.set(lane, &one.0);
        self.1.set(lane, &one.1);
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Self::One
    where
        R: Lanes,
    {
        (self.0.get(lane), self.1.get(lane))
    }

    #[inline(always)]
    fn is_finite(one: &Self::One) -> bool {
        P::is_finite(&one.0) && Q::is_finite(&one.1)
    }
}

impl<R: Real, P: PerLane<R>, const N: usize> PerLane<R> for [P; N] {
    type One = [P::One; N];

    #[inline(always)]
    fn fill(like: R, one: &Self::One) -> Self {
        core::array::from_fn(
            #[inline(always)]
            |i| P::fill(like, &one[i]),
        )
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Self::One)
    where
        R: Lanes,
    {
        for i in 0..N {
            self[i].set(lane, &one[i]);
        }
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Self::One
    where
        R: Lanes,
    {
        core::array::from_fn(|i| self[i].get(lane))
    }

    #[inline(always)]
    fn is_finite(one: &Self::One) -> bool {
        one.iter().all(P::is_finite)
    }
}

/// Declares a struct with separate values in each lane. The fields of the struct are numbers of the type `R`,
/// or groups of numbers.
///
/// The struct `Name<f64>` contains the values in one lane. You write the visibility of the struct and of each
/// field as in an ordinary struct.
///
/// ```
/// flap_core::per_lane! {
///     /// A spring and a mass.
///     pub struct Oscillator<R> {
///         /// Stiffness (N/m).
///         pub stiffness: R,
///         /// Mass (kg).
///         pub mass: R,
///     }
/// }
/// let one = Oscillator { stiffness: 4.0, mass: 1.0 };
/// assert_eq!(one.stiffness / one.mass, 4.0);
/// ```
#[macro_export]
macro_rules! per_lane {
    ($(#[$meta:meta])* $vis:vis struct $Name:ident<R> {
        $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty),* $(,)?
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $vis struct $Name<R> {
            $($(#[$field_meta])* $field_vis $field: $type,)*
        }

        impl<R: $crate::num::Real> $crate::num::PerLane<R> for $Name<R> {
            type One = $Name<f64>;

            #[inline(always)]
            fn fill(like: R, one: &$Name<f64>) -> Self {
                $Name { $($field: $crate::num::PerLane::fill(like, &one.$field),)* }
            }

            #[inline(always)]
            fn set(&mut self, lane: usize, one: &$Name<f64>)
            where
                R: $crate::num::Lanes,
            {
                $($crate::num::PerLane::set(&mut self.$field, lane, &one.$field);)*
            }

            #[inline(always)]
            fn get(&self, lane: usize) -> $Name<f64>
            where
                R: $crate::num::Lanes,
            {
                $Name { $($field: $crate::num::PerLane::get(&self.$field, lane),)* }
            }

            #[inline(always)]
            fn is_finite(one: &$Name<f64>) -> bool {
                true $(&& <$type as $crate::num::PerLane<R>>::is_finite(&one.$field))*
            }
        }
    };
}
