//! The request of the user, as columns of the file.

use flap_sweep::derivative;
use flap_sweep::picture::measures::{Role, usual};
use flap_sweep::vehicle::control::COMPONENTS;

use crate::args::PlotArgs;
use crate::data::columns;
use crate::data::source::Source;
use crate::failure::Failure;

/// Columns that some kinds of pictures require.
const NEEDED: [&str; 7] =
    ["time_s", "stroke_deg", "pitch_deg", "stroke_rate_rad_s", "pitch_rate_rad_s", "branch", "bistable"];

/// The column with the names of inputs in the output of `flap vehicle`.
pub(super) const INPUT: &str = "input";

/// The name of the row of means in the column of inputs.
pub(super) const MEAN: &str = "mean";

/// The request of the user, as columns of the file.
pub(super) struct Request<'a> {
    pub(super) args: &'a PlotArgs,
    names: Vec<String>,
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// Columns that must have a given value, with this value.
    pub(super) filters: Vec<(usize, String)>,
    /// Axes over which the best rows are drawn.
    pub(super) best_over: Vec<usize>,
    /// The columns 1 to `parameters_end`, exclusive, are parameters. This column is `branch` or `status`; 0 if the file has
    /// neither.
    pub(super) parameters_end: usize,
    /// The measure that is drawn over a parameter.
    pub(super) response: Option<usize>,
    /// Measures for benefit, cost and size of the motion. No column has two roles. `None` if the file has
    /// no column for a role.
    pub(super) measures: [Option<usize>; 3],
}

impl<'a> Request<'a> {
    /// Checks the columns that the user requested.
    pub(super) fn of(source: &Source, args: &'a PlotArgs) -> Result<Request<'a>, Failure> {
        let find = |name: &Option<String>| name.as_deref().map(|name| source.find(name)).transpose();
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

    /// Returns the name of a column.
    pub(super) fn name(&self, column: usize) -> &str {
        &self.names[column]
    }

    /// Returns the names of columns, separated by commas.
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

    /// Returns the column with the inputs of a vehicle, if the file has one line for each input.
    pub(super) fn matrix(&self) -> Option<usize> {
        let has = |name: &str| self.position(name).is_some();
        let is_matrix = has("unit") && has("value") && COMPONENTS.iter().all(|name| has(name));
        self.position(INPUT).filter(|_| is_matrix)
    }

    /// Returns the first of the given columns that neither the user requested nor `taken` contains.
    pub(super) fn free(&self, preferred: [Option<usize>; 3], taken: &[usize]) -> Option<usize> {
        let asked = [self.x, self.y, self.color];
        let is_free = |column: &usize| !asked.contains(&Some(*column)) && !taken.contains(column);
        preferred.into_iter().flatten().find(is_free)
    }

    /// Returns the column with the branch of each row of `flap respond`.
    pub(super) fn branch(&self) -> Option<usize> {
        self.position("branch")
    }

    /// Returns true if the user set a better direction.
    pub(super) fn has_aims(&self) -> bool {
        self.args.x_aim.is_some() || self.args.y_aim.is_some()
    }

    /// Returns the column of `--option`. If the column is missing, the failure contains the reason `why`.
    pub(super) fn required(&self, option: &str, column: Option<usize>, why: &str) -> Result<usize, Failure> {
        column.ok_or_else(|| self.unsuitable(format!("--{option} is not given, and {why}")))
    }

    /// Returns the failure of a picture that does not suit the file. The help lists the columns of the file.
    pub(super) fn unsuitable(&self, message: impl Into<String>) -> Failure {
        Failure::usage(message).help(columns::listed(self.names.iter().map(String::as_str)))
    }
}
