//! Coefficients of the Dormand-Prince method of order 5(4).
//!
//! The sources are Dormand and Prince (1980), and Table II.5.2 of Hairer, Nørsett and Wanner, *Solving
//! Ordinary Differential Equations I*, 2nd ed. The coefficients of the dense output are in section II.6 of
//! the book by Hairer, Nørsett and Wanner, and in the code DOPRI5.

/// Number of stages. The last stage of a step is also the first stage of the next step.
pub const STAGES: usize = 7;

/// Times of the stages, as fractions of the step.
pub const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// Weights of the slopes of earlier stages in each stage. Row `s` contains the weights for stage `s`, counted
/// from 0, and only its first `s` entries are used.
#[rustfmt::skip]
pub const A: [[f64; 6]; STAGES] = [
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Weights of the fifth-order solution.
pub const B: [f64; STAGES] =
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0];

/// Weights of the error estimate, which are `B` minus the weights of the embedded fourth-order solution.
pub const E: [f64; STAGES] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Weights of the fourth-order continuous extension.
pub const D: [f64; STAGES] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

const _: () = assert!(rows_sum_to_times(), "each row of A sums to its time in C");
const _: () = assert!(is_fsal(), "the last row of A is B: first same as last");
const _: () = assert!(close(sum(&B), 1.0), "B sums to 1");
const _: () = assert!(close(sum(&E), 0.0), "E sums to 0");
const _: () = assert!(close(sum(&D), 0.0), "D sums to 0");

const fn close(x: f64, y: f64) -> bool {
    let difference = x - y;
    difference < 4e-15 && difference > -4e-15
}

const fn sum(weights: &[f64]) -> f64 {
    let mut total = 0.0;
    let mut i = 0;
    while i < weights.len() {
        total += weights[i];
        i += 1;
    }
    total
}

const fn rows_sum_to_times() -> bool {
    let mut s = 0;
    while s < STAGES {
        if !close(sum(&A[s]), C[s]) {
            return false;
        }
        s += 1;
    }
    true
}

const fn is_fsal() -> bool {
    let mut j = 0;
    while j < 6 {
        if A[6][j].to_bits() != B[j].to_bits() {
            return false;
        }
        j += 1;
    }
    B[6] == 0.0
}
