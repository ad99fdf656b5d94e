//! Integration of many initial value problems at once.

use super::queue::{MOST_LANES, Next, Observer, Queue, SpanEnd};
use super::schedule::run;
use crate::num::{Backend, Kernel, Simd};
use crate::ode::{Ending, Ode, Outcome, Start, Tolerances};

/// Result of the integration of a run.
#[derive(Clone, Copy, Debug)]
pub struct Integrated<T, const N: usize> {
    /// Final state of the run, or the last state before a failure.
    pub y: [f64; N],
    /// Sums that the observer has computed over the steps of the run.
    pub totals: T,
    /// Reason for the end of the run, and the numbers of steps and evaluations.
    pub outcome: Outcome,
}

/// Integrates one run from each initial state in `starts` over `spans` time spans, in the SIMD lanes of
/// `backend`.
///
/// The results have the order of `starts`. `observer` sums up quantities during the runs. If you do not need
/// sums, use [`Unobserved`](super::Unobserved). `spans` must be at least 1.
///
/// The example integrates the decay x' = −k x with 1,000 rates k (1/s), from x = 1 over one second.
///
/// ```
/// use flap_core::num::{Backend, Real};
/// use flap_core::ode::ensemble::{Unobserved, integrate};
/// use flap_core::ode::{Ode, Start, Tolerances};
///
/// struct Decay;
///
/// impl Ode<1> for Decay {
///     type Constants<R: Real> = R;
///     type Input<R: Real> = ();
///
///     #[inline(always)]
///     fn input<R: Real>(&self, _rate: &R, _t: R) {}
///
///     #[inline(always)]
///     fn rhs<R: Real>(&self, rate: &R, _: &(), _side: R, x: &[R; 1]) -> [R; 1] {
///         [-(*rate * x[0])]
///     }
/// }
///
/// let starts: Vec<_> = (0..1000).map(|i| Start::new(f64::from(i) * 0.01, [1.0], 1.0, [1.0])).collect();
/// let tolerances = Tolerances { rtol: 1e-8, atol: 1e-10, max_steps: 1000 };
/// let ends = integrate(Backend::best(), &Decay, &Unobserved, &tolerances, &starts, 1);
/// for (start, end) in starts.iter().zip(&ends) {
///     assert!((end.y[0] - (-start.constants).exp()).abs() < 1e-7);
/// }
/// ```
pub fn integrate<O: Ode<N>, V: Observer<O, N>, const N: usize>(
    backend: Backend,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    starts: &[Start<O::Constants<f64>, N>],
    spans: u32,
) -> Vec<Integrated<V::Totals<f64>, N>> {
    backend.dispatch(Integrate { ode, observer, tolerances, starts, spans })
}

struct Integrate<'a, O: Ode<N>, V, const N: usize> {
    ode: &'a O,
    observer: &'a V,
    tolerances: &'a Tolerances,
    starts: &'a [Start<O::Constants<f64>, N>],
    spans: u32,
}

impl<O: Ode<N>, V: Observer<O, N>, const N: usize> Kernel for Integrate<'_, O, V, N> {
    type Output = Vec<Integrated<V::Totals<f64>, N>>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Self::Output {
        let Integrate { ode, observer, tolerances, starts, spans } = self;
        let mut queue =
            List { starts, spans, begun: 0, lanes: [(0, 0); MOST_LANES], ends: vec![None; starts.len()] };
        run(simd, ode, observer, tolerances, &mut queue);
        // Every run has ended, so no entry is `None`.
        queue.ends.into_iter().flatten().collect()
    }
}

struct List<'a, C, T, const N: usize> {
    starts: &'a [Start<C, N>],
    spans: u32,
    begun: usize,
    /// Index of the run in each lane, and the number of time spans that the run still needs.
    lanes: [(usize, u32); MOST_LANES],
    ends: Vec<Option<Integrated<T, N>>>,
}

impl<O: Ode<N>, V: Observer<O, N>, const N: usize> Queue<O, V, N>
    for List<'_, O::Constants<f64>, V::Totals<f64>, N>
{
    fn next(&mut self, lane: usize, _idle: bool) -> Option<Start<&O::Constants<f64>, N>> {
        let start = self.starts.get(self.begun)?;
        self.lanes[lane] = (self.begun, self.spans);
        self.begun += 1;
        Some(start.with(&start.constants))
    }

    fn ended(&mut self, lane: usize, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<Next<N>> {
        let SpanEnd { y, totals, outcome, .. } = end;
        let (position, spans) = &mut self.lanes[lane];
        self.ends[*position] = Some(Integrated { y: *y, totals: *totals, outcome });
        *spans -= 1;
        (outcome.ending == Ending::Stopped && *spans > 0).then_some(Next::Span)
    }
}
