//! Pictures of maps: the colours of cells show a measure over two parameters.

use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene};

use flap_sweep::picture::colours;
use flap_sweep::picture::scale::is_log;

use super::canvas::Size;
use super::ink;
use super::kind::Columns;
use super::nearest::nearest;
use super::panel::{Axis, Panel};
use super::scale;
use super::selection::Selection;
use super::shades::{self, Shades};
use crate::data::columns::{RefinedAxis, Table};
use crate::data::levels::{Levels, Values};
use crate::failure::Failure;

/// Largest number of cells in a picture, which is about the number of pixels of a usual picture.
const MOST_CELLS: usize = 500_000;

/// A coloured cell: the positions of its sides in the units of the axes, and its value in the unit of the
/// colour bar.
struct Cell {
    x: [f64; 2],
    y: [f64; 2],
    value: f64,
}

/// The cells of a map, and the axes of the map.
struct Grid {
    cells: Vec<Cell>,
    x: Axis,
    y: Axis,
}

/// Draws the column `color` as the colour of cells over the columns `x` and `y`.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let Columns { x, y, color: Some(color), .. } = selection.columns else {
        return Err(Failure::Bug("a map without a colour".to_owned()));
    };
    let branch = table.columns.iter().position(|column| column.name == "branch");
    let followed = branch.map(|branch| branch + 1);
    // Parameters whose values differ from line to line.
    let [free_x, free_y] = [x, y].map(|column| followed == Some(column) || axis_of(table, column).is_some());
    let grid = match (free_x, free_y) {
        (true, true) => nearest_cells(table, selection, color)?,
        (true, false) => curves(table, selection, [x, y], color)?,
        (false, true) => curves(table, selection, [y, x], color)?.transposed(),
        (false, false) => grid(table, selection, color)?,
    };
    let label = table.label(color);
    let Some(range) = scale::range(grid.cells.iter().map(|cell| cell.value)) else {
        return Err(selection.no_numbers(table, color));
    };
    let bar = Axis::linear(label.text(), scale::padded(range, 0.0));
    let missing = grid.cells.iter().filter(|cell| !cell.value.is_finite()).count();

    let mut notes = selection.notes.clone();
    if missing > 0 {
        notes.push(format!("{missing} of {} cells without a value", grid.cells.len()));
    }
    let Grid { cells, x, y } = grid;
    let panel =
        Panel { title: selection.title.clone(), notes, x, y, plots: Vec::new(), legend: None, bar: true };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let ends = (panel.x.range.1, panel.y.range.0);
    let mut scene = panel.scene(size);
    scene.add(drawn(&cells, ends, &frame, &Shades::of(bar.range)));
    ink::frame_lines(&mut scene, &frame);
    shades::colour_bar(&mut scene, &frame, &bar, (missing > 0).then_some("no value"));
    Ok(scene)
}

impl Grid {
    /// Exchanges the horizontal and the vertical axis.
    fn transposed(self) -> Grid {
        let cells = self.cells.into_iter().map(|cell| Cell { x: cell.y, y: cell.x, ..cell });
        Grid { cells: cells.collect(), x: self.y, y: self.x }
    }
}

/// If the sweep added points along the axis of a column, returns this refined axis.
fn axis_of(table: &Table, column: usize) -> Option<&RefinedAxis> {
    table.refined.iter().find(|axis| axis.name == table.columns[column].name)
}

