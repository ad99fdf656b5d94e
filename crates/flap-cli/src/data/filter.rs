//! Conditions of `--where`, which are checked row by row.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeSet;
use std::sync::LazyLock;

use csv::StringRecord;
use flap_core::simulate::Status;
use flap_sweep::notation::expression::{
    Expression, ExpressionError, Kind, Meaning, Mistake, Scope, units_in,
};
use flap_sweep::notation::units;
use flap_sweep::table::labels;

use super::columns;
use super::columns::Table;
use super::source::Source;
use crate::args::Filter;
use crate::failure::Failure;
use crate::table::six_digits;

/// The conditions of the command line.
pub(crate) struct Filters(Vec<Condition>);

/// A condition on the cells of a row.
enum Condition {
    Number(Number),
    Word(Word),
    Comparison(Comparison),
}

/// The condition that a cell equals a given number.
struct Number {
    column: usize,
    name: String,
    unit: String,
    wanted: f64,
    /// True if the number was given without a unit.
    is_bare: bool,
    /// The number of this column in the first row that was checked, as an example for messages.
    first: OnceCell<f64>,
}

/// The condition that a cell equals a given word.
struct Word {
    wanted: String,
    cells: TextColumn,
}

/// A column that a condition compares with words.
struct TextColumn {
    column: usize,
    name: String,
    /// Words that occur in the checked rows. At most `MOST_WORDS + 1` words are stored.
    words: RefCell<BTreeSet<String>>,
}

impl TextColumn {
    fn new(column: usize, name: &str) -> TextColumn {
        TextColumn { column, name: name.to_owned(), words: RefCell::default() }
    }

    /// Returns the index in `wanted` of the word that the row contains. If `wanted` does not contain the word
    /// of the row, returns the length of `wanted`.
    fn place(&self, row: &StringRecord, wanted: &[impl AsRef<str>]) -> usize {
        let word = cell(row, self.column);
        let mut words = self.words.borrow_mut();
        if !word.is_empty() && words.len() <= MOST_WORDS && !words.contains(word) {
            words.insert(word.to_owned());
        }
        wanted.iter().position(|wanted| wanted.as_ref() == word).unwrap_or(wanted.len())
    }

    /// Returns a help line with words that occur in the column, if the checked rows contain words.
    fn advice(&self) -> Option<String> {
        let words = self.words.borrow();
        let more = if words.len() > MOST_WORDS { ", …" } else { "" };
        let words: Vec<&str> = words.iter().take(MOST_WORDS).map(String::as_str).collect();
        (!words.is_empty()).then(|| format!("the values of {} are {}{more}", self.name, words.join(", ")))
    }
}

/// Largest number of words of a column that a message lists.
const MOST_WORDS: usize = 8;

/// A condition that compares columns and numbers.
struct Comparison {
    expression: Expression,
    /// Names and units of all columns.
    names: Vec<String>,
    units: Vec<String>,
    /// Words in quotes, and the columns that the condition compares with these words.
    words: Vec<String>,
    texts: Vec<TextColumn>,
    /// The numbers of the first checked row in the columns that the comparison uses, as examples for
    /// messages.
    first: OnceCell<Vec<f64>>,
}

impl Filters {
    /// Parses the conditions of the command line. `source` contains the names and units of the columns.
    pub(crate) fn of(filters: &[Filter], source: &Source) -> Result<Filters, Failure> {
        let condition = |filter: &Filter| match filter {
            Filter::Equal(name, text) => {
                let (column, first) = (source.find(name)?, OnceCell::new());
                let unit = source.unit(column);
                let wanted = number(name, &unit, text)?;
                let name = source.names()[column].clone();
                Ok(if let Some(wanted) = wanted {
                    let is_bare = text.parse::<f64>().is_ok();
                    Condition::Number(Number { column, name, unit, wanted, is_bare, first })
                } else {
                    Condition::Word(Word { wanted: text.clone(), cells: TextColumn::new(column, &name) })
                })
            }
            Filter::Comparison(text) => {
                let names = source.names().to_vec();
                let units: Vec<String> = (0..names.len()).map(|column| source.unit(column)).collect();
                let compared = Compared::of(text);
                let scope = ColumnScope { names: &names, units: &units, flags: &[], compared: &compared };
                // Numbers 0 and 1 may replace false and true.
                let expression = comparison(text, &scope).or_else(|failure| {
                    comparison(text, &ColumnScope { flags: source.flags(), ..scope }).map_err(|_| failure)
                })?;
                let texts = names.iter().enumerate().filter(|(_, name)| compared.is_text(name));
                let texts = texts.map(|(column, name)| TextColumn::new(column, name)).collect();
                let words = compared.words.into_iter().map(str::to_owned).collect();
                Ok(Condition::Comparison(Comparison {
                    expression,
                    names,
                    units,
                    words,
                    texts,
                    first: OnceCell::new(),
                }))
            }
        };
        filters.iter().map(condition).collect::<Result<_, _>>().map(Filters)
    }

