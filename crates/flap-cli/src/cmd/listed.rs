//! Rows of text for programs: as comma-separated values, and as JSON objects.

use serde::Serializer as _;

use super::shown::json;
use crate::failure::Failure;

/// The rows as comma-separated values below their names.
pub(super) fn csv(names: &[String], rows: &[Vec<String>]) -> Result<String, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let written =
        writer.write_record(names).and_then(|()| rows.iter().try_for_each(|row| writer.write_record(row)));
    let bytes = written.ok().and_then(|()| writer.into_inner().ok());
    let bytes = bytes.ok_or_else(|| Failure::Bug("rows are no comma-separated values".to_owned()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The rows as a list of JSON objects.
pub(super) fn objects(names: &[String], rows: &[Vec<String>]) -> Result<String, Failure> {
    let object = |row: &Vec<String>| {
        let mut bytes = Vec::new();
        let cells = names.iter().zip(row.iter().map(|cell| json(cell)));
        serde_json::Serializer::new(&mut bytes).collect_map(cells)?;
        Ok(format!("  {}", String::from_utf8_lossy(&bytes)))
    };
    let objects: Result<Vec<String>, serde_json::Error> = rows.iter().map(object).collect();
    let objects = objects.map_err(|error| Failure::Bug(error.to_string()))?;
    Ok(format!("[\n{}\n]\n", objects.join(",\n")))
}
