//! Positions, causes and remedies of mistakes in a grid file.

use std::fmt;
use std::ops::{Deref, Range};
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
    /// Position of the bytes with the mistake in the source. The range is empty if the mistake is missing text.
    pub span: Range<usize>,
    /// A few words that are shown at the mistake. The text may be empty.
    pub label: String,
    /// Related positions.
    pub related: Vec<Related>,
    /// Allowed values or forms.
    pub notes: Vec<String>,
    /// Advice.
    pub help: Vec<String>,
    /// True if the mistake is counted but not shown. A hidden mistake needs no help.
    pub(crate) is_only_counted: bool,
}

/// A second position in the file to which a diagnostic refers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Related {
    /// Bytes of the source.
    pub span: Range<usize>,
    /// A few words that are shown at this position of the file.
    pub label: String,
}

impl Diagnostic {
    /// Returns a diagnostic with a message only. Use the methods below to complete it.
    pub(crate) fn new(source: Arc<Source>, span: Range<usize>, message: &str) -> Diagnostic {
        Diagnostic {
            source,
            message: shortened(message).into_owned(),
            span,
            label: String::new(),
            related: Vec::new(),
            notes: Vec::new(),
            help: Vec::new(),
            is_only_counted: false,
        }
    }

    /// Sets the words that are shown at the mistake.
    pub(crate) fn label(&mut self, label: impl Into<String>) -> &mut Diagnostic {
        self.label = shortened(&label.into()).into_owned();
        self
    }

    /// Adds a second position.
    pub(crate) fn related(&mut self, span: Range<usize>, label: impl Into<String>) -> &mut Diagnostic {
        self.related.push(Related { span, label: label.into() });
        self
    }

    /// Adds a line about allowed values or forms.
    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Diagnostic {
        self.notes.push(shortened(&note.into()).into_owned());
        self
    }

    /// Adds a line of advice.
    pub(crate) fn help(&mut self, help: impl Into<String>) -> &mut Diagnostic {
        self.help.push(shortened(&help.into()).into_owned());
        self
    }

    /// Adds the nearest of `names` if `name` resembles it.
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

    /// Returns the line of the span's start, from 1.
    pub fn line(&self) -> usize {
        position(&self.source.text, self.span.start).0
    }

    /// Returns the column of the span's start in characters, from 1.
    pub fn column(&self) -> usize {
        position(&self.source.text, self.span.start).1
    }
}

/// Prints the mistake on one line: `grid.toml:3:13: message`.
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
    /// Largest number of mistakes that are shown. A file with more mistakes usually repeats one mistake.
    pub const MOST_SHOWN: usize = 20;

    /// Returns the first mistakes of `found`, which has the order of the file, and the number `more` of further
    /// mistakes.
    pub(crate) fn new(mut found: Vec<Diagnostic>, more: usize) -> Mistakes {
        let more = more + found.len().saturating_sub(Mistakes::MOST_SHOWN);
        found.truncate(Mistakes::MOST_SHOWN);
        Mistakes { shown: found, more }
    }

    /// Returns the number of mistakes that are not shown.
    pub fn more(&self) -> usize {
        self.more
    }

    /// Returns the number of all mistakes.
    pub fn count(&self) -> usize {
        self.shown.len() + self.more
    }
}

/// The shown mistakes.
impl Deref for Mistakes {
    type Target = [Diagnostic];

    fn deref(&self) -> &[Diagnostic] {
        &self.shown
    }
}

/// Returns the text of the shown `mistakes` with their lines of the grid file, and the number of further mistakes.
///
/// The text has colours if `styled` is true.
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
