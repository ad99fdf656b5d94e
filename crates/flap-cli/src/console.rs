//! The two streams: results go to stdout, everything else to stderr.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

/// Writes results to stdout.
pub(crate) fn results(text: &str) -> io::Result<()> {
    let mut stdout = anstream::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// Warns the user of a damage or of a probable mistake. The work goes on.
pub(crate) fn warn(text: &str) {
    let style = Style::new().bold().fg_color(Some(AnsiColor::BrightYellow.into()));
    say(&format!("{style}warning{style:#}: {text}"));
}

/// Prints a line to stderr. If stderr is closed, the line is lost.
pub(crate) fn say(text: &str) {
    let _ = writeln!(anstream::stderr(), "{text}");
}
