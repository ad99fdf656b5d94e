//! The value of a checked expression.

use super::operation::{Binary, Operation, Unary};

/// The number that `operations` leave on the stack.
pub(super) fn evaluate(operations: &[Operation], values: &[f64]) -> f64 {
    let mut stack: Vec<f64> = Vec::with_capacity(operations.len());
    // The parser balances the stack. NaN stands for what cannot be missing.
    for operation in operations {
        let result = match *operation {
            Operation::Push(number) => number,
            Operation::Read(place) => values.get(place).copied().unwrap_or(f64::NAN),
            Operation::Unary(unary) => one(unary, pop(&mut stack)),
            Operation::Apply(function) => function(pop(&mut stack)),
            Operation::Binary(binary) => {
                let (a, b) = pop_two(&mut stack);
                two(binary, a, b)
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

fn pop(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(f64::NAN)
}

/// The two topmost numbers in the order in which they were put there.
fn pop_two(stack: &mut Vec<f64>) -> (f64, f64) {
    let b = pop(stack);
    (pop(stack), b)
}

fn one(unary: Unary, a: f64) -> f64 {
    match unary {
        Unary::Negate => -a,
        Unary::Not => 1.0 - a,
    }
}

fn two(binary: Binary, a: f64, b: f64) -> f64 {
    match binary {
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Divide => a / b,
        Binary::Power => power(a, b),
        Binary::Less => compared(a, b, a < b),
        Binary::LessOrEqual => compared(a, b, a <= b),
        Binary::Greater => compared(a, b, a > b),
        Binary::GreaterOrEqual => compared(a, b, a >= b),
        Binary::Equal => compared(a, b, a == b),
        Binary::NotEqual => compared(a, b, a != b),
        Binary::And if a == 0.0 || b == 0.0 => 0.0,
        Binary::Or if a == 1.0 || b == 1.0 => 1.0,
        // Where neither side of `and` and `or` decides, it is NaN if one of them is, else the same as both.
        Binary::Multiply | Binary::And | Binary::Or => a * b,
    }
}

/// Unlike `pow`, which gives 1 for an unknown number to the power of 0.
fn power(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { libm::pow(a, b) }
}

fn compared(a: f64, b: f64, holds: bool) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { f64::from(u8::from(holds)) }
}
