//! The Pareto front.

/// The better direction: `true` if larger values are better.
pub(super) type Better = bool;

/// The points that none of the others dominates, by rising first number. A point dominates another if it is at least as
/// good in both numbers and better in one. Points with a NaN are none.
pub(super) fn front(points: &[(f64, f64)], better: (Better, Better)) -> Vec<usize> {
    // More is better in both from here on.
    let toward = |value: f64, more: Better| if more { value } else { -value };
    let place = |index: usize| (toward(points[index].0, better.0), toward(points[index].1, better.1));
    let known = |index: &usize| !points[*index].0.is_nan() && !points[*index].1.is_nan();
    let mut order: Vec<usize> = (0..points.len()).filter(known).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (place(a), place(b));
        b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        let (x, y) = place(index);
        // Those before are at least as good in x; the last one kept is the best of them in y.
        let stands = kept.last().is_none_or(|&last| {
            let (best_x, best_y) = place(last);
            y > best_y || (y == best_y && x == best_x)
        });
        if stands {
            kept.push(index);
        }
    }
    kept.sort_by(|&a, &b| points[a].0.total_cmp(&points[b].0).then(a.cmp(&b)));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the definition, every pair.
    fn brute_force(points: &[(f64, f64)], better: (Better, Better)) -> Vec<usize> {
        let at_least = |a: f64, b: f64, more: Better| if more { a >= b } else { a <= b };
        let dominates = |a: (f64, f64), b: (f64, f64)| {
            at_least(a.0, b.0, better.0) && at_least(a.1, b.1, better.1) && a != b
        };
        let whole = |point: (f64, f64)| !point.0.is_nan() && !point.1.is_nan();
        (0..points.len())
            .filter(|&i| whole(points[i]) && !points.iter().any(|&other| dominates(other, points[i])))
            .collect()
    }

    /// Points from a small grid, so that many share a number, some all.
    fn points(count: usize, seed: u64) -> Vec<(f64, f64)> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let digit = (state >> 33) % 12;
            if digit == 11 { f64::NAN } else { digit as f64 - 5.0 }
        };
        (0..count).map(|_| (next(), next())).collect()
    }

    #[test]
    fn it_is_what_comparing_every_pair_gives() {
        for seed in 0..200 {
            let count = usize::try_from(1 + seed % 40).unwrap();
            let points = points(count, seed);
            for better in [(true, true), (true, false), (false, true), (false, false)] {
                let mut found = front(&points, better);
                let rising: Vec<f64> = found.iter().map(|&index| points[index].0).collect();
                assert!(rising.is_sorted(), "{rising:?}");
                found.sort_unstable();
                assert_eq!(found, brute_force(&points, better), "seed {seed}, {better:?}");
            }
        }
    }

    #[test]
    fn nothing_has_no_front() {
        assert!(front(&[], (true, false)).is_empty());
        assert!(front(&[(f64::NAN, 1.0)], (true, false)).is_empty());
        assert_eq!(front(&[(1.0, 1.0)], (true, false)), [0]);
    }
}
