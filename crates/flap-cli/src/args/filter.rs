//! The option `--where`: conditions on rows.

use flap_sweep::notation::expression::is_free_name;

/// A condition on rows. Rows that do not satisfy the condition are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Filter {
    /// The name of a column, and the value that a row must have in this column.
    Equal(String, String),
    /// A comparison of columns and numbers, such as `lift_mean_mn > 1`.
    Comparison(String),
}

/// Parses a condition `COLUMN=VALUE`, or a comparison if the text has another form.
#[expect(clippy::unnecessary_wraps, reason = "clap requires a result")]
pub(super) fn filter(text: &str) -> Result<Filter, String> {
    let equal = text.split_once('=').map(|(name, value)| (name.trim(), value.trim()));
    Ok(match equal.filter(|(name, value)| is_free_name(name) && !value.starts_with('=')) {
        Some((name, value)) => Filter::Equal(name.to_owned(), unquoted(value).to_owned()),
        None => Filter::Comparison(text.to_owned()),
    })
}

/// Removes the quotes around a word. Words in comparisons have quotes, and some shells pass the quotes to flap.
fn unquoted(word: &str) -> &str {
    let inner = |quote: char| word.strip_prefix(quote)?.strip_suffix(quote);
    inner('\'').or_else(|| inner('"')).unwrap_or(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_equal_sign_behind_a_name_is_a_value() {
        let equal = |name: &str, value: &str| Ok(Filter::Equal(name.to_owned(), value.to_owned()));
        assert_eq!(filter("drive_frequency=95 Hz"), equal("drive_frequency", "95 Hz"));
        assert_eq!(filter(" status = periodic"), equal("status", "periodic"));
        for text in ["drive_shape='square'", "drive_shape = \"square\"", "drive_shape=square"] {
            assert_eq!(filter(text), equal("drive_shape", "square"));
        }
        for text in ["lift_mean_mn>1", "cycles == 7", "a >= 1", "a<=1", "a != 2", "a > 1 and b = 2", "a"] {
            assert_eq!(filter(text), Ok(Filter::Comparison(text.to_owned())));
        }
    }
}
