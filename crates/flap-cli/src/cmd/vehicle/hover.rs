//! Prints the damping matrix and the modes of the linear model about hover, and writes files with this model.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write as _};
use std::path::Path;

use flap_core::vehicle::MassProperties;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::linear_model::{LinearFormat, LinearModel};
use flap_sweep::notation::text;
use flap_sweep::plan::Plan;
use flap_sweep::vehicle::hover::{self, HoverError, STATES, WRENCH_UNITS, component};
use flap_sweep::vehicle::modes::HoverMode;
use flap_sweep::vehicle::trim::Target;
use nalgebra::Matrix6;

use super::super::outputs;
use super::super::point::{self, Chosen, find_parameter};
use crate::console;
use crate::failure::Failure;
use crate::job;
use crate::table::{Table, four_digits, six_digits};

/// Parameter that determines whether the motion of the wings changes when the body moves.
const RESPONSE: &str = "body_response";

/// A small entry of the damping matrix is a rounding error and counts as zero. The limit is this fraction of
/// the smaller of two numbers: the largest entry in the row, and the largest entry in the column.
const ROUNDING: f64 = 1e-12;

/// Checks the name of the file for `--export` before any computation. Returns the name and the format that
/// its ending sets.
pub(super) fn check_output<'p>(path: &'p Path, plan: &Plan) -> Result<(&'p Path, LinearFormat), Failure> {
    let format = LinearFormat::of(path).ok_or_else(|| {
        let failure = Failure::usage(format!("--export {}: the ending names no format", path.display()));
        failure.help(format!("choose a name with the ending {}", LinearFormat::ENDINGS))
    })?;
    let mut inputs = Inputs::new();
    inputs.add_plan(plan);
    outputs::check(&inputs, [Some(path)])?;
    Ok((path, format))
}

/// Sets the parameter `body_response` so that the motion of the wings stays unchanged when the body moves.
pub(super) fn freeze(chosen: &mut Chosen) -> Result<(), Failure> {
    let index = find_parameter(chosen.plan.parameters(), RESPONSE)?;
    let frozen = point::value(&chosen.plan.parameters()[index], "--frozen", "frozen")?;
    chosen.values[index] = frozen;
    Ok(())
}

/// Returns the target values of force and torque for `--trim hover`.
pub(super) fn targets(body: &MassProperties) -> Result<Vec<Target>, Failure> {
    hover::targets(body).ok_or_else(|| match hover::no_weight(body) {
        HoverError::Missing(_) => Failure::usage("--trim hover: total_mass is not set")
            .help("add total_mass to [vehicle], or use --set, as in --set total_mass='85 mg'"),
        error => error.into(),
    })
}

/// Writes the linear model about hover to a file.
pub(super) fn export(
    model: &LinearModel,
    path: &Path,
    format: LinearFormat,
    overwrite: bool,
) -> Result<(), Failure> {
    let written = job::make(path, overwrite, |file| {
        let mut target = BufWriter::new(file);
        model.write(format, &mut target)?;
        target.flush().map(|()| None)
    })?;
    written.map_err(|error: io::Error| Failure::cannot_write(path, &error))?;
    console::say(&format!("linear model in {}", path.display()));
    Ok(())
}

/// Returns the damping matrix for csv and json: the column names, and one row for each component of force and
/// torque.
pub(super) fn damping_cells(damping: &Matrix6<f64>) -> (Vec<String>, Vec<Vec<String>>) {
    let names = ["wrench", "unit"].into_iter().chain(STATES[..6].iter().map(|(name, _)| *name));
    (names.map(str::to_owned).collect(), damping_rows(damping, text::float))
}

fn damping_rows(damping: &Matrix6<f64>, number: impl Fn(f64) -> String) -> Vec<Vec<String>> {
    let row = |i: usize| {
        let head = [component(i).to_owned(), WRENCH_UNITS[i].to_owned()];
        head.into_iter().chain(damping.row(i).iter().map(|slope| number(*slope))).collect()
    };
    (0..6).map(row).collect()
}

