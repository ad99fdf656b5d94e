//! `flap test resonance`: the resonances of one design point, found by several methods.

use flap_experiments::free::{self, FreeMotion, FreeRequest};
use flap_experiments::spectrum::SpectrumPeak;
use flap_sweep::notation::text;
use flap_sweep::resonance::Range;
use flap_sweep::resonance::driven::{self, DrivenPeaks, Gap};

use crate::args::ResonanceArgs;
use crate::cmd::point::{Chosen, check_one_wing};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, six_digits};

/// Number of samples of the free motion per period of the first mode.
const SAMPLES: u32 = 200;

/// If the relative residual of the fitted damped sine exceeds this number, flap prints a note. The residual
/// is the stroke minus the sine, and the relative residual is a ratio of root mean squares.
const POOR_FIT: f64 = 0.1;

/// flap prints a note if the second peak of the settled stroke has at least this fraction of the height of
/// the highest peak.
const RIVAL: f64 = 0.95;

pub(super) fn run(args: &ResonanceArgs) -> Result<Exit, Failure> {
    let chosen = Chosen::new(&args.point, &args.solver)?;
    let Chosen { plan, values, .. } = &chosen;
    check_one_wing(plan, &args.point.what, "`flap test resonance`")?;
    let simulator = plan.robot().model();
    let experiments = simulator.experiments()?;
    let modes = experiments.modes(values)?;
    let request = FreeRequest {
        amplitude: args.impulse,
        fit_cycles: args.window_cycles,
        spectrum_window: args.spectrum_window,
        samples_per_cycle: SAMPLES,
    };
    let range = Range { from: args.from, to: args.to, tolerance: args.tolerance, ..Range::default() };
    let free = free::examine(experiments, &chosen.run(), &request)?;
    let driven = driven::search(simulator, &chosen.run(), &range, |values| chosen.update(values))?;

    let mut lines: Vec<Line> = Vec::new();
    for mode in &modes {
        lines.push(Line { frequency: mode.frequency, ..Line::new(mode.name, "small undamped motion") });
    }
    lines.extend(free_lines(&free, args));
    lines.extend(driven_lines(&driven));
    let rows =
        |number| -> Vec<Vec<String>> { lines.iter().map(|line| line.cells(number).to_vec()).collect() };
    print::table(args.format, &HEADINGS, &rows(text::float), || {
        let table = Table::of(&HEADINGS, rows(six_digits)).text_within(console::width());
        format!("{}\n\n{table}", chosen.title())
    })?;
    comment_on_free(&free, args);
    comment_on_driven(&driven);
    Ok(Exit::Done)
}

/// One resonance as a line of the output. A number is NaN if the method that found the resonance does not
/// compute this number.
struct Line {
    name: String,
    frequency: f64,
    height: f64,
    stroke_pp: f64,
    pitch_pp: f64,
    decay: f64,
    left_over: f64,
    meaning: String,
}

const HEADINGS: [&str; 8] = [
    "resonance",
    "frequency_hz",
    "relative_height",
    "stroke_pp_deg",
    "pitch_pp_deg",
    "decay_1_s",
    "relative_rms",
    "meaning",
];

impl Line {
    fn new(name: impl Into<String>, meaning: impl Into<String>) -> Line {
        let nothing = f64::NAN;
        Line {
            name: name.into(),
            frequency: nothing,
            height: nothing,
            stroke_pp: nothing,
            pitch_pp: nothing,
            decay: nothing,
            left_over: nothing,
            meaning: meaning.into(),
        }
    }

    fn numbers(&self) -> [f64; 6] {
        let Line { frequency, height, stroke_pp, pitch_pp, decay, left_over, .. } = *self;
        [frequency, height, stroke_pp, pitch_pp, decay, left_over]
    }

    fn cells(&self, number: fn(f64) -> String) -> [String; 8] {
        let [a, b, c, d, e, f] = self.numbers().map(number);
        [self.name.clone(), a, b, c, d, e, f, self.meaning.clone()]
    }
}

