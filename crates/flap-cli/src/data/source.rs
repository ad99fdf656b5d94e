//! Reads results files into columns of numbers and words.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use csv::StringRecord;
use flap_sweep::files::beside::sidecar_of;
use flap_sweep::files::integrity::{self, Note, Opened};
use flap_sweep::files::record::other_separator;
use flap_sweep::files::results::Reader;
use flap_sweep::files::sidecar::Sidecar;
use flap_sweep::plan::Plan;
use flap_sweep::plan::axes::Values;
use flap_sweep::table::labels;
use flap_sweep::table::layout::{CellKind, Layout};

use super::columns::{self, Cells, Column, NO_WORD, RefinedAxis, Table};
use crate::args::ReadArgs;
use crate::failure::Failure;
use crate::{console, job, models};

/// Largest number of rows that flap reads, because flap keeps all numbers of these rows in memory.
const MOST_ROWS: usize = 20_000_000;

/// An open results file whose header has been read.
pub(crate) struct Source {
    reader: Reader,
    units: Units,
    /// Names of the columns with true and false that the sidecar lists. Empty without a sidecar.
    flags: Vec<String>,
    /// Names of the sampled parameters, which the sidecar lists. `None` means that flap does not know whether
    /// the points are a sample.
    sample: Option<Vec<String>>,
    /// Names of the derived parameters that the sidecar lists. Empty without a sidecar.
    derived: Vec<String>,
    /// Axes along which the sweep added points. Empty without a sidecar.
    refined: Vec<RefinedAxis>,
    /// The plan with which the results were computed, from the sidecar.
    plan: Option<Plan>,
    path: PathBuf,
    is_verbose: bool,
}

impl Source {
    /// Opens a results file and reads its header. If `is_verbose` is true, prints notes and warnings about
    /// the results to stderr.
    pub(crate) fn open(path: &Path, read: &ReadArgs, is_verbose: bool) -> Result<Source, Failure> {
        Failure::unless_results(path)?;
        let opened = integrity::open(path, read.on_damage())?;
        job::require_checkpoint(path, &opened)?;
        let Opened { reader, sidecar, notes } = opened;
        if is_verbose {
            // Only sweeps write sidecars, but motions and responses can be drawn too.
            let is_sweep =
                ["point", "status"].iter().all(|name| reader.names().iter().any(|own| own == name));
            let is_printed = |note: &&Note| is_sweep || !matches!(note, Note::Unverified { .. });
            notes.iter().filter(is_printed).for_each(job::tell);
        }
        if reader.names().iter().all(String::is_empty) {
            return Err(Failure::usage(format!("{} has no columns", path.display())));
        }
        if let Some(mistake) = other_separator(reader.names()) {
            return Err(Failure::usage(format!("{}: {mistake}", path.display())));
        }
        let plan = plan_beside(path, sidecar.as_ref());
        let units = Units::of(plan.as_ref());
        let flags = plan.as_ref().map(flags).unwrap_or_default();
        let sample = plan.as_ref().and_then(sampled);
        let derived = plan.as_ref().map(derived).unwrap_or_default();
        let refined = plan.as_ref().map(refined).unwrap_or_default();
        Ok(Source { reader, units, flags, sample, derived, refined, plan, path: path.to_owned(), is_verbose })
    }

    pub(crate) fn names(&self) -> &[String] {
        self.reader.names()
    }

