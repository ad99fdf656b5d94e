//! Conditions on rows, checked row by row.

use std::sync::LazyLock;

use csv::StringRecord;
use flap_core::simulate::Status;
use flap_sweep::notation::expression::{Expression, ExpressionError, Kind, Meaning, Problem, Scope};
use flap_sweep::notation::units;

use super::source::Source;
use crate::args::Filter;
use crate::failure::Failure;

/// The conditions of the command line.
pub(crate) struct Filters(Vec<Test>);

/// A condition on the cells of a row.
enum Test {
    /// The cell in this column is this number.
    Number(usize, f64),
    /// The cell in this column is this word.
    Word(usize, String),
    /// A comparison, with the names of all columns.
    Comparison(Expression, Vec<String>),
}

impl Filters {
    /// The conditions on rows of `source`.
    pub(crate) fn of(filters: &[Filter], source: &Source) -> Result<Filters, Failure> {
        let test = |filter: &Filter| match filter {
            Filter::Equal(name, text) => {
                let column = source.find(name)?;
                let number = number(name, &source.unit(column), text)?;
                Ok(number
                    .map_or_else(|| Test::Word(column, text.clone()), |number| Test::Number(column, number)))
            }
            Filter::Comparison(text) => {
                let names = source.names().to_vec();
                Ok(Test::Comparison(comparison(text, &names)?, names))
            }
        };
        filters.iter().map(test).collect::<Result<_, _>>().map(Filters)
    }

    /// True if the row satisfies all conditions. A comparison with an empty cell does not hold.
    pub(crate) fn keep(&self, row: &StringRecord) -> Result<bool, Failure> {
        for test in &self.0 {
            let holds = match test {
                Test::Number(column, wanted) => {
                    cell(row, *column).parse().is_ok_and(|value| is_same(value, *wanted))
                }
                Test::Word(column, word) => cell(row, *column) == word,
                Test::Comparison(expression, names) => {
                    let mut values = vec![f64::NAN; names.len()];
                    for column in expression.reads() {
                        values[column] = value(&names[column], cell(row, column))?;
                    }
                    // NaN stands for a comparison with an empty cell.
                    expression.value(&values) == 1.0
                }
            };
            if !holds {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// The text of a cell.
fn cell(row: &StringRecord, column: usize) -> &str {
    row.get(column).unwrap_or_default()
}

/// True if a cell is the number that a user means, who writes fewer digits than files hold.
pub(crate) fn is_same(value: f64, wanted: f64) -> bool {
    value == wanted || (value - wanted).abs() <= 1e-9 * wanted.abs().max(f64::MIN_POSITIVE)
}

/// The number that `text` is, in the unit of the column called `name`; `None` for a word.
///
/// # Errors
/// `Usage` for a number with a unit of another kind, and for text that begins like a number and is none.
pub(crate) fn number(name: &str, unit: &str, text: &str) -> Result<Option<f64>, Failure> {
    if let Ok(number) = text.parse() {
        return Ok(Some(number));
    }
    match units::parse_as(text, unit) {
        Ok(number) => Ok(Some(number)),
        Err(error) if error.problem == units::Problem::NoNumber => Ok(None),
        Err(error) => {
            let failure = Failure::usage(format!("--where {name}={text}: {}", error.message(name)));
            Err(error.help().into_iter().fold(failure, Failure::help))
        }
    }
}

/// The options of words that comparisons know.
static STATUSES: LazyLock<Vec<&'static str>> =
    LazyLock::new(|| Status::ALL.into_iter().map(Status::name).collect());
const BRANCHES: &[&str] = &["up", "down", "unstable"];

/// The names of columns.
struct Names<'n>(&'n [String]);

impl Scope for Names<'_> {
    fn meaning(&self, name: &str) -> Option<Meaning> {
        let column = self.0.iter().position(|known| known == name)?;
        Some(match name {
            "status" => Meaning::Choice(column, STATUSES.as_slice()),
            "branch" => Meaning::Choice(column, BRANCHES),
            "stable" => Meaning::Condition(column),
            _ => Meaning::Number(column),
        })
    }

    fn names(&self) -> Vec<String> {
        self.0.to_vec()
    }
}

/// The comparison that `text` is.
fn comparison(text: &str, names: &[String]) -> Result<Expression, Failure> {
    let refused = |error: ExpressionError| {
        let failure = Failure::usage(format!("--where {text}: {}", error.message()));
        match &error.problem {
            Problem::Expected("the name of an option in quotes") => failure.help("write COLUMN=WORD"),
            Problem::Expected("an operator") | Problem::BadNumber(_) => failure
                .help("numbers are in the unit of the column and written without it: drive_frequency>95"),
            Problem::UnknownName { nearest: None, .. } => {
                failure.help(format!("the columns are {}", names.join(", ")))
            }
            Problem::Mismatch(_) => {
                failure.help("write COLUMN=VALUE, or a comparison such as lift_mean_mn>1")
            }
            _ => error.help().into_iter().fold(failure, Failure::help),
        }
    };
    let expression = Expression::parse(text, &Names(names)).map_err(|errors| {
        errors.into_iter().next().map_or_else(|| Failure::usage(format!("--where {text}")), &refused)
    })?;
    match expression.kind() {
        Kind::Condition => Ok(expression),
        Kind::Number => {
            let problem = Problem::Mismatch(Kind::Condition);
            Err(refused(ExpressionError { span: 0..text.len(), problem }))
        }
    }
}

/// The value of a cell in a comparison; NaN if it is empty.
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
        Failure::usage(format!("column `{name}` holds words such as `{cell}`: they cannot be compared"))
            .help(format!("write --where {name}={cell}"))
    })
}