fn free_lines(free: &FreeMotion, args: &ResonanceArgs) -> Vec<Line> {
    let mut lines = Vec::new();
    if let Some(fit) = &free.fit {
        let meaning = format!(
            "damped sine through {} periods after an impulse of {} deg (stroke rate {} rad/s)",
            args.window_cycles,
            six_digits(args.impulse.to_degrees()),
            six_digits(free.stroke_rate)
        );
        lines.push(Line {
            frequency: fit.frequency,
            decay: fit.decay,
            left_over: fit.relative_rms,
            ..Line::new("impulse_fit", meaning)
        });
    }
    for (of, peaks) in &free.spectra {
        let highest = peaks.first().map_or(f64::NAN, |peak| peak.amplitude);
        for (number, SpectrumPeak { frequency, amplitude }) in (1..).zip(peaks) {
            let meaning = format!("peak {number} of the {of}'s spectrum after the impulse");
            lines.push(Line {
                frequency: *frequency,
                height: amplitude / highest,
                ..Line::new(format!("{of}_spectrum_{number}"), meaning)
            });
        }
    }
    lines
}

fn driven_lines(driven: &DrivenPeaks) -> Vec<Line> {
    let highest = driven.peaks.first().map_or(f64::NAN, |peak| peak.stroke_pp);
    let line = |(number, peak): (u32, &driven::DrivenPeak)| Line {
        frequency: peak.frequency,
        height: peak.stroke_pp / highest,
        stroke_pp: peak.stroke_pp,
        pitch_pp: peak.pitch_pp,
        ..Line::new(
            format!("driven_{number}"),
            format!("peak {number} of the settled stroke over drive frequency"),
        )
    };
    (1..).zip(&driven.peaks).map(line).collect()
}

fn comment_on_free(free: &FreeMotion, args: &ResonanceArgs) {
    match &free.fit {
        None => console::say(&format!(
            "no damped sine fits: the stroke hardly oscillates in {} periods of the first mode after the impulse",
            args.window_cycles
        )),
        Some(fit) if fit.relative_rms > POOR_FIT => console::say(&format!(
            "the damped sine has a residual of {} % of the stroke (root mean square): the motion has more than one \
             frequency, or its decay rate changes",
            (100.0 * fit.relative_rms).round()
        )),
        Some(_) => {}
    }
}

fn comment_on_driven(driven: &DrivenPeaks) {
    if let Some(frequency) = driven.larger_at {
        console::say(&format!(
            "the settled stroke is larger at the end of the range, {} Hz, than at any peak in the range: widen the range \
             with --from and --to",
            six_digits(frequency)
        ));
    } else if driven.peaks.is_empty() {
        let [from, to] = driven.range.map(six_digits);
        let range = format!("{from} to {to} Hz");
        console::say(&format!("the settled stroke has no peak at drive frequencies from {range}"));
    }
    if let [first, second] = driven.peaks[..]
        && second.stroke_pp >= RIVAL * first.stroke_pp
    {
        let share = 100.0 * (1.0 - second.stroke_pp / first.stroke_pp);
        console::say(&format!(
            "the second peak of the settled stroke is only {share:.1} % lower than the first peak"
        ));
    }
    let unsettled: usize = driven.gaps.iter().map(|gap| gap.points).sum();
    if unsettled > 0 {
        let gaps: Vec<String> = driven.gaps.iter().map(describe).collect();
        console::say(&format!(
            "{unsettled} of {} drive frequencies have no periodic motion, so that the search may miss a peak at these frequencies: {}",
            driven.points,
            gaps.join(", ")
        ));
    }
}

fn describe(gap: &Gap) -> String {
    let Gap { from, to, points, status } = gap;
    let [from, to] = [from, to].map(|frequency| six_digits(*frequency));
    if *points == 1 {
        format!("{from} Hz {}", status.name())
    } else {
        format!("{from} to {to} Hz {} ({points})", status.name())
    }
}