    /// Returns the position of the column `name`, if the file has this column.
    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.names().iter().position(|known| known == name)
    }

    /// Returns the position of the column `name`, or an error that suggests a similar name or lists all
    /// names.
    pub(crate) fn find(&self, name: &str) -> Result<usize, Failure> {
        columns::find(self.names().iter().map(String::as_str), name)
    }

    /// Returns the unit of a column as text; empty for a column without a unit.
    pub(crate) fn unit(&self, column: usize) -> String {
        self.units.of_column(&self.names()[column])
    }

    /// Returns the names of the columns that contain true and false.
    pub(crate) fn flags(&self) -> &[String] {
        &self.flags
    }

    /// Returns true if the sidecar lists this column as a sampled or derived parameter. Such parameters are
    /// not axes.
    pub(crate) fn is_no_axis(&self, name: &String) -> bool {
        self.sample.iter().flatten().chain(&self.derived).any(|known| known == name)
    }

    /// Reads the next row into `row`; returns false after the last row.
    pub(crate) fn next(&mut self, row: &mut StringRecord) -> Result<bool, Failure> {
        let found = self
            .reader
            .next(row)
            .map_err(|error| Failure::system(format!("cannot read {}: {error}", self.path.display())))?;
        if !found && self.is_verbose {
            job::tell_missed(&self.path, &self.reader);
        }
        Ok(found)
    }

    /// Returns the plan with which the results were computed, and `None` at later calls. The result is also
    /// `None` without a usable sidecar.
    pub(crate) fn take_plan(&mut self) -> Option<Plan> {
        self.plan.take()
    }

    /// Returns the path of the results file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Reads the rows that `keep` accepts, with the cells of `wanted` columns.
    ///
    /// If `keep` accepts more than `most` rows, the function keeps only every second accepted row, or every
    /// fourth or eighth row, and so on.
    pub(crate) fn read_kept(
        mut self,
        wanted: impl Fn(usize) -> bool,
        most: usize,
        mut keep: impl FnMut(&StringRecord) -> Result<bool, Failure>,
    ) -> Result<Table, Failure> {
        let names = self.reader.names().to_vec();
        let mut columns: Vec<Gathered> = (0..names.len()).map(|index| Gathered::new(wanted(index))).collect();
        let mut row = StringRecord::new();
        let (mut rows, mut of, mut stride) = (0, 0, 1);
        let name = self.path.display().to_string();
        while self.next(&mut row)? {
            if !keep(&row)? {
                continue;
            }
            if rows == most {
                columns.iter_mut().for_each(Gathered::halve);
                rows = rows.div_ceil(2);
                stride *= 2;
            }
            if rows == MOST_ROWS {
                let message = format!("{name} has more than {MOST_ROWS} rows");
                return Err(Failure::usage(message).help("read one of its shards, or sweep fewer points"));
            }
            if of % stride == 0 {
                for (column, cell) in columns.iter_mut().zip(&row) {
                    column.push(cell, rows);
                }
                rows += 1;
            }
            of += 1;
        }
        let columns = names.into_iter().zip(columns).map(|(name, gathered)| {
            let unit = self.units.of_column(&name);
            Column { name, unit, cells: gathered.cells }
        });
        Ok(Table {
            columns: columns.collect(),
            rows,
            of,
            sample: self.sample,
            derived: self.derived,
            refined: self.refined,
        })
    }
}

/// A column of a file that flap is reading: the cells of the rows so far.
struct Gathered {
    cells: Cells,
    codes: HashMap<String, u32>,
    /// Texts of the first cells of a column of numbers. If a later cell is a word, flap treats the texts of
    /// the earlier cells as words too.
    texts: StringRecord,
}

/// In a column of numbers, flap stores the texts of at most this number of cells. The texts need more memory
/// than the numbers.
const MOST_TEXTS: usize = 100_000;

impl Gathered {
    fn new(wanted: bool) -> Gathered {
        let cells = if wanted { Cells::Numbers(Vec::new()) } else { Cells::Unread };
        Gathered { cells, codes: HashMap::new(), texts: StringRecord::new() }
    }

    /// Adds the cell of row number `row`.
    fn push(&mut self, cell: &str, row: usize) {
        if let Cells::Numbers(values) = &mut self.cells {
            match cell.parse() {
                Ok(value) => values.push(value),
                Err(_) if cell.is_empty() => values.push(f64::NAN),
                Err(_) => self.turn_to_words(row),
            }
            if self.texts.len() == row && row < MOST_TEXTS {
                self.texts.push_field(cell);
            }
        }
        if let Cells::Words { codes, words } = &mut self.cells
            && codes.len() == row
        {
            codes.push(code(cell, words, &mut self.codes));
        }
    }

    /// Removes every second cell.
    fn halve(&mut self) {
        fn every_second<T: Copy>(cells: &mut Vec<T>) {
            *cells = cells.iter().step_by(2).copied().collect();
        }
        match &mut self.cells {
            Cells::Numbers(values) => {
                every_second(values);
                self.texts = self.texts.iter().step_by(2).collect();
            }
            Cells::Words { codes, .. } => every_second(codes),
            Cells::Unread => {}
        }
    }

    /// Converts the first `rows` cells, which are numbers or empty, to words, because the next cell is a
    /// word.
    fn turn_to_words(&mut self, rows: usize) {
        let Cells::Numbers(values) = &self.cells else { return };
        let mut words = Vec::new();
        let text = |value: &f64| if value.is_nan() { String::new() } else { value.to_string() };
        let rest = values.iter().take(rows).skip(self.texts.len()).map(text);
        let texts = self.texts.iter().map(ToOwned::to_owned).chain(rest);
        let codes = texts.map(|text| code(&text, &mut words, &mut self.codes)).collect();
        self.cells = Cells::Words { codes, words };
    }
}

fn code(cell: &str, words: &mut Vec<String>, codes: &mut HashMap<String, u32>) -> u32 {
    if cell.is_empty() {
        return NO_WORD;
    }
    if let Some(code) = codes.get(cell) {
        return *code;
    }
    // A file with more than four thousand million different words does not fit into memory.
    let code = u32::try_from(words.len()).unwrap_or(NO_WORD);
    words.push(cell.to_owned());
    codes.insert(cell.to_owned(), code);
    code
}

/// Returns the plan of a results file, if the sidecar of the file contains a usable plan.
fn plan_beside(results: &Path, sidecar: Option<&Sidecar>) -> Option<Plan> {
    let beside = sidecar_of(results);
    let plan = job::plan_of(&beside, sidecar?).ok();
    if plan.is_none() {
        console::say(&format!(
            "{} cannot be used: units are taken from the names of columns",
            beside.display()
        ));
    }
    plan
}

