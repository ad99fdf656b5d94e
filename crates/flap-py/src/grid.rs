//! Grids: checked design spaces.

use std::path::{Path, PathBuf};

use flap_core::simulate;
use flap_sweep::grid;
use flap_sweep::notation::text;
use flap_sweep::plan::Plan;
use flap_sweep::plan::axes::Values;
use flap_sweep::study::survey;
use numpy::PyArray1;
use pyo3::exceptions::{PyException, PyIndexError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PySlice, PyString};

use crate::{columns, convert, error, grid_text, parameters};

/// Largest number of points for which `Grid.exclusions` evaluates the conditions.
const LOOKED_AT: u64 = 1_000_000;

/// Largest number of positions along an axis whose values are returned as an array.
const LONGEST_AXIS: u64 = 100_000_000;

/// A grid file that was read and checked.
///
/// A grid is a sequence of design points. The parameters of a point are computed on access::
///
///     grid = Grid({"preset": "ozaki2018-large", "axes": {"drive_frequency": [100.0, 105.0, 110.0]}})
///     len(grid)                       # 3
///     grid[1]["drive_frequency"]      # 105.0
///
/// Parameters
/// ----------
/// source : str, path, dict or Grid
///     The name of a preset, or the path of a grid file. A str with a line break or ``=`` is the text of a grid file. A
///     dictionary has the entries of a grid file, with a dictionary for each table. Lists may be arrays, Series, ranges or
///     Arrow columns. A DataFrame has the same meaning as the dictionary of its columns.
///
/// Raises
/// ------
/// GridError
///     The grid has mistakes. The message lists each mistake with the line of the mistake, the allowed values and the
///     most similar known name.
/// ValueError
///     `source` is not the name of a preset.
/// OSError
///     The file does not exist or cannot be read.
/// TypeError
///     `source`, or a value in `source`, has the wrong type.
#[pyclass(frozen, module = "flapwing")]
pub(crate) struct Grid {
    pub(crate) plan: Plan,
}

#[pymethods]
impl Grid {
    #[new]
    #[pyo3(signature = (source, /))]
    fn new(source: &Bound<'_, PyAny>) -> PyResult<Grid> {
        Ok(Grid { plan: plan(source)? })
    }

    fn __len__(&self) -> PyResult<usize> {
        usize::try_from(self.plan.len()).map_err(|_| PyIndexError::new_err("too many points for len()"))
    }

