//! `flap test lift`: forces on a wing with a given motion.

use std::f64::consts::PI;

use flap_core::drive::Repeat;
use flap_core::simulate::{ImposedMotion, Trajectory};
use flap_experiments::free::INTERVALS_MAX;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::record::{self, Record, RecordError};
use flap_sweep::notation::text;
use flap_sweep::plan::Plan;
use flap_sweep::study::experiment;

use crate::args::{LiftArgs, SolverArgs};
use crate::cmd::motion::write_file;
use crate::cmd::outputs;
use crate::cmd::point::{Chosen, check_one_wing};
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, six_digits};

/// Number of samples for the summary per row of the file with the motion. The summary has at least
/// [`LiftArgs::SAMPLES`] samples.
const SAMPLES_PER_ROW: u32 = 4;

pub(super) fn run(args: &LiftArgs) -> Result<Exit, Failure> {
    let chosen = Chosen::new(&args.point, &SolverArgs::default())?;
    let plan = &chosen.plan;
    check_one_wing(plan, &args.point.what, "`flap test lift`")?;
    let mut inputs = Inputs::new();
    inputs.add_plan(plan).add("the motion", &args.motion);
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    let repeat = if args.periodic { Repeat::Periodic } else { Repeat::Once };
    let file = Record::read(&args.motion)?;
    let stroke = file.samples(&record::STROKE, repeat)?;
    let pitch = file.samples(&record::PITCH, repeat).map_err(|error| match error {
        RecordError::Missing { .. } => stroke_alone(error, plan, args),
        _ => error.into(),
    })?;
    let [low, high] = stroke.sample_range();
    let largest = high.max(-low);
    if largest > PI {
        let degrees = six_digits(largest.to_degrees());
        console::warn(&format!(
            "{}: the stroke reaches {degrees}°, which is more than 180°: check the unit in the heading of the stroke",
            args.motion.display()
        ));
    }
    let experiments = plan.simulator().experiments()?;
    let mut motion = ImposedMotion { stroke, pitch, samples: args.samples };
    if let Some(path) = &args.trajectory {
        let forces = experiment::forces(experiments, &chosen.run(), &motion)?;
        write_file(&forces, path, args.overwrite.force, "sample")?;
        if console::is_stdout(path) {
            return Ok(Exit::Done);
        }
    }
    let rows = u32::try_from(file.column(&record::TIME)?.len()).unwrap_or(u32::MAX);
    motion.samples = LiftArgs::SAMPLES.max(SAMPLES_PER_ROW.saturating_mul(rows)).min(INTERVALS_MAX);
    let forces = experiment::forces(experiments, &chosen.run(), &motion)?;
    print::table(args.format, &NAMES, &summary(&forces, text::float), || {
        Table::of(&NAMES, summary(&forces, six_digits)).text_within(console::width())
    })?;
    Ok(Exit::Done)
}

/// Returns the failure for a motion file that has no pitch column. The help line shows a command that
/// computes the pitch of a wing with a prescribed stroke.
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

/// Columns of the summary in csv and json.
const NAMES: [&str; 4] = ["column", "mean", "min", "max"];

/// Returns the summary in the columns [`NAMES`]: mean, minimum and maximum of every column except the time.
fn summary(forces: &Trajectory, number: fn(f64) -> String) -> Vec<Vec<String>> {
    let of_column = |(i, column): (usize, &String)| {
        let values: Vec<f64> = forces.rows.iter().map(|row| row[i]).collect();
        // The samples are equally spaced, and the ends have half the weight.
        let ends = 0.5 * (values[0] + values[values.len() - 1]);
        let mean = (values.iter().sum::<f64>() - ends) / (values.len() - 1) as f64;
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        vec![column.clone(), number(mean), number(min), number(max)]
    };
    forces.columns.iter().enumerate().skip(1).map(of_column).collect()
}
