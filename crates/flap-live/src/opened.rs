//! The design that was opened, and the grid files from which the contents of the page are computed.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::OnceLock;

use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, Row, Setting, Simulator, SolverSettings};
use flap_sweep::grid;
use flap_sweep::grid::diagnostic::{Diagnostic, Mistakes};
use flap_sweep::notation::text;
use flap_sweep::plan::uncertainty::Correlation;
use flap_sweep::plan::{Plan, Value};
use toml_edit::DocumentMut;

use crate::request::{By, Design, MOST_ROWS, Number, Refused, XAxis};

/// The sections of the opened file that every grid file of the page contains. The remaining sections of the
/// opened file describe points and files.
const KEPT: [&str; 4] = ["vehicle", "derived", "where", "measure"];

/// The name that messages show instead of a file name for the grid files of the page.
const NAME: &str = "the grid of the page";

/// The design that was opened.
pub(crate) struct Opened {
    /// The plan that was opened.
    plan: Plan,
    models: Vec<&'static dyn Simulator>,
    /// The beginning of the text of a grid file: the preset, the sections from the opened file and the solver
    /// settings, without parameters.
    head: String,
    /// The plan of `head`, in which all parameters have the published values.
    published: Plan,
    /// Value of each parameter at the first point of the opened plan. The value is NaN if the parameter is
    /// computed from other parameters.
    values: Vec<f64>,
    /// The row of the published design, computed at the first request.
    published_row: OnceLock<Row>,
}

