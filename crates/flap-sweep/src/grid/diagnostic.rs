//! Mistakes in a grid file, with positions, causes and remedies, and the list of all mistakes found so far.

use std::collections::HashSet;
use std::fmt;
use std::ops::{Deref, Range};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Element, Group, Level, Renderer, Snippet};

use crate::notation::nearest;
use crate::notation::text::{position, shortened};
use crate::plan::Source;

/// One mistake in a grid file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// File with the mistake.
    pub source: Arc<Source>,
    /// Description of the mistake in one line.
    pub message: String,
    /// Range of the bytes in the source file that contain the mistake. If text is missing at this position,
    /// the range is empty.
    pub span: Range<usize>,
    /// A few words that are shown below the wrong part of the file, or an empty text.
    pub label: String,
    /// Further positions in the file that help to explain the mistake.
    pub related: Vec<Related>,
    /// Lines of the message that describe the allowed values or forms.
    pub notes: Vec<String>,
    /// Lines of the message that advise how to correct the mistake.
    pub help: Vec<String>,
    /// True if the mistake is counted but not shown. A mistake that is not shown needs no help text.
    pub(crate) is_only_counted: bool,
}

/// A further position in the file that helps to explain a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Related {
    /// Range of the bytes in the source file.
    pub span: Range<usize>,
    /// A few words that are shown at this position of the file.
    pub label: String,
}

impl Diagnostic {
    /// Sets the words that are shown below the wrong part of the file.
    pub(crate) fn label(&mut self, label: impl Into<String>) -> &mut Diagnostic {
        self.label = shortened(&label.into()).into_owned();
        self
    }

    /// Adds a further position in the file that helps to explain the mistake.
    pub(crate) fn related(&mut self, span: Range<usize>, label: impl Into<String>) -> &mut Diagnostic {
        self.related.push(Related { span, label: label.into() });
        self
    }

    /// Adds a line about the allowed values or forms to the message.
    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Diagnostic {
        self.notes.push(shortened(&note.into()).into_owned());
        self
    }

    /// Adds a line of advice to the message.
    pub(crate) fn help(&mut self, help: impl Into<String>) -> &mut Diagnostic {
        self.help.push(shortened(&help.into()).into_owned());
        self
    }

    /// If `name` resembles one of `names`, adds the most similar name as advice.
    pub(crate) fn did_you_mean<'n>(
        &mut self,
        name: &str,
        names: impl IntoIterator<Item = &'n str>,
    ) -> &mut Diagnostic {
        if !self.is_only_counted
            && let Some(nearest) = nearest(name, names)
        {
            self.help.push(format!("did you mean `{nearest}`?"));
        }
        self
    }

    /// Returns the number of the line in which the mistake begins. The first line has the number 1.
    pub fn line(&self) -> usize {
        position(&self.source.text, self.span.start).0
    }

    /// Returns the column in which the mistake begins, in characters. The first column has the number 1.
    pub fn column(&self) -> usize {
        position(&self.source.text, self.span.start).1
    }
}

/// Prints the mistake on one line, as in `grid.toml:3:13: message`.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.source.name, self.line(), self.column(), self.message)
    }
}

impl std::error::Error for Diagnostic {}

/// The mistakes in a grid file: the first [`Mistakes::MOST_SHOWN`] in the order of the file, and the number of
/// further mistakes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistakes {
    shown: Vec<Diagnostic>,
    more: usize,
}

impl Mistakes {
    /// Largest number of mistakes that are shown. A file with more mistakes than this number usually repeats
    /// the same mistake.
    pub const MOST_SHOWN: usize = 20;

    /// Returns the number of mistakes that are not shown.
    pub fn more(&self) -> usize {
        self.more
    }

    /// Returns the number of all mistakes.
    pub fn count(&self) -> usize {
        self.shown.len() + self.more
    }
}

/// Dereferences to the list of the shown mistakes.
impl Deref for Mistakes {
    type Target = [Diagnostic];

    fn deref(&self) -> &[Diagnostic] {
        &self.shown
    }
}

