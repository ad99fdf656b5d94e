//! The two streams: results go to stdout, everything else to stderr.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

/// Writes results to stdout.
pub(crate) fn results(text: &str) -> io::Result<()> {
    let mut stdout = anstream::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// Tells the user something. Nobody is left to tell if stderr is closed.
pub(crate) fn say(text: &str) {
    let _ = writeln!(anstream::stderr(), "{text}");
}

/// Warns the user of what may not have been meant.
pub(crate) fn warn(text: &str) {
    let style = Style::new().bold().fg_color(Some(AnsiColor::Yellow.into()));
    say(&format!("{style}warning{style:#}: {text}"));
}
