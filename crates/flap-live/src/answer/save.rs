//! Texts that the user can save: a grid file, a device file, or lines of Python.

use flap_sweep::grid;
use flap_sweep::plan::Plan;
use serde::Serialize;

use super::context::AnswerContext;
use crate::request::{Refused, SaveKind, SaveRequest, XAxis};

/// A text, and the name of the file in which the user saves the text.
#[derive(Serialize)]
pub(crate) struct Saved {
    name: &'static str,
    text: String,
}

/// Returns the design of a plan as a device file.
fn device(plan: &Plan) -> Result<String, Refused> {
    grid::device(plan).map_err(|error| Refused::Impossible {
        error: error.message,
        help: error.help,
        parameter: None,
    })
}

/// Returns lines of Python that assign the result of a function of flapwing to `result`. The first argument
/// of the function is the text of a grid file, and `more` contains the further arguments.
fn python(result: &str, function: &str, grid: &str, more: &str) -> String {
    let grid = grid.replace('\\', r"\\").replace(r#"""""#, r#"\"\"\""#);
    format!("import flapwing\n\n{result} = flapwing.{function}(\"\"\"\\\n{grid}\"\"\"{more})\n")
}

/// Returns the requested text, which is checked like every grid file.
pub(crate) fn save(context: &AnswerContext<'_>, request: &SaveRequest) -> Result<Saved, Refused> {
    let SaveRequest { kind, design, x, by, updown } = request;
    let followed = x.as_ref().filter(|_| *updown);
    let by = by.as_ref().filter(|_| followed.is_none());
    let text = context.opened.grid(design, x.as_ref(), by)?;
    let plan = context.opened.plan_of(&text)?;
    Ok(match (kind, followed) {
        (SaveKind::Grid, None) => {
            Saved { name: "family.toml", text: format!("# flap sweep family.toml --out family.csv\n{text}") }
        }
        (SaveKind::Grid, Some(XAxis { name, .. })) => {
            let command = format!("flap respond response.toml --along {name} --out response.csv");
            Saved { name: "response.toml", text: format!("# {command}\n{text}") }
        }
        (SaveKind::Device, _) => Saved { name: "design.toml", text: device(&plan)? },
        (SaveKind::Python, None) => Saved { name: "family.py", text: python("table", "sweep", &text, "") },
        (SaveKind::Python, Some(XAxis { name, .. })) => {
            let along = format!(", \"{name}\"");
            Saved { name: "response.py", text: python("curve", "respond", &text, &along) }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_and_backslashes_of_a_grid_are_escaped_in_python() {
        let grid = "preset = \"a\"\n[measure]\nx = \"\"\"\ny\"\"\"\nz = \"\\n\"\n";
        let lines = r#"import flapwing

curve = flapwing.respond("""\
preset = "a"
[measure]
x = \"\"\"
y\"\"\"
z = "\\n"
""", "f")
"#;
        assert_eq!(python("curve", "respond", grid, ", \"f\""), lines);
    }
}
