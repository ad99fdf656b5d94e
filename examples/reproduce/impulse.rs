//! Free motions after an impulse that sets the stroke of the resting wing in motion.

use flap_core::num::Backend;
use flap_core::simulate::{ImpulseRequest, PointRun};
use flap_experiments::damped_sine::{self, DampedSine};
use flap_experiments::free::{FreeMotion, FreeRequest, examine, intervals, stroke_rate};

use crate::points::Bench;

/// Number of samples per period of the first mode.
const SAMPLES: u32 = 200;

/// Results of the first periods of a free motion.
pub(crate) struct Swing {
    pub(crate) fit: DampedSine,
    /// The stroke at the first reversal (deg).
    pub(crate) first_peak: f64,
}

impl Bench {
    /// Fits a damped sine to the first `cycles` periods after an impulse. The size of the impulse is
    /// `amplitude`, a stroke amplitude (rad). The impulse would cause this amplitude if the motion had only
    /// the first mode and no damping.
    pub(crate) fn swing(&self, values: &[f64], amplitude: f64, cycles: u32) -> Swing {
        let modes = self.experiments().modes(values).expect("published parameters are possible");
        let request = ImpulseRequest {
            stroke_rate: stroke_rate(&modes, amplitude).expect("the first mode swings"),
            duration: f64::from(cycles) / modes[0].frequency,
            intervals: intervals(f64::from(cycles), f64::from(SAMPLES)).expect("it is a short motion"),
        };
        let motion =
            self.experiments().free_response(&PointRun::new(Backend::best(), &self.solver, values), &request);
        let motion = motion.expect("the motion does not fail");
        let stroke = motion.columns.iter().position(|column| column == "stroke_deg").expect("it is a state");
        let stroke: Vec<f64> = motion.rows.iter().map(|row| row[stroke]).collect();
        let fit = damped_sine::fit(request.duration / f64::from(request.intervals), &stroke);
        let first_peak = stroke.windows(2).find(|pair| pair[1] < pair[0]).map_or(f64::NAN, |pair| pair[0]);
        Swing { fit: fit.expect("the stroke swings"), first_peak }
    }

    /// Returns the spectra of stroke and pitch in the first second after an impulse of the size `amplitude`
    /// (see [`swing`](Self::swing)).
    pub(crate) fn spectra(&self, values: &[f64], amplitude: f64) -> FreeMotion {
        let request =
            FreeRequest { amplitude, fit_cycles: 4, spectrum_window: 1.0, samples_per_cycle: SAMPLES };
        examine(self.experiments(), &PointRun::new(Backend::best(), &self.solver, values), &request)
            .expect("the motion does not fail")
    }
}
