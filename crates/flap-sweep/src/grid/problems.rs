//! The mistakes found so far, and mistakes of TOML syntax.

use std::collections::HashSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::diagnostic::{Diagnostic, Mistakes};
use crate::plan::Source;

/// Largest number of stored diagnostics. Further diagnostics are counted, so that a file with millions of mistakes
/// takes little time and memory.
const MOST_KEPT: usize = 1000;

/// Collector of diagnostics about one file.
pub(super) struct Problems {
    source: Arc<Source>,
    found: Vec<Diagnostic>,
    /// Latest diagnostic that was counted but not stored.
    last: Option<Diagnostic>,
    only_counted: usize,
}

impl Problems {
    pub(super) fn new(source: Arc<Source>) -> Problems {
        Problems { source, found: Vec::new(), last: None, only_counted: 0 }
    }

    /// Returns the text of the file.
    pub(super) fn text(&self) -> &str {
        &self.source.text
    }

    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Returns the number of mistakes.
    pub(super) fn count(&self) -> usize {
        self.found.len() + self.only_counted
    }

    /// Adds the mistakes of another file.
    pub(super) fn absorb(&mut self, other: Problems) {
        self.only_counted += other.only_counted;
        for diagnostic in other.found {
            self.add(diagnostic);
        }
    }

    /// Adds a diagnostic, and returns it for labels, notes and help.
    pub(super) fn report(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.add(Diagnostic::new(Arc::clone(&self.source), span, &message.into()))
    }

    /// Adds a diagnostic about another file, and returns it.
    pub(super) fn report_in(
        &mut self,
        source: &Arc<Source>,
        span: Range<usize>,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Diagnostic::new(Arc::clone(source), span, &message.into()))
    }

    /// Returns the last mistake, for more help.
    pub(super) fn newest(&mut self) -> Option<&mut Diagnostic> {
        self.last.as_mut().or(self.found.last_mut())
    }

    fn add(&mut self, diagnostic: Diagnostic) -> &mut Diagnostic {
        if self.found.len() == MOST_KEPT {
            self.only_counted += 1;
            return self.last.insert(Diagnostic { is_only_counted: true, ..diagnostic });
        }
        let place = self.found.len();
        self.found.push(diagnostic);
        &mut self.found[place]
    }

    /// Returns the path of a file that the grid file names, relative to the folder of the grid file.
    pub(super) fn beside(&self, path: &str) -> PathBuf {
        Path::new(&self.source.name).parent().unwrap_or(Path::new("")).join(path)
    }

    /// Returns all diagnostics: first about the file, in the order of the file, then about other files.
    pub(super) fn into_mistakes(mut self) -> Mistakes {
        let source = Arc::clone(&self.source);
        self.found
            .sort_by_key(|diagnostic| (!Arc::ptr_eq(&diagnostic.source, &source), diagnostic.span.start));
        Mistakes::new(self.found, self.only_counted)
    }
}

/// Reports the errors of the TOML parser, at most one per line, because one mistake often causes several errors.
pub(super) fn report_syntax(errors: &[toml::de::Error], problems: &mut Problems) {
    let newlines: Vec<usize> = problems.text().match_indices('\n').map(|(newline, _)| newline).collect();
    let mut lines = HashSet::new();
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        let line = newlines.partition_point(|newline| *newline < span.start);
        if !lines.insert(line) {
            continue;
        }
        let text = problems.text().get(span.clone()).unwrap_or_default().to_owned();
        let (message, help) = explain(error.message(), &text);
        let diagnostic = problems.report(span, message);
        if let Some(help) = help {
            diagnostic.help(help);
        }
    }
}

/// Returns a clearer form of the parser's message about `text`, and advice.
///
/// Messages without a clearer form are returned unchanged.
fn explain(message: &str, text: &str) -> (String, Option<String>) {
    let said = |begins: &str| message.starts_with(begins);
    if message == "duplicate key" {
        (format!("`{text}` is defined twice"), Some("keep one of them".into()))
    } else if said("string values must be quoted") && text.is_empty() {
        ("a value is missing".into(), Some("write a number, text in quotes, a list or a range".into()))
    } else if said("string values must be quoted") {
        (format!("`{text}` needs quotes"), Some(format!("write \"{}\"", text.escape_default())))
    } else if said("invalid basic string, expected `\"`") || said("invalid literal string, expected `'`") {
        ("a closing quote is missing".into(), Some("end text with the quote it begins with".into()))
    } else if said("missing comma between array elements") {
        let help = "put commas between the values of a list, and ] after the last";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else if said("unexpected key or value") {
        let help = "start each key on a new line; numbers have a decimal point, not a comma";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else {
        (format!("not valid TOML: {message}"), None)
    }
}
