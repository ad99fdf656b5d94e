//! Files that are not TOML.

use std::collections::HashSet;

use super::problems::Problems;

/// Reports the errors of the TOML parser: one per line, since one slip makes several.
pub(super) fn report(errors: &[toml::de::Error], problems: &mut Problems) {
    let newlines: Vec<usize> = problems.text().match_indices('\n').map(|(newline, _)| newline).collect();
    let mut lines = HashSet::new();
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        let line = newlines.partition_point(|newline| *newline < span.start);
        if !lines.insert(line) {
            continue;
        }
        let text = problems.text().get(span.clone()).unwrap_or_default().to_owned();
        let (message, help) = explain(error.message(), &text);
        let diagnostic = problems.report(span, message);
        if let Some(help) = help {
            diagnostic.help(help);
        }
    }
}

/// The parser's message about `text` in the words of someone who writes grid files, and advice.
///
/// Other messages pass through as they are.
fn explain(message: &str, text: &str) -> (String, Option<String>) {
    let said = |begins: &str| message.starts_with(begins);
    if message == "duplicate key" {
        (format!("`{text}` is defined twice"), Some("keep one of them".into()))
    } else if said("string values must be quoted") && text.is_empty() {
        ("a value is missing".into(), Some("write a number, text in quotes, a list or a range".into()))
    } else if said("string values must be quoted") {
        (format!("`{text}` needs quotes"), Some(format!("write \"{}\"", text.escape_default())))
    } else if said("invalid basic string, expected `\"`") || said("invalid literal string, expected `'`") {
        ("a closing quote is missing".into(), Some("end text with the quote it begins with".into()))
    } else if said("missing comma between array elements") {
        let help = "put commas between the values of a list, and ] after the last";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else if said("unexpected key or value") {
        let help = "start each key on a new line; numbers have a decimal point, not a comma";
        (format!("not valid TOML: {message}"), Some(help.into()))
    } else {
        (format!("not valid TOML: {message}"), None)
    }
}