/// Returns the cells of a map for points that form no grid. Every position of the map has the colour of the
/// nearest point.
///
/// The unit of distances along an axis is the interval between neighbouring values of the axis in the grid
/// file.
fn nearest_cells(table: &Table, selection: &Selection, color: usize) -> Result<Grid, Failure> {
    let columns = [selection.columns.x, selection.columns.y];
    let [across, up] = columns.map(|column| {
        let (label, log) = (table.label(column), axis_of(table, column).is_some_and(|axis| axis.log));
        let places = table.numbers(column)?;
        let places: Vec<f64> = selection.rows.iter().map(|&row| places[row] * label.factor).collect();
        let range = scale::range(places.iter().copied()).unwrap_or((0.0, 1.0));
        Ok::<_, Failure>((places, Axis { log: log && range.0 > 0.0, ..Axis::linear(label.text(), range) }))
    });
    let ((x, across), (y, up)) = (across?, up?);
    let mut keys: Vec<(u64, u64)> = x.iter().zip(&y).map(|(x, y)| (x.to_bits(), y.to_bits())).collect();
    keys.sort_unstable();
    if keys.windows(2).any(|two| two[0] == two[1]) {
        return Err(several_rows(table, selection));
    }
    let points: Vec<[f64; 2]> =
        x.iter().zip(&y).map(|(x, y)| [fraction(&across, *x), fraction(&up, *y)]).collect();
    let (colours, factor) = (table.numbers(color)?, table.label(color).factor);
    let cells = columns.map(|column| axis_of(table, column).map_or(1.0, |axis| axis.cells as f64));
    let owners = nearest(&points, cells, RASTER);
    let cell = |rectangle: Rectangle| Cell {
        x: rectangle.columns.map(|column| value_at(&across, column as f64 / RASTER[0] as f64)),
        y: rectangle.rows.map(|row| value_at(&up, row as f64 / RASTER[1] as f64)),
        value: colours[selection.rows[rectangle.owner]] * factor,
    };
    let cells = rectangles(&owners, RASTER[0]).into_iter().map(cell).collect();
    Ok(Grid { cells, x: across, y: up })
}

/// Number of raster positions in the horizontal and the vertical direction. The plot area of a usual picture
/// has about one pixel per raster position.
const RASTER: [usize; 2] = [720, 480];

/// Returns the position of a value on an axis, as a fraction from 0 to 1.
fn fraction(axis: &Axis, value: f64) -> f64 {
    let to = |value: f64| if axis.log { value.ln() } else { value };
    let (low, high) = (to(axis.range.0), to(axis.range.1));
    if high > low { (to(value) - low) / (high - low) } else { 0.5 }
}

/// Returns the value at a position on an axis. The position is a fraction from 0 to 1.
fn value_at(axis: &Axis, fraction: f64) -> f64 {
    let (low, high) = axis.range;
    if axis.log { low * (high / low).powf(fraction) } else { low + (high - low) * fraction }
}

/// A rectangle of raster positions that have the same nearest point, `owner`. The first number of
/// `columns` and `rows` belongs to the rectangle, and the second number does not.
#[derive(Clone, Debug, PartialEq)]
struct Rectangle {
    columns: [usize; 2],
    rows: [usize; 2],
    owner: usize,
}

/// Combines raster positions with the same nearest point into rectangles. The raster has `columns` positions
/// per row.
fn rectangles(owners: &[usize], columns: usize) -> Vec<Rectangle> {
    let mut done: Vec<Rectangle> = Vec::new();
    // Rectangles that may continue in the next row, by their first column.
    let mut open: Vec<Rectangle> = Vec::new();
    for (row, owners) in owners.chunks(columns).enumerate() {
        let mut next = Vec::new();
        let mut first = 0;
        for run in owners.chunk_by(|a, b| a == b) {
            let (sides, owner) = ([first, first + run.len()], run[0]);
            first += run.len();
            let above = open.iter().position(|other| other.columns == sides && other.owner == owner);
            let mut rectangle = match above {
                Some(above) => open.swap_remove(above),
                None => Rectangle { columns: sides, rows: [row, row], owner },
            };
            rectangle.rows[1] = row + 1;
            next.push(rectangle);
        }
        done.append(&mut open);
        open = next;
    }
    done.append(&mut open);
    done
}

