//! The numbers of operations of right-hand sides. The tests fail if the numbers change.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use flap_core::model::Model;
use flap_core::num::{PerLane, Real};

use super::dual::Dual;
use super::{BIMORPH, DIRECT_DRIVE, DIRECT_DRIVE_BLADES, FOUR_BAR, GROWING_BIMORPH, values};

/// Numbers of operations. Constants, changes of sign, comparisons and selections are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Operations {
    /// Additions and subtractions.
    sums: u32,
    products: u32,
    /// Products with a sum in one operation.
    fused: u32,
    quotients: u32,
    roots: u32,
    /// Elementary functions. Sine and cosine of the same argument count as one function.
    functions: u32,
}

thread_local! {
    static OPERATIONS: Cell<Operations> = const {
        Cell::new(Operations { sums: 0, products: 0, fused: 0, quotients: 0, roots: 0, functions: 0 })
    };
}

/// The operations that `work` computes.
fn operations(work: impl FnOnce()) -> Operations {
    OPERATIONS.set(Operations::default());
    work();
    OPERATIONS.get()
}

/// A number whose operations are counted.
#[derive(Clone, Copy, Debug)]
struct Counted(f64);

/// Counts an operation and returns its result.
fn counted(count: fn(&mut Operations) -> &mut u32, result: f64) -> Counted {
    let mut operations = OPERATIONS.get();
    *count(&mut operations) += 1;
    OPERATIONS.set(operations);
    Counted(result)
}

/// Counts an operation in one of the fields and returns its result.
macro_rules! counted {
    ($field:ident, $result:expr) => {
        counted(|operations| &mut operations.$field, $result)
    };
}

macro_rules! operator {
    ($Trait:ident::$method:ident, $field:ident) => {
        impl $Trait for Counted {
            type Output = Counted;
            fn $method(self, other: Counted) -> Counted {
                counted!($field, self.0.$method(other.0))
            }
        }

        impl $Trait<f64> for Counted {
            type Output = Counted;
            fn $method(self, c: f64) -> Counted {
                counted!($field, self.0.$method(c))
            }
        }
    };
}

operator!(Add::add, sums);
operator!(Sub::sub, sums);
operator!(Mul::mul, products);
operator!(Div::div, quotients);

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        Counted(-self.0)
    }
}

macro_rules! functions {
    ($($function:ident),*) => {
        $(
            fn $function(self) -> Counted {
                counted!(functions, self.0.$function())
            }
        )*
    };
}

impl Real for Counted {
    type Mask = bool;

    fn lit(self, c: f64) -> Counted {
        Counted(c)
    }

    fn mul_add(self, a: Counted, b: Counted) -> Counted {
        counted!(fused, self.0.mul_add(a.0, b.0))
    }

    fn abs(self) -> Counted {
        Counted(self.0.abs())
    }

    fn sqrt(self) -> Counted {
        counted!(roots, self.0.sqrt())
    }

    fn copysign(self, sign: Counted) -> Counted {
        Counted(self.0.copysign(sign.0))
    }

    fn round_ties_even(self) -> Counted {
        Counted(self.0.round_ties_even())
    }

    functions!(exp, exp_m1, ln, ln_1p);

    fn sin_cos(self) -> (Counted, Counted) {
        let (sin, cos) = self.0.sin_cos();
        (counted!(functions, sin), Counted(cos))
    }

    fn lt(self, other: Counted) -> bool {
        self.0 < other.0
    }

    fn select(mask: bool, yes: Counted, no: Counted) -> Counted {
        if mask { yes } else { no }
    }

    fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Counted; N] {
        table(self.0).map(Counted)
    }
}

/// Operations as `[sums, products, fused, quotients, roots, functions]`.
fn numbers(o: Operations) -> [u32; 6] {
    [o.sums, o.products, o.fused, o.quotients, o.roots, o.functions]
}

/// Operations of the inputs and of the right-hand side. `number` converts a counted number to a number of type `R`.
fn counts<M: Model<4>, R: Real>(model: &M, preset: &str, number: fn(Counted) -> R) -> [[u32; 6]; 2] {
    let start = model.start(&values(preset)).unwrap();
    let number = |value| number(Counted(value));
    let c = M::Constants::<R>::fill(number(0.0), &start.constants);
    let t = number(0.1 * start.span);
    let y = start.scale.map(number);
    let side = number(1.0);
    let input = operations(|| _ = model.input(&c, t));
    let u = model.input(&c, t);
    let rhs = operations(|| _ = model.rhs(&c, &u, side, &y));
    [input, rhs].map(numbers)
}

#[test]
fn right_hand_sides_take_these_operations() {
    let plain = |number| number;
    let found = [
        counts(&BIMORPH, "jafferis2016", plain),
        counts(&GROWING_BIMORPH, "jafferis2016", plain),
        counts(&DIRECT_DRIVE, "ozaki2018-large", plain),
        counts(&DIRECT_DRIVE_BLADES, "ozaki2018-large", plain),
        counts(&FOUR_BAR, "arabagi2013-75hz", plain),
    ];
    let expected = [
        [[19, 57, 3, 1, 0, 2], [23, 40, 0, 0, 0, 3]],
        [[19, 57, 3, 1, 0, 2], [26, 52, 1, 1, 0, 3]],
        [[0, 6, 1, 0, 0, 1], [34, 76, 0, 1, 0, 1]],
        [[0, 6, 1, 0, 0, 1], [37, 73, 0, 1, 0, 1]],
        [[0, 6, 1, 0, 0, 1], [73, 154, 70, 3, 2, 4]],
    ];
    assert_eq!(found, expected);
}

/// Operations for the slopes of a motion with four responses, by dual numbers and by five motions. The function counts
/// arithmetic operations and elementary functions.
fn costs<M: Model<4>>(model: &M, preset: &str) -> [[u32; 2]; 2] {
    let sum = |o: [u32; 6]| [o[..5].iter().sum(), o[5]];
    let [dual, plain] = [
        counts::<M, Dual<Counted, 4>>(model, preset, Dual::constant)[1],
        counts(model, preset, |number| number)[1],
    ]
    .map(sum);
    // Each component of a response is added to the state, and its slope is a difference over the size of the change.
    [dual, [5 * plain[0] + 3 * 16, 5 * plain[1]]]
}

#[test]
fn dual_numbers_take_more_arithmetic_than_five_motions() {
    let found = [
        costs(&BIMORPH, "jafferis2016"),
        costs(&GROWING_BIMORPH, "jafferis2016"),
        costs(&DIRECT_DRIVE, "ozaki2018-large"),
        costs(&DIRECT_DRIVE_BLADES, "ozaki2018-large"),
        costs(&FOUR_BAR, "arabagi2013-75hz"),
    ];
    let expected = [
        [[487, 3], [363, 15]],
        [[629, 3], [448, 15]],
        [[868, 1], [603, 5]],
        [[856, 1], [603, 5]],
        [[2503, 4], [1558, 20]],
    ];
    assert_eq!(found, expected);
    // Arithmetic operations alone: dual numbers take more of them.
    let ratios = found.map(|[[dual, _], [motions, _]]| f64::from(dual) / f64::from(motions));
    assert!(ratios.iter().all(|ratio| (1.3..1.65).contains(ratio)), "{ratios:?}");
}
