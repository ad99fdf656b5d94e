//! The mistakes found so far.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::grid::diagnostic::{Diagnostic, Mistakes};
use crate::plan::Source;

/// Diagnostics that are kept. Others are only counted, so that a file with millions of mistakes takes neither time nor memory
/// for mistakes that are not shown.
const MOST_KEPT: usize = 1000;

/// Collects diagnostics about one file.
pub(super) struct Problems {
    source: Arc<Source>,
    found: Vec<Diagnostic>,
    /// The last of those that are only counted.
    last: Option<Diagnostic>,
    only_counted: usize,
}

impl Problems {
    pub(super) fn new(source: Arc<Source>) -> Problems {
        Problems { source, found: Vec::new(), last: None, only_counted: 0 }
    }

    /// The text of the file.
    pub(super) fn text(&self) -> &str {
        &self.source.text
    }

    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Number of mistakes.
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

    /// Adds a diagnostic, and hands it back for labels, notes and help.
    pub(super) fn report(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.add(Diagnostic::new(Arc::clone(&self.source), span, &message.into()))
    }

    /// Adds a diagnostic about another file.
    pub(super) fn report_in(
        &mut self,
        source: &Arc<Source>,
        span: Range<usize>,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Diagnostic::new(Arc::clone(source), span, &message.into()))
    }

    /// The mistake that was reported last, for more help.
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

    /// The path of a file that the grid file names: relative to the folder of the grid file.
    pub(super) fn beside(&self, path: &str) -> PathBuf {
        Path::new(&self.source.name).parent().unwrap_or(Path::new("")).join(path)
    }

    /// All diagnostics, in the order of the file, then those about other files.
    pub(super) fn into_mistakes(mut self) -> Mistakes {
        let source = Arc::clone(&self.source);
        self.found
            .sort_by_key(|diagnostic| (!Arc::ptr_eq(&diagnostic.source, &source), diagnostic.span.start));
        Mistakes::new(self.found, self.only_counted)
    }
}
