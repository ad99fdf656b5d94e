//! Sets of signals: structs with one field per signal.

use super::signal::{Signal, Statistics};
use crate::num::{Lanes, PerLane};

/// A set of signals, declared by [`signals!`](crate::signals).
pub trait SignalSet: Copy + 'static {
    /// A struct with one `T` for each signal, in the field with the name of the signal.
    type Of<T: Copy>: Copy;

    /// The signals of the set, in the order of their columns.
    const TABLE: &'static [Signal];

    /// Returns a set that contains the same value for each signal.
    fn all<T: Copy>(value: T) -> Self::Of<T>;

    /// Returns the results of `f` for each signal. The arguments of `f` are the required quantities of the signal and
    /// two values.
    fn zip<A: Copy, B: Copy, C: Copy>(
        one: &Self::Of<A>,
        other: &Self::Of<B>,
        f: impl FnMut(Statistics, A, B) -> C,
    ) -> Self::Of<C>;

    /// Calls `f` for each signal. The arguments of `f` are the required quantities of the signal, a mutable reference
    /// to its value in `of`, and its values in `from`.
    fn update<A: Copy, B: Copy, const L: usize>(
        of: &mut Self::Of<A>,
        from: [&Self::Of<B>; L],
        f: impl FnMut(Statistics, &mut A, [B; L]),
    );

    /// Returns each signal with its value, in the order of [`SignalSet::TABLE`].
    fn each<T: Copy>(of: &Self::Of<T>) -> impl Iterator<Item = (&'static Signal, T)>;

    /// Returns the results of `f` for each signal. The arguments of `f` are the required quantities of the signal and
    /// one value.
    #[inline(always)]
    fn map<A: Copy, B: Copy>(of: &Self::Of<A>, mut f: impl FnMut(Statistics, A) -> B) -> Self::Of<B> {
        Self::zip(
            of,
            of,
            #[inline(always)]
            |statistics, value, _| f(statistics, value),
        )
    }
}

/// One `T` for each signal of the set `S`: the struct that [`signals!`](crate::signals) declares.
pub type SignalsOf<S, T> = <S as SignalSet>::Of<T>;

/// [`SignalsOf`] as a group of numbers with one set of numbers for each lane.
#[derive(Clone, Copy, Debug)]
pub struct Each<S: SignalSet, T: Copy>(pub S::Of<T>);

impl<S: SignalSet, R: Lanes, P: PerLane<R>> PerLane<R> for Each<S, P> {
    type One = Each<S, P::One>;

    #[inline(always)]
    fn fill(like: R, one: &Self::One) -> Self {
        Each(S::map(
            &one.0,
            #[inline(always)]
            |_, one| P::fill(like, &one),
        ))
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, one: &Self::One) {
        S::update(
            &mut self.0,
            [&one.0],
            #[inline(always)]
            |_, lanes, [one]| lanes.set(lane, &one),
        );
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Self::One {
        Each(S::map(
            &self.0,
            #[inline(always)]
            |_, lanes| lanes.get(lane),
        ))
    }

    #[inline(always)]
    fn is_finite(one: &Self::One) -> bool {
        S::each(&one.0).all(|(_, one)| P::is_finite(&one))
    }
}

/// Declares the signals of a model: a struct with one field per signal.
///
/// Each line of the macro consists of name, unit, description and [measures](crate::model::Measure). Each measure is a
/// column of rows. A line may end with these options:
///
/// - `principal Mean` or `principal First`: the [measure](crate::model::Principal) whose error contributes to the error
///   estimate of a row
/// - `needs [...]`: measures that are used only in derived columns
/// - `of_wings [...]`: measures of a force for which the rows of a vehicle have one column per wing
///
/// `Signals<T>` contains one `T` for each signal. `Signals<R>` contains the values at an instant, and
/// `Signals<SignalCycle>` the measures over a drive period. `Signals` without a type argument is the set of signals for
/// [`Model::Signals`](crate::model::Model::Signals).
///
/// ```
/// use flap_core::model::{SignalSet, Unit};
///
/// flap_core::signals! {
///     /// Signals of an oscillator.
///     pub struct Signals {
///         stroke: (Unit::DEG, "stroke angle", [Amplitude, Mean]) principal First,
///         power: (Unit::MW, "power of the drive", [Mean]) needs [Supply],
///     }
/// }
///
/// let now = Signals { stroke: 0.5, power: 1e-3 };
/// assert_eq!(now.stroke, 0.5);
/// let names: Vec<&str> = Signals::TABLE.iter().map(|signal| signal.name).collect();
/// assert_eq!(names, ["stroke", "power"]);
/// assert!(Signals::TABLE[1].statistics().rectified);
/// ```
#[macro_export]
macro_rules! signals {
    ($(#[$meta:meta])* pub struct $Name:ident {
        $($signal:ident: ($unit:expr, $doc:literal, [$($measure:ident),*])
            $(principal $principal:ident)? $(needs [$($needed:ident),*])? $(of_wings [$($of_wings:ident),*])?),* $(,)?
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $Name<T = ()> {
            $(#[doc = $doc] pub $signal: T,)*
        }

        impl $Name {
            /// Descriptions of all signals, in one struct.
            pub const SIGNALS: $Name<$crate::model::Signal> = $Name {
                $($signal: $crate::model::Signal {
                    $(principal: Some($crate::model::Principal::$principal),)?
                    $(needed: &[$($crate::model::Measure::$needed),*],)?
                    $(of_wings: &[$($crate::model::Measure::$of_wings),*],)?
                    ..$crate::model::Signal::new(
                        stringify!($signal), $unit, $doc, &[$($crate::model::Measure::$measure),*],
                    )
                },)*
            };
        }

        impl $crate::model::SignalSet for $Name {
            type Of<T: Copy> = $Name<T>;

            const TABLE: &'static [$crate::model::Signal] = &[$($Name::SIGNALS.$signal),*];

            #[inline(always)]
            fn all<T: Copy>(value: T) -> $Name<T> {
                $Name { $($signal: value),* }
            }

            #[inline(always)]
            fn zip<A: Copy, B: Copy, C: Copy>(
                one: &$Name<A>,
                other: &$Name<B>,
                mut f: impl FnMut($crate::model::Statistics, A, B) -> C,
            ) -> $Name<C> {
                $Name { $($signal: f(const { $Name::SIGNALS.$signal.statistics() }, one.$signal, other.$signal)),* }
            }

            #[inline(always)]
            fn update<A: Copy, B: Copy, const L: usize>(
                of: &mut $Name<A>,
                from: [&$Name<B>; L],
                mut f: impl FnMut($crate::model::Statistics, &mut A, [B; L]),
            ) {
                $(
                    let mut values = [from[0].$signal; L];
                    for i in 1..L {
                        values[i] = from[i].$signal;
                    }
                    f(const { $Name::SIGNALS.$signal.statistics() }, &mut of.$signal, values);
                )*
            }

            fn each<T: Copy>(
                of: &$Name<T>,
            ) -> impl Iterator<Item = (&'static $crate::model::Signal, T)> {
                <$Name as $crate::model::SignalSet>::TABLE.iter().zip([$(of.$signal),*])
            }
        }
    };
}
