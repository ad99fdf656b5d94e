//! Chooses the design point that a Python call computes, from the design, the keyword arguments and the index
//! of the point.

use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Rows, Simulator};
use flap_sweep::plan::Plan;
use flap_sweep::resonance::{DRIVE_FREQUENCY, RESONANCE_HZ};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::records::Wave;
use crate::watch::interruptible;
use crate::{convert, design, error, sweep};

/// A design point and its plan.
pub(crate) struct Chosen {
    pub(crate) plan: Plan,
    /// Value of each parameter, in the order of the parameter table.
    pub(crate) values: Vec<f64>,
    /// The model whose drive or stroke is replaced by samples, if the call gives a waveform or a stroke.
    sampled: Option<Box<dyn Simulator>>,
    /// The reason why the point cannot be simulated.
    pub(crate) invalid: Option<String>,
}

impl Chosen {
    /// Returns point number `point` of a design, with the values of the keyword arguments. If `wave` is
    /// given, its samples replace the drive or the stroke of the point.
    pub(crate) fn new(
        design: &Bound<'_, PyAny>,
        keywords: &Bound<'_, PyDict>,
        point: Option<&Bound<'_, PyAny>>,
        wave: Option<&Wave>,
    ) -> PyResult<Chosen> {
        let plan = design::whole(design, keywords)?;
        let index = index(&plan, point)?;
        let values = plan.point(index).values;
        let mut chosen = Chosen { plan, values, sampled: None, invalid: None };
        if let Some(wave) = wave {
            design::check_one_wing(&chosen.plan)?;
            chosen.drive_by(wave, keywords.contains(DRIVE_FREQUENCY)?)?;
        }
        chosen.invalid = chosen.plan.invalid(&chosen.values).map(|invalid| invalid.to_string());
        Ok(chosen)
    }

    /// Returns the point, or an error if the point cannot be simulated.
    pub(crate) fn possible(self) -> PyResult<Chosen> {
        match &self.invalid {
            Some(reason) => Err(PyValueError::new_err(reason.clone())),
            None => Ok(self),
        }
    }

    /// Returns the point whose motion is requested, or an error if the point cannot be simulated or is a
    /// vehicle. If the drive frequency is the resonance, searches for the resonance.
    pub(crate) fn for_motion(self, py: Python<'_>) -> PyResult<Chosen> {
        design::check_one_wing(&self.plan)?;
        self.at_frequency(py)
    }

    /// Returns the point, or an error if the point cannot be simulated. If the drive frequency is the
    /// resonance, searches for the resonance.
    pub(crate) fn at_frequency(self, py: Python<'_>) -> PyResult<Chosen> {
        let mut chosen = self.possible()?;
        let Some(resonance) = chosen.plan.resonance() else { return Ok(chosen) };
        let Some(index) = chosen.parameter(DRIVE_FREQUENCY).filter(|index| chosen.values[*index].is_nan())
        else {
            return Ok(chosen);
        };
        let row =
            interruptible(py, |interrupted| resonance.run_point(&chosen.run().until(interrupted), None))?;
        let place = resonance.columns().iter().position(|column| column.name == RESONANCE_HZ);
        let found = place.and_then(|place| row.measures.get(place)).copied();
        chosen.values[index] = found.ok_or_else(|| {
            let reason = row.reason.unwrap_or_else(|| format!("at every frequency: {}", row.status.name()));
            PyValueError::new_err(format!("the resonance of this point was not found: {reason}"))
        })?;
        Ok(chosen)
    }

    /// Returns the point, or an error if the point cannot be simulated. If the grid requires hover (`trim`),
    /// searches for the inputs at hover and sets these inputs.
    pub(crate) fn at_hover(self, py: Python<'_>) -> PyResult<Chosen> {
        let mut chosen = self.possible()?;
        let found = interruptible(py, |interrupted| {
            let body = chosen.plan.body()?;
            body.trim(chosen.plan.solver(), &chosen.values, interrupted)
        })?;
        if let Some(found) = found {
            let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
            chosen.values = found.applied(&chosen.values);
        }
        Ok(chosen)
    }

    /// Returns the arguments with which a model simulates the point.
    pub(crate) fn run(&self) -> PointRun<'_> {
        PointRun::new(Backend::best(), self.plan.solver(), &self.values)
    }

    /// Returns the model of the point.
    pub(crate) fn simulator(&self) -> &dyn Simulator {
        self.sampled.as_deref().unwrap_or(self.plan.simulator())
    }

    /// Returns the object that computes the row of the point: the model of the point, or the search for the
    /// point's resonance.
    pub(crate) fn rows(&self) -> &dyn Rows {
        match self.sampled.as_deref() {
            Some(sampled) => sampled,
            None => self.plan.rows(),
        }
    }

    /// Returns a dictionary with the versions, the model and the settings that produced the motions of the
    /// point (see [`sweep::meta`]).
    pub(crate) fn meta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        sweep::meta(py, &self.plan, &sweep::options(None)?)
    }

    fn parameter(&self, name: &str) -> Option<usize> {
        Parameter::index(self.plan.parameters(), name)
    }

    /// Replaces the drive or the stroke by samples. The drive period is the duration of the samples, unless
    /// the call sets the drive frequency (`is_set`).
    fn drive_by(&mut self, wave: &Wave, is_set: bool) -> PyResult<()> {
        let mut fixed = Vec::new();
        if !is_set && let Some(index) = self.parameter(DRIVE_FREQUENCY) {
            if self.plan.derived().parameters().any(|derived| derived == index) {
                let message = format!("the grid derives {DRIVE_FREQUENCY}, but the record sets it");
                return Err(PyValueError::new_err(message + "\nremove the formula from `derived`"));
            }
            self.values[index] = 1.0 / wave.samples.duration();
            fixed.push(index);
        }
        if wave.is_stroke {
            let Some((mode, amplitude)) =
                self.parameter("stroke_mode").zip(self.parameter("stroke_amplitude"))
            else {
                let message = format!(
                    "the stroke of the model {} cannot be prescribed\nthis requires a model with the parameter stroke_mode",
                    self.plan.simulator().name()
                );
                return Err(PyValueError::new_err(message));
            };
            (self.values[mode], self.values[amplitude]) = (1.0, 1.0);
            fixed.extend([mode, amplitude]);
        }
        self.plan.derived().fill(&mut self.values, &fixed);
        let experiments = self.plan.simulator().experiments().map_err(|reason| error::unfinished(&reason))?;
        self.sampled = Some(experiments.with_samples(wave.samples.clone()));
        Ok(())
    }
}

/// Returns the index of the chosen point. If `point` is not given, the plan must have only one point.
fn index(plan: &Plan, point: Option<&Bound<'_, PyAny>>) -> PyResult<u64> {
    let length = plan.len();
    let Some(point) = point else {
        if length == 1 {
            return Ok(0);
        }
        let message = format!(
            "the grid has {length} points, but this call takes one\ngive point=0 to point={}",
            length - 1
        );
        return Err(PyValueError::new_err(message));
    };
    convert::point_index(plan.len(), "point", point)
}