/// Returns a message with the shown `mistakes`, the lines of the grid file around them, and the number of
/// further mistakes.
///
/// If `styled` is true, the message contains codes for the colours of the terminal.
pub fn render(mistakes: &Mistakes, styled: bool) -> String {
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    let text: String =
        mistakes.iter().map(|diagnostic| renderer.render(&[group(diagnostic)]) + "\n\n").collect();
    let name = mistakes.first().map_or("", |diagnostic| diagnostic.source.name.as_str());
    let more = if mistakes.more() > 0 { format!("and {} more\n\n", mistakes.more()) } else { String::new() };
    let count = match mistakes.count() {
        1 => "1 mistake".to_owned(),
        many => format!("{many} mistakes"),
    };
    format!("{text}{more}{name}: {count}, nothing was run")
}

fn group(diagnostic: &Diagnostic) -> Group<'_> {
    let label = Some(diagnostic.label.as_str()).filter(|label| !label.is_empty());
    let primary = AnnotationKind::Primary.span(diagnostic.span.clone()).label(label);
    let related = diagnostic
        .related
        .iter()
        .map(|related| AnnotationKind::Context.span(related.span.clone()).label(related.label.as_str()));
    let snippet = Snippet::source(diagnostic.source.text.as_str())
        .path(diagnostic.source.name.as_str())
        .annotation(primary)
        .annotations(related);
    let notes = diagnostic.notes.iter().map(|note| Element::from(Level::NOTE.message(note.as_str())));
    let help = diagnostic.help.iter().map(|help| Element::from(Level::HELP.message(help.as_str())));
    Level::ERROR.primary_title(diagnostic.message.as_str()).element(snippet).elements(notes.chain(help))
}

/// Largest number of stored diagnostics. Further diagnostics are only counted, so that a file with millions
/// of mistakes takes little time and memory.
const MOST_KEPT: usize = 1000;

/// Collects the diagnostics about one file.
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

    /// Adds the mistakes that were found in a file that this file names.
    pub(super) fn absorb(&mut self, other: Problems) {
        self.only_counted += other.only_counted;
        for diagnostic in other.found {
            self.add(diagnostic);
        }
    }

    /// Adds a diagnostic and returns a reference to it, so that the caller can add labels, notes and help.
    pub(super) fn report(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        let source = Arc::clone(&self.source);
        self.report_in(&source, span, message)
    }

    /// Adds a diagnostic about the file `source`, and returns a reference to the diagnostic.
    pub(super) fn report_in(
        &mut self,
        source: &Arc<Source>,
        span: Range<usize>,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Diagnostic {
            source: Arc::clone(source),
            message: shortened(&message.into()).into_owned(),
            span,
            label: String::new(),
            related: Vec::new(),
            notes: Vec::new(),
            help: Vec::new(),
            is_only_counted: false,
        })
    }

    /// Returns the mistake that was added last, so that the caller can add help to this mistake.
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

    /// Sorts the diagnostics: first the diagnostics about this file, in the order of the file, then the
    /// diagnostics about other files. Keeps the first [`Mistakes::MOST_SHOWN`] diagnostics, and counts the
    /// remaining diagnostics.
    pub(super) fn into_mistakes(mut self) -> Mistakes {
        let source = Arc::clone(&self.source);
        self.found
            .sort_by_key(|diagnostic| (!Arc::ptr_eq(&diagnostic.source, &source), diagnostic.span.start));
        let more = self.only_counted + self.found.len().saturating_sub(Mistakes::MOST_SHOWN);
        self.found.truncate(Mistakes::MOST_SHOWN);
        Mistakes { shown: self.found, more }
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

/// Returns a clearer form of a message of the TOML parser about `text`, and advice if there is any.
///
/// If a message has no clearer form, the function adds the words "not valid TOML" before the message.
fn explain(message: &str, text: &str) -> (String, Option<String>) {
    let begins = |text: &str| message.starts_with(text);
    if message == "duplicate key" {
        (format!("`{text}` is defined twice"), Some("keep one of them".into()))
    } else if begins("string values must be quoted") && text.is_empty() {
        ("a value is missing".into(), Some("write a number, text in quotes, a list or a range".into()))
    } else if begins("string values must be quoted") {
        (format!("`{text}` needs quotes"), Some(format!("write \"{}\"", text.escape_default())))
    } else if begins("invalid basic string, expected `\"`") || begins("invalid literal string, expected `'`")
    {
        ("a closing quote is missing".into(), Some("end text with the quote it begins with".into()))
    } else if begins("missing comma between array elements") {
        let help = "put commas between the values of a list, and ] after the last";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else if begins("unexpected key or value") {
        let help = "start each key on a new line; numbers have a decimal point, not a comma";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else {
        (format!("not valid TOML: {message}"), None)
    }
}
