//! The choice of a picture that suits a file: its kind and columns.

use super::chosen::{Chosen, Columns};
use super::slices::{self, Taken};
use crate::args::{Aim, Filter, PictureKind, PlotArgs};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::Table;
use crate::data::source::Source;
use crate::failure::Failure;

/// Measures that are drawn by default, and columns that some kinds need.
const USUAL: [&str; 9] = [
    "lift_mean_mn",
    "power_mean_mw",
    "stroke_amplitude_deg",
    "time_s",
    "stroke_deg",
    "pitch_deg",
    "stroke_rate_rad_s",
    "pitch_rate_rad_s",
    "branch",
];

/// The wishes of the user, as columns of the file.
pub(super) struct Wishes<'a> {
    args: &'a PlotArgs,
    names: Vec<String>,
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    by: Option<usize>,
    color: Option<usize>,
    /// Columns that must have a value, with it and with their place.
    values: Vec<(String, String)>,
    filters: Vec<usize>,
    /// The end of the leading parameters: the place of `status`, or of `branch`.
    pub(super) end: usize,
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
        Ok(Wishes {
            x: find(&args.x)?,
            y: find(&args.y)?,
            by: find(&args.by)?,
            color: find(&args.color)?,
            args,
            names,
            values,
            filters,
            end,
        })
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// True if the cells of a column are needed.
    pub(super) fn wants(&self, column: usize) -> bool {
        let asked =
            [self.x, self.y, self.by, self.color].contains(&Some(column)) || self.filters.contains(&column);
        // Behind `branch` is the parameter that rises and falls, behind `status` the first measure.
        asked || column <= self.end + 1 || USUAL.contains(&self.names[column].as_str())
    }

    /// Chooses kind, columns and rows.
    pub(super) fn choose(&self, table: &Table, title: String) -> Result<Chosen, Failure> {
        let rows = slices::filtered(table, &self.values)?;
        let axes = Axes::of(table, self.end);
        let columns = self.columns(&axes)?;
        let Columns { kind, x, y, by, .. } = columns;
        let label = |column: usize| table.label(column);
        let mut notes: Vec<String> = (self.filters.iter().zip(&self.values))
            .map(|(&column, (_, value))| match value.parse() {
                Ok(number) => format!("{} {}", label(column).words, label(column).value(number)),
                Err(_) => format!("{} {value}", label(column).words),
            })
            .collect();
        notes.extend(self.args.comparisons().into_iter().map(|filter| match filter {
            Filter::Comparison(text) | Filter::Equal(_, text) => text,
        }));
        let rows = if matches!(kind, PictureKind::Pareto | PictureKind::Trajectory) {
            rows
        } else {
            let shown: Vec<usize> = [Some(x), Some(y), by].into_iter().flatten().collect();
            let slice = slices::sliced(table, &axes.columns, &shown, rows);
            for taken in &slice.taken {
                let Taken { typed, of, .. } = taken;
                console::say(&format!("drawn: {typed}, the middle of {of} values; --where chooses another"));
            }
            notes.extend(slice.taken.into_iter().map(|taken| taken.shown));
            slice.rows
        };
        Ok(Chosen { aims: self.aims(&columns), columns, rows, title, notes })
    }

    /// Chooses kind and columns.
    pub(super) fn columns(&self, axes: &Axes) -> Result<Columns, Failure> {
        let kind = match self.args.kind {
            Some(kind) => kind,
            None => self.kind(axes)?,
        };
        self.refuse_strays(kind)?;
        match kind {
            PictureKind::Response => self.response(axes),
            PictureKind::Map => self.map(axes),
            PictureKind::Pareto => self.pareto(),
            PictureKind::Trajectory => self.trajectory(),
            PictureKind::Hysteresis => self.hysteresis(axes),
        }
    }

    /// The better directions of x and y.
    pub(super) fn aims(&self, columns: &Columns) -> (Aim, Aim) {
        let aim = |asked: Option<Aim>, column: usize| asked.unwrap_or_else(|| Aim::of(&self.names[column]));
        (aim(self.args.x_aim, columns.x), aim(self.args.y_aim, columns.y))
    }

    /// The column with the branch of each row of `flap respond`.
    pub(super) fn branch(&self) -> Option<usize> {
        self.place("branch")
    }

    /// The kind that suits the file and the wishes.
    fn kind(&self, axes: &Axes) -> Result<PictureKind, Failure> {
        let is_parameter = |column: usize| (1..self.end).contains(&column);
        if self.place("branch").is_some() {
            return Ok(PictureKind::Hysteresis);
        }
        let motion = ["time_s", "stroke_deg", "pitch_deg"].iter().all(|name| self.place(name).is_some());
        let asked = self.x.is_some() || self.y.is_some();
        if motion && !asked {
            return Ok(PictureKind::Trajectory);
        }
        match (self.x, self.y) {
            (Some(x), Some(y)) if is_parameter(x) && is_parameter(y) => return Ok(PictureKind::Map),
            (Some(x), Some(y)) if self.end > 0 && !is_parameter(x) && !is_parameter(y) => {
                return Ok(PictureKind::Pareto);
            }
            (Some(_), Some(_)) => return Ok(PictureKind::Response),
            _ => {}
        }
        if self.end == 0 {
            let message = "the file is neither of a sweep nor of a motion: name the columns to draw";
            return Err(Failure::usage(message).help("name columns with --x and --y").help(self.listed()));
        }
        Ok(if axes.sampled {
            PictureKind::Pareto
        } else if self.color.is_some() && axes.columns.len() > 1 {
            PictureKind::Map
        } else if self.by.is_some() || axes.columns.len() < 2 || self.frequency(axes).is_some() {
            PictureKind::Response
        } else {
            PictureKind::Map
        })
    }

    /// Refuses options that this kind does not have.
    fn refuse_strays(&self, kind: PictureKind) -> Result<(), Failure> {
        use PictureKind::{Hysteresis, Map, Pareto, Response, Trajectory};
        let by = matches!(kind, Response | Hysteresis);
        let color = matches!(kind, Map | Pareto);
        let aims = self.args.x_aim.is_some() || self.args.y_aim.is_some();
        let strays = [
            (self.by.is_some() && !by, "--by needs", "--kind response or hysteresis"),
            (self.color.is_some() && !color, "--color needs", "--kind map or pareto"),
            (aims && kind != Pareto, "--x-aim and --y-aim need", "--kind pareto"),
            (
                (self.x.is_some() || self.y.is_some()) && kind == Trajectory,
                "--x and --y need",
                "another kind",
            ),
        ];
        match strays.iter().find(|(stray, ..)| *stray) {
            Some((_, option, home)) => {
                let message = format!("{option} {home}, and this picture is a {}", kind.name());
                Err(Failure::usage(message).help("name the kind with --kind"))
            }
            None => Ok(()),
        }
    }

    fn response(&self, axes: &Axes) -> Result<Columns, Failure> {
        let taken = [self.y, self.by];
        let free = || axes.columns.iter().copied().filter(|column| !taken.contains(&Some(*column)));
        let x = self.x.or_else(|| self.frequency(axes)).or_else(|| free().next_back());
        let x = x.ok_or_else(|| self.unclear("x", "no parameter has more than one value"))?;
        let y = self.y.or_else(|| self.measure("stroke_amplitude_deg"));
        let y = y.ok_or_else(|| self.unclear("y", "the file has no measures"))?;
        let by = self.by.or_else(|| if axes.sampled { None } else { free().find(|&column| column != x) });
        Ok(Columns { kind: PictureKind::Response, x, y, by, color: None })
    }

    fn map(&self, axes: &Axes) -> Result<Columns, Failure> {
        let free = |other: Option<usize>| {
            let taken = [other, self.color];
            axes.columns.iter().copied().filter(move |column| !taken.contains(&Some(*column)))
        };
        let x = self
            .x
            .or_else(|| self.frequency(axes).filter(|&f| self.y != Some(f)))
            .or_else(|| free(self.y).next_back());
        let x = x.ok_or_else(|| self.unclear("x", "no parameter has more than one value"))?;
        let y = self.y.or_else(|| free(Some(x)).next());
        let y = y.ok_or_else(|| self.unclear("y", "a map needs two parameters that vary"))?;
        let color = self.color.or_else(|| self.measure("lift_mean_mn"));
        let color = color.ok_or_else(|| self.unclear("color", "the file has no measures"))?;
        Ok(Columns { kind: PictureKind::Map, x, y, by: None, color: Some(color) })
    }

    fn pareto(&self) -> Result<Columns, Failure> {
        let x = self.x.or_else(|| self.place("lift_mean_mn"));
        let x = x.ok_or_else(|| self.unclear("x", "the file has no lift_mean_mn"))?;
        let y = self.y.or_else(|| self.place("power_mean_mw"));
        let y = y.ok_or_else(|| self.unclear("y", "the file has no power_mean_mw"))?;
        Ok(Columns { kind: PictureKind::Pareto, x, y, by: None, color: self.color })
    }

    fn trajectory(&self) -> Result<Columns, Failure> {
        for name in ["time_s", "stroke_deg", "pitch_deg"] {
            if self.place(name).is_none() {
                let message =
                    format!("a trajectory needs a column {name}, as `flap run --trajectory` writes it");
                return Err(Failure::usage(message).help(self.listed()));
            }
        }
        let time = self.place("time_s").unwrap_or(0);
        Ok(Columns { kind: PictureKind::Trajectory, x: time, y: time, by: None, color: None })
    }

    fn hysteresis(&self, axes: &Axes) -> Result<Columns, Failure> {
        let Some(branch) = self.place("branch") else {
            let message =
                "a picture of hysteresis needs a column `branch`, as `flap respond --out` writes it";
            return Err(Failure::usage(message).help(self.listed()));
        };
        let x = self.x.unwrap_or(branch + 1);
        let y = self.y.or_else(|| self.measure("stroke_amplitude_deg"));
        let y = y.ok_or_else(|| self.unclear("y", "the file has no measures"))?;
        Ok(Columns {
            kind: PictureKind::Hysteresis,
            x,
            y,
            by: self.by.or_else(|| axes.columns.first().copied()),
            color: None,
        })
    }

    fn frequency(&self, axes: &Axes) -> Option<usize> {
        self.place("drive_frequency").filter(|column| axes.columns.contains(column))
    }

    /// The measure of that name, or the first one.
    fn measure(&self, name: &str) -> Option<usize> {
        let first = self.place("status").map(|status| status + 1);
        self.place(name).or(first.filter(|&first| first < self.names.len()))
    }

    fn unclear(&self, option: &str, why: &str) -> Failure {
        Failure::usage(format!("--{option} is not given, and {why}")).help(self.listed())
    }

    fn listed(&self) -> String {
        format!("the columns are {}", self.names.join(", "))
    }
}
