//! Selection of the points that flap computes: all points of a plan, every n-th point, or a list of points.

use std::fmt;
use std::str::FromStr;

use xxhash_rust::xxh3::Xxh3Default;

/// Selection of the points that flap computes for a plan. Rows contain the indices that the points have in
/// the whole plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// All points.
    #[default]
    All,
    /// The points of one shard. Each shard is computed on one machine.
    Shard(Shard),
    /// Points whose indices are in a list, in ascending order.
    Listed(Vec<u64>),
}

impl Selection {
    /// Returns the number of selected points, for a plan of `points` points.
    pub fn len(&self, points: u64) -> u64 {
        match self {
            Selection::All => points,
            Selection::Shard(shard) => (points + shard.of - shard.number) / shard.of,
            Selection::Listed(list) => list.len() as u64,
        }
    }

    /// Returns the index that the selected point number `position` has in the plan. `position` must be less
    /// than [`Selection::len`].
    pub fn index(&self, position: u64) -> u64 {
        match self {
            Selection::All => position,
            Selection::Shard(shard) => shard.number - 1 + position * shard.of,
            Selection::Listed(list) => usize::try_from(position).map_or(u64::MAX, |position| list[position]),
        }
    }

    /// Returns the position of point number `index` among the selected points. The point must be selected.
    pub fn position(&self, index: u64) -> u64 {
        match self {
            Selection::All => index,
            Selection::Shard(shard) => (index + 1 - shard.number) / shard.of,
            Selection::Listed(list) => list.partition_point(|listed| *listed < index) as u64,
        }
    }
}

/// Prints `all points`, `shard 2/3`, or the number of listed points with a hash of the list.
impl fmt::Display for Selection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Selection::All => f.write_str("all points"),
            Selection::Shard(shard) => write!(f, "shard {shard}"),
            Selection::Listed(list) => {
                let mut hash = Xxh3Default::new();
                for index in list {
                    hash.update(&index.to_le_bytes());
                }
                write!(f, "{} listed points ({:016x})", list.len(), hash.digest())
            }
        }
    }
}

/// One of several equal parts of a plan: the points whose index modulo `of` equals `number - 1`.
///
/// Neighbouring points of a plan take similar time, so all shards of the plan take similar time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    of: u64,
}

impl Shard {
    /// Largest number of shards of a plan.
    pub const MOST: u64 = 1_000_000;

    /// Returns the number of this shard, counted from 1.
    pub fn number(self) -> u64 {
        self.number
    }

    /// Returns the number of shards of the plan.
    pub fn of(self) -> u64 {
        self.of
    }

    /// Returns true if the shard contains point number `index`.
    pub fn contains(self, index: u64) -> bool {
        index % self.of == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    /// Parses text such as `2/3`, which means the second of three shards.
    fn from_str(text: &str) -> Result<Shard, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| number.parse().ok().zip(of.parse().ok()));
        match numbers {
            Some((number, of)) if 1 <= number && number <= of && of <= Shard::MOST => {
                Ok(Shard { number, of })
            }
            _ => Err(format!("expected I/N with I from 1 to N and N up to {}, such as 2/8", Shard::MOST)),
        }
    }
}

/// Converts an ascending list of indices to text, with ranges for consecutive indices, such as `3,17,20-31`.
pub fn list_text(list: &[u64]) -> String {
    let runs = list.chunk_by(|a, b| a + 1 == *b);
    let run = |run: &[u64]| match run {
        [first, .., last] => format!("{first}-{last}"),
        _ => run.iter().map(u64::to_string).collect(),
    };
    runs.map(run).collect::<Vec<_>>().join(",")
}

/// Largest number of points in a list of points. The number is limited because the list is stored in memory.
pub const MOST_LISTED: u64 = 10_000_000;

/// Converts text in the form of [`list_text`] to a list of indices. Returns `None` if the text does not have
/// the form of [`list_text`], or if an index is not below `points`. Also returns `None` if there are more
/// than [`MOST_LISTED`] indices.
pub fn read_list(text: &str, points: u64) -> Option<Vec<u64>> {
    let mut list: Vec<u64> = Vec::new();
    for run in text.split(',').filter(|run| !run.is_empty()) {
        let (first, last) = run.split_once('-').unwrap_or((run, run));
        let (first, last): (u64, u64) = (first.parse().ok()?, last.parse().ok()?);
        if first > last || last >= points || list.last().is_some_and(|&before| before >= first) {
            return None;
        }
        if last - first >= MOST_LISTED - list.len() as u64 {
            return None;
        }
        list.extend(first..=last);
    }
    Some(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_points_out() {
        for points in [0, 1, 2, 3, 7, 100] {
            for of in [1, 2, 3, 8] {
                let mut seen: Vec<u64> = Vec::new();
                for number in 1..=of {
                    let shard: Shard = format!("{number}/{of}").parse().unwrap();
                    let selection = Selection::Shard(shard);
                    let length = selection.len(points);
                    assert!(
                        (0..length).all(|position| selection.position(selection.index(position)) == position)
                    );
                    let indices = (0..length).map(|position| selection.index(position));
                    seen.extend(indices.inspect(|&index| assert!(shard.contains(index))));
                }
                seen.sort_unstable();
                assert!(seen.into_iter().eq(0..points), "{points} points in {of} shards");
            }
        }
    }

    #[test]
    fn listed_points_have_their_positions() {
        let selection = Selection::Listed(vec![2, 5, 9]);
        assert!((0..3).all(|position| selection.position(selection.index(position)) == position));
        assert_eq!(Selection::All.position(7), 7);
    }

    #[test]
    fn what_is_no_shard_is_refused() {
        for text in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3", "1/1000001"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
        assert_eq!("2/3".parse::<Shard>().unwrap().to_string(), "2/3");
    }

    #[test]
    fn lists_read_back() {
        for list in [&[][..], &[5], &[0, 1, 2], &[3, 17, 20, 21, 22, 31], &[1, 2, 4, 5]] {
            assert_eq!(read_list(&list_text(list), 100).as_deref(), Some(list));
        }
        assert_eq!(list_text(&[3, 17, 20, 21, 22]), "3,17,20-22");
        for text in ["x", "3-1", "5,4", "5,5", "1-", "100", "0-99999999999999999999"] {
            assert_eq!(read_list(text, 100), None, "{text}");
        }
        assert_eq!(read_list("0-10000000", u64::MAX), None, "too many");
    }
}