    /// Returns true if the row satisfies all conditions. A comparison with an empty cell is false.
    pub(crate) fn accept(&self, row: &StringRecord) -> Result<bool, Failure> {
        for condition in &self.0 {
            let holds = match condition {
                Condition::Number(Number { column, wanted, first, .. }) => {
                    let value: Option<f64> = cell(row, *column).parse().ok();
                    value.is_some_and(|value| {
                        first.get_or_init(|| value);
                        is_same(value, *wanted)
                    })
                }
                Condition::Word(Word { wanted, cells }) => cells.place(row, &[wanted]) == 0,
                Condition::Comparison(Comparison { expression, names, words, texts, first, .. }) => {
                    let mut values = vec![f64::NAN; names.len()];
                    for column in expression.reads() {
                        let cell = cell(row, column);
                        let text = texts.iter().find(|text| text.column == column && !cell.is_empty());
                        values[column] = match text {
                            Some(text) => text.place(row, words) as f64,
                            None => value(&names[column], cell)?,
                        };
                    }
                    // An expression with an empty cell is NaN.
                    let holds = expression.value(&values) == 1.0;
                    first.get_or_init(|| values);
                    holds
                }
            };
            if !holds {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Returns help lines for the case that no row satisfies the conditions: units and examples of the
    /// columns in the conditions.
    pub(crate) fn advice(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for condition in &self.0 {
            match condition {
                Condition::Number(Number { name, unit, wanted, is_bare, first, .. }) => {
                    let usual = first.get().copied().unwrap_or(f64::NAN);
                    let line = Some(*wanted)
                        .filter(|_| *is_bare)
                        .and_then(|wanted| prefix_question(name, unit, wanted, usual));
                    lines.extend(line.or_else(|| in_unit(name, unit, usual)));
                }
                Condition::Word(Word { cells, .. }) => lines.extend(cells.advice()),
                Condition::Comparison(Comparison { expression, names, units, texts, first, .. }) => {
                    let values = first.get().map_or(&[][..], Vec::as_slice);
                    lines.extend(texts.iter().filter_map(TextColumn::advice));
                    for column in expression.reads() {
                        if texts.iter().any(|text| text.column == column) {
                            continue;
                        }
                        let usual = values.get(column).copied().unwrap_or(f64::NAN);
                        lines.extend(in_unit(&names[column], &units[column], usual));
                    }
                }
            }
        }
        lines.dedup();
        lines
    }

    /// Reads the rows of `source` that satisfy the conditions into a table, with [`Source::read_kept`].
    /// Returns an error if no row satisfies the conditions.
    pub(crate) fn read(
        &self,
        source: Source,
        wanted: impl Fn(usize) -> bool,
        most: usize,
    ) -> Result<Table, Failure> {
        let name = source.path().display().to_string();
        let mut rows = 0_u64;
        let table = source.read_kept(wanted, most, |row| {
            rows += 1;
            self.accept(row)
        })?;
        if table.rows == 0 && rows > 0 {
            let failure = Failure::usage(format!("no row of {name} satisfies --where"));
            return Err(failure.helps(self.advice()));
        }
        if table.rows == 0 {
            return Err(Failure::usage(format!("{name} has no rows: there is nothing to draw")));
        }
        Ok(table)
    }
}

/// If a number without a unit looks too large or too small, returns the question whether the user meant a
/// unit with a prefix. `usual` is a typical number of the column, for comparison.
pub(crate) fn prefix_question(name: &str, unit: &str, wanted: f64, usual: f64) -> Option<String> {
    let meant = units::meant(wanted, usual, unit).filter(|meant| *meant != wanted)?;
    let text = shown_in(meant, unit);
    Some(format!("a number without a unit is in {unit}: did you mean --where {name}='{text}'?"))
}

/// Returns a help line with the unit of a column and an example, or `None` for a column without a unit.
fn in_unit(name: &str, unit: &str, usual: f64) -> Option<String> {
    let example =
        if usual.is_finite() { format!(", such as {}", shown_in(usual, unit)) } else { String::new() };
    (!unit.is_empty()).then(|| format!("{name} is in {unit}{example}; a number may have its unit"))
}

/// Returns a number with its unit as text. Units without a prefix get a suitable prefix, and units such as mN
/// keep their prefix.
fn shown_in(number: f64, unit: &str) -> String {
    let prefixed = units::prefixed(number, unit);
    let is_read = units::parse_as(&prefixed, unit).is_ok();
    if is_read { prefixed } else { format!("{} {unit}", six_digits(number)) }
}

/// Returns the text of a cell.
fn cell(row: &StringRecord, column: usize) -> &str {
    row.get(column).unwrap_or_default()
}

/// Returns true if the number in a cell equals the number that the user gave, up to a relative difference of
/// 1e-9.
pub(crate) fn is_same(value: f64, wanted: f64) -> bool {
    value == wanted || (value - wanted).abs() <= 1e-9 * wanted.abs().max(f64::MIN_POSITIVE)
}

/// Parses `text` as a number in the unit of the column `name`; returns `None` for a word.
///
/// # Errors
/// `Usage` if the unit of the number has a different dimension than the column, or if an invalid text begins
/// like a number.
pub(crate) fn number(name: &str, unit: &str, text: &str) -> Result<Option<f64>, Failure> {
    if let Ok(number) = text.parse() {
        return Ok(Some(number));
    }
    match units::parse_in(text, unit) {
        Ok(number) => Ok(Some(number)),
        Err(error) if error.problem == units::UnitProblem::NoNumber => Ok(None),
        Err(error) => {
            let failure = Failure::usage(format!("--where {name}={text}: {}", error.message(name)));
            Err(failure.helps(error.help()))
        }
    }
}

/// The words with which a comparison can compare the column `status`.
static STATUSES: LazyLock<Vec<&'static str>> =
    LazyLock::new(|| Status::ALL.into_iter().map(Status::name).collect());
const BRANCHES: &[&str] = &["up", "down", "unstable"];

/// The words in quotes in a comparison, and the names of the columns that the comparison compares with these
/// words.
struct Compared<'t> {
    words: Vec<&'t str>,
    names: Vec<&'t str>,
}

impl<'t> Compared<'t> {
    fn of(text: &'t str) -> Compared<'t> {
        // Every second part is in quotes.
        let parts: Vec<&str> = text.split(['\'', '"']).collect();
        let words = parts.iter().skip(1).step_by(2).copied().collect();
        let names = parts.iter().step_by(2).filter_map(|part| {
            let part = part.trim_end();
            let left = part.strip_suffix("==").or_else(|| part.strip_suffix("!="))?.trim_end();
            left.rsplit(|character: char| !character.is_ascii_alphanumeric() && character != '_').next()
        });
        Compared { words, names: names.collect() }
    }

    /// Returns true if the comparison compares the column `name` with words. Returns false for `status` and
    /// `branch`, which have a fixed list of words.
    fn is_text(&self, name: &str) -> bool {
        self.names.contains(&name) && !["status", "branch"].contains(&name)
    }
}

/// The columns that a comparison may contain.
struct ColumnScope<'n> {
    names: &'n [String],
    units: &'n [String],
    /// Names of the columns that are conditions by themselves.
    flags: &'n [String],
    compared: &'n Compared<'n>,
}

impl Scope for ColumnScope<'_> {
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
        let column = self.names.iter().position(|known| known == name)?;
        Some(match name {
            "status" => Meaning::Choice(column, STATUSES.as_slice()),
            "branch" => Meaning::Choice(column, BRANCHES),
            "stable" | "bistable" => Meaning::Condition(column),
            _ if self.flags.iter().any(|flag| flag == name) => Meaning::Condition(column),
            _ if self.compared.is_text(name) => Meaning::Choice(column, &self.compared.words),
            _ => Meaning::Number(column),
        })
    }

