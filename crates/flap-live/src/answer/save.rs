//! Texts to save: a grid file, a device, a line of Python.

use flap_sweep::grid;
use serde::Serialize;

use super::desk::Desk;
use super::python;
use crate::request::{Refused, SaveKind, SaveRequest};

/// A text, and the name of its file.
#[derive(Serialize)]
pub(crate) struct Saved {
    name: &'static str,
    text: String,
}

/// The text that was asked for, checked as every grid file is.
pub(crate) fn save(desk: &Desk<'_>, request: &SaveRequest) -> Result<Saved, Refused> {
    let SaveRequest { kind, design, x, by } = request;
    let text = desk.opened.grid(design, x.as_ref(), by.as_ref())?;
    let plan = desk.opened.plan_of(&text)?;
    Ok(match kind {
        SaveKind::Grid => {
            Saved { name: "family.toml", text: format!("# flap sweep family.toml --out family.csv\n{text}") }
        }
        SaveKind::Device => Saved { name: "design.toml", text: grid::device(&plan) },
        SaveKind::Python => Saved { name: "family.py", text: python::line(&text)? },
    })
}
