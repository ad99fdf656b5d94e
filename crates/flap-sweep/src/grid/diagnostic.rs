//! Mistakes in a grid file: their places, their causes and their remedies.

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
    /// The file the mistake is in.
    pub source: Arc<Source>,
    /// The mistake, in one line.
    pub message: String,
    /// Bytes of the source at fault. May be empty where something is missing.
    pub span: Range<usize>,
    /// A few words to print at the span; may be empty.
    pub label: String,
    /// Other places that have to do with it.
    pub related: Vec<Related>,
    /// The values or forms that are allowed.
    pub notes: Vec<String>,
    /// Advice.
    pub help: Vec<String>,
    /// True if it is counted and not shown: then it needs no help.
    pub(crate) is_only_counted: bool,
}

/// A second place that a diagnostic is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Related {
    /// Bytes of the source.
    pub span: Range<usize>,
    /// A few words to print there.
    pub label: String,
}

impl Diagnostic {
    /// A diagnostic that has only a message, to be filled in with the methods below.
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

    /// Sets the words at the span.
    pub(crate) fn label(&mut self, label: impl Into<String>) -> &mut Diagnostic {
        self.label = shortened(&label.into()).into_owned();
        self
    }

    /// Adds a second place.
    pub(crate) fn related(&mut self, span: Range<usize>, label: impl Into<String>) -> &mut Diagnostic {
        self.related.push(Related { span, label: label.into() });
        self
    }

    /// Adds a line about the values or forms that are allowed.
    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Diagnostic {
        self.notes.push(shortened(&note.into()).into_owned());
        self
    }

    /// Adds a line of advice.
    pub(crate) fn help(&mut self, help: impl Into<String>) -> &mut Diagnostic {
        self.help.push(shortened(&help.into()).into_owned());
        self
    }

    /// Adds the nearest of `names` if `name` resembles one.
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

    /// Line of the start of the span, from 1.
    pub fn line(&self) -> usize {
        position(&self.source.text, self.span.start).0
    }

    /// Column of the start of the span in characters, from 1.
    pub fn column(&self) -> usize {
        position(&self.source.text, self.span.start).1
    }
}

/// `grid.toml:3:13: message`, on one line.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.source.name, self.line(), self.column(), self.message)
    }
}

impl std::error::Error for Diagnostic {}

/// The mistakes in a grid file: the first [`Mistakes::MOST_SHOWN`] in the order of the file, and the number of the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistakes {
    shown: Vec<Diagnostic>,
    more: usize,
}

impl Mistakes {
    /// The most mistakes that are shown. A file with more usually has one mistake many times.
    pub const MOST_SHOWN: usize = 20;

    /// The first ones of `found`, which is in the order of the file; `more` others were found, too.
    pub(crate) fn new(mut found: Vec<Diagnostic>, more: usize) -> Mistakes {
        let more = more + found.len().saturating_sub(Mistakes::MOST_SHOWN);
        found.truncate(Mistakes::MOST_SHOWN);
        Mistakes { shown: found, more }
    }

    /// Mistakes that are not shown.
    pub fn more(&self) -> usize {
        self.more
    }

    /// All mistakes, shown or not.
    pub fn count(&self) -> usize {
        self.shown.len() + self.more
    }
}

/// The mistakes that are shown.
impl Deref for Mistakes {
    type Target = [Diagnostic];

    fn deref(&self) -> &[Diagnostic] {
        &self.shown
    }
}

/// The text of the `mistakes` that are shown, with the lines of the grid file that they are about, and the number of the
/// others; with colours if `styled`.
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
