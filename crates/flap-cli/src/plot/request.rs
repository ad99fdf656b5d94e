//! The picture that the user requested. Columns are given by their positions in the file.

use flap_sweep::derivative;
use flap_sweep::picture::measures::{Role, usual};
use flap_sweep::vehicle::control::COMPONENTS;

use crate::args::PlotArgs;
use crate::data::columns;
use crate::data::source::Source;
use crate::failure::Failure;

/// Columns that flap always reads, because some kinds of pictures require them.
const NEEDED: [&str; 7] =
    ["time_s", "stroke_deg", "pitch_deg", "stroke_rate_rad_s", "pitch_rate_rad_s", "branch", "bistable"];

/// The name of the column that contains the names of the inputs in the output of `flap vehicle`.
pub(super) const INPUT: &str = "input";

/// The row with the mean force and torque has this word in the column `input`.
pub(super) const MEAN: &str = "mean";

/// The picture that the user requested. Columns are given by their positions in the file.
pub(super) struct Request<'a> {
    pub(super) args: &'a PlotArgs,
    names: Vec<String>,
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// The columns and values of the conditions `COLUMN=VALUE`.
    pub(super) filters: Vec<(usize, String)>,
    /// The axes of `--best-over`.
    pub(super) best_over: Vec<usize>,
    /// The columns from 1 to `parameters_end` - 1 are parameters, and the column `parameters_end` is `branch`
    /// or `status`. If the file has neither column, `parameters_end` is 0.
    pub(super) parameters_end: usize,
    /// The measure that a response picture shows over a parameter by default.
    pub(super) response: Option<usize>,
    /// The default measures for the roles benefit, cost, and size of the motion. All three measures differ,
    /// and a measure is `None` if the file has no column for its role.
    pub(super) measures: [Option<usize>; 3],
}

impl<'a> Request<'a> {
    /// Finds the columns that the user requested, or returns an error if the file lacks one of these columns.
    pub(super) fn of(source: &Source, args: &'a PlotArgs) -> Result<Request<'a>, Failure> {
        let find = |name: &Option<String>| name.as_deref().map(|name| source.find(name)).transpose();
        // Other columns of text, such as `device`, are horizontal axes.
        if args.x.as_deref() == Some("status") {
            return Err(columns::no_numbers("status"));
        }
        let names = source.names().to_vec();
        let first_measure = source.position("status").map_or(names.len(), |status| status + 1);
        let measured: Vec<&str> = names[first_measure..].iter().map(String::as_str).collect();
        let mut taken = Vec::new();
        let measures = [Role::Benefit, Role::Cost, Role::Motion].map(|role| {
            let found = usual(role, &measured, &taken)?;
            taken.push(measured[found]);
            Some(first_measure + found)
        });
        let filters = args.values().into_iter().map(|(name, value)| Ok((source.find(&name)?, value)));
        Ok(Request {
            filters: filters.collect::<Result<_, Failure>>()?,
            best_over: args.best_over.iter().map(|name| source.find(name)).collect::<Result<_, _>>()?,
            x: find(&args.x)?,
            y: find(&args.y)?,
            by: find(&args.by)?,
            color: find(&args.color)?,
            response: usual(Role::Response, &measured, &[]).map(|found| first_measure + found),
            measures,
            args,
            parameters_end: source.position("branch").or_else(|| source.position("status")).unwrap_or(0),
            names,
        })
    }

    /// Returns the name of the column at a position.
    pub(super) fn name(&self, column: usize) -> &str {
        &self.names[column]
    }

    /// Returns the names of the given columns as text, separated by commas.
    pub(super) fn listed(&self, columns: &[usize]) -> String {
        columns.iter().map(|&column| self.name(column)).collect::<Vec<_>>().join(", ")
    }

    /// Returns the position of the column `name`, if the file has this column.
    pub(super) fn position(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Returns true if the picture may use the cells of a column.
    pub(super) fn uses(&self, column: usize) -> bool {
        let [a, b, c] = self.measures;
        let some = [self.x, self.y, self.by, self.color, self.response, a, b, c].contains(&Some(column));
        // The column after `branch` is the followed parameter.
        some || self.filters.iter().any(|(filtered, _)| *filtered == column)
            || self.best_over.contains(&column)
            || column <= self.parameters_end + 1
            // The columns before the time name the motions.
            || self.position("time_s").is_some_and(|time| column < time)
            || self.matrix().is_some()
            || (self.args.derivatives && derivative::parts(&self.names[column]).is_some())
            || NEEDED.contains(&self.names[column].as_str())
    }

    /// Returns the column `input` if the file is the control matrix of a vehicle.
    pub(super) fn matrix(&self) -> Option<usize> {
        let has = |name: &str| self.position(name).is_some();
        let is_matrix = has("unit") && has("value") && COMPONENTS.iter().all(|name| has(name));
        self.position(INPUT).filter(|_| is_matrix)
    }

    /// Returns the first column in `preferred` that the user did not request and that `taken` does not
    /// contain.
    pub(super) fn free(&self, preferred: [Option<usize>; 3], taken: &[usize]) -> Option<usize> {
        let asked = [self.x, self.y, self.color];
        let is_free = |column: &usize| !asked.contains(&Some(*column)) && !taken.contains(column);
        preferred.into_iter().flatten().find(is_free)
    }

    /// Returns the column `branch` in results of `flap respond`.
    pub(super) fn branch(&self) -> Option<usize> {
        self.position("branch")
    }

    /// Returns true if the user gave `--x-aim` or `--y-aim`.
    pub(super) fn has_aims(&self) -> bool {
        self.args.x_aim.is_some() || self.args.y_aim.is_some()
    }

    /// Returns `column`, or a failure if it is `None`. The message of the failure contains `--option` and the
    /// reason `why`.
    pub(super) fn required(&self, option: &str, column: Option<usize>, why: &str) -> Result<usize, Failure> {
        column.ok_or_else(|| self.unsuitable(format!("--{option} is not given, and {why}")))
    }

    /// Returns the failure for a picture that flap cannot draw from this file. The help line lists the
    /// columns of the file.
    pub(super) fn unsuitable(&self, message: impl Into<String>) -> Failure {
        Failure::usage(message).help(columns::listed(self.names.iter().map(String::as_str)))
    }
}
