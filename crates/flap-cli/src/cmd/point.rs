//! The design point of a command: a preset, a device or a point of a grid file, with the changes of `--set`
//! and `--each`.

use std::path::Path;

use flap_core::num::Backend;
use flap_core::parameter::{Invalid, Parameter};
use flap_core::simulate::{Column, PointRun, Row, Rows, Simulator, never};
use flap_sweep::grid;
use flap_sweep::notation::text;
use flap_sweep::notation::units;
use flap_sweep::notation::value::{self, UnitOf, ValueError};
use flap_sweep::plan::{Admission, Plan, with_rtol};
use flap_sweep::resonance::{DRIVE_FREQUENCY, RESONANCE_HZ};
use flap_sweep::vehicle::BodyRows;

use super::samples::DriveRecord;
use crate::args::{PointArgs, SolverArgs};
use crate::console;
use crate::failure::Failure;
use crate::models;
use crate::table::six_digits;

/// A design point, and the plan that contains all points of the same grid.
pub(crate) struct Chosen {
    pub(crate) plan: Plan,
    /// Value of each parameter of the plan, in SI units and in the order of the parameters.
    pub(crate) values: Vec<f64>,
    /// The model with a waveform or stroke from a file, if the user gave `--waveform` or `--stroke`.
    sampled: Option<Box<dyn Simulator>>,
    index: u64,
    /// Indices of the parameters whose values come from the command line, or from a record of a waveform or
    /// stroke.
    set: Vec<usize>,
    /// Indices of the parameters in `set` whose values were given with a unit.
    set_with_unit: Vec<usize>,
    /// True if the drive frequency is a resonance that flap found by a search.
    has_found_resonance: bool,
}

impl Chosen {
    /// Returns the design point that the command line selects.
    pub(crate) fn new(point: &PointArgs, solver: &SolverArgs) -> Result<Chosen, Failure> {
        Chosen::driven_by(None, point, solver)
    }

    /// Returns the design point that the command line selects, with the waveform or the stroke of `record`.
    pub(super) fn driven_by(
        record: Option<&DriveRecord>,
        point: &PointArgs,
        solver: &SolverArgs,
    ) -> Result<Chosen, Failure> {
        let plan = with_solver(plan(&point.what)?, solver)?;
        if point.point >= plan.len() {
            let PointArgs { what, point: index, .. } = point;
            let message = format!("there is no point {index}: {what} has points 0 to {}", plan.len() - 1);
            let help = "a point of [refine] is in the rows only: set its parameters with --set";
            return Err(Failure::usage(message).helps(plan.refine().map(|_| help)));
        }
        let mut values = plan.point(point.point).values;
        let (mut set, mut set_with_unit) = (Vec::new(), Vec::new());
        for (option, name, value) in point.changes.all() {
            let index = find_parameter(plan.parameters(), name)?;
            if set.contains(&index) {
                return Err(twice(option, name));
            }
            values[index] = self::value(&plan.parameters()[index], &format!("{option} {name}="), value)?;
            set.push(index);
            set_with_unit.extend(units::has_unit(value).then_some(index));
        }
        let index = point.point;
        let mut chosen =
            Chosen { plan, values, sampled: None, index, set, set_with_unit, has_found_resonance: false };
        if let Some(record) = record {
            check_one_wing(&chosen.plan, &point.what, &format!("`flap run` with {}", record.option()))?;
            chosen.apply(record)?;
        }
        let Chosen { plan, values, set, .. } = &mut chosen;
        plan.fill_design(values, set);
        plan.derived().fill(values, set);
        match plan.judge(values) {
            Admission::Runs => {}
            Admission::Excluded(unsatisfied) => {
                let names: Vec<&str> =
                    unsatisfied.iter().map(|&condition| plan.conditions()[condition].name.as_str()).collect();
                console::say(&format!(
                    "a sweep excludes this point, because it does not satisfy {}",
                    names.join(", ")
                ));
            }
            Admission::Invalid(invalid) => return Err(invalid.into()),
        }
        chosen.find_resonance()?;
        chosen.find_hover()?;
        Ok(chosen)
    }

