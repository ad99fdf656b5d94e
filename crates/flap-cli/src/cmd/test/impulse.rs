//! `flap test impulse`: the free motion after an impulse on the stroke.

use flap_core::modes::Mode;
use flap_core::simulate::{Experiments, ImpulseRequest, Trajectory};
use flap_experiments::free::{first, intervals, stroke_rate};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::notation::text;

use crate::args::ImpulseArgs;
use crate::cmd::motion::write_file;
use crate::cmd::outputs;
use crate::cmd::point::{Chosen, check_one_wing};
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, six_digits};

/// Default duration of the motion, in periods of the first mode.
const CYCLES: f64 = 10.0;

pub(super) fn run(args: &ImpulseArgs) -> Result<Exit, Failure> {
    let chosen = Chosen::new(&args.point, &args.solver)?;
    let Chosen { plan, values, .. } = &chosen;
    check_one_wing(plan, &args.point.what, "`flap test impulse`")?;
    let mut inputs = Inputs::new();
    inputs.add_plan(plan);
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    let experiments = plan.simulator().experiments()?;
    let modes = experiments.modes(values)?;
    let first = first(&modes)?;
    let stroke_rate = stroke_rate(&modes, args.amplitude)?;
    let duration = args.duration.unwrap_or(CYCLES / first.frequency);
    let request = ImpulseRequest {
        stroke_rate,
        duration,
        intervals: intervals(duration, first.frequency * f64::from(args.samples))?,
    };
    let motion = experiments.free_response(&chosen.run(), &request)?;

    if let Some(path) = &args.trajectory {
        write_file(&motion, path, args.overwrite.force, "sample")?;
        if is_stdout(path) {
            return Ok(Exit::Done);
        }
    }
    let rows = |number| summary((args.amplitude, stroke_rate), &first, experiments, &motion, number);
    print::table(args.format, &NAMES, &rows(text::float), || {
        let table = Table::of(&NAMES, rows(six_digits)).text_within(console::width());
        format!("{}\n\n{table}", chosen.title())
    })?;
    Ok(Exit::Done)
}

/// Columns of the summary in csv and json.
const NAMES: [&str; 4] = ["column", "value", "unit", "meaning"];

/// Returns the summary in the columns [`NAMES`]: the impulse, the frequency of the first mode, and the peaks
/// of the motion.
fn summary(
    (amplitude, stroke_rate): (f64, f64),
    first: &Mode,
    experiments: &dyn Experiments,
    motion: &Trajectory,
    number: fn(f64) -> String,
) -> Vec<Vec<String>> {
    let row = |column: &str, value: f64, unit: &str, meaning: &str| {
        vec![column.to_owned(), number(value), unit.to_owned(), meaning.to_owned()]
    };
    let impulse = "amplitude that the stroke would reach in the first mode alone, without damping";
    let mut rows = vec![
        row("impulse_deg", amplitude.to_degrees(), "deg", impulse),
        row(&format!("{}_hz", first.name), first.frequency, "Hz", "natural frequency of the first mode"),
        row("stroke_rate_rad_s", stroke_rate, "rad/s", "rate of the stroke right after the impulse"),
    ];
    for signal in experiments.free_signals() {
        let (name, unit, column) = (signal.name, signal.unit.name, signal.column());
        if let Some(index) = motion.columns.iter().position(|other| *other == column) {
            let largest = motion.rows.iter().fold(0.0_f64, |largest, row| largest.max(row[index].abs()));
            let peak = column.replacen(name, &format!("{name}_peak"), 1);
            rows.push(row(&peak, largest, unit, &format!("largest magnitude of the {name} in the samples")));
        }
    }
    rows
}
