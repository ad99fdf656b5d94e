//! One mistake in a grid file.
//!
//! A diagnostic carries the text that it is about, so that a function that shows it needs nothing else.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::notation::nearest;
use crate::notation::position::position;
use crate::notation::text::shortened;
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
