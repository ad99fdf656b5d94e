//! Experiments on single points of a model: the implementation of [`Experiments`].
//!
//! A chirp is a drive whose frequency changes at a constant rate. The motion during a chirp is integrated one
//! cycle of the drive after another. Each cycle of a chirp begins at the drive phase zero, with the final
//! frequency of the previous cycle. The measures of a cycle are therefore computed like the measures of a
//! drive period. The phase stays small, so the rounding errors of the phase also stay small.

use core::ops::ControlFlow;

use super::request::{ChirpRequest, ChirpResponse, ImposedMotion, ImpulseRequest, Trajectory, Unfinished};
use super::runner::Runner;
use super::sampler::{Sampler, columns as trajectory_columns, sampled, shown};
use super::simulator::{Experiments, Simulator};
use super::single::{PointRun, on_scalars};
use super::start::start_at;
use crate::body::BodyParameters;
use crate::drive::Samples;
use crate::measure::cycle::{SignalObserver, Sums, finish};
use crate::model::{ExperimentModel, Measure, Model, Signal, SignalSet};
use crate::modes::Mode;
use crate::num::{PerLane, Scalar};
use crate::ode::Start;
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve_until;
use crate::parameter::Invalid;

impl<M: ExperimentModel<N>, const N: usize> Experiments for Runner<M, N> {
    fn chirp(&self, run: &PointRun<'_>, request: &ChirpRequest) -> Result<ChirpResponse, Unfinished> {
        on_scalars!(run, R => chirp::<M, R, N>(&self.model, run, request))
    }

    fn free_response(&self, run: &PointRun<'_>, request: &ImpulseRequest) -> Result<Trajectory, Unfinished> {
        on_scalars!(run, R => free_response::<M, R, N>(&self.model, run, request))
    }

    /// Computes the forces at equally spaced times, from the first to the last sample of the given motion. No
    /// equation is integrated.
    fn imposed(&self, run: &PointRun<'_>, motion: &ImposedMotion) -> Result<Trajectory, Unfinished> {
        let ImposedMotion { stroke, pitch, samples } = motion;
        let (duration, other) = (stroke.duration(), pitch.duration());
        if (duration - other).abs() > 1e-9 * duration {
            return Err(Invalid::new(format!(
                "stroke and pitch must have the same duration, not {duration} s and {other} s"
            ))
            .into());
        }
        // Stroke and pitch are given, so the response of the wings to the motion of the body has no effect.
        let values = &BodyParameters::passive(M::DESCRIPTION.parameters, run.values);
        let model = self.model.variant(values);
        let constants = model.start(values)?.constants;
        let rows = (0..=*samples).map(|i| {
            if (run.interrupted)() {
                return Err(Unfinished::Interrupted);
            }
            let time = duration * (f64::from(i) / f64::from((*samples).max(1)));
            let (y, signals) = model.imposed(&constants, stroke.motion(time), pitch.motion(time));
            let mut row = vec![time];
            row.extend(y);
            row.extend(shown::<M::Signals>(&signals));
            Ok(row)
        });
        Ok(Trajectory { columns: trajectory_columns::<M, N>(), rows: rows.collect::<Result<_, _>>()? })
    }

    fn modes(&self, values: &[f64]) -> Result<Vec<Mode>, Invalid> {
        let model = self.model.variant(values);
        Ok(M::modes(&model.start(values)?.constants))
    }

    fn free_signals(&self) -> &'static [Signal] {
        M::FREE_SIGNALS
    }

    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator> {
        Box::new(Runner::<M, N>::with_experiments(self.model.sampled(samples)))
    }
}

