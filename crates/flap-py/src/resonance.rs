//! The resonances of one point: linear, after an impulse, and driven.

use flap_core::modes::Mode;
use flap_core::num::Backend;
use flap_core::simulate::PointRun;
use flap_experiments::free::{self, FreeRequest};
use flap_sweep::resonance::SearchError;
use flap_sweep::resonance::driven::{self, PeakSearch};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyList};

use crate::point::Chosen;
use crate::watch::interruptible;
use crate::{convert, design, error};

/// Samples of a free motion per period of the first mode.
const SAMPLES: u32 = 200;

/// Finds the resonances of one point; see `flapwing.resonance`.
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
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.possible()?;
    design::check_one_wing(&chosen.plan)?;
    let (simulator, solver, values) = (chosen.plan.robot().model(), chosen.plan.solver(), &chosen.values);
    let frequency = |name, value: Option<&Bound<'py, PyAny>>| {
        value.map(|value| convert::quantity(name, "Hz", true, value)).transpose()
    };
    let request = FreeRequest {
        amplitude: convert::impulse("impulse", impulse)?,
        fit_cycles: convert::count("fit_cycles", fit_cycles)?,
        spectrum_window: convert::quantity("spectrum_window", "s", true, spectrum_window)?,
        samples_per_cycle: SAMPLES,
    };
    let backend = Backend::best();
    let experiments = simulator.experiments().map_err(|reason| error::unfinished(&reason))?;
    let modes = experiments.modes(values).map_err(|reason| error::unfinished(&reason))?;
    let search = PeakSearch {
        from: frequency("start", start)?,
        to: frequency("stop", stop)?,
        tolerance: convert::quantity("tolerance", "Hz", true, tolerance)?,
    };
    let found = interruptible(py, |interrupted| {
        let run = PointRun::new(backend, solver, values).until(interrupted);
        Ok((free::examine(experiments, &run, &request)?, driven::search(simulator, &run, &search)?))
    })?;
    let (free, driven) = found.map_err(|reason: SearchError| PyValueError::new_err(reason.to_string()))?;

    let linear = modes
        .into_iter()
        .map(|Mode { name, frequency }| (name, frequency))
        .collect::<Vec<_>>()
        .into_py_dict(py)?;
    let fit = free.fit.map(|fit| {
        let dict = PyDict::new(py);
        dict.set_item("frequency_hz", fit.frequency)?;
        dict.set_item("decay_1_s", fit.decay)?;
        dict.set_item("relative_rms", fit.relative_rms)?;
        PyResult::Ok(dict)
    });
    let peaks = PyList::empty(py);
    for peak in &driven.peaks {
        let dict = PyDict::new(py);
        dict.set_item("frequency_hz", peak.frequency)?;
        dict.set_item("stroke_pp_deg", peak.stroke_pp)?;
        dict.set_item("pitch_pp_deg", peak.pitch_pp)?;
        peaks.append(dict)?;
    }
    let gaps = driven.gaps.iter().map(|gap| (gap.from, gap.to, gap.status.name())).collect::<Vec<_>>();

    let dict = PyDict::new(py);
    dict.set_item("linear_hz", linear)?;
    dict.set_item("impulse_fit", fit.transpose()?)?;
    for (signal, peaks) in &free.spectra {
        let frequencies = peaks.iter().map(|peak| peak.frequency).collect::<Vec<f64>>();
        dict.set_item(format!("{signal}_spectrum_hz"), frequencies)?;
    }
    dict.set_item("driven", peaks)?;
    dict.set_item("larger_at_hz", driven.larger_at)?;
    dict.set_item("gaps", gaps)?;
    Ok(dict)
}