    fn names(&self) -> Vec<String> {
        self.names.to_vec()
    }

    fn has_units(&self) -> bool {
        true
    }

    /// Returns the unit of a column. The cells of a measure are in the unit of the measure, such as mN, and
    /// not in SI units.
    fn unit(&self, name: &str) -> Option<String> {
        let column = self.names.iter().position(|known| known == name)?;
        Some(self.units[column].clone())
    }
}

/// Returns the comparison `text` with units as they are printed in books, such as `µN·m/rad` for `uN*m/rad`.
pub(crate) fn printed(text: &str) -> String {
    let (mut shown, mut copied) = (String::new(), 0);
    for unit in units_in(text) {
        shown += text[copied..unit.start].trim_end();
        shown += " ";
        shown += &labels::printed(&text[unit.clone()]);
        copied = unit.end;
    }
    shown + &text[copied..]
}

/// Parses the comparison `text`.
fn comparison(text: &str, scope: &ColumnScope<'_>) -> Result<Expression, Failure> {
    let refused = |error: ExpressionError| {
        let failure = Failure::usage(format!("--where {text}: {}", error.message));
        match error.mistake {
            Mistake::NotInQuotes => failure.help("write COLUMN=WORD"),
            Mistake::NoOperator => failure
                .help("compare a number with a column, with or without its unit: drive_frequency > 95 Hz"),
            Mistake::UnknownName(_) if error.help.is_none() => {
                failure.help(columns::listed(scope.names.iter().map(String::as_str)))
            }
            Mistake::Mismatch => failure.help("write COLUMN=VALUE, or a comparison such as lift_mean_mn>1"),
            _ => failure.helps(error.help),
        }
    };
    let expression = Expression::parse(text, scope).map_err(|errors| {
        errors.into_iter().next().map_or_else(|| Failure::usage(format!("--where {text}")), &refused)
    })?;
    match expression.kind() {
        Kind::Condition => Ok(expression),
        Kind::Number => Err(refused(ExpressionError::mismatch(0..text.len(), Kind::Condition))),
    }
}

