//! Computes the modes of motion of a linear hover model, and names the modes.

use core::f64::consts::{LN_2, TAU};

use nalgebra::{Complex, DMatrix, SMatrix, Schur};

/// Number of states that determine the accelerations: velocities, rates, roll angle and pitch angle.
const DYNAMIC: usize = 8;

/// Names of motions, each with the indices of its states.
const MOTIONS: [(&str, &[usize]); 10] = [
    ("forward velocity", &[0]),
    ("sideways velocity", &[1]),
    ("vertical velocity", &[2]),
    ("roll", &[3, 6]),
    ("pitch", &[4, 7]),
    ("yaw", &[5]),
    ("heading", &[8]),
    ("forward position", &[9]),
    ("sideways position", &[10]),
    ("height", &[11]),
];

/// Indices of the states of the longitudinal motion, which is the motion in the plane of x and z.
const LONGITUDINAL: [usize; 6] = [0, 2, 4, 7, 9, 11];

/// The name of a mode contains all motions whose participation in the mode is at least this value.
const NAMED_SHARE: f64 = 0.2;

/// A mode is called longitudinal if the participation of the lateral states is at most this value. A mode is
/// called lateral if the participation of the longitudinal states is at most this value.
const COUPLED_SHARE: f64 = 0.1;

/// If the magnitude of an eigenvalue is at most this fraction of the largest magnitude, the eigenvalue counts
/// as zero.
const NEUTRAL: f64 = 1e-10;

/// A mode of motion, with one real eigenvalue or a pair of complex eigenvalues.
#[derive(Clone, Debug, PartialEq)]
pub struct HoverMode {
    /// Eigenvalue of the mode (1/s). For a complex pair, the field contains the eigenvalue with the positive
    /// imaginary part.
    pub eigenvalue: Complex<f64>,
    /// Participation of each state in the mode. The sum over all states is 1. The participation does not
    /// depend on the units of the states.
    ///
    /// Source: Pérez-Arriaga, Verghese and Schweppe, IEEE Transactions on Power Apparatus and Systems 101 (1982) 3117.
    pub participation: Vec<f64>,
}

impl HoverMode {
    /// Returns true if the mode consists of a change of heading or position alone. The eigenvalue is then zero.
    pub(super) fn is_displacement(&self) -> bool {
        self.participation[DYNAMIC..].iter().any(|share| *share != 0.0)
    }

    /// Returns the time (s) in which the mode grows to twice its amplitude, or `None` if the mode does not
    /// grow.
    pub fn time_to_double(&self) -> Option<f64> {
        (self.eigenvalue.re > 0.0).then(|| LN_2 / self.eigenvalue.re)
    }

    /// Returns the time (s) in which the mode decays to half its amplitude, or `None` if the mode does not
    /// decay.
    pub fn time_to_half(&self) -> Option<f64> {
        (self.eigenvalue.re < 0.0).then(|| -LN_2 / self.eigenvalue.re)
    }

    /// Returns the period of the mode (s), or `None` if the mode does not oscillate.
    pub fn period(&self) -> Option<f64> {
        (self.eigenvalue.im != 0.0).then(|| TAU / self.eigenvalue.im.abs())
    }

    /// Returns a name of the mode that lists its motions and its kind, such as `pitch and forward velocity
    /// (longitudinal oscillation)`.
    ///
    /// The name lists motions whose participation is at least a fifth. A mode with a negative real eigenvalue
    /// is called a subsidence, and a mode with a positive real eigenvalue is called a divergence. A mode with
    /// the eigenvalue zero is called neutral.
    pub fn name(&self) -> String {
        let share = |states: &[usize]| -> f64 {
            states.iter().filter_map(|&state| self.participation.get(state)).sum()
        };
        let mut moving: Vec<(f64, &str)> =
            MOTIONS.iter().map(|(name, states)| (share(states), *name)).collect();
        moving.retain(|(share, _)| *share >= NAMED_SHARE);
        moving.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        let moving: Vec<&str> = moving.into_iter().map(|(_, name)| name).collect();
        let longitudinal = share(&LONGITUDINAL);
        let plane = if longitudinal >= 1.0 - COUPLED_SHARE {
            "longitudinal"
        } else if longitudinal <= COUPLED_SHARE {
            "lateral"
        } else {
            "coupled"
        };
        let kind = if self.eigenvalue.im != 0.0 {
            "oscillation"
        } else if self.eigenvalue.re < 0.0 {
            "subsidence"
        } else if self.eigenvalue.re > 0.0 {
            "divergence"
        } else {
            return format!("{} (neutral)", listed(&moving));
        };
        format!("{} ({plane} {kind})", listed(&moving))
    }
}

