//! The branches of a response, and the jumps between them.

use super::colours::{DARK, SERIES};

/// A branch as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The name, in the column `branch` and in legends.
    pub name: &'static str,
    /// The colour in a picture of one design.
    pub colour: &'static str,
}

/// The branches, in the order of drawing.
pub const BRANCHES: [Branch; 3] = [
    Branch { name: "up", colour: SERIES[0] },
    Branch { name: "down", colour: SERIES[1] },
    Branch { name: "unstable", colour: DARK },
];

/// Branches that differ by less than this share of the measure's range have come to the same motion.
const SAME: f64 = 0.01;

/// A branch in the order in which it was followed.
#[derive(Clone, Copy, Debug)]
pub struct Way<'a> {
    /// Values of the parameter that is followed.
    pub x: &'a [f64],
    /// Values of the measure; NaN for none.
    pub y: &'a [f64],
}

/// The difference between the ways up and down.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// First and last value of each run of values where the ways have different motions.
    pub bands: Vec<(f64, f64)>,
    /// The rows of the way up after which it jumps to the motion of the other, and those of the way down: the ways differ
    /// there, and no more behind it.
    pub jumps: [Vec<usize>; 2],
}

/// Compares the ways up and down of a measure whose values differ by `range` in all.
pub fn compared(up: Way<'_>, down: Way<'_>, range: f64) -> Comparison {
    let common = common(up, down, SAME * range);
    let mut bands: Vec<(f64, f64)> = Vec::new();
    let mut is_within = false;
    for &(value, differs) in &common {
        match bands.last_mut() {
            Some(band) if differs && is_within => band.1 = value,
            _ if differs => bands.push((value, value)),
            _ => {}
        }
        is_within = differs;
    }
    let jumps = [up, down].map(|way| {
        let differs = |row: usize| {
            let place = common.binary_search_by(|(value, _)| value.total_cmp(&way.x[row]));
            place.is_ok_and(|place| common[place].1)
        };
        let is_jump =
            |&row: &usize| differs(row) && !differs(row + 1) && (way.y[row] + way.y[row + 1]).is_finite();
        (0..way.x.len().saturating_sub(1)).filter(is_jump).collect()
    });
    Comparison { bands, jumps }
}

/// The values that both ways have, rising, with true where the ways differ by more than `tolerance`.
fn common(up: Way<'_>, down: Way<'_>, tolerance: f64) -> Vec<(f64, bool)> {
    let sorted = |way: Way<'_>| {
        let mut rows: Vec<(f64, f64)> = way.x.iter().copied().zip(way.y.iter().copied()).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows.dedup_by(|later, first| later.0 == first.0);
        rows
    };
    let others = sorted(down);
    let pair = |(x, y): (f64, f64)| {
        let place = others.binary_search_by(|(other, _)| other.total_cmp(&x)).ok()?;
        Some((x, (y - others[place].1).abs() > tolerance))
    };
    sorted(up).into_iter().filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_jump_where_they_meet_again() {
        let x = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let back = [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0];
        let up = Way { x: &x, y: &[11.0, 12.0, 13.0, 14.0, 15.0, 2.0, 2.0] };
        let down = Way { x: &back, y: &[2.0, 2.0, 2.0, 2.0, 2.0, 12.0, 11.0] };
        let found = compared(up, down, 13.0);
        assert_eq!(found, Comparison { bands: vec![(3.0, 5.0)], jumps: [vec![4], vec![4]] });
        let same = compared(up, up, 13.0);
        assert_eq!(same, Comparison { bands: vec![], jumps: [vec![], vec![]] });
        let alone = compared(up, Way { x: &[], y: &[] }, 13.0);
        assert_eq!(alone, Comparison { bands: vec![], jumps: [vec![], vec![]] });
    }

    #[test]
    fn two_bands_have_two_jumps() {
        let x = [1.0, 2.0, 3.0, 4.0, 5.0];
        let up = Way { x: &x, y: &[1.0, 9.0, 3.0, 9.0, 5.0] };
        let down = Way { x: &x, y: &[1.0, 2.0, 3.0, 4.0, 5.0] };
        let found = compared(up, down, 8.0);
        assert_eq!(found.bands, [(2.0, 2.0), (4.0, 4.0)]);
        assert_eq!(found.jumps, [vec![1, 3], vec![1, 3]]);
    }

    /// Nothing is known of a jump beside a row without a motion.
    #[test]
    fn gaps_are_no_jumps() {
        let x = [1.0, 2.0, 3.0];
        let up = Way { x: &x, y: &[1.0, 9.0, f64::NAN] };
        let down = Way { x: &x, y: &[1.0, 2.0, 3.0] };
        let found = compared(up, down, 8.0);
        assert_eq!((found.bands, found.jumps), (vec![(2.0, 2.0)], [vec![], vec![1]]));
    }
}
