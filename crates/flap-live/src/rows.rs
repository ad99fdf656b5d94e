//! Rows of a sweep as JSON.

use std::io;

use flap_sweep::plan::Plan;
use flap_sweep::run::Sink;
use flap_sweep::table::layout::{Cell, Layout};
use serde::Serialize;
use serde_json::Value;

/// The rows of a plan. Numbers are not rounded to fewer digits, and an unknown value is null.
#[derive(Serialize)]
pub(crate) struct Rows {
    columns: Vec<String>,
    rows: Vec<Vec<Value>>,
}

impl Rows {
    /// Returns an empty table for rows of `plan`.
    pub(crate) fn of(plan: &Plan) -> Rows {
        Rows { columns: Layout::of(plan).names(), rows: Vec::new() }
    }
}

impl Sink for Rows {
    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.rows.push(cells.iter().map(|cell| value(*cell)).collect());
        Ok(())
    }
}

/// Returns a cell as JSON. JSON has no infinite numbers, so an infinite number becomes text.
pub(crate) fn value(cell: Cell<'_>) -> Value {
    match cell {
        Cell::Whole(number) => number.into(),
        Cell::Number(number) if number.is_nan() => Value::Null,
        Cell::Number(number) if number.is_infinite() => number.to_string().into(),
        Cell::Number(number) => number.into(),
        Cell::Flag(flag) => flag.into(),
        Cell::Text(text) => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_their_digits() {
        let cells = [
            Cell::Whole(7),
            Cell::Number(0.1 + 0.2),
            Cell::Number(f64::NAN),
            Cell::Number(f64::INFINITY),
            Cell::Flag(Some(true)),
            Cell::Flag(None),
            Cell::Text("periodic"),
        ];
        let row = Value::from(cells.map(value).to_vec());
        assert_eq!(row.to_string(), r#"[7,0.30000000000000004,null,"inf",true,null,"periodic"]"#);
    }
}
