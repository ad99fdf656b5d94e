//! Newton's iteration on the period map: from a state near a periodic orbit onto it.

use nalgebra::DMatrix;

use crate::ode::variation::response;

/// Iterations after which a search is given up: where it converges at all, it takes two to four.
const LONGEST: u32 = 8;

/// The factor by which the residual must at least fall from one iteration to the next.
const PROGRESS: f64 = 0.5;

/// The largest distance between the march and the prediction of the orbit's linear map, relative to the distance between
/// march and orbit.
const LINEAR: f64 = 0.3;

/// The search for the fixed point of the map from the state at the beginning of a period to that at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Newton<const N: usize> {
    scale: [f64; N],
    /// The residual that is aimed at, and the one that will do if it cannot be reached.
    goal: f64,
    enough: f64,
    /// The state of the march when the search began, and a period later.
    march: [[f64; N]; 2],
    /// The beginning of the period that is being integrated.
    y: [f64; N],
    iterations: u32,
    residual: f64,
}

/// A fixed point.
#[derive(Clone, Copy, Debug)]
pub(super) struct FixedPoint<const N: usize> {
    pub(super) y: [f64; N],
    /// Change of the state over a period, in units of [`Newton::new`]'s scales.
    pub(super) residual: f64,
    /// Responses of the end of the period to changes of its beginning, in units of [`Newton::new`]'s scales; not
    /// numbers if they are not known.
    pub(super) monodromy: [[f64; N]; N],
    /// Largest modulus of the Floquet multipliers.
    pub(super) floquet_max: f64,
}

/// The result of a period.
pub(super) enum Step<const N: usize> {
    /// To be integrated from this state.
    Again([f64; N]),
    /// An orbit to which the march was on its way.
    Found(FixedPoint<N>),
    /// The residual, given here, hardly falls any more, or the linear system cannot be solved.
    Stuck(f64),
    /// An orbit that the march does not approach, or a period that cannot be integrated.
    Failed,
}

impl<const N: usize> Newton<N> {
    /// A search that begins where a march has come to. Changes of a component count in units of its `scale`, in a motion
    /// smaller than its scales relative to the motion's own size.
    pub(super) fn new(y: &[f64; N], scale: &[f64; N], tolerance: f64) -> Newton<N> {
        Newton {
            scale: *scale,
            goal: tolerance,
            enough: tolerance,
            march: [*y; 2],
            y: *y,
            iterations: 0,
            residual: f64::INFINITY,
        }
    }

    /// The same search, which aims at the residual `goal`.
    pub(super) fn aiming_at(self, goal: f64) -> Newton<N> {
        Newton { goal, ..self }
    }

    /// The search that goes on from where this one was stuck, on the period map of finer integration. Returns it with
    /// the state at which it goes on.
    pub(super) fn resumed(self) -> (Newton<N>, [f64; N]) {
        (Newton { iterations: 1, residual: f64::INFINITY, ..self }, self.y)
    }

    /// Judges a period, given its end with the responses to changes of its beginning.
    pub(super) fn judge<const K: usize>(&mut self, all: &[f64; K]) -> Step<N> {
        let end: [f64; N] = core::array::from_fn(|i| all[i]);
        if self.iterations == 0 {
            self.march[1] = end;
        }
        let change = difference(&end, &self.y);
        let size = self.size(&end).max(self.size(&self.y)).min(1.0);
        let residual = if change == [0.0; N] { 0.0 } else { self.size(&change) / size };
        let monodromy = self.monodromy(all);
        let slow = residual > PROGRESS * self.residual || self.iterations == LONGEST;
        let next = fixed_point(&monodromy, &self.scale, &self.y, &change);
        if residual <= self.goal || (slow && residual <= self.enough) {
            let y = next.unwrap_or(end);
            let point = FixedPoint { y, residual, monodromy, floquet_max: spectral_radius(&monodromy) };
            let approached = point.floquet_max < 1.0 && self.approaches(&point.y, &monodromy);
            return if approached { Step::Found(point) } else { Step::Failed };
        }
        self.residual = residual;
        self.iterations += 1;
        match next {
            Some(next) if !slow => {
                self.y = next;
                Step::Again(next)
            }
            _ => Step::Stuck(residual),
        }
    }

