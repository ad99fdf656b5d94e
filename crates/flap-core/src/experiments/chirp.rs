//! The response to a chirp: a drive whose frequency changes steadily.
//!
//! A chirp is a chain of cycles. Each begins at phase zero with the frequency that the last one ended with, so
//! every cycle can be measured like a drive period, and no growing phase loses digits.

use core::ops::ControlFlow;

use crate::measure::cycle::{Signals, Sums, finish};
use crate::model::{Measure, Model, Motions, SignalSet};
use crate::num::{PerLane, Scalar};
use crate::ode::Start;
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve_until;
use crate::simulate::{
    ChirpRequest, ChirpResponse, PointRun, Question, RequestError, Sampler, Trajectory, Unfinished,
};

/// The chirp begins at rest.
impl<M: Motions<N>, const N: usize> Question<M, N> for &ChirpRequest {
    type Answer = Result<ChirpResponse, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<ChirpResponse, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let ChirpRequest { from, to, rate, samples_per_cycle } = *self;
        if !(from > 0.0 && to > 0.0 && (to - from) * rate > 0.0) {
            return Err(RequestError::Chirp { from, to, rate }.into());
        }
        let start = model.start(values)?;
        let mut sampler = Sampler::new(samples_per_cycle);
        let mut rows = Vec::new();
        let (mut frequency, mut time, mut y) = (from, 0.0, start.y);
        // The frequency at the end is rounded: a chirp that has arrived but for that is over.
        while (to - frequency) * rate > 1e-9 * to * rate.abs() {
            // One cycle: f T + r T²/2 = 1, ending with the frequency f + r T = √(f² + 2r).
            let square = frequency * frequency + 2.0 * rate;
            if square <= 0.0 {
                break;
            }
            let end = square.sqrt();
            let span = 2.0 / (frequency + end);
            let (model, constants) = model.chirped(&start.constants, frequency, rate);
            let cycle = Start { constants, y, span, ..start };
            let observer = Signals::<M>::all(&model);
            let mut totals = Sums::<M::Signals, R>::fill(R::new(0.0), &Observer::<M, N>::nothing(&observer));
            sampler.begin_cycle(span);
            let outcome = solve_until::<M, R, N>(
                &model,
                &solver.tolerances(),
                &cycle,
                interrupted,
                &mut |c, attempt| {
                    R::enter(
                        #[inline(always)]
                        || observer.add(c, attempt, true, &mut totals),
                    );
                    if samples_per_cycle > 0 {
                        sampler.step(&model, c, attempt);
                    }
                },
                &mut |end| {
                    y = *end;
                    ControlFlow::Break(())
                },
            );
            Unfinished::check(outcome.ending, interrupted)?;

            let mut row = vec![time, time + span, 1.0 / span];
            let cycle = finish::<M::Signals>(&totals.get(0), span);
            for (signal, cycle) in M::Signals::each(&cycle) {
                row.extend(
                    measures(signal.measures).map(|measure| cycle.measure(measure) * signal.unit.factor),
                );
            }
            rows.push(row);
            time += span;
            frequency = end;
        }
        let envelope = Trajectory { columns: columns::<M, N>(), rows };
        Ok(ChirpResponse { envelope, motion: sampler.finish::<M, N>() })
    }
}

/// The measures that mean something in a cycle that is not periodic.
fn measures(of_signal: &[Measure]) -> impl Iterator<Item = Measure> + '_ {
    of_signal.iter().copied().filter(|&measure| measure != Measure::First)
}

/// Names of the envelope's columns.
fn columns<M: Model<N>, const N: usize>() -> Vec<String> {
    let mut columns = ["begin_s", "end_s", "frequency_hz"].map(str::to_owned).to_vec();
    for signal in M::Signals::TABLE {
        columns.extend(
            measures(signal.measures)
                .map(|measure| format!("{}_{}_{}", signal.name, measure.name(), signal.unit.suffix)),
        );
    }
    columns
}
