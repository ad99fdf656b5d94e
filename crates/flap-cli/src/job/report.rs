//! The messages that flap prints at the end of a sweep or of `flap respond`.

use std::path::Path;

use flap_core::simulate::Status;
use flap_sweep::files::job::Done;
use flap_sweep::files::results::Format;
use flap_sweep::notation::text::count;
use flap_sweep::plan::Plan;
use flap_sweep::plan::selection::Selection;
use flap_sweep::refine::Refined;
use flap_sweep::run::{InvalidPoint, Warnings};
use flap_sweep::table::layout::Layout;

use super::exclusion;
use crate::console::{self, shell_word};

/// Prints a summary of the rows, and the name of the file or stream that contains the rows.
pub(super) fn report(plan: &Plan, done: &Done, out: &Path) {
    let Done { summary, rows_before, seconds, place } = done;
    for InvalidPoint { point, reason } in &summary.invalid {
        console::say(&format!("point {point} is invalid: {reason}"));
    }
    let counts = summary.statuses.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let counts = if counts.is_empty() { "no points".to_owned() } else { counts.join(", ") };
    let rate = (summary.rows - rows_before) as f64 / seconds.max(1e-9);
    console::say(&format!("{counts} in {seconds:.2} s ({rate:.0} points/s)"));

    if summary.excluded > 0 {
        console::say(&exclusion::text(summary.excluded, &summary.unsatisfied));
    }
    if let Some(refined) = &summary.refined {
        console::say(&refinement(refined));
    } else if plan.refine().is_some() && matches!(plan.selection(), Selection::Shard(_)) {
        console::say(
            "shards contain the points of the axes only: after `flap results merge`, \
             `flap results resume` adds the points of [refine] to the merged file",
        );
    }
    // An interrupted sweep must be continued first.
    if !summary.is_interrupted() {
        report_warnings(plan, done);
        report_unsettled(plan, done);
    }

    let to = place.as_deref().unwrap_or(out).display();
    if summary.is_interrupted() {
        let (done, points) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {points} points are in {to}"));
    } else {
        console::say(&format!("{} in {to}", count(summary.rows, "row")));
    }
}

/// Returns a line about the points that the refinement of a grid added.
fn refinement(refined: &Refined) -> String {
    let Refined { rounds, added, boxes, above, is_limited } = *refined;
    let added = format!("{} added in {}", count(added, "point"), count(rounds, "round"));
    if above == 0 {
        return format!("{added}: the estimated interpolation error is below `error` in all {boxes} boxes");
    }
    let why = if is_limited {
        "`max_points` is reached"
    } else {
        "they contain jumps and are halved `halvings` times"
    };
    format!("{added}: the estimated interpolation error is above `error` in {above} of {boxes} boxes ({why})")
}

/// Prints how many rows are inaccurate or unreliable, with advice.
fn report_warnings(plan: &Plan, done: &Done) {
    let Warnings { inaccurate, negative_power, at_range_end, unbalanced } = done.summary.warnings;
    if inaccurate > 0 {
        let rows = count(inaccurate, "row");
        let verb = if inaccurate == 1 { "misses" } else { "miss" };
        let said = format!("{rows} {verb} the accuracy of [solver]");
        let it = if inaccurate == 1 { "it" } else { "them" };
        console::say(&match &done.place {
            _ if !Layout::of(plan).has("error_estimate") => {
                format!("{said}: use a smaller rtol, or add `error_estimate` to `columns`")
            }
            _ if is_rerun(plan) => {
                let rtol = plan.solver().rtol;
                format!(
                    "{said} with rtol = {rtol:e} (see the column error_estimate): lower --rtol further, or raise --accuracy"
                )
            }
            Some(place) => format!(
                "{said} (see the column error_estimate). To run {it} again: \
                 flap results rerun {} --inaccurate --rtol 1e-10 --out {}",
                shell_word(&place.to_string_lossy()),
                beside(place, "accurate")
            ),
            None => format!("{said} (see the column error_estimate): use a smaller rtol"),
        });
    }
    if unbalanced > 0 {
        let rows = count(unbalanced, "row");
        let verb = if unbalanced == 1 { "does" } else { "do" };
        console::say(&format!(
            "{rows} {verb} not hover: the search for hover left more than 1 % of the weight (see the column hover_residual)"
        ));
    }
    if negative_power > 0 {
        let rows = count(negative_power, "row");
        let verb = if negative_power == 1 { "has" } else { "have" };
        console::say(&format!(
            "{rows} {verb} negative mean power: the air adds energy to the wing (see the manual, Models, Direct drive)"
        ));
    }
    if at_range_end > 0 {
        let resonances = count(at_range_end, "resonance");
        let place =
            if at_range_end == 1 { "is at an end of its range" } else { "are at an end of their range" };
        console::say(&format!(
            "{resonances} {place} (resonance_margin_hz is 0), so it may not be a peak: \
             widen the range with from and to in [resonance]"
        ));
    }
}

/// Prints the number of points that did not settle, and advice, such as a command that runs these points
/// longer. In a rerun, the advice is to run the points longer only if their residual has become smaller.
fn report_unsettled(plan: &Plan, done: &Done) {
    let unsettled = done.summary.statuses.of(Status::Unsettled);
    if unsettled == 0 {
        return;
    }
    let cycles = plan.solver().max_cycles;
    let (points, it) = (count(unsettled, "point"), if unsettled == 1 { "it" } else { "them" });
    let periods = count(cycles.into(), "drive period");
    let longer = match &done.place {
        _ if is_rerun(plan) => {
            "Run them longer with --max-cycles only if the column residual is smaller than in the earlier rows. \
             Otherwise lower --rtol or raise --settle-tol; a motion that stays unsettled is quasi-periodic or chaotic"
                .to_owned()
        }
        Some(place) => format!(
            "To run {it} longer: flap results rerun {} --status unsettled --max-cycles {} --out {}. \
             If the column residual does not fall with more periods, lower rtol or raise settle_tol",
            shell_word(&place.to_string_lossy()),
            cycles.saturating_mul(10),
            beside(place, "unsettled")
        ),
        None => format!(
            "To run {it} longer, raise max_cycles in [solver]. \
             If the column residual does not fall with more periods, lower rtol or raise settle_tol"
        ),
    };
    console::say(&format!("{points} did not settle within {periods}. {longer}"));
}

/// Returns true if the plan is a rerun, whose points were chosen from earlier results.
fn is_rerun(plan: &Plan) -> bool {
    matches!(plan.selection(), Selection::Listed(_))
}

/// Returns the name of results with a word before the ending: `sweep.unsettled.csv` for `sweep.csv`.
fn beside(results: &Path, word: &str) -> String {
    shell_word(&Format::with_word(results, word).to_string_lossy())
}

/// Prints the number of response curves, and the name of the file or stream that contains their rows.
pub(super) fn report_curves(done: &Done, out: &Path) {
    let Done { summary, place, .. } = done;
    let to = place.as_deref().unwrap_or(out).display();
    if summary.is_interrupted() {
        let (done, designs) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {designs} designs are in {to}"));
    } else if place.is_some() {
        console::say(&format!("{} in {to}", count(summary.ran, "curve")));
    }
}