/// Returns the names of the sampled parameters of a plan. The result is `None` if no parameter is sampled but
/// an axis lists values of several parameters. An axis that lists values of several parameters may contain
/// the points of a sample.
fn sampled(plan: &Plan) -> Option<Vec<String>> {
    let parameters = plan.parameters();
    let is_sampled = |values: &Values| matches!(values, Values::Sampled { .. } | Values::Correlated { .. });
    let sampled = plan.axes().parameters().filter(|(_, values)| is_sampled(values));
    let sampled: Vec<String> = sampled.map(|&(place, _)| parameters[place].name.to_owned()).collect();
    let is_listed = plan.axes().as_slice().iter().any(|axis| axis.parameters().len() > 1);
    (!sampled.is_empty() || !is_listed).then_some(sampled)
}

/// Returns the names of the columns of a plan's rows that contain true and false.
fn flags(plan: &Plan) -> Vec<String> {
    let columns = Layout::of(plan).columns().into_iter();
    columns.filter(|column| column.kind == CellKind::Flag).map(|column| column.name).collect()
}

/// Returns the names of the derived parameters of a plan.
fn derived(plan: &Plan) -> Vec<String> {
    plan.derived().parameters().map(|place| plan.parameters()[place].name.to_owned()).collect()
}

/// Returns the axes along which the refinement of a plan adds points.
fn refined(plan: &Plan) -> Vec<RefinedAxis> {
    let along = plan.refine().map(|refine| refine.along.as_slice()).unwrap_or_default();
    let parameters = along.iter().flat_map(|&axis| plan.axes().as_slice()[axis].parameters());
    let axis = |(parameter, values): &(usize, Values)| RefinedAxis {
        name: plan.parameters()[*parameter].name.to_owned(),
        log: matches!(values, Values::Log { .. }),
        cells: values.len() - 1,
    };
    parameters.map(axis).collect()
}

/// The units of columns, from the plan in the sidecar. Without a sidecar, flap takes the units from the
/// models and from the endings of the column names.
struct Units(BTreeMap<String, String>);

impl Units {
    fn of(plan: Option<&Plan>) -> Units {
        let columns = plan.map(|plan| Layout::of(plan).columns()).unwrap_or_default();
        Units(columns.into_iter().map(|column| (column.name, column.unit.into_owned())).collect())
    }

    fn of_column(&self, name: &str) -> String {
        self.0.get(name).cloned().unwrap_or_else(|| labels::unit_of(name, models::all()).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gathered(cells: &[&str]) -> Cells {
        let mut column = Gathered::new(true);
        for (row, cell) in cells.iter().enumerate() {
            column.push(cell, row);
        }
        column.cells
    }

    #[test]
    fn cells_are_numbers_as_long_as_none_is_a_word() {
        let Cells::Numbers(values) = gathered(&["1", "", "2.5e-3"]) else { panic!("numbers") };
        assert_eq!((values[0], values[2]), (1.0, 2.5e-3));
        assert!(values[1].is_nan());
    }

    #[test]
    fn words_have_codes() {
        let words = gathered(&["", "up", "down", "up"]);
        let codes = vec![NO_WORD, 0, 1, 0];
        assert_eq!(words, Cells::Words { codes, words: vec!["up".to_owned(), "down".to_owned()] });
        assert_eq!(
            gathered(&["3.0", "", "up"]),
            Cells::Words { codes: vec![0, NO_WORD, 1], words: vec!["3.0".to_owned(), "up".to_owned()] }
        );
    }

    #[test]
    fn halves_keep_the_first() {
        let mut column = Gathered::new(true);
        for row in 0..5 {
            column.push(&row.to_string(), row);
        }
        column.halve();
        assert_eq!(column.cells, Cells::Numbers(vec![0.0, 2.0, 4.0]));
        column.push("up", 3);
        let words = ["0", "2", "4", "up"].map(ToOwned::to_owned).to_vec();
        assert_eq!(column.cells, Cells::Words { codes: vec![0, 1, 2, 3], words });
    }

    #[test]
    fn cells_that_nobody_wants_are_not_kept() {
        let mut column = Gathered::new(false);
        column.push("1", 0);
        assert_eq!(column.cells, Cells::Unread);
    }

    #[test]
    fn units_come_from_the_models_and_from_names() {
        let units = Units(BTreeMap::from([("lift_mean_mn".to_owned(), "N".to_owned())]));
        assert_eq!(units.of_column("lift_mean_mn"), "N", "the sidecar comes first");
        assert_eq!(units.of_column("hinge_stiffness"), "N*m/rad");
        assert_eq!(units.of_column("efficiency_gf_per_w"), "gf/W");
        assert_eq!(units.of_column("my_own_ms"), "ms");
        assert_eq!(units.of_column("rhs_evals"), "");
    }
}
