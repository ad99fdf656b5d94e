//! The rules by which a run counts as periodic.

use flap_core::measure::strobe::Strobe;

const TOLERANCE: f64 = 1e-6;

/// Passes states to a strobe until the motion settles; returns the orbit's length and the number of periods.
fn settle(mut state: impl FnMut(u32) -> f64) -> Option<(u32, u32)> {
    let mut strobe = Strobe::new(&[state(0)], &[1.0], TOLERANCE);
    (1..200).find_map(|n| strobe.period_end(&[state(n)]).map(|period| (period, n)))
}

#[test]
fn a_decaying_transient_settles_when_it_changes_less_than_the_tolerance() {
    // Changes by 0.5^n; the first below 1e-6 is n = 20, and two in a row are needed.
    assert_eq!(settle(|n| 1.0 + 0.5_f64.powi(n as i32)), Some((1, 21)));
}

/// The tolerance for a small motion is relative to the size of the motion.
#[test]
fn a_small_motion_takes_as_long_to_settle_as_a_large_one() {
    let settled = settle(|n| 1e-6 * (1.0 + 0.5_f64.powi(n as i32)));
    assert_eq!(settled, Some((1, 21)));
    assert_eq!(settle(|n| 1e-12 * f64::from(n)), None);
}

#[test]
fn rest_is_settled() {
    assert_eq!(settle(|_| 0.0), Some((1, 2)));
}

#[test]
fn subharmonics_are_told_by_their_length() {
    for period in 2..=8_u32 {
        let settled = settle(|n| 1.0 + f64::from(n % period) + 0.3_f64.powi(n as i32));
        assert_eq!(settled.map(|(p, _)| p), Some(period));
    }
}

#[test]
fn nine_periods_and_quasi_periodic_motion_are_not_settled() {
    assert_eq!(settle(|n| f64::from(n % 9)), None);
    assert_eq!(settle(|n| f64::from(n).sin()), None);
}

/// With a multiplier near −1, every second state almost repeats long before the motion has settled.
#[test]
fn a_slow_alternation_is_not_taken_for_a_subharmonic() {
    let settled = settle(|n| 1.0 + 5e-3 * (-0.9999_f64).powi(n as i32));
    assert_eq!(settled, None);
}

#[test]
fn a_single_coincidence_is_not_enough() {
    let states = [0.0, 1.0, 1.0, 2.0, 3.0, 4.0];
    assert_eq!(settle(|n| states.get(n as usize).copied().unwrap_or(f64::from(n))), None);
}

#[test]
fn changes_count_in_units_of_each_scale() {
    let mut strobe = Strobe::new(&[0.0, 0.0], &[1.0, 1000.0], TOLERANCE);
    assert!(strobe.change(1).is_nan());
    strobe.period_end(&[2.25, 100.0]);
    assert_eq!(strobe.change(1), 2.25);
    strobe.period_end(&[2.25, 600.0]);
    assert_eq!(strobe.change(1), 0.5);
    assert_eq!(strobe.change(2), 2.25);
    assert!(strobe.change(3).is_nan());
    assert_eq!(strobe.cycles(), 2);
    assert_eq!(strobe.state(), &[2.25, 600.0]);
}
