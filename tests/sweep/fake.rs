//! Two small models that only have parameters, presets and columns, so that tests need no physics.

use std::sync::LazyLock;

use flap_core::model::{Description, OverWings};
use flap_core::num::Backend;
use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::{Column, Jobs, PointRun, Row, Rows, Simulator, SolverSettings};
use flap_sweep::grid::diagnostic::{Diagnostic, Mistakes};
use flap_sweep::plan::Plan;

/// A model that is never run.
pub(crate) struct Fake {
    name: &'static str,
    parameters: &'static [Parameter<'static>],
    presets: &'static [Preset],
    columns: &'static LazyLock<Vec<Column>>,
}

impl Rows for Fake {
    fn columns(&self) -> &[Column] {
        self.columns
    }

    fn run(&self, _: Backend, _: &SolverSettings, _: &mut dyn Jobs) {
        unimplemented!("grid files are checked without running anything")
    }

    fn run_point(&self, _: &PointRun<'_>, _: Option<&[f64]>) -> Row {
        unimplemented!("grid files are checked without running anything")
    }
}

impl Simulator for Fake {
    fn description(&self) -> Description<'_> {
        Description::new(self.name, "a fake", self.parameters, self.presets)
    }
}

const fn parameter(name: &'static str, unit: &'static str, kind: Kind<'static>) -> Parameter<'static> {
    Parameter::new(name, unit, "", kind, "")
}

static COLUMNS: LazyLock<Vec<Column>> = LazyLock::new(|| {
    [("lift_mean_mn", "mN"), ("power_mean_mw", "mW"), ("stroke_pp_deg", "deg")]
        .map(|(name, unit)| Column {
            name: name.to_owned(),
            unit,
            doc: String::new(),
            over_wings: OverWings::Omitted,
        })
        .to_vec()
});

/// The values of `preset = "fly"`, in the order of the parameters.
pub(crate) const FLY: [f64; 8] = [150.0, 100.0, 5e-5, 1e-6, 0.0, 0.5, 0.0, f64::NAN];

static FLAPPER: Fake = Fake {
    name: "flapper",
    parameters: &[
        parameter("drive_voltage_pp", "V", Kind::Number(Range::Positive)),
        parameter("drive_frequency", "Hz", Kind::Number(Range::Positive)),
        parameter("wing_area", "m^2", Kind::Number(Range::Positive)),
        parameter("hinge_stiffness", "N*m/rad", Kind::Number(Range::NonNegative)),
        parameter("stroke_offset", "rad", Kind::Number(Range::Any)),
        parameter("hinge_position", "", Kind::Number(Range::Any)),
        parameter("arms", "", Kind::Choice(&["printed", "axis"])),
        parameter("plate_width", "m", Kind::Following(Range::Positive, "half of the length")),
    ],
    presets: &[
        Preset { name: "fly", doc: "", values: || FLY.to_vec() },
        Preset { name: "moth", doc: "", values: || FLY.map(|value| value * 2.0).to_vec() },
    ],
    columns: &COLUMNS,
};

static HOPPER: Fake = Fake {
    name: "hopper",
    parameters: &[parameter("leg_length", "m", Kind::Number(Range::Positive))],
    presets: &[Preset { name: "flea", doc: "", values: || vec![1e-3] }],
    columns: &COLUMNS,
};

pub(crate) static MODELS: [&'static dyn Simulator; 2] = [&FLAPPER, &HOPPER];

/// Index of a parameter of the flapper.
pub(crate) fn index(name: &str) -> usize {
    FLAPPER.parameters.iter().position(|parameter| parameter.name == name).expect(name)
}

/// The plan of a text that is a proper grid file.
pub(crate) fn plan(text: &str) -> Plan {
    flap_sweep::grid::parse("grid.toml", text, &MODELS)
        .unwrap_or_else(|problems| panic!("{text}\n{}", report(&problems)))
}

/// The messages about a text with mistakes.
pub(crate) fn problems(text: &str) -> Mistakes {
    flap_sweep::grid::parse("grid.toml", text, &MODELS)
        .err()
        .unwrap_or_else(|| panic!("no mistake in\n{text}"))
}

/// Diagnostics as plain lines: `line:column |text underlined| message (label)`, then other places, notes and
/// help.
pub(crate) fn report(problems: &[Diagnostic]) -> String {
    let mut lines = Vec::new();
    for problem in problems {
        let text = &problem.source.text;
        let place = format!("{}:{} |{}|", problem.line(), problem.column(), &text[problem.span.clone()]);
        let label = if problem.label.is_empty() { String::new() } else { format!(" ({})", problem.label) };
        lines.push(format!("{place} {}{label}", problem.message));
        for related in &problem.related {
            let line = 1 + text[..related.span.start].matches('\n').count();
            lines.push(format!("  line {line} |{}| ({})", &text[related.span.clone()], related.label));
        }
        lines.extend(problem.notes.iter().map(|note| format!("  note: {note}")));
        lines.extend(problem.help.iter().map(|help| format!("  help: {help}")));
    }
    lines.join("\n")
}