/// Returns the response to a chirp. The wing is at rest when the chirp begins.
fn chirp<M: ExperimentModel<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    request: &ChirpRequest,
) -> Result<ChirpResponse, Unfinished> {
    let PointRun { solver, values, interrupted, .. } = *run;
    let ChirpRequest { from, to, rate, samples_per_cycle } = *request;
    // A cycle that begins with the frequency f ends with √(f² + 2r), see below.
    if !(from > 0.0 && to > 0.0 && (to - from) * rate > 0.0 && to * to + 2.0 * rate > 0.0) {
        return Err(Invalid::new(format!(
            "a chirp from {from} Hz cannot reach {to} Hz at {rate} Hz/s: frequencies must be more than zero, and the rate \
             must have the sign of the change and be more than {} Hz/s",
            -0.5 * to * to
        ))
        .into());
    }
    let model = model.variant(values);
    let start = start_at(&model, solver, values, None)?;
    let mut sampler = Sampler::new(samples_per_cycle);
    let mut rows = Vec::new();
    let (mut frequency, mut time, mut y) = (from, 0.0, start.y);
    // The final frequency is rounded, so the loop ends within 1e-9 of it.
    while (to - frequency) * rate > 1e-9 * to * rate.abs() {
        // One cycle: f T + r T²/2 = 1, ending with the frequency f + r T = √(f² + 2r).
        let square = frequency * frequency + 2.0 * rate;
        let end = square.sqrt();
        let span = 2.0 / (frequency + end);
        let (model, constants) = model.chirped(&start.constants, frequency, rate);
        let cycle = Start { constants, y, span, ..start };
        let observer = SignalObserver::<M>::all(&model);
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
            row.extend(measures(signal.measures).map(|measure| cycle.measure(measure) * signal.unit.factor));
        }
        rows.push(row);
        time += span;
        frequency = end;
    }
    let envelope = Trajectory { columns: envelope_columns::<M, N>(), rows };
    Ok(ChirpResponse { envelope, motion: sampler.finish::<M, N>() })
}

/// Returns the measures of a signal except the first harmonic. The first harmonic is meaningful only for a
/// periodic motion.
fn measures(of_signal: &[Measure]) -> impl Iterator<Item = Measure> + '_ {
    of_signal.iter().copied().filter(|&measure| measure != Measure::First)
}

/// Returns the column names of the table that contains one row for each cycle of a chirp.
fn envelope_columns<M: Model<N>, const N: usize>() -> Vec<String> {
    let mut columns = ["begin_s", "end_s", "frequency_hz"].map(str::to_owned).to_vec();
    for signal in M::Signals::TABLE {
        columns.extend(
            measures(signal.measures)
                .map(|measure| format!("{}_{}_{}", signal.name, measure.name(), signal.unit.suffix)),
        );
    }
    columns
}

/// Returns the motion after an impulse on the stroke, at a constant drive voltage.
fn free_response<M: ExperimentModel<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    request: &ImpulseRequest,
) -> Result<Trajectory, Unfinished> {
    let PointRun { solver, values, interrupted, .. } = *run;
    let ImpulseRequest { stroke_rate, duration, intervals } = *request;
    refuse_nonsense(request)?;
    let model = model.variant(values);
    let Start { constants, mut scale, .. } = start_at(&model, solver, values, None)?;
    let period = M::modes(&constants).first().map_or(f64::NAN, |mode| 1.0 / mode.frequency);
    let (model, constants, y) = model.released(&constants, stroke_rate);

    // Absolute tolerances shrink with a small motion, so that its relative accuracy is the same as for a large
    // one.
    let largest = y.iter().zip(&scale).fold(0.0_f64, |largest, (y, scale)| largest.max(y.abs() / scale));
    for scale in &mut scale {
        *scale *= largest.min(1.0);
    }

    // A span is about one period long and contains a whole number of intervals. The last span may end after the
    // duration.
    let interval = duration / f64::from(intervals);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the range of intervals"
    )]
    let per_span = (period / interval).round().max(1.0).min(f64::from(intervals)) as u32;
    let span = interval * f64::from(per_span);
    let start = Start::new(constants, y, span, scale);
    let spans = intervals.div_ceil(per_span);
    let mut motion = sampled::<M, R, N>(&model, solver, &start, spans, per_span, interrupted)?;
    motion.rows.truncate(intervals as usize + 1);
    Ok(motion)
}

/// Checks that the impulse is finite and not zero, and that the duration and the number of intervals are more
/// than zero.
fn refuse_nonsense(request: &ImpulseRequest) -> Result<(), Invalid> {
    let ImpulseRequest { stroke_rate, duration, intervals } = *request;
    if !(stroke_rate.is_finite() && stroke_rate != 0.0) {
        return Err(Invalid::new(format!(
            "the stroke rate of an impulse must be finite and not zero, not {stroke_rate} rad/s"
        )));
    }
    if !(duration.is_finite() && duration > 0.0) || intervals == 0 {
        return Err(Invalid::new(format!(
            "the duration and the number of intervals must be more than zero, not {duration} s and {intervals} intervals"
        )));
    }
    Ok(())
}