    /// Returns point number `index`: a dictionary of numbers in SI units and names of options. For a slice,
    /// returns a list with one dictionary per point.
    fn __getitem__<'py>(&self, py: Python<'py>, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(slice) = index.cast::<PySlice>() {
            let length = isize::try_from(self.__len__()?).unwrap_or(isize::MAX);
            let range = slice.indices(length)?;
            let points = PyList::empty(py);
            let mut place = range.start;
            for _ in 0..range.slicelength {
                py.check_signals()?;
                points.append(self.point(py, place.unsigned_abs() as u64)?)?;
                place += range.step;
            }
            return Ok(points.into_any());
        }
        let place = convert::point_index(self.plan.len(), "index", index)?;
        Ok(self.point(py, place)?.into_any())
    }

    fn __repr__(&self) -> String {
        let axes = self.plan.axes().as_slice().iter().map(|axis| {
            let names =
                axis.parameters().iter().map(|(parameter, _)| self.plan.parameters()[*parameter].name);
            format!("{} ({})", names.collect::<Vec<_>>().join(" + "), axis.len())
        });
        let axes = axes.collect::<Vec<_>>().join(" x ");
        let along = if axes.is_empty() { String::new() } else { format!(": {axes}") };
        format!("<flapwing.Grid of {} points of {}{along}>", self.plan.len(), self.plan.preset())
    }

    /// Return the grid for a text that was read from the file `name`.
    #[staticmethod]
    #[pyo3(signature = (name, text, /))]
    fn _named(py: Python<'_>, name: &str, text: &str) -> PyResult<Grid> {
        Ok(Grid { plan: parse(py, name, text)? })
    }

    /// Returns the function and the arguments from which `pickle` restores the grid.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, String))> {
        let source = slf.get().plan.source();
        Ok((slf.get_type().getattr("_named")?, (source.name.clone(), source.text.clone())))
    }

    /// The path of the grid file, or ``"<grid>"``. Paths in the grid are relative to the folder of the grid file.
    #[getter]
    fn name(&self) -> &str {
        &self.plan.source().name
    }

    /// The text of the grid file.
    #[getter]
    fn text(&self) -> &str {
        &self.plan.source().text
    }

    /// The name of the preset. Parameters that the grid does not set have the values of the preset.
    #[getter]
    fn preset(&self) -> &'static str {
        self.plan.preset()
    }

    /// The name of the model whose parameters the grid sets.
    #[getter]
    fn model(&self) -> &'static str {
        self.plan.simulator().name()
    }

    /// The axes of the grid. The last axis varies fastest. Each dictionary has the parameters that vary together along
    /// an axis, with values in SI units. If the axis is a sample, the first entry
    /// is `sample`, an array with the numbers of the sampled points, which begin at 0.
    #[getter]
    pub(crate) fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        axes(py, &self.plan)
    }

    /// The parameters that differ between points: parameters of the axes, and then derived parameters.
    #[getter]
    fn varied(&self) -> Vec<&str> {
        let varied = self.plan.differing();
        varied.map(|index| self.plan.parameters()[index].name).collect()
    }

    /// Count the points that the conditions of ``[where]`` exclude. If the grid has more than a million points, flap checks
    /// a million points that are spread over the grid.
    ///
    /// Returns
    /// -------
    /// Exclusions
    ///     The numbers of checked and excluded points.
    fn exclusions(&self, py: Python<'_>) -> PyResult<Exclusions> {
        let found = py.detach(|| survey::exclusions(&self.plan, LOOKED_AT));
        let unsatisfied = columns::unsatisfied(py, &found.unsatisfied)?.unbind();
        Ok(Exclusions { looked_at: found.looked_at, excluded: found.excluded, unsatisfied })
    }
}

/// The points of a grid that the conditions of ``[where]`` exclude.
///
/// Attributes
/// ----------
/// looked_at : int
///     Number of points for which the conditions were evaluated.
/// excluded : int
///     Number of evaluated points that do not satisfy all conditions.
/// unsatisfied : dict of str to int
///     Conditions, each with the number of points that do not satisfy the condition.
#[pyclass(frozen, get_all, module = "flapwing")]
pub(crate) struct Exclusions {
    looked_at: u64,
    excluded: u64,
    unsatisfied: Py<PyDict>,
}

#[pymethods]
impl Exclusions {
    fn __repr__(&self) -> String {
        format!("<flapwing.Exclusions: {} of {} points>", self.excluded, self.looked_at)
    }
}

impl Grid {
    fn point<'py>(&self, py: Python<'py>, index: u64) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        let values = self.plan.point(index).values;
        for (parameter, value) in self.plan.parameters().iter().zip(values) {
            match text::option(parameter, value) {
                Some(option) => dict.set_item(parameter.name, option)?,
                // A parameter that follows others, or is the resonance, has no value here.
                None if value.is_nan() => {}
                None => dict.set_item(parameter.name, value)?,
            }
        }
        Ok(dict)
    }
}

/// Returns the plan of a design: the name of a preset, a path, the text of a grid file, a dictionary or a
/// grid.
pub(crate) fn plan(source: &Bound<'_, PyAny>) -> PyResult<Plan> {
    let py = source.py();
    if let Ok(grid) = source.cast::<Grid>() {
        let source = grid.get().plan.source();
        return parse(py, &source.name, &source.text);
    }
    if let Some(dict) = grid_text::dictionary(source)? {
        return parse(py, "<grid>", &grid_text::text_of(&dict)?);
    }
    if let Some(name) = name(source)?
        && !Path::new(&name).exists()
    {
        return of_preset(py, parameters::find_preset(source)?.1.name);
    }
    if let Ok(text) = source.cast::<PyString>() {
        let text = text.to_cow()?;
        if text.contains(['\n', '=']) {
            return parse(py, "<grid>", &text);
        }
    }
    let path = source.extract::<PathBuf>().map_err(|error| {
        if !error.is_instance_of::<PyException>(py) {
            return error;
        }
        let found = convert::type_name(source);
        PyTypeError::new_err(format!(
            "a design cannot be {found}\nit must be the name of a preset, a path, the text of a grid file, a dictionary or a Grid"
        ))
    })?;
    let plan = grid::read(&path, simulate::all()).map_err(|error| error::grid_file(py, &error))?;
    with_warnings(py, plan)
}

