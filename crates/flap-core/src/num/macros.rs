//! Macros for operators and functions of the types in this folder.

/// Implements an operator for `[generics] Type`, given the expression that computes the result of the operator.
macro_rules! operator {
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident, |$a:ident| $result:expr) => {
        impl<$($generics)*> core::ops::$Trait for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                let $a = self;
                $result
            }
        }
    };
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident, |$a:ident, $b:ident| $result:expr) => {
        impl<$($generics)*> core::ops::$Trait for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, $b: Self) -> Self {
                let $a = self;
                $result
            }
        }
    };
}

/// Implements the operators `+`, `-` and `*` with an `f64` constant on the right. The operators convert the
/// constant to the number type.
macro_rules! constants_on_the_right {
    ([$($generics:tt)*] $Type:ty) => {
        $crate::num::macros::constants_on_the_right!([$($generics)*] $Type, Add::add);
        $crate::num::macros::constants_on_the_right!([$($generics)*] $Type, Sub::sub);
        $crate::num::macros::constants_on_the_right!([$($generics)*] $Type, Mul::mul);
    };
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident) => {
        impl<$($generics)*> core::ops::$Trait<f64> for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, c: f64) -> Self {
                core::ops::$Trait::$method(self, $crate::num::real::Real::lit(self, c))
            }
        }
    };
}

/// Implements methods of a wrapper type. Each method calls the method with the same name on the wrapped
/// number.
macro_rules! of_inner {
    ($Wrapper:ident: $($method:ident($($argument:ident),*)),*) => {
        $(
            #[inline(always)]
            fn $method(self, $($argument: Self),*) -> Self {
                $Wrapper(self.0.$method($($argument.0),*))
            }
        )*
    };
}

/// Implements methods of a pair. Each method calls the method with the same name on the two numbers in the
/// pair.
macro_rules! of_both {
    ($Pair:ident: $($method:ident($($argument:ident),*)),*) => {
        $(
            #[inline(always)]
            fn $method(self, $($argument: Self),*) -> Self {
                $Pair { lo: self.lo.$method($($argument.lo),*), hi: self.hi.$method($($argument.hi),*) }
            }
        )*
    };
}

/// Implements the functions of `Real` for types with `Lanes`, with the polynomials of the module `functions`.
macro_rules! functions_of_lanes {
    () => {
        $crate::num::macros::functions_of_lanes!(
            sin, exp, exp_m1, ln, ln_1p, round_ties_even, exp_of_ordinary, exp_m1_of_ordinary, ln_of_normal,
            ln_1p_of_normal
        );

        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            $crate::num::functions::sin_cos(self)
        }

        #[inline(always)]
        fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Self; N] {
            let mut out = [self; N];
            for lane in 0..<Self as $crate::num::Lanes>::LANES {
                let entries = table($crate::num::Lanes::lane(self, lane));
                for i in 0..N {
                    $crate::num::Lanes::set_lane(&mut out[i], lane, entries[i]);
                }
            }
            out
        }
    };
    ($($function:ident),*) => {
        $(
            #[inline(always)]
            fn $function(self) -> Self {
                $crate::num::functions::$function(self)
            }
        )*
    };
}

pub(super) use {constants_on_the_right, functions_of_lanes, of_both, of_inner, operator};