/// Returns the cells of a map for points that form a grid, in which every value of `x` is combined with every
/// value of `y`.
fn grid(table: &Table, selection: &Selection, color: usize) -> Result<Grid, Failure> {
    let [across, up] =
        [selection.columns.x, selection.columns.y].map(|column| side(table, selection, column));
    let (across, up) = (across?, up?);
    let colours = table.numbers(color)?;
    let columns = across.edges.len() - 1;
    let count = columns * (up.edges.len() - 1);
    check_count(count, &format!("{columns} times {}", up.edges.len() - 1))?;
    let factor = table.label(color).factor;
    let mut values: Vec<Option<f64>> = vec![None; count];
    for (place, &row) in selection.rows.iter().enumerate() {
        let cell = &mut values[up.codes[place] * columns + across.codes[place]];
        if cell.is_some() {
            return Err(several_rows(table, selection));
        }
        *cell = Some(colours[row] * factor);
    }
    let cell = |(place, value): (usize, Option<f64>)| Cell {
        x: [0, 1].map(|end| across.edges[place % columns + end]),
        y: [0, 1].map(|end| up.edges[place / columns + end]),
        value: value.unwrap_or(f64::NAN),
    };
    Ok(Grid { cells: values.into_iter().enumerate().map(cell).collect(), x: across.axis, y: up.axis })
}

/// Returns the cells of a map for points that form curves. Each curve extends along the first of `columns`
/// and has one value of the second column.
///
/// Different curves have different values of the first column in results of `flap respond`, and in sweeps
/// that refine only the first column. The boundaries of the cells are halfway between the values of a curve.
fn curves(table: &Table, selection: &Selection, columns: [usize; 2], color: usize) -> Result<Grid, Failure> {
    let [along, across] = columns;
    let side = side(table, selection, across)?;
    let (places, colours) = (table.numbers(along)?, table.numbers(color)?);
    let (label, factor) = (table.label(along), table.label(color).factor);
    check_count(selection.rows.len(), &selection.rows.len().to_string())?;
    let mut cells = Vec::new();
    for code in 0..side.edges.len() - 1 {
        let of_curve = selection.rows.iter().zip(&side.codes).filter(|(_, other)| **other == code);
        let mut curve: Vec<(f64, f64)> =
            of_curve.map(|(&row, _)| (places[row] * label.factor, colours[row] * factor)).collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        if curve.windows(2).any(|two| two[0].0 == two[1].0) {
            return Err(several_rows(table, selection));
        }
        let places: Vec<f64> = curve.iter().map(|(place, _)| *place).collect();
        let edges = edges(&places, false);
        let sides = edges.windows(2).zip(&curve);
        cells.extend(sides.map(|(sides, &(_, value))| Cell {
            x: [sides[0], sides[1]],
            y: [side.edges[code], side.edges[code + 1]],
            value,
        }));
    }
    let range = scale::range(cells.iter().flat_map(|cell| cell.x)).unwrap_or((0.0, 1.0));
    Ok(Grid { cells, x: Axis::linear(label.text(), range), y: side.axis })
}

/// The boundaries of the cells along an axis, and for each row of the table the index of its cell.
struct Side {
    edges: Vec<f64>,
    codes: Vec<usize>,
    axis: Axis,
}

fn side(table: &Table, selection: &Selection, column: usize) -> Result<Side, Failure> {
    // Words have no position on an axis.
    table.numbers(column)?;
    let Levels { codes, values: Values::Numbers(values) } = Levels::of(table, column, &selection.rows) else {
        return Err(Failure::Bug("numbers without values".to_owned()));
    };
    let label = table.label(column);
    let log = is_log(&values);
    let scaled: Vec<f64> = values.iter().map(|value| value * label.factor).collect();
    let edges = edges(&scaled, log);
    let axis = Axis { log, ..Axis::linear(label.text(), (edges[0], edges[edges.len() - 1])) };
    Ok(Side { edges, codes, axis })
}

fn check_count(count: usize, shown: &str) -> Result<(), Failure> {
    if count <= MOST_CELLS {
        return Ok(());
    }
    let message = format!("a map of {shown} cells is too large for a picture");
    Err(Failure::usage(message).help(
        "draw a sample with --kind scatter, choose one value of an axis with --where, or write a page with --html",
    ))
}

