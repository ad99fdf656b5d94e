//! The damage of a result file, in words.

use std::fmt;
use std::ops::RangeInclusive;

use crate::files::results::{BLOCK_ROWS, Checksums, TextDigest};
use crate::notation::text::count;

/// The treatment of damage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnDamage {
    /// Damaged results are not read.
    Refuse,
    /// Rows that can be read are read, and a [`Note`](super::Note) tells of the damage.
    Tolerate,
}

/// Most ranges that a message lists; it counts the others.
const MOST_LISTED: usize = 5;

/// The differences of a file from the one that was written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "any of them may hold, and each has a sentence of its own")]
pub struct Damage {
    /// The checksums themselves cannot be read.
    pub checksums: bool,
    /// The header has changed.
    pub header: bool,
    /// Ranges of rows, counted from 1, in blocks that have changed: at least one row in each, and all rows behind a missing or
    /// an added one.
    pub rows: Vec<RangeInclusive<u64>>,
    /// Number of rows in the file and number of rows that were written, if they differ.
    pub count: Option<(u64, u64)>,
    /// Reason why the rest of the file cannot be read.
    pub unreadable: Option<String>,
    /// Bytes have changed, perhaps only some that rows do not depend on.
    pub bytes: bool,
    /// Unfinished rows are not those that the journal records.
    pub altered: bool,
    /// Number of rows that the journal records and the file lacks.
    pub lost: u64,
    /// Differences between the rows that the sidecar describes and those that the journal records, in words.
    pub foreign_sidecar: Vec<String>,
}

impl Damage {
    /// The damage of the text that was found, compared with the `checksums` of the `rows` that were written.
    pub(super) fn of_text(found: &TextDigest, checksums: &Checksums, rows: Option<u64>) -> Damage {
        let mut damage = Damage::default();
        if found.text() == checksums.text {
            return damage;
        }
        let Some(written) = checksums.parts().filter(|_| checksums.block_rows == BLOCK_ROWS) else {
            return Damage { checksums: true, ..damage };
        };
        let found_parts = found.parts();
        damage.header = found_parts.first() != written.first();
        let last = rows.unwrap_or(0).max(found.rows());
        let blocks = written.len().max(found_parts.len());
        for block in (1..blocks).filter(|&block| found_parts.get(block) != written.get(block)) {
            let begin = (block as u64 - 1) * u64::from(BLOCK_ROWS) + 1;
            let end = last.min(begin + u64::from(BLOCK_ROWS) - 1).max(begin);
            match damage.rows.last_mut() {
                Some(range) if range.end() + 1 == begin => *range = *range.start()..=end,
                _ => damage.rows.push(begin..=end),
            }
        }
        damage.count = rows.filter(|&rows| rows != found.rows()).map(|rows| (found.rows(), rows));
        damage
    }

    /// True if there is no damage.
    pub fn is_none(&self) -> bool {
        *self == Damage::default()
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut told = Vec::new();
        if self.checksums {
            told.push("its checksums cannot be read".to_owned());
        }
        if self.header {
            told.push("its header has changed".to_owned());
        }
        if !self.rows.is_empty() {
            told.push(format!("rows {} have changed since they were written", listed(&self.rows)));
        }
        if let Some((found, written)) = self.count {
            told.push(format!("it holds {found} rows, but {written} were written"));
        }
        if let Some(reason) = &self.unreadable {
            told.push(format!("the rest cannot be read ({reason})"));
        }
        if self.altered {
            told.push("it has changed since the sweep wrote it".to_owned());
        }
        if self.lost > 0 {
            told.push(format!("it lacks {} that its journal records", count(self.lost, "row")));
        }
        if !self.foreign_sidecar.is_empty() {
            told.push(format!("its sidecar is of another sweep: {}", self.foreign_sidecar.join("; ")));
        }
        if self.bytes && told.is_empty() {
            told.push("its rows are unchanged, but other bytes of the file have changed".to_owned());
        }
        f.write_str(&told.join("; "))
    }
}

fn listed(ranges: &[RangeInclusive<u64>]) -> String {
    let range = |range: &RangeInclusive<u64>| format!("{} to {}", range.start(), range.end());
    let shown: Vec<String> = ranges.iter().take(MOST_LISTED).map(range).collect();
    let more = match ranges.len().saturating_sub(MOST_LISTED) {
        0 => String::new(),
        more => format!(" and {more} more ranges"),
    };
    shown.join(", ") + &more
}
