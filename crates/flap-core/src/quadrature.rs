//! Quadrature rules for integrals over the interval from 0 to 1.

use core::f64::consts::PI;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use nalgebra::{DMatrix, SymmetricEigen};

/// A node of a quadrature rule in [0, 1], and the weight of the node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Position of the node.
    pub x: f64,
    /// Weight of the function's value at the node. The weights of a quadrature rule add up to 1.
    pub weight: f64,
}

/// Returns the midpoint rule. The nodes of the rule are the midpoints of `n` equal parts of the interval, and
/// all weights are equal. The midpoint rule is exact for linear functions.
pub(crate) fn midpoints(n: usize) -> Rc<[Node]> {
    let weight = 1.0 / n as f64;
    (0..n).map(|i| Node { x: (i as f64 + 0.5) * weight, weight }).collect()
}

/// Returns the Gauss-Legendre rule with `n` nodes in ascending order. The rule is exact for polynomials up to
/// degree 2n − 1.
///
/// ```
/// let rule = flap_core::quadrature::gauss_legendre(4);
/// let integral: f64 = rule.iter().map(|node| node.weight * node.x.powi(7)).sum();
/// assert!((integral - 1.0 / 8.0).abs() < 1e-16);
/// ```
pub fn gauss_legendre(n: usize) -> Rc<[Node]> {
    thread_local! {
        // All points of a sweep use the same few rules.
        static RULES: RefCell<BTreeMap<usize, Rc<[Node]>>> = const { RefCell::new(BTreeMap::new()) };
    }
    RULES.with_borrow_mut(|rules| Rc::clone(rules.entry(n).or_insert_with(|| find_gauss_legendre(n))))
}

fn find_gauss_legendre(n: usize) -> Rc<[Node]> {
    (0..n)
        .map(|i| {
            // Newton's method from an approximation that is closer to its own root than to any other.
            let mut z = -libm::cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
            let mut slope = 1.0;
            for _ in 0..8 {
                let value;
                [value, slope] = legendre(n, z);
                let step = value / slope;
                z -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            Node { x: 0.5 * (1.0 + z), weight: 1.0 / ((1.0 - z * z) * slope * slope) }
        })
        .collect()
}

/// Returns the Gauss rule with `n` nodes in ascending order, for the beta distribution x^(p−1) (1−x)^(q−1)
/// with p, q > 0.
///
/// The weights add up to 1. For polynomials up to degree 2n − 1, the rule computes the mean over the beta
/// distribution exactly. The nodes are the eigenvalues of the Jacobi matrix, and the weights are the squared
/// first components of its eigenvectors (Golub and Welsch 1969).
///
/// ```
/// let rule = flap_core::quadrature::gauss_beta(4, 2.0, 1.5);
/// let mean: f64 = rule.iter().map(|node| node.weight * node.x).sum();
/// assert!((mean - 2.0 / 3.5).abs() < 1e-15);
/// ```
pub fn gauss_beta(n: usize, p: f64, q: f64) -> Vec<Node> {
    // Jacobi polynomials on [−1, 1] with the weight (1 − z)^a (1 + z)^b.
    let (a, b) = (q - 1.0, p - 1.0);
    let sum = a + b;
    let diagonal = |k: f64| {
        let twice = 2.0 * k + sum;
        // The quotient of the general term is 0/0 for k = 0 and a + b = 0.
        if k == 0.0 { (b - a) / (sum + 2.0) } else { (b * b - a * a) / (twice * (twice + 2.0)) }
    };
    let beside = |k: f64| {
        let twice = 2.0 * k + sum;
        // For k = 1 the factors k + a + b and 2k + a + b − 1 are equal.
        let quotient = if k == 1.0 { 1.0 } else { (k + sum) / (twice - 1.0) };
        (4.0 * k * (k + a) * (k + b) * quotient / (twice * twice * (twice + 1.0))).sqrt()
    };
    let matrix = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => diagonal(i as f64),
        1 => beside(i.max(j) as f64),
        _ => 0.0,
    });
    let found = SymmetricEigen::new(matrix);
    let mut nodes: Vec<Node> = (0..n)
        .map(|i| {
            let first = found.eigenvectors[(0, i)];
            Node { x: 0.5 * (1.0 + found.eigenvalues[i]), weight: first * first }
        })
        .collect();
    nodes.sort_by(|one, other| one.x.total_cmp(&other.x));
    nodes
}

/// Returns the value and the derivative of the Legendre polynomial of degree `n` at `z`, with −1 < `z` < 1.
fn legendre(n: usize, z: f64) -> [f64; 2] {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * z * value - k * before) / (k + 1.0));
    }
    [value, n as f64 * (z * value - before) / (z * z - 1.0)]
}
