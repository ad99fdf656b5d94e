//! The functions and constants of expressions.

/// A function of numbers.
#[derive(Clone, Copy)]
pub(super) enum Function {
    /// Of one number.
    One(fn(f64) -> f64),
    /// Of two numbers.
    Two(fn(f64, f64) -> f64),
    /// Of two numbers or more, taken two by two.
    Many(fn(f64, f64) -> f64),
}

/// Names with what they stand for. Angles are in radians.
const FUNCTIONS: [(&str, Function); 24] = [
    ("abs", Function::One(f64::abs)),
    ("acos", Function::One(libm::acos)),
    ("asin", Function::One(libm::asin)),
    ("atan", Function::One(libm::atan)),
    ("atan2", Function::Two(libm::atan2)),
    ("cbrt", Function::One(libm::cbrt)),
    ("ceil", Function::One(libm::ceil)),
    ("cos", Function::One(libm::cos)),
    ("cosh", Function::One(libm::cosh)),
    ("exp", Function::One(libm::exp)),
    ("floor", Function::One(libm::floor)),
    ("hypot", Function::Two(libm::hypot)),
    ("ln", Function::One(libm::log)),
    ("log10", Function::One(libm::log10)),
    ("log2", Function::One(libm::log2)),
    ("max", Function::Many(max)),
    ("min", Function::Many(min)),
    ("round", Function::One(libm::round)),
    ("sign", Function::One(sign)),
    ("sin", Function::One(libm::sin)),
    ("sinh", Function::One(libm::sinh)),
    ("sqrt", Function::One(libm::sqrt)),
    ("tan", Function::One(libm::tan)),
    ("tanh", Function::One(libm::tanh)),
];

const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// The function called `name`.
pub(super) fn find(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

/// The constant called `name`.
pub(super) fn constant(name: &str) -> Option<f64> {
    CONSTANTS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// The names of all functions.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|(name, _)| *name)
}

/// The names of all constants.
pub(super) fn constants() -> impl Iterator<Item = &'static str> {
    CONSTANTS.iter().map(|(name, _)| *name)
}

/// Not a number if either is not, unlike [`f64::min`].
fn min(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if b < a {
        b
    } else {
        a
    }
}

/// Not a number if either is not, unlike [`f64::max`].
fn max(a: f64, b: f64) -> f64 {
    -min(-a, -b)
}

/// -1, 0 or 1.
fn sign(a: f64) -> f64 {
    if a == 0.0 || a.is_nan() { a } else { a.signum() }
}