    /// Replaces the waveform of the drive, or the stroke, by the samples of a record. The drive period
    /// becomes the duration of the record, unless the command line sets the drive frequency.
    fn apply(&mut self, record: &DriveRecord) -> Result<(), Failure> {
        let parameters = self.plan.parameters();
        let mut values = Vec::new();
        let frequency = Parameter::index(parameters, DRIVE_FREQUENCY);
        if let Some(index) = frequency.filter(|index| !self.set.contains(index)) {
            if self.plan.derived().parameters().any(|derived| derived == index) {
                let message = format!("the grid file derives {DRIVE_FREQUENCY}, but the record sets it");
                let help = format!("remove the formula from [derived], or add --set {DRIVE_FREQUENCY}=...");
                return Err(Failure::usage(message).help(help));
            }
            let value = 1.0 / record.samples.duration();
            if self.plan.axes().varied().any(|varied| varied == index) {
                console::say(&format!(
                    "{DRIVE_FREQUENCY} = {} Hz, from the record, not from the point of the grid",
                    six_digits(value)
                ));
            }
            values.push((index, value));
        }
        if record.is_stroke {
            let [mode, amplitude] =
                ["stroke_mode", "stroke_amplitude"].map(|name| Parameter::index(parameters, name));
            let Some((mode, amplitude)) = mode.zip(amplitude) else {
                let message =
                    format!("the stroke of the model {} cannot be prescribed", self.plan.simulator().name());
                let help = "--stroke requires a model with the parameter stroke_mode";
                return Err(Failure::usage(message).help(help));
            };
            values.extend([(mode, 1.0), (amplitude, 1.0)]);
        }
        for (index, value) in values {
            self.values[index] = value;
            self.set.push(index);
            self.set_with_unit.push(index);
        }
        self.sampled = Some(self.plan.simulator().experiments()?.with_samples(record.samples.clone()));
        Ok(())
    }

    /// If the grid file sets the drive frequency to the resonance, searches for the resonance of this point.
    fn find_resonance(&mut self) -> Result<(), Failure> {
        let Some(resonance) = self.plan.resonance() else { return Ok(()) };
        let index = find_parameter(self.plan.parameters(), DRIVE_FREQUENCY)?;
        if !self.values[index].is_nan() {
            return Ok(());
        }
        let row = resonance.run_point(&self.run(), None);
        let place = resonance.columns().iter().position(|column| column.name == RESONANCE_HZ);
        let found = place.and_then(|place| row.measures.get(place));
        let found = found.copied().ok_or_else(|| {
            let reason =
                row.reason.clone().unwrap_or_else(|| format!("at every frequency: {}", row.status.name()));
            Failure::usage(format!("the resonance of this point was not found: {reason}"))
        })?;
        self.values[index] = found;
        self.has_found_resonance = true;
        console::say(&format!("{DRIVE_FREQUENCY} = {} Hz, the resonance", six_digits(found)));
        Ok(())
    }

    /// If the grid file requires rows at hover, searches for the inputs at which the vehicle hovers.
    fn find_hover(&mut self) -> Result<(), Failure> {
        let trim = |body: &BodyRows| body.trim(self.plan.solver(), &self.values, &never);
        let Some(found) = self.plan.body().and_then(trim) else { return Ok(()) };
        let found = found?;
        let inputs = found.inputs.iter().zip(&found.values);
        let inputs =
            inputs.map(|(input, value)| format!("{} = {} {}", input.name, six_digits(*value), input.unit));
        console::say(&format!("{}: the vehicle hovers", inputs.collect::<Vec<_>>().join(", ")));
        self.values = found.applied(&self.values);
        Ok(())
    }

    /// Returns the values and the solver settings with which a model computes the point.
    pub(crate) fn run(&self) -> PointRun<'_> {
        PointRun::new(Backend::best(), self.plan.solver(), &self.values)
    }

    /// Returns the model that computes the point.
    pub(crate) fn simulator(&self) -> &dyn Simulator {
        self.sampled.as_deref().unwrap_or(self.plan.simulator())
    }

    /// Returns the columns of the measures in the point's row.
    pub(crate) fn columns(&self) -> &[Column] {
        self.plan.body().map_or_else(|| self.simulator().columns(), Rows::columns)
    }

    /// Computes the row of the point. The row of a vehicle also contains the measures about hover and damping
    /// that the grid file requests.
    pub(crate) fn row(&self) -> Row {
        let run = self.run();
        self.plan
            .body()
            .map_or_else(|| self.simulator().run_point(&run, None), |body| body.row_at(&run, None))
    }

    /// Computes the derived parameters in `values` again after a change of the drive frequency. If the
    /// changed values are invalid, returns the reason.
    pub(crate) fn update(&self, values: &mut [f64]) -> Option<Invalid> {
        let frequency = Parameter::index(self.plan.parameters(), DRIVE_FREQUENCY);
        self.plan.update(values, &self.set.iter().copied().chain(frequency).collect::<Vec<usize>>())
    }

    /// Returns the indices of the parameters whose values come from the command line, or from a record of a
    /// waveform or stroke.
    pub(crate) fn set_parameters(&self) -> &[usize] {
        &self.set
    }

    /// Returns true if the drive frequency is a resonance that flap found by a search.
    pub(crate) fn has_found_resonance(&self) -> bool {
        self.has_found_resonance
    }

    /// Returns true if the user gave the value of a parameter with a unit, in the grid file or on the command
    /// line.
    pub(crate) fn has_unit(&self, parameter: usize) -> bool {
        let of_file = !self.set.contains(&parameter) && self.plan.has_unit(parameter);
        of_file || self.set_with_unit.contains(&parameter)
    }

    /// Returns a line with the model and the preset, and with the index of the point if the plan has several
    /// points.
    pub(crate) fn title(&self) -> String {
        let Chosen { plan, index, .. } = self;
        let title = format!("{} from {}", plan.simulator().name(), plan.preset());
        if plan.len() > 1 { format!("{title}, point {index} of {}", plan.len()) } else { title }
    }
}

