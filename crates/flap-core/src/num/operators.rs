//! Operators of the types in this folder, each declared by one line.

/// Implements an operator for `[generics] Type`, by the expression for its result.
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

/// Implements the operators with a constant on the right, by those with two numbers.
macro_rules! constants_on_the_right {
    ([$($generics:tt)*] $Type:ty) => {
        $crate::num::operators::with_constant!([$($generics)*] $Type, Add::add);
        $crate::num::operators::with_constant!([$($generics)*] $Type, Sub::sub);
        $crate::num::operators::with_constant!([$($generics)*] $Type, Mul::mul);
    };
}

/// Implements one operator with a constant on the right.
macro_rules! with_constant {
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

/// Methods of a wrapper of numbers, which are those of the numbers within.
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

pub(super) use {constants_on_the_right, of_inner, operator, with_constant};
