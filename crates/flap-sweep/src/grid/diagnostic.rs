//! What is wrong in a grid file, where, and what to do about it.
//!
//! A diagnostic carries the text it is about, so that whoever shows it needs nothing else.

mod mistakes;
mod render;

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

pub use mistakes::Mistakes;
pub use render::render;

use crate::notation::nearest;
use crate::notation::text::shortened;
use crate::plan::Source;

/// One mistake in a grid file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The file the mistake is in.
    pub source: Arc<Source>,
    /// What is wrong, in one line.
    pub message: String,
    /// Bytes of the source at fault. May be empty where something is missing.
    pub span: Range<usize>,
    /// A few words to print at the span; may be empty.
    pub label: String,
    /// Other places that have to do with it.
    pub related: Vec<Related>,
    /// What is allowed.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Vec<String>,
    /// Whether it is counted, and not shown: then it needs no help.
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

    /// Adds a line on what is allowed.
    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Diagnostic {
        self.notes.push(shortened(&note.into()).into_owned());
        self
    }

    /// Adds a line on what to do.
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

/// Line and column of a byte of `text`, both from 1; columns count characters.
pub(crate) fn position(text: &str, byte: usize) -> (usize, usize) {
    let mut end = byte.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.matches('\n').count();
    // Editors do not show the byte order mark.
    let column = 1 + before[line_start..].chars().filter(|c| *c != '\u{feff}').count();
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_not_bytes() {
        let text = "a = 1\n\"µ\" = 2\n";
        assert_eq!(position(text, 0), (1, 1));
        assert_eq!(position(text, 4), (1, 5));
        assert_eq!(position(text, 6), (2, 1));
        assert_eq!(position(text, 11), (2, 5));
        assert_eq!(position(text, text.len()), (3, 1));
        assert_eq!(position("\u{feff}a", 3), (1, 1));
    }
}
