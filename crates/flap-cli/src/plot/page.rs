//! One page for a browser, in which to choose columns, filter rows and look at them. All is in it: rows, code and style.

use std::collections::HashMap;
use std::fmt::Write as _;

use super::axes::Axes;
use super::choose::Wishes;
use super::columns::{Cells, Column, NO_WORD, Source, Table};
use crate::args::{Aim, PictureKind, PlotArgs};
use crate::console;
use crate::failure::Failure;

const PAGE: &str = include_str!("assets/page.html");
const STYLE: &str = include_str!("assets/page.css");
const SCRIPT: &str = include_str!("assets/page.js");

/// The most rows in a page: a browser draws them while one drags.
const MOST_ROWS: usize = 1 << 17;

/// The most rows whose measures have all their digits; those of more rows have seven.
const MOST_EXACT: usize = 20_000;

/// The page of results. `tells` says whether a user is told what is wrong with them.
pub(super) fn page(args: &PlotArgs, heading: &str, tells: bool) -> Result<String, Failure> {
    let source = Source::open(args, tells)?;
    let wishes = Wishes::of(&source, args)?;
    let table = source.read(|_| true, MOST_ROWS)?;
    let start = Start::of(&wishes, &table, args)?;
    if table.of > table.rows {
        console::say(&format!("{} of {} rows are in the page, evenly chosen", table.rows, table.of));
    }
    let axes = Axes::of(&table, wishes.end());
    let data = data(&table, &axes.columns, &start, wishes.branch());
    // In this order: what is put in is not searched again.
    let mut page = String::new();
    for (number, part) in PAGE.split("{{").enumerate() {
        let Some((name, rest)) = part.split_once("}}").filter(|_| number > 0) else {
            page += part;
            continue;
        };
        match name {
            "title" => page += &escaped(heading),
            "style" => page += STYLE,
            "data" => page += &data,
            _ => page += SCRIPT,
        }
        page += rest;
    }
    Ok(page)
}

/// What the page shows at first.
struct Start {
    kind: &'static str,
    x: usize,
    y: usize,
    by: Option<usize>,
    color: Option<usize>,
    /// Which x and y are better, as the page writes it; empty if no front is drawn.
    best: String,
    /// Values of slices, as JSON by column.
    filters: Vec<(String, String)>,
}

impl Start {
    fn of(wishes: &Wishes, table: &Table, args: &PlotArgs) -> Result<Start, Failure> {
        let filters = (args.filters.iter())
            .map(|(name, text)| Ok((name.clone(), filter(table, name, text)?)))
            .collect::<Result<_, Failure>>()?;
        let columns = match wishes.columns(table) {
            Ok(columns) => columns,
            // A page can always show something; what was asked for must be possible.
            Err(failure) if args.kind.is_some() => return Err(failure),
            Err(_) => {
                let numbers = || (0..table.columns.len()).filter(|&column| table.numbers(column).is_ok());
                let x = wishes.x().or(numbers().next());
                let y = wishes.y().or(numbers().nth(1)).or(x);
                let (Some(x), Some(y)) = (x, y) else {
                    return Err(Failure::usage("no column of the file holds numbers"));
                };
                return Ok(Start {
                    kind: "scatter",
                    x,
                    y,
                    by: None,
                    color: None,
                    best: String::new(),
                    filters,
                });
            }
        };
        let sign = |aim: Aim| if aim == Aim::Max { "1" } else { "-1" };
        let mut best = String::new();
        let kind = match columns.kind {
            PictureKind::Map => "map",
            PictureKind::Pareto => {
                best = format!("{},{}", sign(columns.aims.0), sign(columns.aims.1));
                "scatter"
            }
            PictureKind::Response | PictureKind::Hysteresis | PictureKind::Trajectory => "line",
        };
        let (mut by, mut y) = (columns.by, columns.y);
        if columns.kind == PictureKind::Trajectory {
            y = table.find("stroke_deg")?;
        } else if columns.kind == PictureKind::Hysteresis {
            by = by.or(table.find("branch").ok());
        }
        table.numbers(columns.x)?;
        table.numbers(y)?;
        Ok(Start { kind, x: columns.x, y, by, color: columns.color, best, filters })
    }
}

/// The value of a slice as JSON.
fn filter(table: &Table, name: &str, text: &str) -> Result<String, Failure> {
    let column = table.find(name)?;
    let rows = super::axes::filtered(table, &[(name.to_owned(), text.to_owned())])?;
    Ok(match &table.columns[column].cells {
        Cells::Numbers(values) => number(values[rows[0]]),
        _ => quoted(text),
    })
}

