//! Defines the operations and functions of expressions, and computes the value of a checked expression.

use std::sync::Arc;

use super::scope::Kind;

/// Executes `operations` on a stack of numbers, and returns the last number on the stack.
pub(super) fn evaluate(operations: &[Operation], values: &[f64]) -> f64 {
    let mut stack: Vec<f64> = Vec::with_capacity(operations.len());
    // The parser balances the stack, so this NaN does not occur.
    for operation in operations {
        let result = match *operation {
            Operation::Push(number) => number,
            Operation::Read(place) => read(values, place),
            Operation::ReadOf(choice, ref numbers) => of_choice(numbers, read(values, choice)),
            Operation::Apply(function) => function(pop(&mut stack)),
            Operation::Binary(operator) => {
                let (a, b) = pop_two(&mut stack);
                (operator.apply)(a, b)
            }
            Operation::Apply2(function) => {
                let (a, b) = pop_two(&mut stack);
                function(a, b)
            }
        };
        stack.push(result);
    }
    pop(&mut stack)
}

/// Splits `operations` into the operations of the left operand and of the right operand of a binary operator.
/// Returns `None` if `operations` does not consist of two operands.
pub(super) fn operands(operations: &[Operation]) -> Option<(&[Operation], &[Operation])> {
    // Operands that are still to be found on the way back to the beginning of the right one.
    let mut missing = 1;
    for (place, operation) in operations.iter().enumerate().rev() {
        missing += match operation {
            Operation::Push(_) | Operation::Read(_) | Operation::ReadOf(..) => 0,
            Operation::Apply(_) => 1,
            Operation::Binary(_) | Operation::Apply2(_) => 2,
        };
        missing -= 1;
        if missing == 0 {
            return (place > 0).then(|| operations.split_at(place));
        }
    }
    None
}

fn read(values: &[f64], place: usize) -> f64 {
    values.get(place).copied().unwrap_or(f64::NAN)
}

/// Returns the number in `numbers` that belongs to the option with the index `option`. Returns NaN if no
/// option has the index `option`.
pub(crate) fn of_choice(numbers: &[f64], option: f64) -> f64 {
    let found = numbers.iter().enumerate().find(|(place, _)| *place as f64 == option);
    found.map_or(f64::NAN, |(_, number)| *number)
}

fn pop(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(f64::NAN)
}

/// Removes the two topmost numbers from the stack, and returns them in the order in which they were pushed.
fn pop_two(stack: &mut Vec<f64>) -> (f64, f64) {
    let b = pop(stack);
    (pop(stack), b)
}

/// Returns `a` to the power of `b`. NaN to the power of 0 is NaN, whereas `pow` returns 1.
fn power(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { libm::pow(a, b) }
}

fn compared(a: f64, b: f64, holds: bool) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { f64::from(u8::from(holds)) }
}

/// One operation. On the stack, a condition is the number 1 for true, 0 for false, and NaN for unknown.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    /// Pushes a constant number onto the stack.
    Push(f64),
    /// Pushes the value with the given index onto the stack.
    Read(usize),
    /// Pushes a number that depends on a choice onto the stack. The variant contains the index of the choice,
    /// and one number for each option.
    ReadOf(usize, Arc<[f64]>),
    /// Replaces the two topmost numbers on the stack by the result of a binary operator.
    Binary(&'static Operator),
    /// Replaces the topmost number on the stack by a function of this number.
    Apply(fn(f64) -> f64),
    /// Replaces the two topmost numbers on the stack by a function of both numbers.
    Apply2(fn(f64, f64) -> f64),
}

/// Precedence of operators, in ascending order.
pub(super) mod precedence {
    pub(in super::super) const ANY: u8 = 0;
    pub(in super::super) const OR: u8 = 1;
    pub(in super::super) const AND: u8 = 2;
    pub(in super::super) const NOT: u8 = 3;
    pub(in super::super) const COMPARISON: u8 = 4;
    pub(in super::super) const SUM: u8 = 5;
    pub(in super::super) const PRODUCT: u8 = 6;
    /// `-2^2` is -4.
    pub(in super::super) const SIGN: u8 = 7;
    pub(in super::super) const POWER: u8 = 8;
}

