//! The two streams: results go to stdout, everything else to stderr.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

/// Writes results to stdout.
pub(crate) fn results(text: &str) -> io::Result<()> {
    let mut stdout = anstream::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// Tells the user what is not as it should be or may not have been meant, and does not stop the work.
pub(crate) fn warn(text: &str) {
    let style = Style::new().bold().fg_color(Some(AnsiColor::BrightYellow.into()));
    say(&format!("{style}warning{style:#}: {text}"));
}

/// Tells the user something. Nobody is left to tell if stderr is closed.
pub(crate) fn say(text: &str) {
    let _ = writeln!(anstream::stderr(), "{text}");
}
