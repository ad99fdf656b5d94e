//! The report of a finished job.

use std::path::Path;

use flap_core::simulate::Status;
use flap_sweep::files::job::Done;
use flap_sweep::run::Doubts;

use super::exclusion;
use crate::console;

/// Tells the user the summary of the rows and their file.
pub(super) fn report(done: &Done) {
    let Done { summary, rows_before, seconds, place } = done;
    for (point, reason) in &summary.invalid {
        console::say(&format!("point {point} is invalid: {reason}"));
    }
    let counts = summary.counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let counts = if counts.is_empty() { "no points".to_owned() } else { counts.join(", ") };
    let rate = (summary.rows - rows_before) as f64 / seconds.max(1e-9);
    console::say(&format!("{counts} in {seconds:.2} s ({rate:.0} points/s)"));

    if summary.excluded > 0 {
        console::say(&exclusion::text(summary.excluded, &summary.unsatisfied));
    }
    report_doubts(done);
    let unsettled = summary.counts.of(Status::Unsettled);
    if unsettled > 0 {
        console::say(&format!(
            "{unsettled} did not settle: where `residual` is still falling, raise max_cycles in [solver]; \
             where it is not, lower rtol or raise settle_tol"
        ));
    }

    let place = place.as_deref().map_or("stdout".into(), Path::to_string_lossy);
    if summary.interrupted {
        let (done, points) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {points} points are in {place}"));
    } else {
        console::say(&format!("{} rows in {place}", summary.rows));
    }
}

/// Tells the user the numbers of rows to be read with care, with advice.
fn report_doubts(done: &Done) {
    let Doubts { inaccurate, powerless, at_range_end } = done.summary.doubts;
    if inaccurate > 0 {
        let help = match &done.place {
            Some(place) => {
                format!(
                    "`flap rerun {} --inaccurate --rtol 1e-10 --out again.csv` runs them again",
                    place.display()
                )
            }
            None => "lower rtol in [solver]".to_owned(),
        };
        console::say(&format!(
            "{inaccurate} rows miss the accuracy of [solver], see their error_estimate: {help}"
        ));
    }
    if powerless > 0 {
        console::say(&format!(
            "{powerless} rows have negative mean power: the model's air gives energy to the wing there (docs/model.md)"
        ));
    }
    if at_range_end > 0 {
        console::say(&format!(
            "{at_range_end} resonances are at an end of their range (resonance_margin_hz is 0): they are no peaks, \
             widen the range with from and to in [resonance]"
        ));
    }
}

/// Tells the user the number of curves and their file.
pub(super) fn report_curves(done: &Done) {
    let Done { summary, place, .. } = done;
    let curves = summary.ran;
    match place {
        Some(place) if !summary.interrupted => {
            console::say(&format!("{curves} curves in {}", place.display()));
        }
        // Rows on stdout speak for themselves.
        None if !summary.interrupted => {}
        place => {
            let place = place.as_ref().map_or("stdout".to_owned(), |place| place.display().to_string());
            let (done, designs) = (summary.done(), summary.points);
            console::say(&format!(
                "interrupted: the rows of the first {done} of {designs} designs are in {place}"
            ));
        }
    }
}
