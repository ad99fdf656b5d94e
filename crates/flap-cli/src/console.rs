//! Output of the command: results go to stdout, and all other messages go to stderr.

use std::env;
use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use anstyle::{AnsiColor, Style};

static QUIET: AtomicBool = AtomicBool::new(false);

/// After this call, flap prints only warnings and errors to stderr: no notes and no progress.
pub(crate) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Returns true if the option `--quiet` has switched off notes and progress.
pub(crate) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Returns the largest number of characters in a line of stdout. The number is the width of the terminal or,
/// without a terminal, the value of the environment variable COLUMNS.
///
/// The result is `None` if there is neither a terminal nor COLUMNS, for example in a pipe. If the result is
/// `None`, lines may have any length.
pub(crate) fn width() -> Option<usize> {
    let terminal = terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0));
    terminal.or_else(|| env::var("COLUMNS").ok()?.parse().ok()).filter(|width| *width > 0)
}

/// Returns true for `-` and `/dev/stdout`, the names of stdout.
///
/// If the shell redirects stdout to a file, `/dev/stdout` is a link to this file, which the shell has already
/// opened.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-" || (cfg!(unix) && path == Path::new("/dev/stdout"))
}

/// Writes results to stdout.
pub(crate) fn results(text: &str) -> io::Result<()> {
    let mut stdout = anstream::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// Prints a warning about damage or a probable mistake. The command continues.
pub(crate) fn warn(text: &str) {
    let style = Style::new().bold().fg_color(Some(AnsiColor::BrightYellow.into()));
    complain(&format!("{style}warning{style:#}: {text}"));
}

/// Breaks a long help line into lines that fit the terminal. Lines after the first line are indented to the first word
/// of the first line.
pub(crate) fn help_lines(text: &str) -> String {
    const MARGIN: &str = "      ";
    let terminal = terminal_size::terminal_size_of(io::stderr()).map(|(width, _)| usize::from(width.0));
    let width = terminal.filter(|width| *width > 40).unwrap_or(100) - MARGIN.len();
    textwrap::wrap(text, width).join(&format!("\n{MARGIN}"))
}

/// Returns a word in a form that a user can copy into a shell. The word is in quotes if it contains
/// characters that shells interpret.
pub(crate) fn shell_word(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "._-/+=:,".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// Prints a note to stderr, unless notes are switched off. If stderr is closed, the printed line is lost.
pub(crate) fn say(text: &str) {
    if !is_quiet() {
        complain(text);
    }
}

/// Prints a warning or an error to stderr. If stderr is closed, the printed line is lost.
///
/// The text and its line break are written in one call, so that no other process can write between them.
pub(crate) fn complain(text: &str) {
    let _ = anstream::stderr().write_all(format!("{text}\n").as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_shells_are_in_quotes_if_they_must() {
        for (word, shell) in [
            ("results/a-1.csv", "results/a-1.csv"),
            ("my results.csv", "'my results.csv'"),
            ("drive_voltage_pp=80 V", "'drive_voltage_pp=80 V'"),
            ("it's", "'it'\\''s'"),
            ("", "''"),
        ] {
            assert_eq!(shell_word(word), shell);
        }
    }
}
