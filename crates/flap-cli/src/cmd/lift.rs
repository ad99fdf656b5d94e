//! `flap lift`: forces on a wing with a given motion.

use std::io;

use flap_core::drive::Repeat;
use flap_core::simulate::{ImposedMotion, Trajectory};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::record::{self, RecordError};
use flap_sweep::plan::Plan;

use super::motion::{write_csv, write_file};
use super::point::Chosen;
use super::{outputs, samples};
use crate::args::{LiftArgs, SolverArgs};
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::table::{Table, six_digits};

pub(crate) fn run(args: &LiftArgs) -> Result<Exit, Failure> {
    let Chosen { plan, values, .. } = Chosen::new(&args.point, &SolverArgs::default())?;
    let mut inputs = Inputs::new();
    inputs.add_plan(&plan).add("the motion", &args.motion);
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    let repeat = if args.periodic { Repeat::Periodic } else { Repeat::Once };
    let file = samples::read(&args.motion)?;
    let stroke = samples::column(&file, &args.motion, record::STROKE, repeat)?;
    if let Err(error @ RecordError::Missing { .. }) = file.column(record::PITCH) {
        return Err(stroke_alone(error, &plan, args));
    }
    let pitch = samples::column(&file, &args.motion, record::PITCH, repeat)?;
    let motion = ImposedMotion { stroke, pitch, samples: args.samples };
    let mut forces = plan.simulator().experiments()?.imposed(&values, &motion)?;
    drop_unknown(&mut forces);

    match &args.trajectory {
        Some(path) if path.as_os_str() == "-" => {
            write_csv(&forces, io::stdout().lock())?;
            return Ok(Exit::Done);
        }
        Some(path) => write_file(&forces, path, args.overwrite.force, "sample")?,
        None => {}
    }
    console::results(&summary(&forces))?;
    Ok(Exit::Done)
}

/// The failure of a motion without pitch. Models whose stroke can be prescribed compute the pitch.
fn stroke_alone(error: RecordError, plan: &Plan, args: &LiftArgs) -> Failure {
    let computes = |what: &str| {
        let motion = shell_word(&args.motion.to_string_lossy());
        format!(
            "`flap run {what} --stroke {motion}` computes the pitch of a wing that follows the stroke, and its lift"
        )
    };
    let is_able = plan.parameters().iter().any(|parameter| parameter.name == "stroke_mode");
    Failure::from(error).help(if is_able {
        computes(&args.point.what)
    } else {
        computes("PRESET") + ", with a preset of a model that has the parameter stroke_mode"
    })
}

/// Removes the columns that a given motion does not determine.
fn drop_unknown(forces: &mut Trajectory) {
    let known: Vec<bool> =
        (0..forces.columns.len()).map(|i| forces.rows.iter().any(|row| !row[i].is_nan())).collect();
    let keep = |i: &mut usize| {
        *i += 1;
        known[*i - 1]
    };
    let mut i = 0;
    forces.columns.retain(|_| keep(&mut i));
    for row in &mut forces.rows {
        let mut i = 0;
        row.retain(|_| keep(&mut i));
    }
}

/// Mean, least and largest of every column but the time.
fn summary(forces: &Trajectory) -> String {
    let mut table = Table::with_headings(&["column", "mean", "min", "max"]);
    for (i, column) in forces.columns.iter().enumerate().skip(1) {
        let values: Vec<f64> = forces.rows.iter().map(|row| row[i]).collect();
        // Equally spaced: the ends count half.
        let ends = 0.5 * (values[0] + values[values.len() - 1]);
        let mean = (values.iter().sum::<f64>() - ends) / (values.len() - 1) as f64;
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        table.row([column.clone(), six_digits(mean), six_digits(min), six_digits(max)]);
    }
    table.text_within(console::width())
}
