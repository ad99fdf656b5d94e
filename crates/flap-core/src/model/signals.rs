//! Sets of signals: structs with one field per signal.

use super::signal::{Signal, Statistics};
use crate::num::{Lanes, PerLane};

/// A set of signals that the macro [`signals!`](crate::signals) declares.
pub trait SignalSet: Copy + 'static {
    /// A struct with one field of the type `T` for each signal. The name of each field is the name of the
    /// signal.
    type Of<T: Copy>: Copy;

    /// The signals of the set, in the order of their columns.
    const TABLE: &'static [Signal];

    /// Returns a set that contains the same value for each signal.
    fn all<T: Copy>(value: T) -> Self::Of<T>;

    /// Calls `f` for each signal, and returns a set of the results. The arguments of `f` are the quantities
    /// that flap computes for the signal, and the values of the signal in `one` and in `other`.
    fn zip<A: Copy, B: Copy, C: Copy>(
        one: &Self::Of<A>,
        other: &Self::Of<B>,
        f: impl FnMut(Statistics, A, B) -> C,
    ) -> Self::Of<C>;

    /// Calls `f` for each signal. The arguments of `f` are the quantities that flap computes for the signal,
    /// a mutable reference to its value in `of`, and its values in `from`.
    fn update<A: Copy, B: Copy, const L: usize>(
        of: &mut Self::Of<A>,
        from: [&Self::Of<B>; L],
        f: impl FnMut(Statistics, &mut A, [B; L]),
    );

    /// Returns each signal with its value, in the order of [`SignalSet::TABLE`].
    fn each<T: Copy>(of: &Self::Of<T>) -> impl Iterator<Item = (&'static Signal, T)>;

    /// Calls `f` for each signal, and returns a set of the results. The arguments of `f` are the quantities
    /// that flap computes for the signal, and the value of the signal in `of`.
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

/// The struct that [`signals!`](crate::signals) declares, with one field of the type `T` for each signal of
/// the set `S`.
pub type SignalsOf<S, T> = <S as SignalSet>::Of<T>;

/// Wrapper of [`SignalsOf`] whose fields contain one value for each lane.
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
/// Each line of the macro declares one signal by its name, unit, description and
/// [measures](crate::model::Measure). Each measure becomes a column of the results. A line may end with these
/// options:
///
/// - `principal Mean` or `principal First`: the [measure](crate::model::Principal) whose error contributes to the error
///   estimate of a row
/// - `needs [...]`: measures that have no columns, but are needed to compute derived columns
/// - `of_wings [...]`: measures of a force that have one column per wing in the rows of a vehicle
///
/// `Signals<T>` contains one value of the type `T` for each signal. If `R` is a number type, `Signals<R>`
/// contains the values of the signals at one instant. `Signals<SignalCycle>` contains the measured quantities
/// of the signals over a drive period. `Signals` without a type argument is the set of signals for
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
            /// Names, units and measures of all signals, in one struct.
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