/// Computes the modes of motion from the state matrix. Returns `None` if the iteration for the eigenvalues does not
/// converge, or if the matrix contains values that are not finite.
///
/// Heading and position have no effect on the eight states other than heading and position. Heading and each
/// position therefore have a separate mode with the eigenvalue zero. The eigenvectors are computed only for
/// the eight states without heading and position.
pub(super) fn modes(a: &DMatrix<f64>) -> Option<Vec<HoverMode>> {
    /// Largest number of iterations for the eigenvalues of eight states.
    const MOST_ITERATIONS: usize = 10_000;

    let dynamic: SMatrix<f64, DYNAMIC, DYNAMIC> = a.fixed_view::<DYNAMIC, DYNAMIC>(0, 0).into_owned();
    if dynamic.iter().any(|entry| !entry.is_finite()) {
        return None;
    }
    let schur = Schur::try_new(dynamic, f64::EPSILON, MOST_ITERATIONS)?;
    let eigenvalues = schur.complex_eigenvalues();
    let largest = eigenvalues.iter().map(|one| one.norm()).fold(0.0, f64::max);
    let mut modes = Vec::new();
    for &eigenvalue in eigenvalues.iter().filter(|eigenvalue| eigenvalue.im >= 0.0) {
        let is_neutral = eigenvalue.norm() <= NEUTRAL * largest;
        let eigenvalue = if is_neutral { Complex::new(0.0, 0.0) } else { eigenvalue };
        let mut participation = participation(&dynamic, eigenvalue)?;
        participation.resize(a.nrows(), 0.0);
        modes.push(HoverMode { eigenvalue, participation });
    }
    for state in DYNAMIC..a.nrows() {
        let mut participation = vec![0.0; a.nrows()];
        participation[state] = 1.0;
        modes.push(HoverMode { eigenvalue: Complex::new(0.0, 0.0), participation });
    }
    modes.sort_by(|one, other| {
        let (one, other) = (one.eigenvalue, other.eigenvalue);
        other.re.total_cmp(&one.re).then(other.im.total_cmp(&one.im))
    });
    Some(modes)
}

/// Returns the participation of each state in the mode with the given eigenvalue. The sum over all states is
/// 1.
///
/// The left and right eigenvectors are computed as the singular vectors of A − λ with the smallest singular
/// value.
fn participation(a: &SMatrix<f64, DYNAMIC, DYNAMIC>, eigenvalue: Complex<f64>) -> Option<Vec<f64>> {
    let decomposed = (a.map(Complex::from) - SMatrix::from_diagonal_element(eigenvalue)).svd(true, true);
    let (u, v_t) = (decomposed.u?, decomposed.v_t?);
    let values = decomposed.singular_values.iter().enumerate();
    let (smallest, _) = values.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let both = |i: usize| u[(i, smallest)].norm() * v_t[(smallest, i)].norm();
    let sum: f64 = (0..DYNAMIC).map(both).sum();
    // The eigenvectors of a repeated eigenvalue can have no state in common.
    let right = |i: usize| v_t[(smallest, i)].norm_sqr();
    Some((0..DYNAMIC).map(|i| if sum > 0.0 { both(i) / sum } else { right(i) }).collect())
}

/// Joins names to a text such as `a`, `a and b`, or `a, b and c`.
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [name] => (*name).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
