//! The free motion after an impulse on the stroke.

use core::ops::ControlFlow;

use super::motion::{Sampler, check};
use super::simulator::{ImpulseRequest, SolverSettings, Trajectory, Unfinished};
use crate::model::Motions;
use crate::num::Scalar;
use crate::ode::solve::solve_until;
use crate::ode::{Interrupt, Start};
use crate::parameter::Invalid;

/// Gives the stroke an impulse and samples the motion that follows.
pub(super) fn respond<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    request: &ImpulseRequest,
    interrupted: Interrupt<'_>,
) -> Result<Trajectory, Unfinished>
where
    M: Motions<N, S>,
    R: Scalar,
{
    let ImpulseRequest { stroke_rate, duration, intervals } = *request;
    refuse_nonsense(request)?;
    let driven = model.variant(values);
    let Start { constants, mut scale, .. } = driven.start(values)?;
    let period = 1.0 / M::modes(&constants)[0].frequency;
    let (model, constants, y) = driven.released(&constants, stroke_rate);

    // Absolute tolerances shrink with a small motion, so that it is as exact as a large one.
    let largest = y.iter().zip(&scale).fold(0.0_f64, |largest, (y, scale)| largest.max(y.abs() / scale));
    for scale in &mut scale {
        *scale *= largest.min(1.0);
    }

    // A span is about a period and a whole number of intervals. The last may reach beyond the duration.
    let interval = duration / f64::from(intervals);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the range of intervals"
    )]
    let per_span = (period / interval).round().clamp(1.0, f64::from(intervals)) as u32;
    let span = interval * f64::from(per_span);
    let start = Start { constants, y, span, scale, tighten: 1.0 };
    let spans = intervals.div_ceil(per_span);

    let mut sampler = Sampler::new(per_span);
    let mut ended = 0;
    let outcome = solve_until::<M, R, N>(
        &model,
        &solver.tolerances(),
        &start,
        interrupted,
        |c, attempt| {
            if attempt.t.lane(0) == 0.0 {
                sampler.begin_cycle(span);
            }
            sampler.step(&model, c, attempt);
        },
        |_| {
            ended += 1;
            if ended == spans { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    check(outcome.ending, interrupted)?;
    let mut motion = sampler.finish::<M, N, S>();
    motion.rows.truncate(intervals as usize + 1);
    Ok(motion)
}

fn refuse_nonsense(request: &ImpulseRequest) -> Result<(), Invalid> {
    let ImpulseRequest { stroke_rate, duration, intervals } = *request;
    if !(stroke_rate.is_finite() && stroke_rate != 0.0) {
        return Err(Invalid::new(format!(
            "an impulse cannot give the stroke a rate of {stroke_rate} rad/s: any finite number but zero"
        )));
    }
    if !(duration.is_finite() && duration > 0.0) || intervals == 0 {
        return Err(Invalid::new(format!(
            "a motion cannot be sampled over {duration} s in {intervals} intervals: both are more than zero"
        )));
    }
    Ok(())
}
