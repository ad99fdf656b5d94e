//! Chord steps onto an orbit, with the linear map of an orbit of looser tolerances.

use super::newton::{FixedPoint, Newton, Step, fixed_point};

/// Steps after which the iteration is given up: one to three are usual.
const LONGEST: u32 = 6;

/// The factor by which the residual must at least fall from one step to the next.
const PROGRESS: f64 = 0.5;

/// The chord iteration `y ← y + (I − M)⁻¹ (Φ(y) − y)`: Φ is the period map, integrated without responses, and M the
/// monodromy matrix of an orbit nearby, corrected by what each step shows of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord<const N: usize> {
    /// The orbit whose monodromy matrix is taken.
    near: FixedPoint<N>,
    /// The beginning of the period that is being integrated, and of the one before it.
    y: [f64; N],
    before: Option<[f64; N]>,
    /// The end of that period.
    end: [f64; N],
    steps: u32,
    /// The residual of the period before.
    last: f64,
    /// True once a step has not led as near the orbit as was presumed.
    disproved: bool,
}

impl<const N: usize> Chord<N> {
    /// The iteration that begins on the orbit `near`.
    pub(super) fn new(near: FixedPoint<N>) -> Chord<N> {
        Chord { near, y: near.y, before: None, end: near.y, steps: 0, last: f64::INFINITY, disproved: false }
    }

    /// The iteration from the state `y` without a monodromy matrix, which begins as a march.
    pub(super) fn marching(y: [f64; N]) -> Chord<N> {
        Chord::new(FixedPoint { y, residual: f64::NAN, monodromy: [[0.0; N]; N], floquet_max: f64::NAN })
    }

    /// Takes the end of the period.
    pub(super) fn period_end(&mut self, end: &[f64; N]) {
        self.end = *end;
    }

    /// Takes note that a step has not led as near the orbit as was presumed.
    pub(super) fn disprove(&mut self) {
        self.disproved = true;
    }

    /// True once a step has not led as near the orbit as was presumed.
    pub(super) fn is_disproved(&self) -> bool {
        self.disproved
    }

    /// The beginning of the period that is being integrated.
    pub(super) fn y(&self) -> [f64; N] {
        self.y
    }

    /// This beginning as an orbit.
    pub(super) fn point(&self) -> FixedPoint<N> {
        FixedPoint { y: self.y, ..self.near }
    }

    /// The change of the state over the period, in the units of `newton`.
    pub(super) fn residual(&self, newton: &Newton<N>) -> f64 {
        newton.residual(&self.y, &self.end)
    }

    /// The next step after a period, in the units of `newton`. It leads to the orbit if the residual before it is at most
    /// `enough`.
    pub(super) fn step(&mut self, newton: &Newton<N>, enough: f64) -> Step<N> {
        let residual = self.residual(newton);
        self.learn(newton.scale());
        let slow = residual > PROGRESS * self.last || self.steps == LONGEST;
        let next = fixed_point(&self.near.monodromy, newton.scale(), &self.y, &self.end);
        let Some(next) = next.filter(|_| !slow) else { return Step::Stuck(residual) };
        self.steps += 1;
        self.last = residual;
        self.before = Some(self.y);
        self.y = next;
        if residual <= enough {
            Step::Found(FixedPoint { residual, ..self.point() })
        } else {
            Step::Again(next)
        }
    }

    /// Corrects the matrix by the last step, which should have ended on the orbit: Broyden's update. What is left of the
    /// change over a period is the error of the matrix along the step.
    fn learn(&mut self, scale: &[f64; N]) {
        let Some(before) = self.before else { return };
        let step: [f64; N] = core::array::from_fn(|i| (self.y[i] - before[i]) / scale[i]);
        let square: f64 = step.iter().map(|s| s * s).sum();
        if square == 0.0 {
            return;
        }
        for i in 0..N {
            let left = (self.end[i] - self.y[i]) / scale[i];
            for j in 0..N {
                self.near.monodromy[i][j] += left * step[j] / square;
            }
        }
    }
}
