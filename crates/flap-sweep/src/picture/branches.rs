//! Branches of a response, and the jumps between the branches.

use super::colours::{DARK, SERIES};

/// Name and colour of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Name of the branch in the column `branch` and in legends.
    pub name: &'static str,
    /// Colour of the branch in a picture of one design.
    pub colour: &'static str,
}

/// All branches, in the order in which pictures draw the branches.
pub const BRANCHES: [Branch; 3] = [
    Branch { name: "up", colour: SERIES[0] },
    Branch { name: "down", colour: SERIES[1] },
    Branch { name: "unstable", colour: DARK },
];

/// Rows of a branch in the order in which they were computed.
#[derive(Clone, Copy, Debug)]
pub struct Way<'a> {
    /// Values of the parameter that varies along the branch.
    pub x: &'a [f64],
    /// Values of the measure; NaN if missing.
    pub y: &'a [f64],
    /// Values of the column `bistable`. A value is true if the motions of the branches `up` and `down`
    /// differ at this value of the parameter.
    pub bistable: &'a [bool],
}

/// Differences between the branches `up` and `down`: bistable bands, and jumps from the motion of one branch
/// to the motion of the other branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Bistable bands: the first and the last parameter value of each interval in which the branches differ.
    pub bands: Vec<(f64, f64)>,
    /// For the branch `up`, then for the branch `down`: indices of the rows after which the branch jumps to
    /// the motion of the other branch.
    ///
    /// In the row before a jump, the motions of the two branches differ. In the row after the jump, the
    /// motions are equal.
    pub jumps: [Vec<usize>; 2],
}

/// Returns the bistable bands and the jumps of the branches `up` and `down`. Both branches must have the same
/// parameter values. If one of the two branches has no rows, there are no bands and no jumps.
pub fn compared(up: Way<'_>, down: Way<'_>) -> Comparison {
    if up.x.is_empty() || down.x.is_empty() {
        return Comparison { bands: Vec::new(), jumps: [Vec::new(), Vec::new()] };
    }
    let mut rows: Vec<(f64, bool)> = up.x.iter().copied().zip(up.bistable.iter().copied()).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let bands = rows.chunk_by(|a, b| a.1 == b.1).filter(|run| run[0].1);
    let bands = bands.map(|run| (run[0].0, run[run.len() - 1].0)).collect();
    let jumps = [up, down].map(|way| {
        let is_jump = |row: &usize| {
            way.bistable[*row] && !way.bistable[row + 1] && (way.y[*row] + way.y[row + 1]).is_finite()
        };
        (0..way.x.len().saturating_sub(1)).filter(is_jump).collect()
    });
    Comparison { bands, jumps }
}

#[cfg(test)]
mod tests {
    use super::*;

    const F: bool = false;
    const T: bool = true;

    #[test]
    fn ways_jump_where_they_meet_again() {
        let x = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let back = [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0];
        let bistable = [F, F, T, T, T, F, F];
        let up = Way { x: &x, y: &[11.0, 12.0, 13.0, 14.0, 15.0, 2.0, 2.0], bistable: &bistable };
        let down = Way { x: &back, y: &[2.0, 2.0, 2.0, 2.0, 2.0, 12.0, 11.0], bistable: &bistable };
        let found = compared(up, down);
        assert_eq!(found, Comparison { bands: vec![(3.0, 5.0)], jumps: [vec![4], vec![4]] });
        let same = Way { bistable: &[F; 7], ..up };
        assert_eq!(compared(same, same), Comparison { bands: vec![], jumps: [vec![], vec![]] });
        let none = Way { x: &[], y: &[], bistable: &[] };
        assert_eq!(compared(up, none), Comparison { bands: vec![], jumps: [vec![], vec![]] });
    }

    #[test]
    fn two_bands_have_two_jumps() {
        let x = [1.0, 2.0, 3.0, 4.0, 5.0];
        let bistable = [F, T, F, T, F];
        let up = Way { x: &x, y: &[1.0, 9.0, 3.0, 9.0, 5.0], bistable: &bistable };
        let down = Way { x: &x, y: &[1.0, 2.0, 3.0, 4.0, 5.0], bistable: &bistable };
        let found = compared(up, down);
        assert_eq!(found.bands, [(2.0, 2.0), (4.0, 4.0)]);
        assert_eq!(found.jumps, [vec![1, 3], vec![1, 3]]);
    }

    /// A jump next to a row without a motion has no defined position.
    #[test]
    fn gaps_are_no_jumps() {
        let x = [1.0, 2.0, 3.0];
        let bistable = [F, T, F];
        let up = Way { x: &x, y: &[1.0, 9.0, f64::NAN], bistable: &bistable };
        let down = Way { x: &x, y: &[1.0, 2.0, 3.0], bistable: &bistable };
        let found = compared(up, down);
        assert_eq!((found.bands, found.jumps), (vec![(2.0, 2.0)], [vec![], vec![1]]));
    }
}
