//! Failures of `flap top` and `flap describe` if no row can be used.

use crate::args::LookArgs;
use crate::data::filter::Filters;
use crate::failure::Failure;

impl LookArgs {
    /// Returns the failure for a file without rows, or for a file in which no row satisfies the conditions of
    /// `--where`.
    pub(super) fn no_rows(&self, filters: &Filters) -> Failure {
        let file = self.results.display();
        if self.filters.is_empty() {
            return Failure::usage(format!("{file} has no rows"));
        }
        Failure::usage(format!("no row of {file} satisfies --where"))
            .helps(filters.advice())
            .help("`flap describe` shows the range of each column")
    }

    /// Returns the failure for a file in which no selected row has a value in the column `name`.
    pub(super) fn without(&self, name: &str) -> Failure {
        let file = self.results.display();
        if self.all {
            return Failure::usage(format!("no row of {file} has a value of {name}"));
        }
        let rows =
            if self.filters.is_empty() { "periodic row" } else { "periodic row that satisfies --where" };
        Failure::usage(format!("no {rows} of {file} has a value of {name}"))
            .help("--all uses rows of every status")
    }
}
