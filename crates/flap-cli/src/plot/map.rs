//! A measure as the colour of cells over two parameters.

use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene};

use flap_sweep::picture::colours;

use super::bar;
use super::chosen::{Chosen, Columns};
use super::ink;
use super::panel::{Axis, Panel};
use super::scale;
use super::shades::Shades;
use crate::args::Size;
use crate::data::columns::Table;
use crate::data::levels::{Levels, Values};
use crate::failure::Failure;

/// Most cells of a picture: more would exceed its pixels.
const MOST_CELLS: usize = 500_000;

/// Values over a grid; those of a row of cells lie together, the lowest first.
struct Grid {
    x: Vec<f64>,
    y: Vec<f64>,
    values: Vec<f64>,
}

/// Draws column `color` over the columns `x` and `y`.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let Columns { x, y, color: Some(color), .. } = chosen.columns else {
        return Err(Failure::Bug("a map without a colour".to_owned()));
    };
    let grid = grid(table, chosen, color)?;
    let labels = [table.label(x), table.label(y), table.label(color)];
    let axis = |values: &[f64], label: &super::label::Label| {
        let log = scale::is_log(values);
        let scaled: Vec<f64> = values.iter().map(|value| value * label.factor).collect();
        let edges = edges(&scaled, log);
        let range = (edges[0], edges[edges.len() - 1]);
        (edges, Axis { label: label.text(), range, log })
    };
    let (x_edges, x) = axis(&grid.x, &labels[0]);
    let (y_edges, y) = axis(&grid.y, &labels[1]);
    let values: Vec<f64> = grid.values.iter().map(|value| value * labels[2].factor).collect();
    let Some(range) = scale::range(values.iter().copied()) else {
        return Err(chosen.nothing(table, color));
    };
    let bar = Axis::linear(labels[2].text(), scale::padded(range, 0.0));
    let missing = values.iter().filter(|value| !value.is_finite()).count();

    let mut notes = chosen.notes.clone();
    if missing > 0 {
        notes.push(format!("{missing} of {} cells without a value", values.len()));
    }
    let panel =
        Panel { title: chosen.title.clone(), notes, x, y, plots: Vec::new(), legend: None, bar: true };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    scene.add(cells((&x_edges, &y_edges), &values, &frame, &Shades::of(bar.range)));
    ink::frame_lines(&mut scene, &frame);
    bar::colour_bar(&mut scene, &frame, &bar, (missing > 0).then_some("no value"));
    Ok(scene)
}

fn grid(table: &Table, chosen: &Chosen, color: usize) -> Result<Grid, Failure> {
    let names = [chosen.columns.x, chosen.columns.y].map(|column| table.columns[column].name.as_str());
    let levels = [chosen.columns.x, chosen.columns.y].map(|column| Levels::of(table, column, &chosen.rows));
    // Words have no place on an axis.
    table.numbers(chosen.columns.x)?;
    table.numbers(chosen.columns.y)?;
    let colours = table.numbers(color)?;
    let [across, up] = &levels;
    let cells = across.len() * up.len();
    if cells > MOST_CELLS {
        let message =
            format!("a map of {} times {} cells is too large for a picture", across.len(), up.len());
        return Err(Failure::usage(message).help(
            "draw a sample with --kind scatter, choose one value of an axis with --where, or write a page with --html",
        ));
    }
    let mut values = vec![f64::NAN; cells];
    let mut taken = vec![false; cells];
    for (place, &row) in chosen.rows.iter().enumerate() {
        let cell = up.codes[place] * across.len() + across.codes[place];
        if taken[cell] {
            let message = format!("several rows have the same {} and {}", names[0], names[1]);
            return Err(Failure::usage(message).help("choose one value of each other parameter with --where"));
        }
        taken[cell] = true;
        values[cell] = colours[row];
    }
    let numbers = |levels: &Levels| match &levels.values {
        Values::Numbers(values) => values.clone(),
        Values::Words(_) => Vec::new(),
    };
    Ok(Grid { x: numbers(across), y: numbers(up), values })
}

/// The ends of the cells: halfway between their values, and as far outside the first and the last.
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

fn cells(edges: (&[f64], &[f64]), values: &[f64], frame: &ComputedLayout, shades: &Shades) -> Primitive {
    let columns: Vec<f64> = edges.0.iter().map(|&edge| frame.map_x(edge)).collect();
    let rows: Vec<f64> = edges.1.iter().map(|&edge| frame.map_y(edge)).collect();
    let (mut x, mut y, mut w, mut h, mut fills) = (vec![], vec![], vec![], vec![], vec![]);
    for (row, ends) in rows.windows(2).enumerate() {
        for (column, sides) in columns.windows(2).enumerate() {
            let value = values[row * (columns.len() - 1) + column];
            let last = (column + 2 == columns.len(), row == 0);
            // Neighbours overlap a little, so that no background shines through between them.
            x.push(sides[0]);
            y.push(ends[1]);
            w.push(sides[1] - sides[0] + if last.0 { 0.0 } else { 0.4 });
            h.push(ends[0] - ends[1] + if last.1 { 0.0 } else { 0.4 });
            fills.push(if value.is_finite() {
                Color::from(shades.colour(value))
            } else {
                Color::from(colours::MISSING)
            });
        }
    }
    Primitive::RectBatch { x, y, w, h, fills }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_end_halfway() {
        assert_eq!(edges(&[1.0, 2.0, 4.0], false), [0.5, 1.5, 3.0, 5.0]);
        let ratios = edges(&[1.0, 100.0], true);
        assert!((ratios[0] - 0.1).abs() < 1e-12 && (ratios[1] - 10.0).abs() < 1e-12, "{ratios:?}");
        assert_eq!(edges(&[0.0], false), [-0.5, 0.5]);
        assert_eq!(edges(&[20.0], false), [19.0, 21.0]);
    }
}