/// Returns the plan, and warns about parameters of a vehicle that have no effect.
fn with_warnings(py: Python<'_>, plan: Plan) -> PyResult<Plan> {
    plan.unreached().iter().try_for_each(|parameter| parameters::warn_unreached(py, parameter))?;
    Ok(plan)
}

/// Returns the plan of a preset. The plan has one point.
pub(crate) fn of_preset(py: Python<'_>, preset: &str) -> PyResult<Plan> {
    parse(py, preset, &format!("preset = \"{preset}\"\n"))
}

/// Returns `design` if it can be the name of a preset or a model. Returns `None` if `design` is a path, the
/// text of a grid, or not text.
pub(crate) fn name(design: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let Ok(text) = design.cast::<PyString>() else { return Ok(None) };
    let text = text.to_cow()?;
    let is_grid = text.contains(['\n', '=', '/', '\\']) || text.ends_with(".toml");
    Ok((!is_grid).then(|| text.into_owned()))
}

/// Returns the plan for a grid text that was read from the file `name`.
pub(crate) fn parse(py: Python<'_>, name: &str, text: &str) -> PyResult<Plan> {
    let plan =
        grid::parse(name, text, simulate::all()).map_err(|diagnostics| error::grid(py, &diagnostics))?;
    with_warnings(py, plan)
}

/// Returns an error if an axis of a plan is too long for an array of its values.
pub(crate) fn check_axes(plan: &Plan) -> PyResult<()> {
    let Some(axis) = plan.axes().as_slice().iter().find(|axis| axis.len() > LONGEST_AXIS) else {
        return Ok(());
    };
    let names = axis.parameters().iter().map(|(index, _)| plan.parameters()[*index].name);
    let names = names.collect::<Vec<_>>().join("` + `");
    Err(PyValueError::new_err(format!(
        "the axis `{names}` has {} values: an array of values has at most {LONGEST_AXIS}\n\
         choose fewer values, or compute the rows with the command `flap sweep`",
        axis.len()
    )))
}

/// Returns the axes of a plan, see [`Grid::axes`].
pub(crate) fn axes<'py>(py: Python<'py>, plan: &Plan) -> PyResult<Bound<'py, PyList>> {
    check_axes(plan)?;
    let list = PyList::empty(py);
    for axis in plan.axes().as_slice() {
        let dict = PyDict::new(py);
        if axis
            .parameters()
            .iter()
            .any(|(_, values)| matches!(values, Values::Sampled { .. } | Values::Correlated { .. }))
        {
            dict.set_item("sample", PyArray1::from_iter(py, 0..axis.len()))?;
        } else if axis.parameters().iter().any(|(_, values)| matches!(values, Values::Unchecked(_))) {
            dict.set_item("row", PyArray1::from_iter(py, 0..axis.len()))?;
        }
        for (index, values) in axis.parameters() {
            let parameter = &plan.parameters()[*index];
            let numbers = (0..values.len()).map(|place| py.check_signals().map(|()| values.get(place)));
            let numbers = numbers.collect::<PyResult<Vec<f64>>>()?;
            if numbers.first().is_some_and(|value| text::option(parameter, *value).is_some()) {
                let options = numbers.iter().map(|value| text::option(parameter, *value));
                dict.set_item(parameter.name, options.collect::<Vec<_>>())?;
            } else {
                dict.set_item(parameter.name, PyArray1::from_vec(py, numbers))?;
            }
        }
        list.append(dict)?;
    }
    Ok(list)
}