/// All that the script reads.
fn data(table: &Table, axes: &[usize], start: &Start, branch: Option<usize>) -> String {
    let single = table.rows > MOST_EXACT;
    let index = |column: Option<usize>| column.map_or_else(|| "null".to_owned(), |column| column.to_string());
    let list = axes.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let wheres: Vec<String> =
        start.filters.iter().map(|(name, value)| format!("{}:{value}", quoted(name))).collect();
    let stride = table.of.div_ceil(table.rows.max(1));
    let mut json = format!("{{\"rows\":{},\"of\":{},\"stride\":{stride},", table.rows, table.of);
    let branch = index(branch);
    let _ = write!(json, "\"single\":{single},\"branch\":{branch},\"axes\":[{list}],");
    let Start { kind, x, y, best, .. } = start;
    let (by, color) = (index(start.by), index(start.color));
    let _ =
        write!(json, "\"start\":{{\"kind\":\"{kind}\",\"x\":{x},\"y\":{y},\"by\":{by},\"color\":{color},");
    let _ = write!(json, "\"best\":\"{best}\",\"where\":{{{}}}}},\"columns\":[", wheres.join(","));
    for (place, of_column) in table.columns.iter().enumerate() {
        let label = table.label(place);
        if place > 0 {
            json.push(',');
        }
        let (name, words, unit) = (quoted(&of_column.name), quoted(&label.words), quoted(&label.unit));
        let factor = number(label.factor);
        let _ = write!(json, "{{\"name\":{name},\"label\":{words},\"unit\":{unit},\"factor\":{factor},");
        column(&mut json, of_column, single);
        json.push('}');
    }
    json + "]}"
}

/// The cells of a column: few different values by codes and a list, otherwise one number per row, little-endian.
fn column(json: &mut String, column: &Column, single: bool) {
    match &column.cells {
        Cells::Words { codes, words } => {
            let list: Vec<String> = words.iter().map(|word| quoted(word)).collect();
            let codes: Vec<usize> =
                codes.iter().map(|&code| if code == NO_WORD { words.len() } else { code as usize }).collect();
            coded(json, &codes, words.len() + 1);
            let _ = write!(json, ",\"words\":[{}]", list.join(","));
        }
        Cells::Numbers(values) => match distinct(values) {
            Some((codes, list)) => {
                coded(json, &codes, list.len());
                let list: Vec<String> = list.into_iter().map(number).collect();
                let _ = write!(json, ",\"values\":[{}]", list.join(","));
            }
            None if single => {
                #[expect(clippy::cast_possible_truncation, reason = "seven digits are what is promised")]
                let bytes =
                    values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect::<Vec<u8>>();
                let _ = write!(json, "\"type\":\"f32\",\"data\":\"{}\"", base64(&bytes));
            }
            None => {
                let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
                let _ = write!(json, "\"type\":\"f64\",\"data\":\"{}\"", base64(&bytes));
            }
        },
        Cells::Unread => json.push_str("\"type\":\"u8\",\"data\":\"\""),
    }
}

/// Codes of a column with `count` different ones.
fn coded(json: &mut String, codes: &[usize], count: usize) {
    let width = match count {
        0..=0x100 => 1,
        0x101..=0x1_0000 => 2,
        _ => 4,
    };
    let bytes: Vec<u8> = codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(width)).collect();
    let _ = write!(json, "\"type\":\"u{}\",\"data\":\"{}\"", 8 * width, base64(&bytes));
}

/// The different values of a column and which each row has, if there are few.
fn distinct(values: &[f64]) -> Option<(Vec<usize>, Vec<f64>)> {
    let most = (values.len() / 4).min(1 << 16);
    let mut places = HashMap::new();
    let mut list = Vec::new();
    let mut codes = Vec::with_capacity(values.len());
    for value in values {
        let code = *places.entry(value.to_bits()).or_insert_with(|| {
            list.push(*value);
            list.len() - 1
        });
        if list.len() > most {
            return None;
        }
        codes.push(code);
    }
    Some((codes, list))
}

/// A number as JSON, which has none that are not finite.
fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:e}") } else { "null".to_owned() }
}

/// A text as JSON that may stand in a script: without `<`, so that nothing ends the script or begins another.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => {
                out.push('\\');
                out.push(letter);
            }
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' | '\0'..='\u{1f}' => {
                let _ = write!(out, "\\u{:04x}", letter as u32);
            }
            _ => out.push(letter),
        }
    }
    out.push('"');
    out
}

/// A text as HTML.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            _ => out.push(letter),
        }
    }
    out
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let at = |place: usize| usize::from(three.get(place).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for letter in 0..4 {
            let code = bits >> (18 - 6 * letter) & 63;
            out.push(if letter <= three.len() { char::from(LETTERS[code]) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (text, code) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
        ] {
            assert_eq!(base64(text.as_bytes()), code);
        }
        assert_eq!(base64(&[255, 239, 191]), "/++/");
    }

    #[test]
    fn texts_cannot_end_the_script() {
        assert_eq!(quoted("a\"b\\c</script>&\n"), "\"a\\\"b\\\\c\\u003c/script\\u003e\\u0026\\u000a\"");
        assert_eq!(escaped("<b a=\"'\">&"), "&lt;b a=&quot;&#39;&quot;&gt;&amp;");
    }

    #[test]
    fn few_values_have_codes() {
        let values = [1.0, 2.0, 1.0, 1.0, 2.0, f64::NAN, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let (codes, list) = distinct(&values).unwrap();
        assert_eq!(codes[..6], [0, 1, 0, 0, 1, 2]);
        assert_eq!(list.len(), 3);
        assert!(distinct(&[1.0, 2.0, 3.0, 4.0]).is_none());
    }
}
