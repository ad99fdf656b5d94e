//! The words of an expression.

use std::ops::Range;

use super::error::{ExpressionError, Problem};

/// One word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f64),
    /// A name, which may have dots: `preset.wing_area`. The words `and`, `or` and `not` are names here.
    Name(&'t str),
    /// Text in quotes, without them.
    Text(&'t str),
    /// An operator, a parenthesis or a comma.
    Sign(&'static str),
    End,
}

/// Longer ones before those they begin with.
const SIGNS: [&str; 14] = ["<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/", "^", "(", ")", ","];

/// Operators of other languages, with those to write here.
const FOREIGN: [(&str, &str); 6] =
    [("**", "^ for powers"), ("&&", "and"), ("||", "or"), ("<>", "!="), ("=", "== to compare"), ("!", "not")];

/// Takes words off the front of a text.
pub(super) struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Tokens<'t> {
        Tokens { text, at: 0 }
    }

    /// The next word with its bytes, [`Token::End`] for ever after the last.
    pub(super) fn next(&mut self) -> Result<(Token<'t>, Range<usize>), ExpressionError> {
        self.at = self.text.len() - self.text[self.at..].trim_start().len();
        let rest = &self.text[self.at..];
        let Some(first) = rest.chars().next() else {
            return Ok((Token::End, self.at..self.at));
        };
        let (token, length) = match first {
            '0'..='9' | '.' => number(rest).map_err(|error| self.place(error))?,
            'a'..='z' | 'A'..='Z' | '_' => name(rest),
            '\'' | '"' => text(rest, first).map_err(|error| self.place(error))?,
            _ => sign(rest, first).map_err(|error| self.place(error))?,
        };
        let span = self.at..self.at + length;
        self.at = span.end;
        Ok((token, span))
    }

    /// Moves an error at the front of the rest to its place in the text.
    fn place(&self, (length, problem): (usize, Problem)) -> ExpressionError {
        ExpressionError { span: self.at..self.at + length, problem }
    }
}

/// A word and its length, or the length of the mistake.
type Found<'t> = Result<(Token<'t>, usize), (usize, Problem)>;

fn is_name(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

fn number(rest: &str) -> Found<'_> {
    let bytes = rest.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let count = digits(end + 1 + sign);
        if count > 0 {
            end += 1 + sign + count;
        }
    }
    // What runs on as if it were part of the number is a slip: `2x`, `1.2.3`, `1_000`.
    let run = end + rest[end..].find(|c: char| !is_name(c) && c != '.').unwrap_or(rest.len() - end);
    match rest[..end].parse::<f64>() {
        Ok(value) if run == end && value.is_finite() => Ok((Token::Number(value), end)),
        Ok(_) if run == end => Err((end, Problem::TooLarge)),
        _ => Err((run, Problem::BadNumber(rest[..run].to_owned()))),
    }
}

fn name(rest: &str) -> (Token<'_>, usize) {
    let length = rest.find(|c: char| !is_name(c) && c != '.').unwrap_or(rest.len());
    (Token::Name(&rest[..length]), length)
}

fn text(rest: &str, quote: char) -> Found<'_> {
    match rest[1..].find(quote) {
        Some(length) => Ok((Token::Text(&rest[1..=length]), length + 2)),
        None => Err((rest.len(), Problem::OpenQuote)),
    }
}

fn sign(rest: &str, first: char) -> Found<'_> {
    let known = SIGNS.iter().find(|sign| rest.starts_with(**sign));
    let foreign = FOREIGN.iter().find(|(foreign, _)| rest.starts_with(foreign));
    match (known, foreign) {
        // `**` begins with `*`, and `!=` with `!`.
        (Some(known), Some((foreign, right))) if foreign.len() > known.len() => {
            Err((foreign.len(), Problem::Foreign(foreign, right)))
        }
        (Some(known), _) => Ok((Token::Sign(known), known.len())),
        (None, Some((foreign, right))) => Err((foreign.len(), Problem::Foreign(foreign, right))),
        (None, None) => Err((first.len_utf8(), Problem::Character(first))),
    }
}