/// Returns the damping matrix as text for a terminal.
pub(super) fn damping_table(damping: &Matrix6<f64>) -> String {
    // Entries that vanish by symmetry are rounding beside the other entries of their row and column.
    let tidy = Matrix6::from_fn(|i, j| {
        let beside = damping.row(i).amax().min(damping.column(j).amax());
        if damping[(i, j)].abs() <= ROUNDING * beside { 0.0 } else { damping[(i, j)] }
    });
    let units = ["", ""].into_iter().chain(STATES[..6].iter().map(|(_, unit)| *unit));
    let mut table = Table::with_headings(&["mean", "unit", "forward", "left", "up", "roll", "pitch", "yaw"]);
    table.row(
        units
            .map(|unit| if unit.is_empty() { String::new() } else { format!("per {unit}") })
            .collect::<Vec<_>>(),
    );
    for row in damping_rows(&tidy, six_digits) {
        table.row(row);
    }
    format!(
        "\nChange of force and torque with velocity and rates of the body (damping matrix):\n\n{}",
        table.text_within(console::width())
    )
}

/// Returns the modes for csv and json: the column names, and one row for each real eigenvalue or pair of
/// complex eigenvalues.
pub(super) fn mode_cells(model: &LinearModel) -> (Vec<String>, Vec<Vec<String>>) {
    let names =
        ["mode", "eigenvalue_real", "eigenvalue_imag", "time_to_double_s", "time_to_half_s", "period_s"];
    let shares = model.hover.states().iter().map(|(name, _)| format!("participation_{name}"));
    let row = |mode: &HoverMode| {
        let numbers = [
            Some(mode.eigenvalue.re),
            Some(mode.eigenvalue.im),
            mode.time_to_double(),
            mode.time_to_half(),
            mode.period(),
        ];
        let numbers = numbers.map(|number| number.map(text::float).unwrap_or_default());
        let shares = mode.participation.iter().map(|share| text::float(*share));
        core::iter::once(mode.name()).chain(numbers).chain(shares).collect()
    };
    let names = names.into_iter().map(str::to_owned).chain(shares);
    (names.collect(), model.hover.modes.iter().map(row).collect())
}

/// Returns the trim residual and the modes as text for a terminal.
pub(super) fn mode_table(model: &LinearModel) -> String {
    let mut page = String::new();
    let limits = model.hover.residual_limits();
    let mut table = Table::with_headings(&["residual", "unit", "value", "limit"]);
    for (i, (residual, limit)) in model.hover.residual().into_iter().zip(limits).enumerate() {
        let residual = if residual.abs() < ROUNDING * limit { 0.0 } else { residual };
        table.row([
            component(i).to_owned(),
            WRENCH_UNITS[i].to_owned(),
            six_digits(residual),
            six_digits(limit),
        ]);
    }
    let width = console::width();
    let _ = write!(
        page,
        "\nForce without the weight of {} N, and torque, at the point:\n\n{}",
        six_digits(model.hover.body.mass * model.hover.body.gravity),
        table.text_within(width)
    );
    let headings = ["eigenvalue (1/s)", "doubles in (s)", "halves in (s)", "period (s)", "mode"];
    let mut modes = Table::with_headings(&headings);
    let four = |number: Option<f64>| number.map_or_else(|| "-".to_owned(), four_digits);
    for mode in &model.hover.modes {
        let value = mode.eigenvalue;
        let eigenvalue = if value.im == 0.0 {
            six_digits(value.re)
        } else {
            format!("{} ± {}i", six_digits(value.re), six_digits(value.im))
        };
        let times = [mode.time_to_double(), mode.time_to_half(), mode.period()].map(four);
        modes.row(core::iter::once(eigenvalue).chain(times).chain([mode.name()]).collect::<Vec<_>>());
    }
    let _ = write!(page, "\nModes of the linear model about hover:\n\n{}", modes.text_within(width));
    page
}

impl From<HoverError> for Failure {
    fn from(error: HoverError) -> Failure {
        let help = match &error {
            HoverError::Control(error) => return error.clone().into(),
            HoverError::Trim(_) => {
                "start closer to hover: set the drive with --set, or total_mass. `flap vehicle` prints the effect of each input"
            }
            HoverError::Missing(_) => {
                "add the numbers to [vehicle], or use --set, as in --set total_mass='85 mg' --set body_inertia_roll='1.5e-9 kg*m^2'"
            }
            HoverError::Impossible(_) => {
                "correct the mass properties in [vehicle]: masses in mg and lengths in mm give moments in 1e-12 kg*m^2"
            }
            HoverError::NoBodyMotion => "choose a model whose wings respond to the motion of the body",
            HoverError::Moving(_) => "set velocities and rates of the body to zero",
            HoverError::Eigenvalues => {
                "check the mass properties and the damping matrix: `--damping` prints this matrix"
            }
        };
        Failure::usage(error.to_string()).help(help)
    }
}