fn several_rows(table: &Table, selection: &Selection) -> Failure {
    let [x, y] = [selection.columns.x, selection.columns.y].map(|column| table.columns[column].name.as_str());
    let message = format!("several rows have the same {x} and {y}");
    Failure::usage(message).help("choose one value of each of the other parameters with --where")
}

/// Returns the boundaries of the cells along an axis. Inner boundaries are halfway between neighbouring
/// values. The first and the last value are in the middle of their cells.
fn edges(values: &[f64], log: bool) -> Vec<f64> {
    let to = |value: f64| if log { value.ln() } else { value };
    let from = |place: f64| if log { place.exp() } else { place };
    let places: Vec<f64> = values.iter().map(|&value| to(value)).collect();
    let (first, last) = (places[0], places[places.len() - 1]);
    let alone = if first == 0.0 { 0.5 } else { 0.05 * first.abs() };
    let ends = match places.len() {
        1 => (first - alone, first + alone),
        many => (first - (places[1] - first) / 2.0, last + (last - places[many - 2]) / 2.0),
    };
    let between = places.windows(2).map(|two| f64::midpoint(two[0], two[1]));
    std::iter::once(ends.0).chain(between).chain([ends.1]).map(from).collect()
}

/// Returns the cells as coloured rectangles. Neighbouring rectangles overlap slightly, so that no background
/// is visible between them.
///
/// `ends` contains the value at the right end of the horizontal axis and at the lower end of the vertical
/// axis. Rectangles do not extend beyond these ends.
fn drawn(cells: &[Cell], ends: (f64, f64), frame: &ComputedLayout, shades: &Shades) -> Primitive {
    let (mut x, mut y, mut w, mut h, mut fills) = (vec![], vec![], vec![], vec![], vec![]);
    for cell in cells {
        let (left, right) = (frame.map_x(cell.x[0]), frame.map_x(cell.x[1]));
        let (bottom, top) = (frame.map_y(cell.y[0]), frame.map_y(cell.y[1]));
        x.push(left);
        y.push(top);
        w.push(right - left + if cell.x[1] >= ends.0 { 0.0 } else { 0.4 });
        h.push(bottom - top + if cell.y[0] <= ends.1 { 0.0 } else { 0.4 });
        fills.push(if cell.value.is_finite() {
            Color::from(shades.colour(cell.value))
        } else {
            Color::from(colours::MISSING)
        });
    }
    Primitive::RectBatch { x, y, w, h, fills }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_neighbours_form_rectangles() {
        let found = rectangles(&[1, 1, 2, 1, 1, 2, 1, 3, 3], 3);
        let rectangle = |columns, rows, owner| Rectangle { columns, rows, owner };
        for expected in [
            rectangle([0, 2], [0, 2], 1),
            rectangle([2, 3], [0, 2], 2),
            rectangle([0, 1], [2, 3], 1),
            rectangle([1, 3], [2, 3], 3),
        ] {
            assert!(found.contains(&expected), "{expected:?} in {found:?}");
        }
        assert_eq!(found.len(), 4);
    }

    #[test]
    fn positions_along_axes_are_fractions() {
        let log = Axis { log: true, ..Axis::linear(String::new(), (1.0, 100.0)) };
        assert!((fraction(&log, 10.0) - 0.5).abs() < 1e-12 && (value_at(&log, 0.5) - 10.0).abs() < 1e-12);
        let linear = Axis::linear(String::new(), (40.0, 240.0));
        assert_eq!((fraction(&linear, 90.0), value_at(&linear, 0.25)), (0.25, 90.0));
    }

    #[test]
    fn cells_end_halfway() {
        assert_eq!(edges(&[1.0, 2.0, 4.0], false), [0.5, 1.5, 3.0, 5.0]);
        let ratios = edges(&[1.0, 100.0], true);
        assert!((ratios[0] - 0.1).abs() < 1e-12 && (ratios[1] - 10.0).abs() < 1e-12, "{ratios:?}");
        assert_eq!(edges(&[0.0], false), [-0.5, 0.5]);
        assert_eq!(edges(&[20.0], false), [19.0, 21.0]);
    }
}
