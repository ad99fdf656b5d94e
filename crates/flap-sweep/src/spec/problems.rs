//! The mistakes found so far.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::plan::Source;

/// Collects diagnostics about one file.
pub(super) struct Problems {
    source: Arc<Source>,
    found: Vec<Diagnostic>,
}

impl Problems {
    pub(super) fn new(source: Arc<Source>) -> Problems {
        Problems { source, found: Vec::new() }
    }

    /// The text of the file.
    pub(super) fn text(&self) -> &str {
        &self.source.text
    }

    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Adds a diagnostic, and hands it back for labels, notes and help.
    pub(super) fn report(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = Diagnostic::new(Arc::clone(&self.source), span, message.into());
        self.found.push(diagnostic);
        self.found.last_mut().expect("one was just added")
    }

    /// Adds a diagnostic about another file.
    pub(super) fn report_in(
        &mut self,
        source: &Arc<Source>,
        span: Range<usize>,
        message: String,
    ) -> &mut Diagnostic {
        self.found.push(Diagnostic::new(Arc::clone(source), span, message));
        self.found.last_mut().expect("one was just added")
    }

    /// The path of a file that the grid file names: relative to the folder of the grid file.
    pub(super) fn beside(&self, path: &str) -> PathBuf {
        Path::new(&self.source.name).parent().unwrap_or(Path::new("")).join(path)
    }

    /// Everything reported, in the order of the file, then what is about other files.
    pub(super) fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        let source = Arc::clone(&self.source);
        self.found
            .sort_by_key(|diagnostic| (!Arc::ptr_eq(&diagnostic.source, &source), diagnostic.span.start));
        self.found
    }
}
