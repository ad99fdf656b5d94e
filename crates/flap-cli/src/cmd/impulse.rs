//! `flap run --drive impulse`: the free motion after an impulse on the stroke.

use std::io;

use flap_core::simulate::ImpulseRequest;
use flap_experiments::free::{first, intervals, stroke_rate};

use super::motion::{write_csv, write_file};
use super::point::Chosen;
use crate::args::RunArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::table::{Table, six_digits};

/// The default impulse (rad).
const IMPULSE: f64 = core::f64::consts::PI / 9.0;

/// Default duration, in periods of the first mode.
const CYCLES: f64 = 10.0;

pub(crate) fn run(chosen: &Chosen, args: &RunArgs) -> Result<Exit, Failure> {
    let Chosen { plan, values, .. } = chosen;
    let experiments = plan.simulator().experiments()?;
    let modes = experiments.modes(values)?;
    let first = first(&modes)?;
    let amplitude = args.impulse.unwrap_or(IMPULSE);
    let stroke_rate = stroke_rate(&modes, amplitude)?;
    let duration = args.duration.unwrap_or(CYCLES / first.frequency);
    let request = ImpulseRequest {
        stroke_rate,
        duration,
        intervals: intervals(duration, first.frequency * f64::from(args.samples))?,
    };
    let motion = experiments.free_response(&chosen.run(), &request)?;

    let mut table = Table::with_headings(&["column", "value", "unit", "meaning"]);
    let mut row = |column: &str, value: f64, unit: &str, meaning: &str| {
        table.row([column.to_owned(), six_digits(value), unit.to_owned(), meaning.to_owned()]);
    };
    let impulse = "amplitude of the first mode alone, without damping";
    row("impulse_deg", amplitude.to_degrees(), "deg", impulse);
    row(&format!("{}_hz", first.name), first.frequency, "Hz", "natural frequency of the first mode");
    row("stroke_rate_rad_s", stroke_rate, "rad/s", "rate of the stroke right after the impulse");
    for signal in experiments.free_signals() {
        let (name, unit, column) = (signal.name, signal.unit.name, signal.column());
        if let Some(index) = motion.columns.iter().position(|other| *other == column) {
            let largest = motion.rows.iter().fold(0.0_f64, |largest, row| largest.max(row[index].abs()));
            row(
                &column.replacen(name, &format!("{name}_peak"), 1),
                largest,
                unit,
                &format!("largest magnitude of the {name} sampled"),
            );
        }
    }
    let page = format!("{}\n\n{}", chosen.title(), table.text_within(console::width()));

    match &args.trajectory {
        Some(path) if path.as_os_str() == "-" => {
            console::say(page.trim_end());
            write_csv(&motion, io::stdout().lock())?;
        }
        Some(path) => {
            write_file(&motion, path, args.overwrite.force, "sample")?;
            console::results(&page)?;
        }
        None => console::results(&page)?,
    }
    Ok(Exit::Done)
}