/// A binary operator.
#[derive(Debug)]
pub(super) struct Operator {
    pub(super) sign: &'static str,
    /// Precedence.
    pub(super) binds: u8,
    /// Kind of both operands.
    pub(super) takes: Kind,
    /// Kind of the result.
    pub(super) gives: Kind,
    apply: fn(f64, f64) -> f64,
}

/// Binary operators. If no side of `and` or `or` alone determines the result, the result is the product of
/// both sides. The product is NaN if a side is NaN. If no side is NaN, both sides are 1 or both sides are 0,
/// so the product is also 1 or 0.
static OPERATORS: [Operator; 13] = [
    logical("or", precedence::OR, |a, b| if a == 1.0 || b == 1.0 { 1.0 } else { a * b }),
    logical("and", precedence::AND, |a, b| if a == 0.0 || b == 0.0 { 0.0 } else { a * b }),
    comparison("<", |a, b| compared(a, b, a < b)),
    comparison("<=", |a, b| compared(a, b, a <= b)),
    comparison(">", |a, b| compared(a, b, a > b)),
    comparison(">=", |a, b| compared(a, b, a >= b)),
    comparison("==", |a, b| compared(a, b, a == b)),
    comparison("!=", |a, b| compared(a, b, a != b)),
    arithmetic("+", precedence::SUM, |a, b| a + b),
    arithmetic("-", precedence::SUM, |a, b| a - b),
    arithmetic("*", precedence::PRODUCT, |a, b| a * b),
    arithmetic("/", precedence::PRODUCT, |a, b| a / b),
    arithmetic("^", precedence::POWER, power),
];

const fn logical(sign: &'static str, binds: u8, apply: fn(f64, f64) -> f64) -> Operator {
    Operator { sign, binds, takes: Kind::Condition, gives: Kind::Condition, apply }
}

const fn comparison(sign: &'static str, apply: fn(f64, f64) -> f64) -> Operator {
    Operator { sign, binds: precedence::COMPARISON, takes: Kind::Number, gives: Kind::Condition, apply }
}

const fn arithmetic(sign: &'static str, binds: u8, apply: fn(f64, f64) -> f64) -> Operator {
    Operator { sign, binds, takes: Kind::Number, gives: Kind::Number, apply }
}

/// Returns the binary operator with the sign `sign`.
pub(super) fn operator(sign: &str) -> Option<&'static Operator> {
    OPERATORS.iter().find(|operator| operator.sign == sign)
}

/// A function of numbers.
#[derive(Clone, Copy)]
pub(super) enum Function {
    /// Function of one number.
    One(fn(f64) -> f64),
    /// Function of two numbers.
    Two(fn(f64, f64) -> f64),
    /// Function of two or more numbers, such as `max`. The function is applied to two numbers, then to the
    /// result and the next number.
    Many(fn(f64, f64) -> f64),
}

/// Functions by name. Angles are in radians.
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

/// Name and value of `pi`, the only constant in expressions.
pub(super) const PI: (&str, f64) = ("pi", std::f64::consts::PI);

/// Returns the function called `name`.
pub(super) fn find(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

/// Returns the names of all functions.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|(name, _)| *name)
}

/// Returns the smaller number, or NaN if one of the numbers is NaN. In contrast, [`f64::min`] ignores NaN.
fn min(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if b < a {
        b
    } else {
        a
    }
}

/// Returns the larger number, or NaN if one of the numbers is NaN. In contrast, [`f64::max`] ignores NaN.
fn max(a: f64, b: f64) -> f64 {
    -min(-a, -b)
}

/// Returns the sign of a number: -1, 0 or 1.
fn sign(a: f64) -> f64 {
    if a == 0.0 || a.is_nan() { a } else { a.signum() }
}
