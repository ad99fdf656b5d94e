//! The free motion after an impulse on the stroke.

use crate::model::Motions;
use crate::num::Scalar;
use crate::ode::Start;
use crate::simulate::{ImpulseRequest, PointRun, Question, RequestError, Trajectory, Unfinished, sampled};

/// The drive is held still.
impl<M: Motions<N>, const N: usize> Question<M, N> for &ImpulseRequest {
    type Answer = Result<Trajectory, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Trajectory, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let ImpulseRequest { stroke_rate, duration, intervals } = *self;
        refuse_nonsense(self)?;
        let Start { constants, mut scale, .. } = model.start(values)?;
        let period = M::modes(&constants).first().map_or(f64::NAN, |mode| 1.0 / mode.frequency);
        let (model, constants, y) = model.released(&constants, stroke_rate);

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
        let start = Start::new(constants, y, span, scale);
        let spans = intervals.div_ceil(per_span);
        let mut motion = sampled::<M, R, N>(&model, solver, &start, spans, per_span, interrupted)?;
        motion.rows.truncate(intervals as usize + 1);
        Ok(motion)
    }
}

/// Checks that there is an impulse, and a motion to sample.
fn refuse_nonsense(request: &ImpulseRequest) -> Result<(), RequestError> {
    let ImpulseRequest { stroke_rate, duration, intervals } = *request;
    if !(stroke_rate.is_finite() && stroke_rate != 0.0) {
        return Err(RequestError::StrokeRate(stroke_rate));
    }
    if !(duration.is_finite() && duration > 0.0) || intervals == 0 {
        return Err(RequestError::Sampling { duration, intervals });
    }
    Ok(())
}