/// Returns the number that stands for a cell in a comparison. An empty cell becomes NaN, and a status or
/// branch becomes its index in the list of all statuses or branches.
fn value(name: &str, cell: &str) -> Result<f64, Failure> {
    let among = |options: &[&str]| options.iter().position(|option| *option == cell);
    let found = match name {
        _ if cell.is_empty() => Some(f64::NAN),
        "status" => among(&STATUSES).map(|place| place as f64),
        "branch" => among(BRANCHES).map(|place| place as f64),
        _ if cell == "true" => Some(1.0),
        _ if cell == "false" => Some(0.0),
        _ => cell.parse().ok(),
    };
    found.ok_or_else(|| {
        Failure::usage(format!("column `{name}` contains text such as `{cell}`, and text has no order"))
            .help(format!("write --where {name}={cell}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_in_the_unit_of_the_column() {
        for (unit, text, wanted) in [
            ("deg", "60 deg", 60.0),
            ("mN", "0.002 N", 2.0),
            ("Hz", "0.12 kHz", 120.0),
            ("deg", "60", 60.0),
            ("", "5 %", 0.05),
        ] {
            let found = number("measure", unit, text).ok().flatten().unwrap();
            assert!(is_same(found, wanted), "{text}: {found} {unit}");
        }
        assert!(number("measure", "deg", "60 V").is_err());
        assert!(matches!(number("measure", "", "up"), Ok(None)));
    }

    #[test]
    fn units_are_printed_as_in_books() {
        assert_eq!(
            printed("hinge_stiffness>90uN*m/rad and x2 < 1 %"),
            "hinge_stiffness>90 µN·m/rad and x2 < 1 %"
        );
        assert_eq!(printed("x2 > 1"), "x2 > 1");
    }
}
