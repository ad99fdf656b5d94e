//! Times as text.

const UNITS: [(f64, &str); 5] =
    [(31_557_600.0, "years"), (86_400.0, "days"), (3600.0, "hours"), (60.0, "minutes"), (1.0, "seconds")];

/// Returns a time as text, such as `7 minutes`, in the largest unit in which the number is at least two.
pub(crate) fn words(seconds: f64) -> String {
    between(seconds, seconds)
}

/// Returns a range of times as text, such as `6 to 8 minutes`, or `7 minutes` if both ends round to the same
/// number.
pub(crate) fn between(low: f64, high: f64) -> String {
    let Some((length, name)) = UNITS.iter().find(|(length, _)| high >= 2.0 * length) else {
        return "a second or two".to_owned();
    };
    let [low, high] = [low, high].map(|seconds| format!("{:.0}", seconds / length));
    if low == high { format!("{low} {name}") } else { format!("{low} to {high} {name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_in_words() {
        let cases = [
            (0.01, "a second or two"),
            (2.4, "2 seconds"),
            (119.0, "119 seconds"),
            (120.0, "2 minutes"),
            (7.4e3, "2 hours"),
            (1e5, "28 hours"),
            (2e5, "2 days"),
            (1e9, "32 years"),
        ];
        for (seconds, expected) in cases {
            assert_eq!(words(seconds), expected, "{seconds}");
        }
        assert_eq!(between(360.0, 480.0), "6 to 8 minutes");
        assert_eq!(between(100.0, 130.0), "2 minutes");
        assert_eq!(between(0.2, 1.5), "a second or two");
        assert_eq!(between(0.2, 3.0), "0 to 3 seconds");
    }
}
