//! Simulated experiments, each with one design point: chirps, impulses, and forces along a given motion.

use flap_core::drive::Repeat;
use flap_core::parameter::Invalid;
use flap_core::simulate::{ChirpRequest, Experiments, ImposedMotion, ImpulseRequest};
use flap_experiments::free::{first, intervals, stroke_rate};
use flap_sweep::files::record;
use flap_sweep::resonance::DRIVE_FREQUENCY;
use flap_sweep::study::experiment;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::point::Chosen;
use crate::watch::interruptible;
use crate::{convert, error, motion, records};

/// Simulate a chirp; see `flapwing.chirp`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point, start, stop, rate, samples))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn chirp<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    start: &Bound<'py, PyAny>,
    stop: Option<&Bound<'py, PyAny>>,
    rate: &Bound<'py, PyAny>,
    samples: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.for_motion(py)?;
    let from = convert::quantity("start", "Hz", true, start)?;
    let frequency = chosen.plan.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY);
    let to = match stop {
        Some(stop) => convert::quantity("stop", "Hz", true, stop)?,
        None => frequency.map_or(from, |index| 2.0 * chosen.values[index]),
    };
    let request = ChirpRequest {
        from,
        to,
        rate: convert::quantity("rate", "Hz/s", true, rate)?,
        samples_per_cycle: samples.map_or(Ok(0), |samples| convert::count("samples", samples))?,
    };
    let experiments = experiments(&chosen)?;
    let response = interruptible(py, |interrupted| {
        experiment::chirp(experiments, &chosen.run().until(interrupted), &request)
    })?;
    let response = response.map_err(|reason| error::experiment(&reason))?;
    let meta = chosen.meta(py)?;
    if samples.is_some() {
        let meanings = motion::meanings(chosen.simulator(), &response.motion)?;
        return motion::into_python(py, response.motion, meanings, &meta);
    }
    let measured = chosen.simulator().columns();
    let meaning = |name: &str| match name {
        "begin_s" => "time at which the cycle begins".to_owned(),
        "end_s" => "time at which the cycle ends".to_owned(),
        "frequency_hz" => "cycles per second in this cycle".to_owned(),
        _ => measured
            .iter()
            .find(|column| column.name == name)
            .map_or_else(String::new, |column| column.doc.clone()),
    };
    motion::into_python(py, response.envelope, meaning, &meta)
}

/// Default duration of the simulated motion after an impulse, in periods of the first mode.
const CYCLES: f64 = 10.0;

/// Simulate the motion after an impulse; see `flapwing.impulse`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point, amplitude, duration, samples))]
pub(crate) fn impulse<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    amplitude: &Bound<'py, PyAny>,
    duration: Option<&Bound<'py, PyAny>>,
    samples: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.for_motion(py)?;
    let experiments = experiments(&chosen)?;
    let modes = experiments.modes(&chosen.values).map_err(|reason| error::unfinished(&reason))?;
    let amplitude = convert::impulse("amplitude", amplitude)?;
    let invalid = |reason: Invalid| error::unfinished(&reason);
    let stroke_rate = stroke_rate(&modes, amplitude).map_err(invalid)?;
    let frequency = first(&modes).map_err(invalid)?.frequency;
    let duration = match duration {
        Some(duration) => convert::duration("duration", duration)?,
        None => CYCLES / frequency,
    };
    let per_second = frequency * f64::from(convert::count("samples", samples)?);
    let intervals = intervals(duration, per_second).map_err(invalid)?;
    let request = ImpulseRequest { stroke_rate, duration, intervals };
    let free = interruptible(py, |interrupted| {
        experiments.free_response(&chosen.run().until(interrupted), &request)
    })?;
    let free = free.map_err(|reason| error::unfinished(&reason))?;
    let meta = chosen.meta(py)?;
    meta.set_item("mode_hz", frequency)?;
    meta.set_item("stroke_rate_rad_s", stroke_rate)?;
    let meanings = motion::meanings(chosen.simulator(), &free)?;
    motion::into_python(py, free, meanings, &meta)
}

/// Compute the forces on a wing along a given motion; see `flapwing.forces_along`.
#[pyfunction]
#[pyo3(signature = (design, motion, keywords, /, *, point, periodic, samples))]
pub(crate) fn forces_along<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    motion: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    periodic: bool,
    samples: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.for_motion(py)?;
    let repeat = if periodic { Repeat::Periodic } else { Repeat::Once };
    let record = records::read("motion", motion)?;
    let imposed = ImposedMotion {
        stroke: records::samples(&record, &record::STROKE, repeat)?,
        pitch: records::samples(&record, &record::PITCH, repeat)?,
        samples: convert::count("samples", samples)?,
    };
    let experiments = experiments(&chosen)?;
    let forces = interruptible(py, |interrupted| {
        experiment::forces(experiments, &chosen.run().until(interrupted), &imposed)
    })?;
    let forces = forces.map_err(|reason| error::experiment(&reason))?;
    let meanings = motion::meanings(chosen.simulator(), &forces)?;
    motion::into_python(py, forces, meanings, &chosen.meta(py)?)
}

fn experiments(chosen: &Chosen) -> PyResult<&dyn Experiments> {
    chosen.plan.simulator().experiments().map_err(|reason| error::unfinished(&reason))
}
