//! All mistakes in a grid file: the first ones, and how many others there are.

use std::ops::Deref;

use super::mistake::Diagnostic;

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
