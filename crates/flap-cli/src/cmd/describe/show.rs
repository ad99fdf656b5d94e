//! The output of `flap describe` as tables, comma-separated values or JSON.

use std::fmt::Write as _;

use flap_sweep::notation::text;

use super::best::{Axis, Best};
use super::description::Description;
use super::words::{WordCount, Words};
use crate::args::OutputFormat;
use crate::cmd::shown::Shown;
use crate::console;
use crate::data::levels::Value;
use crate::failure::Failure;
use crate::table::Table;

/// Returns a summary as text in the given format.
pub(super) fn text(description: &Description, format: OutputFormat) -> Result<String, Failure> {
    match format {
        OutputFormat::Table => Ok(page(description)),
        OutputFormat::Csv => {
            csv(description).ok_or_else(|| Failure::Bug("no comma-separated values".to_owned()))
        }
        OutputFormat::Json => {
            let json = serde_json::to_string_pretty(description);
            json.map(|json| json + "\n").map_err(|error| Failure::Bug(error.to_string()))
        }
    }
}

/// Returns the tables of a summary as text, one below the other.
fn page(description: &Description) -> String {
    let mut tables = Vec::new();
    if !description.statuses.is_empty() {
        let mut table = Table::with_headings(&["status", "rows", "share"]);
        for status in &description.statuses {
            let share = 100.0 * status.rows as f64 / description.rows as f64;
            table.row([status.status.clone(), status.rows.to_string(), format!("{share:.1} %")]);
        }
        tables.push(table.text_within(console::width()));
    }
    if !description.columns.is_empty() {
        let mut table = Table::with_headings(&[
            "column", "unit", "rows", "mean", "sd", "min", "5 %", "median", "95 %", "max",
        ]);
        for spread in &description.columns {
            // The standard error of the mean is only in csv and json: the table would be too wide.
            let numbers = spread.statistics().into_iter().filter(|(name, _)| *name != "se");
            let numbers: Vec<f64> = numbers.map(|(_, number)| number).collect();
            let shown = Shown::of_column(&spread.column, &spread.unit, numbers.iter().copied());
            let head = [spread.column.clone(), shown.unit().to_owned(), spread.count.to_string()];
            table.row(
                head.into_iter()
                    .chain(numbers.into_iter().map(|number| shown.number(number)))
                    .collect::<Vec<_>>(),
            );
        }
        tables.push(table.text_within(console::width()));
    }
    if description.words.iter().any(|words| !words.counts.is_empty()) {
        let mut table = Table::with_headings(&["column", "value", "rows", "share"]);
        for Words { column, counts } in &description.words {
            let all: usize = counts.iter().map(|count| count.rows).sum();
            for WordCount { value, rows } in counts {
                let share = 100.0 * *rows as f64 / all as f64;
                table.row([column.clone(), value.clone(), rows.to_string(), format!("{share:.1} %")]);
            }
        }
        tables.push(table.text_within(console::width()));
    }
    tables.extend(description.best.iter().map(best));
    tables.join("\n")
}

/// Returns a line with the best value of a measure, and a table with one line per axis.
fn best(best: &Best) -> String {
    let shown = Shown::of_column(&best.column, &best.unit, [best.value]);
    let direction = if best.aim == "max" { "largest" } else { "smallest" };
    let value = format!("{} {}", shown.number(best.value), shown.unit());
    let mut text = format!("{direction} {}: {} at point {}\n", best.column, value.trim_end(), best.point);
    if best.axes.is_empty() {
        return text;
    }
    let mut table =
        Table::with_headings(&["axis", "unit", "from", "to", "values", "best row", "best tenth", ""]);
    for axis in &best.axes {
        table.row(line(axis));
    }
    let _ = write!(text, "{}", table.text_within(console::width()));
    text
}

fn line(axis: &Axis) -> [String; 8] {
    let number = |value: &Value| if let Value::Number(number) = value { *number } else { f64::NAN };
    let shown = Shown::of_column(&axis.name, &axis.unit, axis.range.iter().map(number));
    let text = |value: &Value| match value {
        Value::Number(number) => shown.number(*number),
        Value::Word(word) => word.clone(),
    };
    let tenth: Vec<String> = axis.best_tenth.iter().map(text).collect();
    let tenth = match (&axis.best, tenth.as_slice()) {
        (Value::Number(_), [from, to]) if from != to => format!("{from} to {to}"),
        (Value::Number(_), [one, ..]) => one.clone(),
        _ => tenth.join(", "),
    };
    let [from, to] = &axis.range;
    let end = if axis.at_the_end { "at the end" } else { "" };
    [
        axis.name.clone(),
        shown.unit().to_owned(),
        text(from),
        text(to),
        axis.values.to_string(),
        text(&axis.best),
        tenth,
        end.to_owned(),
    ]
}

/// Returns the summary as comma-separated values. Each line contains one number, and the names of its table,
/// column, axis and statistic.
fn csv(description: &Description) -> Option<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut line = |cells: [&str; 5]| writer.write_record(cells).ok();
    line(["table", "column", "axis", "name", "value"])?;
    for status in &description.statuses {
        line(["statuses", "status", "", &status.status, &status.rows.to_string()])?;
    }
    for spread in &description.columns {
        line(["columns", &spread.column, "", "count", &spread.count.to_string()])?;
        for (name, number) in spread.statistics() {
            line(["columns", &spread.column, "", name, &text::float(number)])?;
        }
    }
    for Words { column, counts } in &description.words {
        for WordCount { value, rows } in counts {
            line(["words", column, "", value, &rows.to_string()])?;
        }
    }
    for best in &description.best {
        line(["best", &best.column, "", "value", &text::float(best.value)])?;
        line(["best", &best.column, "", "point", &best.point.to_string()])?;
        for axis in &best.axes {
            let [from, to] = &axis.range;
            for (name, value) in [("from", from), ("to", to), ("best", &axis.best)] {
                line(["best", &best.column, &axis.name, name, &value.typed()])?;
            }
            for value in &axis.best_tenth {
                line(["best", &best.column, &axis.name, "best_tenth", &value.typed()])?;
            }
        }
    }
    String::from_utf8(writer.into_inner().ok()?).ok()
}
