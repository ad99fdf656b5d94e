//! Examines the points of a plan without computing rows: counts the points that conditions exclude, and
//! chooses points that are spread over the plan.

use crate::plan::{Admission, Plan};
use crate::run::Unsatisfied;

/// Number of points that the conditions of a plan exclude, in total and for each condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exclusions {
    /// Number of examined points: all points of the plan, or some points that are spread over the plan.
    pub looked_at: u64,
    /// Number of examined points that at least one condition excludes.
    pub excluded: u64,
    /// For each condition of the plan, the number of examined points that do not satisfy the condition.
    pub unsatisfied: Vec<Unsatisfied>,
}

/// Counts the points that the conditions of `plan` exclude.
///
/// If the plan has at most `most` points, the function examines all points. If the plan has more than `most`
/// points, the function examines `most` points that are spread over the plan.
pub fn exclusions(plan: &Plan, most: u64) -> Exclusions {
    let conditions = plan.conditions().iter();
    let unsatisfied =
        conditions.map(|condition| Unsatisfied { condition: condition.name.clone(), points: 0 }).collect();
    let mut found = Exclusions { looked_at: plan.len().min(most), excluded: 0, unsatisfied };
    for number in 0..found.looked_at {
        let index = if plan.len() > most { spread(number, plan.len()) } else { number };
        if let Admission::Excluded(unsatisfied) = plan.judge(&plan.point(index).values) {
            found.excluded += 1;
            for condition in unsatisfied {
                found.unsatisfied[condition].points += 1;
            }
        }
    }
    found
}

/// Returns an element of an endless sequence of point indices that are evenly spread over a plan. `number` is
/// the position in the sequence, and `points` is the number of points of the plan.
///
/// Each index is the fractional part of a multiple of the golden ratio, times `points`. The fractional parts
/// leave no large gaps, and their sequence has no common period with the values of any axis.
pub fn spread(number: u64, points: u64) -> u64 {
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    let share = number.wrapping_mul(GOLDEN);
    // Less than `points`, so it fits.
    u64::try_from((u128::from(share) * u128::from(points)) >> 64).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn spread_points_leave_no_large_gaps() {
        for points in [1_u64, 10, 1000, 1 << 63] {
            let mut found: Vec<u64> = (0..100).map(|number| spread(number, points)).collect();
            found.sort_unstable();
            assert!(found.iter().all(|index| *index < points));
            let ends = found.iter().copied().chain([points]);
            let largest = ends.zip([0].iter().chain(&found)).map(|(b, a)| b - a).max();
            assert!(largest <= Some((points / 50).max(1)), "{points}: {largest:?}");
        }
    }
}
