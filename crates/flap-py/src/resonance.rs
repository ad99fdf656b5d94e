//! Computes the resonances of one point in small motions, in the free motion after an impulse, and in the
//! driven motion.

use flap_core::modes::Mode;
use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Unfinished};
use flap_experiments::free::{self, FreeRequest};
use flap_sweep::resonance::driven;
use flap_sweep::resonance::{DRIVE_FREQUENCY, Range};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::point::Chosen;
use crate::watch::interruptible;
use crate::{convert, design, error};

/// Number of samples of a free motion per period of the first mode.
const SAMPLES: u32 = 200;

/// The resonances of a point, as a dictionary; see `flapwing.Resonances`.
#[derive(IntoPyObject)]
pub(crate) struct Resonances<'py> {
    linear_hz: Bound<'py, PyDict>,
    impulse_fit: Option<Sine>,
    stroke_spectrum_hz: Vec<f64>,
    pitch_spectrum_hz: Vec<f64>,
    driven: Vec<Peak>,
    larger_at_hz: f64,
    gaps: Vec<Gap>,
}

/// A damped sine.
#[derive(IntoPyObject)]
struct Sine {
    frequency_hz: f64,
    decay_1_s: f64,
    relative_rms: f64,
}

/// A peak of the settled stroke over drive frequency.
#[derive(IntoPyObject)]
struct Peak {
    frequency_hz: f64,
    stroke_pp_deg: f64,
    pitch_pp_deg: f64,
}

/// A range of drive frequencies without a periodic motion.
#[derive(IntoPyObject)]
struct Gap {
    start_hz: f64,
    stop_hz: f64,
    status: &'static str,
}

/// Compute the resonances of one point; see `flapwing.resonance`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point, start, stop, tolerance, impulse, fit_cycles, spectrum_window))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn resonance<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    start: Option<&Bound<'py, PyAny>>,
    stop: Option<&Bound<'py, PyAny>>,
    tolerance: &Bound<'py, PyAny>,
    impulse: &Bound<'py, PyAny>,
    fit_cycles: &Bound<'py, PyAny>,
    spectrum_window: &Bound<'py, PyAny>,
) -> PyResult<Resonances<'py>> {
    let chosen = Chosen::new(design, keywords, point, None)?.possible()?;
    design::check_one_wing(&chosen.plan)?;
    let (simulator, solver, values) = (chosen.plan.robot().model(), chosen.plan.solver(), &chosen.values);
    let frequency = |name, value: Option<&Bound<'py, PyAny>>| {
        value.map(|value| convert::quantity(name, "Hz", true, value)).transpose()
    };
    let request = FreeRequest {
        amplitude: convert::impulse("impulse", impulse)?,
        fit_cycles: convert::count("fit_cycles", fit_cycles)?,
        spectrum_window: convert::duration("spectrum_window", spectrum_window)?,
        samples_per_cycle: SAMPLES,
    };
    let backend = Backend::best();
    let experiments = simulator.experiments().map_err(|reason| error::unfinished(&reason))?;
    let modes = experiments.modes(values).map_err(|reason| error::unfinished(&reason))?;
    let range = Range {
        from: frequency("start", start)?,
        to: frequency("stop", stop)?,
        tolerance: convert::quantity("tolerance", "Hz", true, tolerance)?,
        ..Range::default()
    };
    let found = interruptible(py, |interrupted| {
        let run = PointRun::new(backend, solver, values).until(interrupted);
        let free = free::examine(experiments, &run, &request)?;
        let fixed: Vec<usize> =
            Parameter::index(chosen.plan.parameters(), DRIVE_FREQUENCY).into_iter().collect();
        Ok((free, driven::search(simulator, &run, &range, |values| chosen.plan.update(values, &fixed))?))
    })?;
    let (free, driven) = found.map_err(|reason: Unfinished| error::unfinished(&reason))?;

    let fit = free.fit.map(|fit| Sine {
        frequency_hz: fit.frequency,
        decay_1_s: fit.decay,
        relative_rms: fit.relative_rms,
    });
    let peaks = driven.peaks.iter().map(|peak| Peak {
        frequency_hz: peak.frequency,
        stroke_pp_deg: peak.stroke_pp,
        pitch_pp_deg: peak.pitch_pp,
    });
    let gaps =
        driven.gaps.iter().map(|gap| Gap { start_hz: gap.from, stop_hz: gap.to, status: gap.status.name() });
    let spectrum = |wanted: &str| {
        let peaks = free.spectra.iter().find(|(signal, _)| *signal == wanted).map(|(_, peaks)| peaks);
        peaks.into_iter().flatten().map(|peak| peak.frequency).collect()
    };
    let linear = modes.into_iter().map(|Mode { name, frequency }| (name, frequency)).collect::<Vec<_>>();
    Ok(Resonances {
        linear_hz: linear.into_py_dict(py)?,
        impulse_fit: fit,
        stroke_spectrum_hz: spectrum("stroke"),
        pitch_spectrum_hz: spectrum("pitch"),
        driven: peaks.collect(),
        larger_at_hz: driven.larger_at.unwrap_or(f64::NAN),
        gaps: gaps.collect(),
    })
}