/// Returns the plan of a preset, a device file or a grid file.
pub(super) fn plan(what: &str) -> Result<Plan, Failure> {
    if models::preset(what).is_some() {
        let grid = format!("preset = \"{what}\"\n");
        return grid::parse(what, &grid, models::all()).map_err(Failure::Grid);
    }
    let path = Path::new(what);
    let looks_like_a_file = path.extension().is_some() || path.components().count() > 1;
    if super::grid::is_stdin(path) || looks_like_a_file || path.exists() {
        return super::grid::read(path);
    }
    let failure = Failure::usage(format!("there is no preset and no file `{what}`"));
    Err(failure.nearest(what, models::presets(), "`flap models` lists models and presets"))
}

/// Returns an error if the plan describes a vehicle, because `command` simulates only one wing.
pub(super) fn check_one_wing(plan: &Plan, what: &str, command: &str) -> Result<(), Failure> {
    let Some(vehicle) = plan.vehicle() else { return Ok(()) };
    let wings = text::count(vehicle.mounts().len() as u64, "wing");
    let failure = Failure::usage(format!("{what} is a vehicle of {wings}, but {command} requires one wing"));
    Err(failure
        .help("remove [vehicle] from the file, and all keys that refer to single wings or their differences"))
}

/// Returns the failure for an `option` that the user gave twice for the same name.
pub(super) fn twice(option: &str, name: &str) -> Failure {
    Failure::usage(format!("{option}: `{name}` is given twice")).help("remove one of them")
}

/// Returns the plan with the solver settings of the command line, which override the settings of the grid
/// file.
pub(super) fn with_solver(plan: Plan, args: &SolverArgs) -> Result<Plan, Failure> {
    let settings = *plan.solver();
    let mut settings = args.rtol.map_or(settings, |rtol| with_rtol(settings, rtol));
    settings.accuracy = args.accuracy.unwrap_or(settings.accuracy);
    settings.settle_tol = args.settle_tol.unwrap_or(settings.settle_tol);
    settings.max_cycles = args.max_cycles.unwrap_or(settings.max_cycles);
    Ok(plan.with_solver(settings)?)
}

/// Returns the index of the parameter called `name`, or an error that suggests a similar name.
pub(super) fn find_parameter(parameters: &[Parameter], name: &str) -> Result<usize, Failure> {
    Parameter::index(parameters, name).ok_or_else(|| {
        let names = parameters.iter().map(|parameter| parameter.name);
        let failure = Failure::usage(format!("there is no parameter `{name}`"));
        if let Some(reason) = grid::why_absent(parameters, name) {
            return failure.help(reason);
        }
        failure.nearest(name, names, "`flap models` lists the parameters of a model")
    })
}

/// Parses `text` as the value of a parameter. Error messages begin with the name of the command-line option
/// `option`.
pub(super) fn value(parameter: &Parameter, option: &str, text: &str) -> Result<f64, Failure> {
    // As in a grid file, a number without a unit is in SI units.
    value::of_text(parameter, text, UnitOf::TextOrSi).map_err(|error| {
        let message = error.message(parameter.name, text);
        let failure = Failure::usage(match error {
            ValueError::NoQuantity(_) if option.ends_with('=') => format!("{option}{text}: {message}"),
            ValueError::NoQuantity(_) => format!("{option} {text}: {message}"),
            ValueError::NoOption { .. } | ValueError::OutOfRange { .. } => message,
        });
        failure.helps(error.help())
    })
}
