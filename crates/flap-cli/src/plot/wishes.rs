//! The wishes of the user, as columns of the file, and the measures that are drawn if none is named.

use flap_sweep::picture::measures::{Role, usual};
use flap_sweep::study::control::COMPONENTS;

use crate::args::PlotArgs;
use crate::data::columns;
use crate::data::source::Source;
use crate::failure::Failure;

/// Columns that some kinds need.
const NEEDED: [&str; 7] =
    ["time_s", "stroke_deg", "pitch_deg", "stroke_rate_rad_s", "pitch_rate_rad_s", "branch", "bistable"];

/// The column of `flap vehicle` with the names of inputs.
pub(super) const INPUT: &str = "input";

/// The name in that column of the row of means.
pub(super) const MEAN: &str = "mean";

/// The wishes of the user, as columns of the file.
pub(super) struct Wishes<'a> {
    pub(super) args: &'a PlotArgs,
    names: Vec<String>,
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// Columns that must have a value, with it and with their place.
    pub(super) values: Vec<(String, String)>,
    pub(super) filters: Vec<usize>,
    /// The end of the leading parameters: the place of `status`, or of `branch`.
    pub(super) end: usize,
    /// The measure over a parameter.
    pub(super) response: Option<usize>,
    /// Benefit, cost and size of the motion: three different measures, as long as there are any.
    pub(super) three: [Option<usize>; 3],
}

impl<'a> Wishes<'a> {
    /// Checks the columns that are asked for.
    pub(super) fn of(source: &Source, args: &'a PlotArgs) -> Result<Wishes<'a>, Failure> {
        let find = |name: &Option<String>| name.as_deref().map(|name| source.find(name)).transpose();
        let names = source.names().to_vec();
        let place = |name: &str| names.iter().position(|known| known == name);
        let end = place("branch").or_else(|| place("status")).unwrap_or(0);
        let values = args.values();
        let filters = values.iter().map(|(name, _)| source.find(name)).collect::<Result<_, _>>()?;
        let measures = place("status").map_or(names.len(), |status| status + 1);
        let behind: Vec<&str> = names[measures..].iter().map(String::as_str).collect();
        let mut taken = Vec::new();
        let three = [Role::Benefit, Role::Cost, Role::Motion].map(|role| {
            let found = usual(role, &behind, &taken)?;
            taken.push(behind[found]);
            Some(measures + found)
        });
        Ok(Wishes {
            x: find(&args.x)?,
            y: find(&args.y)?,
            by: find(&args.by)?,
            color: find(&args.color)?,
            response: usual(Role::Response, &behind, &[]).map(|found| measures + found),
            three,
            args,
            values,
            filters,
            end,
            names,
        })
    }

    /// The names of the columns.
    pub(super) fn name(&self, column: usize) -> &str {
        &self.names[column]
    }

    /// The column of that name.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// True if the cells of a column are needed.
    pub(super) fn wants(&self, column: usize) -> bool {
        let [a, b, c] = self.three;
        let some = [self.x, self.y, self.by, self.color, self.response, a, b, c].contains(&Some(column));
        // Behind `branch` is the parameter that rises and falls.
        some || self.filters.contains(&column)
            || column <= self.end + 1
            || self.matrix().is_some()
            || NEEDED.contains(&self.names[column].as_str())
    }

    /// The column with the inputs of a vehicle, if the file has a line for each.
    pub(super) fn matrix(&self) -> Option<usize> {
        let has = |name: &str| self.place(name).is_some();
        let is_matrix = has("unit") && has("value") && COMPONENTS.iter().all(|name| has(name));
        self.place(INPUT).filter(|_| is_matrix)
    }

    /// The first of these columns that is not among those asked for.
    pub(super) fn free(&self, preferred: [Option<usize>; 3]) -> Option<usize> {
        let asked = [self.x, self.y, self.color];
        preferred.into_iter().flatten().find(|column| !asked.contains(&Some(*column)))
    }

    /// The column with the branch of each row of `flap respond`.
    pub(super) fn branch(&self) -> Option<usize> {
        self.place("branch")
    }

    /// The failure of a picture without a column that it needs.
    pub(super) fn unclear(&self, option: &str, why: &str) -> Failure {
        Failure::usage(format!("--{option} is not given, and {why}")).help(self.listed())
    }

    /// The columns, as help.
    pub(super) fn listed(&self) -> String {
        columns::listed(self.names.iter().map(String::as_str))
    }
}
