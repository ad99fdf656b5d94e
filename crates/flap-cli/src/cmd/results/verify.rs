//! `flap results verify`: compares results with the checksums in the sidecar.

use std::io::ErrorKind;
use std::path::Path;

use flap_sweep::files::integrity::{self, Integrity};
use flap_sweep::input::InputError;
use flap_sweep::notation::text::count;

use crate::args::{OutputFormat, VerifyArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;

/// Columns of the output in csv and json.
const NAMES: [&str; 3] = ["file", "verdict", "detail"];

pub(super) fn run(args: &VerifyArgs) -> Result<Exit, Failure> {
    let mut worst = Exit::Done;
    let mut rows = Vec::new();
    for results in &args.results {
        let (verdict, detail, exit) = verdict(results);
        let file = results.display().to_string();
        if args.format == OutputFormat::Table {
            // Large files take time, so each line is printed at once.
            console::results(&format!("{file}: {verdict}: {detail}\n"))?;
        }
        rows.push(vec![file, verdict.to_owned(), detail]);
        worst = if exit as u8 > worst as u8 { exit } else { worst };
    }
    if args.format != OutputFormat::Table {
        print::table(args.format, &NAMES, &rows, String::new)?;
    }
    Ok(worst)
}

/// Compares a results file with its checksums. Returns the verdict as a word, an explanation of the verdict,
/// and the exit code.
fn verdict(results: &Path) -> (&'static str, String, Exit) {
    match integrity::verify(results) {
        Ok(Integrity::Sound { rows }) => ("sound", count(rows, "row"), Exit::Done),
        Ok(Integrity::Unfinished { done: Some(done) }) => {
            ("unfinished", format!("sound so far ({} done)", count(done, "point")), Exit::Done)
        }
        Ok(Integrity::Unfinished { done: None }) => (
            "unfinished",
            "the file has no journal, so flap could not verify anything".to_owned(),
            Exit::NotAll,
        ),
        Ok(Integrity::Unverified(why)) => ("unverified", why.to_owned(), Exit::NotAll),
        Ok(Integrity::Damaged(damage)) => ("damaged", damage.to_string(), Exit::System),
        Err(error @ integrity::OpenError::Format(_)) => ("unreadable", error.to_string(), Exit::Usage),
        Err(integrity::OpenError::Read { source, .. }) if source.kind() == ErrorKind::NotFound => {
            ("unreadable", InputError::Missing.to_string(), Exit::System)
        }
        Err(error) => ("unreadable", error.to_string(), Exit::System),
    }
}
