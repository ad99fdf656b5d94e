//! Second derivatives of cubic splines.

/// The equations of a spline for its second derivatives: lower, middle and upper diagonal, right-hand side, for the
/// samples between the ends.
fn equations(x: &[f64], y: &[f64]) -> [Vec<f64>; 4] {
    let mut rows: [Vec<f64>; 4] = Default::default();
    for i in 1..x.len() - 1 {
        let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        rows[0].push(before / 6.0);
        rows[1].push((before + after) / 3.0);
        rows[2].push(after / 6.0);
        rows[3].push((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
    }
    rows
}

/// Second derivatives of the spline whose third derivative is continuous at the samples next to the ends
/// ("not-a-knot"): the ends go on as the record does.
pub(super) fn bends(x: &[f64], y: &[f64]) -> Vec<f64> {
    let [lower, mut middle, upper, right] = equations(x, y);
    let n = middle.len();
    // The ends' second derivatives, extrapolated from the two samples next to them, are put into the equations.
    let (first, second) = (x[1] - x[0], x[2] - x[1]);
    let (last, before) = (x[n + 1] - x[n], x[n] - x[n - 1]);
    let (start, end) = (first / second, last / before);
    let (mut lower_in, mut upper_in) = (lower.clone(), upper.clone());
    middle[0] += lower[0] * (1.0 + start);
    upper_in[0] -= lower[0] * start;
    middle[n - 1] += upper[n - 1] * (1.0 + end);
    lower_in[n - 1] -= upper[n - 1] * end;
    let inner = tridiagonal(&lower_in, &middle, &upper_in, &right);
    let mut bends = vec![inner[0] + start * (inner[0] - inner[1])];
    bends.extend(&inner);
    bends.push(inner[n - 1] + end * (inner[n - 1] - inner[n - 2]));
    bends
}

/// Second derivatives of the periodic spline, whose first and last sample are the same.
pub(super) fn periodic_bends(x: &[f64], y: &[f64]) -> Vec<f64> {
    let [lower, middle, upper, right] = equations(x, y);
    let n = middle.len();
    let (first, last) = (x[1] - x[0], x[n + 1] - x[n]);
    let slope = (y[1] - y[0]) / first - (y[n + 1] - y[n]) / last;
    // The unknown at the seam, s, enters the equations of its neighbours: bends = plain + s · unit.
    let mut coupling = vec![0.0; n];
    coupling[0] -= lower[0];
    coupling[n - 1] -= upper[n - 1];
    let plain = tridiagonal(&lower, &middle, &upper, &right);
    let unit = tridiagonal(&lower, &middle, &upper, &coupling);
    let seam = (slope - first / 6.0 * plain[0] - last / 6.0 * plain[n - 1])
        / ((first + last) / 3.0 + first / 6.0 * unit[0] + last / 6.0 * unit[n - 1]);
    let mut bends = vec![seam];
    bends.extend(plain.iter().zip(&unit).map(|(plain, unit)| plain + seam * unit));
    bends.push(seam);
    bends
}

/// Solves a tridiagonal system (Thomas algorithm). `lower[0]` and the last of `upper` are not used.
fn tridiagonal(lower: &[f64], middle: &[f64], upper: &[f64], right: &[f64]) -> Vec<f64> {
    let n = middle.len();
    let mut factor = vec![0.0; n];
    let mut solution = vec![0.0; n];
    let mut pivot = middle[0];
    solution[0] = right[0] / pivot;
    for i in 1..n {
        factor[i] = upper[i - 1] / pivot;
        pivot = middle[i] - lower[i] * factor[i];
        solution[i] = (right[i] - lower[i] * solution[i - 1]) / pivot;
    }
    for i in (0..n - 1).rev() {
        solution[i] -= factor[i + 1] * solution[i + 1];
    }
    solution
}