impl Opened {
    /// Opens the first design of a plan, with its formulas, conditions and settings.
    ///
    /// # Errors
    /// The mistakes that remain in the opened file if its sections about points are left out.
    pub(crate) fn new(plan: Plan, models: &[&'static dyn Simulator]) -> Result<Opened, Mistakes> {
        let head = head(&plan);
        let published = parsed(&plan, &head, models)?;
        let mut values = plan.point(0).values;
        for (value, (published, given)) in values.iter_mut().zip(published.base().iter().zip(plan.base())) {
            // The page has one drive frequency, without a search for the resonance of each design.
            if *given == Value::Resonance {
                *value = published.in_point();
            }
        }
        let models = models.to_vec();
        Ok(Opened { plan, models, head, published, values, published_row: OnceLock::new() })
    }

    /// Returns the plan that was opened.
    pub(crate) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns the values of the design, one per parameter.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the plan of the published design, with the formulas and measures of the opened plan.
    pub(crate) fn published_plan(&self) -> &Plan {
        &self.published
    }

    /// Returns the published values, one per parameter.
    pub(crate) fn published(&self) -> Vec<f64> {
        self.published.point(0).values
    }

    /// Returns the row of the published design, with the columns of a grid without axes.
    pub(crate) fn published_row(&self) -> &Row {
        self.published_row.get_or_init(|| {
            let values = self.published();
            let run = PointRun::new(Backend::best(), self.published.solver(), &values);
            let mut row = self.published.rows().run_point(&run, None);
            self.published.add_own_measures(&values, &mut row.measures);
            row
        })
    }

    /// Returns a grid file for the design. `x` and `by` become axes of the grid.
    ///
    /// # Errors
    /// [`Refused::Impossible`] if the plan would have too many rows, or if the design removes a value that
    /// the preset or `[vehicle]` sets.
    pub(crate) fn grid(
        &self,
        design: &Design,
        x: Option<&XAxis>,
        by: Option<&By>,
    ) -> Result<String, Refused> {
        let rows = x.map_or(1, |x| x.n as usize) * by.map_or(1, |by| by.values.len());
        if rows > MOST_ROWS {
            let error = format!("{rows} rows are too many for the page, which shows at most {MOST_ROWS}");
            return Err(Refused::impossible(error));
        }
        if let Some(x) = x.filter(|x| x.n > 1 && number(&x.from) == number(&x.to)) {
            let error =
                format!("`{}` must have two different ends, but both are {}", x.name, number(&x.from));
            return Err(Refused::Impossible { error, help: None, parameter: Some(x.name.clone()) });
        }
        self.check_cleared(design)?;
        let axes = [by.map(|by| by.name.as_str()), x.map(|x| x.name.as_str())];
        let mut page = self.head.clone();
        page += "\n[params]\n";
        self.write_params(&mut page, design, &axes);
        if x.is_some() || by.is_some() {
            page += "\n[axes]\n";
        }
        if let Some(By { name, values }) = by {
            let values: Vec<String> = values.iter().map(number).collect();
            let _ = writeln!(page, "{} = [{}]", key(name), values.join(", "));
        }
        if let Some(XAxis { name, from, to, n }) = x {
            let (from, to) = (number(from), number(to));
            let _ = writeln!(page, "{} = {{ from = {from}, to = {to}, n = {n} }}", key(name));
        }
        self.write_correlations(&mut page, design, &axes);
        Ok(page)
    }

    /// Returns an error if the design removes a value that the preset or `[vehicle]` sets.
    fn check_cleared(&self, design: &Design) -> Result<(), Refused> {
        let is_set = |name: &str| {
            let index = Parameter::index(self.plan.parameters(), name);
            index.is_some_and(|index| !self.published()[index].is_nan())
        };
        let cleared = design.iter().filter(|(_, value)| value.is_none()).map(|(name, _)| name);
        let Some(name) = cleared.into_iter().find(|name| is_set(name)) else { return Ok(()) };
        Err(Refused::Impossible {
            error: format!("`{name}` cannot be empty: the preset or [vehicle] sets it"),
            help: Some("type a value, or reset the parameter".to_owned()),
            parameter: Some(name.clone()),
        })
    }

    /// Returns true if a parameter has its value from the opened file, because the design, the axes and the
    /// formulas do not change this value.
    fn is_as_opened(&self, index: usize, design: &Design, axes: &[Option<&str>]) -> bool {
        let name = self.plan.parameters()[index].name;
        !axes.contains(&Some(name))
            && !design.contains_key(name)
            && !self.plan.derived().parameters().any(|derived| derived == index)
    }

    /// Returns the standard error of a parameter value from the opened file. Parameters on the axes of the
    /// opened file have no standard error, because the standard error in a device describes only the device's
    /// own value.
    fn error(&self, index: usize) -> Option<f64> {
        let is_varied = self.plan.axes().varied().any(|varied| varied == index);
        self.plan.uncertainty().error(index).filter(|_| !is_varied)
    }

    /// Writes lines for the parameters that differ from the published values, except parameters in `axes`.
    ///
    /// Values from the opened file keep their standard errors.
    fn write_params(&self, page: &mut String, design: &Design, axes: &[Option<&str>]) {
        let published = self.published();
        // The page shows one design, and its grids have no parameter for the name of the design.
        let own = self.plan.design();
        let parameters = self.plan.parameters().iter().enumerate();
        for (index, parameter) in parameters.filter(|(index, _)| own != Some(*index)) {
            let (name, value) = (parameter.name, self.values[index]);
            let error = self.error(index);
            let is_as_published = value.to_bits() == published[index].to_bits() && error.is_none();
            if is_as_published || value.is_nan() || !self.is_as_opened(index, design, axes) {
                continue;
            }
            let value = match text::option(parameter, value) {
                Some(option) => format!("\"{option}\""),
                None => text::float(value),
            };
            let _ = match error {
                Some(error) => writeln!(page, "{name} = {{ value = {value}, sd = {} }}", text::float(error)),
                None => writeln!(page, "{name} = {value}"),
            };
        }
        for (name, value) in design {
            if let Some(value) = value.as_ref().filter(|_| !axes.contains(&Some(name))) {
                let _ = writeln!(page, "{} = {}", key(name), number(value));
            }
        }
    }

    /// Writes the correlations between values from the opened file.
    fn write_correlations(&self, page: &mut String, design: &Design, axes: &[Option<&str>]) {
        for Correlation { between, coefficient } in self.plan.uncertainty().correlations() {
            let is_written =
                |&index: &usize| self.is_as_opened(index, design, axes) && self.error(index).is_some();
            if !between.iter().all(is_written) {
                continue;
            }
            let [one, other] = between.map(|index| self.plan.parameters()[index].name);
            let coefficient = text::float(*coefficient);
            let _ = write!(
                page,
                "\n[[correlation]]\nbetween = [\"{one}\", \"{other}\"]\ncoefficient = {coefficient}\n"
            );
        }
    }

    /// Returns the plan of a grid file that the browser page has created. The function checks this grid file
    /// like every grid file.
    ///
    /// # Errors
    /// Returns [`Refused::Impossible`] with the first mistake in the grid file.
    pub(crate) fn plan_of(&self, grid: &str) -> Result<Plan, Refused> {
        parsed(&self.plan, grid, &self.models).map_err(|mistakes| match mistakes.first() {
            Some(first) => refused(first, self.plan.parameters()),
            None => Refused::Fault("a grid was refused without a reason".to_owned()),
        })
    }

    /// Returns the plan of one design.
    ///
    /// # Errors
    /// Returns [`Refused::Impossible`] with the first mistake in the grid file.
    pub(crate) fn design(&self, design: &Design) -> Result<Plan, Refused> {
        self.plan_of(&self.grid(design, None, None)?)
    }
}

/// Returns the plan of a grid file that the browser page has created. If the grid file names device files of
/// wings, these files are not read again: the function uses the contents that are stored in `opened`.
fn parsed(opened: &Plan, grid: &str, models: &[&'static dyn Simulator]) -> Result<Plan, Mistakes> {
    // Paths of devices are relative to the folder of the opened file.
    let name = Path::new(&opened.source().name).with_file_name(NAME);
    grid::parse_recorded(&name.display().to_string(), grid, opened.devices(), models)
}

/// Returns true if a formula of the opened file uses a value of the file's device. The grid files of the page
/// contain no device, but only a preset.
pub(crate) fn uses_device(plan: &Plan) -> bool {
    let document: DocumentMut = plan.source().text.parse().unwrap_or_default();
    let sections = KEPT.iter().filter_map(|name| document.get(name)?.as_table_like());
    let mut formulas = sections.flat_map(|section| section.iter()).filter_map(|(_, item)| item.as_str());
    document.contains_key("device") && formulas.any(|formula| formula.contains("device."))
}

/// Returns the beginning of every grid file of the page: the preset, the sections from the opened file and
/// the solver settings.
fn head(plan: &Plan) -> String {
    let mut document: DocumentMut = plan.source().text.parse().unwrap_or_default();
    let strays: Vec<String> = document.iter().map(|(key, _)| key.to_owned()).collect();
    for key in strays.iter().filter(|key| !KEPT.contains(&key.as_str())) {
        document.remove(key);
    }
    // The text after the last section is not about the kept sections.
    document.set_trailing("");
    let mut head = format!("preset = \"{}\"\n", plan.preset());
    let kept = document.to_string();
    if !kept.trim().is_empty() {
        head += kept.trim_start();
        head = head.trim_end().to_owned() + "\n";
    }
    let settings = SolverSettings::TABLE.iter().filter_map(|Setting { name, kind, .. }| {
        let value = text::setting(*kind, plan.solver());
        (value != text::setting(*kind, &SolverSettings::DEFAULT)).then(|| format!("{name} = {value}\n"))
    });
    let changed: String = settings.collect();
    if !changed.is_empty() {
        let _ = write!(head, "\n[solver]\n{changed}");
    }
    head
}

/// Returns a name as a key of TOML. A name that is not a single word is in quotes.
fn key(name: &str) -> String {
    toml_edit::Key::new(name).display_repr().into_owned()
}

/// Returns a number or a text as a value of TOML.
fn number(value: &Number) -> String {
    match value {
        Number::Si(value) => text::float(*value),
        Number::Text(text) => toml_edit::Value::from(text.as_str()).to_string(),
    }
}

/// Converts a mistake in a grid file of the page into a refusal. If the line with the mistake sets a
/// parameter, the refusal contains the name of this parameter.
fn refused(mistake: &Diagnostic, parameters: &[Parameter]) -> Refused {
    let line = mistake.source.text.lines().nth(mistake.line().saturating_sub(1)).unwrap_or_default();
    let name = line.split('=').next().unwrap_or_default().trim();
    let parameter = parameters.iter().find(|parameter| parameter.name == name);
    let help: Vec<&str> = mistake.notes.iter().chain(&mistake.help).map(String::as_str).collect();
    Refused::Impossible {
        error: mistake.message.clone(),
        help: Some(help.join("; ")).filter(|help| !help.is_empty()),
        parameter: parameter.map(|parameter| parameter.name.to_owned()),
    }
}