    /// Column j: response to a change of component j by its scale, in units of the scales.
    pub(super) fn monodromy<const K: usize>(&self, all: &[f64; K]) -> [[f64; N]; N] {
        let mut monodromy = [[0.0; N]; N];
        for j in 0..N {
            let column = response::<N, K>(all, j);
            for i in 0..N {
                monodromy[i][j] = column[i] / self.scale[i];
            }
        }
        monodromy
    }

    /// True if the march, in the period with which the search began, moved towards the orbit through `y` as the orbit's
    /// linear map predicts. Then the march was near the orbit and, if that is stable, goes there.
    fn approaches(&self, y: &[f64; N], monodromy: &[[f64; N]; N]) -> bool {
        let [before, after] = self.march.map(|march| {
            let distance = difference(&march, y);
            core::array::from_fn::<f64, N, _>(|i| distance[i] / self.scale[i])
        });
        let mut astray = 0.0_f64;
        let mut distance = 0.0_f64;
        for i in 0..N {
            let mut predicted = 0.0;
            for j in 0..N {
                predicted += monodromy[i][j] * before[j];
            }
            astray = astray.max((after[i] - predicted).abs());
            distance = distance.max(before[i].abs());
        }
        astray <= LINEAR * distance + self.enough
    }

    /// The largest component in units of the scales.
    fn size(&self, y: &[f64; N]) -> f64 {
        (0..N).fold(0.0, |size, i| (y[i].abs() / self.scale[i]).max(size))
    }
}

impl<const N: usize> FixedPoint<N> {
    /// The fixed point of a slightly different map, which takes this one's state to `end`. `None` if it is not near.
    pub(super) fn of_map(&self, scale: &[f64; N], end: &[f64; N]) -> Option<[f64; N]> {
        fixed_point(&self.monodromy, scale, &self.y, &difference(end, &self.y))
    }
}

/// The fixed point of the linear map that changes `y` by `change`, and small changes of y as the monodromy matrix says.
fn fixed_point<const N: usize>(
    monodromy: &[[f64; N]; N],
    scale: &[f64; N],
    y: &[f64; N],
    change: &[f64; N],
) -> Option<[f64; N]> {
    let scaled = core::array::from_fn(|i| change[i] / scale[i]);
    let step = solve(&identity_minus(monodromy), &scaled)?;
    Some(core::array::from_fn(|i| y[i] + step[i] * scale[i]))
}

fn difference<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// The identity matrix.
pub(super) fn identity<const N: usize>() -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// The product `second * first`.
pub(super) fn product<const N: usize>(second: &[[f64; N]; N], first: &[[f64; N]; N]) -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| (0..N).map(|k| second[i][k] * first[k][j]).sum()))
}

fn identity_minus<const N: usize>(m: &[[f64; N]; N]) -> [[f64; N]; N] {
    let identity = identity::<N>();
    core::array::from_fn(|i| core::array::from_fn(|j| identity[i][j] - m[i][j]))
}

/// Solves a small linear system by elimination with pivoting; `None` if it is singular or not finite.
fn solve<const N: usize>(matrix: &[[f64; N]; N], right: &[f64; N]) -> Option<[f64; N]> {
    let (mut a, mut b) = (*matrix, *right);
    for k in 0..N {
        let pivot = (k..N).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        if !(a[pivot][k].abs() > 1e-14 && a[pivot][k].is_finite()) {
            return None;
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..N {
            let factor = a[i][k] / a[k][k];
            for j in k..N {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..N).rev() {
        for j in k + 1..N {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b.iter().all(|x| x.is_finite()).then_some(b)
}

/// Largest modulus of the eigenvalues; infinite if one of the matrix's components is, NaN if one is not a number.
pub(super) fn spectral_radius<const N: usize>(m: &[[f64; N]; N]) -> f64 {
    if m.iter().flatten().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    if m.iter().flatten().any(|x| x.is_infinite()) {
        return f64::INFINITY;
    }
    let matrix = DMatrix::from_fn(N, N, |i, j| m[i][j]);
    matrix.complex_eigenvalues().iter().fold(0.0, |radius, value| libm::hypot(value.re, value.im).max(radius))
}
