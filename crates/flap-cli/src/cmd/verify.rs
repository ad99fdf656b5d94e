//! `flap verify`: results compared with their recorded checksums.

use std::path::Path;

use flap_sweep::files::integrity::{self, Verdict};
use flap_sweep::notation::text::count;

use crate::args::VerifyArgs;
use crate::console;
use crate::failure::{Exit, Failure};

pub(crate) fn run(args: &VerifyArgs) -> Result<Exit, Failure> {
    let mut worst = Exit::Done;
    for results in &args.results {
        let (line, exit) = verdict(results);
        console::results(&format!("{line}\n"))?;
        worst = if exit as u8 > worst as u8 { exit } else { worst };
    }
    Ok(worst)
}

/// The line about a file, and its exit code.
fn verdict(results: &Path) -> (String, Exit) {
    let name = results.display();
    match integrity::verify(results) {
        Ok(Verdict::Sound { rows }) => (format!("{name}: sound, {}", count(rows, "row")), Exit::Done),
        Ok(Verdict::Unfinished { done: Some(done) }) => {
            (format!("{name}: unfinished, sound so far ({} done)", count(done, "point")), Exit::Done)
        }
        Ok(Verdict::Unfinished { done: None }) => {
            (format!("{name}: unfinished, and could not be verified: it has no journal"), Exit::NotAll)
        }
        Ok(Verdict::Unverified(why)) => (format!("{name}: could not be verified: {why}"), Exit::NotAll),
        Ok(Verdict::Damaged(damage)) => (format!("{name}: damaged: {damage}"), Exit::System),
        Err(integrity::OpenError::Format(error)) => (error.to_string(), Exit::Usage),
        Err(error) => (format!("{name}: {error}"), Exit::System),
    }
}
