//! Newton's iteration on the period map: from a state near a periodic orbit onto it.

use nalgebra::{SMatrix, SVector};

use crate::measure::multipliers::{monodromy, spectral_radius};

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
    /// The error of the march.
    slack: f64,
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
            slack: tolerance,
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

    /// The same search after a march whose last period began at `before` and ended at `after`.
    pub(super) fn after(self, before: &[f64; N], after: &[f64; N]) -> Newton<N> {
        Newton { march: [*before, *after], iterations: 1, ..self }
    }

    /// The same search after a march that errs by `slack`, in units of the states' typical sizes.
    pub(super) fn allowing(self, slack: f64) -> Newton<N> {
        Newton { slack, ..self }
    }

    /// The search that goes on from where this one was stuck, on the period map of finer integration. Returns it with
    /// the state at which it goes on.
    pub(super) fn resumed(self) -> (Newton<N>, [f64; N]) {
        (self.resumed_at(self.y), self.y)
    }

    /// The search that goes on from the state `y`, on the period map of other tolerances.
    pub(super) fn resumed_at(self, y: [f64; N]) -> Newton<N> {
        Newton { y, iterations: 1, residual: f64::INFINITY, ..self }
    }

    /// Judges a period, given its end with the responses to changes of its beginning.
    pub(super) fn judge<const K: usize>(&mut self, all: &[f64; K]) -> Step<N> {
        let end: [f64; N] = core::array::from_fn(|i| all[i]);
        if self.iterations == 0 {
            self.march[1] = end;
        }
        let residual = self.residual(&self.y, &end);
        let monodromy = self.monodromy(all);
        let slow = residual > PROGRESS * self.residual || self.iterations == LONGEST;
        let next = fixed_point(&monodromy, &self.scale, &self.y, &end);
        if residual <= self.goal || (slow && residual <= self.enough) {
            let y = next.unwrap_or(end);
            let point = FixedPoint { y, residual, monodromy, floquet_max: spectral_radius(&monodromy) };
            return if self.leads_to(&point) { Step::Found(point) } else { Step::Failed };
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

    /// The same search from the state `y`.
    pub(super) fn moved_to(self, y: [f64; N]) -> Newton<N> {
        Newton { y, ..self }
    }

    /// The fixed point of the linear map of the period that is being integrated, given its end with the responses.
    pub(super) fn linearised<const K: usize>(&self, all: &[f64; K]) -> Option<FixedPoint<N>> {
        let end: [f64; N] = core::array::from_fn(|i| all[i]);
        let y = fixed_point(&self.monodromy(all), &self.scale, &self.y, &end)?;
        Some(FixedPoint { residual: self.residual(&self.y, &end), ..self.point(y, all) })
    }

    /// The state `y` as an orbit, with the monodromy matrix of the period that is being integrated.
    pub(super) fn point<const K: usize>(&self, y: [f64; N], all: &[f64; K]) -> FixedPoint<N> {
        let monodromy = self.monodromy(all);
        FixedPoint { y, residual: f64::NAN, monodromy, floquet_max: spectral_radius(&monodromy) }
    }

    /// The change of the state over a period from `y` to `end`: in units of the scales, in a motion smaller than these
    /// relative to its own size.
    pub(super) fn residual(&self, y: &[f64; N], end: &[f64; N]) -> f64 {
        let change = difference(end, y);
        let size = self.size(end).max(self.size(y)).min(1.0);
        if change == [0.0; N] { 0.0 } else { self.size(&change) / size }
    }

    /// The residual that is aimed at.
    pub(super) fn goal(&self) -> f64 {
        self.goal
    }

    /// True if the residual is as small as the search aims at.
    pub(super) fn is_enough(&self, residual: f64) -> bool {
        residual <= self.goal
    }

    /// Typical sizes of the states.
    pub(super) fn scale(&self) -> &[f64; N] {
        &self.scale
    }

    /// The monodromy matrix, given the end of a period with its responses.
    pub(super) fn monodromy<const K: usize>(&self, all: &[f64; K]) -> [[f64; N]; N] {
        monodromy(all, &self.scale)
    }

    /// True if the orbit is stable, and the march was on its way to it.
    pub(super) fn leads_to(&self, orbit: &FixedPoint<N>) -> bool {
        orbit.floquet_max < 1.0 && self.approaches(orbit)
    }

    /// True if the march, in the period with which the search began, moved towards the orbit through `y` as the orbit's
    /// linear map predicts. Then the march was near the orbit and, if that is stable, goes there.
    fn approaches(&self, orbit: &FixedPoint<N>) -> bool {
        let FixedPoint { y, monodromy, .. } = orbit;
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
        astray <= LINEAR * distance + self.slack
    }

    /// The largest component in units of the scales.
    fn size(&self, y: &[f64; N]) -> f64 {
        (0..N).fold(0.0, |size, i| (y[i].abs() / self.scale[i]).max(size))
    }
}

impl<const N: usize> FixedPoint<N> {
    /// The fixed point of a slightly different map, which takes this one's state to `end`. `None` if it is not near.
    pub(super) fn of_map(&self, scale: &[f64; N], end: &[f64; N]) -> Option<[f64; N]> {
        fixed_point(&self.monodromy, scale, &self.y, end)
    }
}

/// The fixed point of the linear map that takes `y` to `end`, and changes small changes of y as the monodromy matrix
/// says. `None` if the linear system is singular or not finite.
pub(super) fn fixed_point<const N: usize>(
    monodromy: &[[f64; N]; N],
    scale: &[f64; N],
    y: &[f64; N],
    end: &[f64; N],
) -> Option<[f64; N]> {
    let inverse =
        SMatrix::<f64, N, N>::from_fn(|i, j| f64::from(u8::from(i == j)) - monodromy[i][j]).try_inverse()?;
    let step = inverse * SVector::<f64, N>::from_fn(|i, _| (end[i] - y[i]) / scale[i]);
    let is_finite = step.iter().all(|component| component.is_finite());
    is_finite.then(|| core::array::from_fn(|i| y[i] + step[i] * scale[i]))
}

fn difference<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] - b[i])
}
