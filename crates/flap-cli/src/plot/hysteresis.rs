//! Pictures of the branches of a response, in which a parameter first rises and then falls.

use flap_sweep::picture::branches::{BRANCHES, Comparison, Way, compared};
use flap_sweep::picture::colours::BISTABLE;
use kuva::render::annotations::ShadedRegion;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene};

use super::canvas::Size;
use super::ink::{self, Look};
use super::label::{Label, digits};
use super::panel::{Axis, Panel};
use super::response::{Line, family, ordered};
use super::scale;
use super::selection::Selection;
use crate::console;
use crate::data::columns::{Cells, Table};
use crate::failure::Failure;

/// Largest number of response curves in a picture, because the reader cannot distinguish a larger number of
/// curves.
const MOST_CURVES: usize = 10;

/// The index of the branch of unstable orbits in [`BRANCHES`].
const UNSTABLE: usize = 2;

/// The response curve of one design. The order of the branches is the order of [`BRANCHES`], and their points
/// are in the units of the picture.
struct Curve {
    name: String,
    branches: [Vec<(f64, f64)>; 3],
    compared: Comparison,
}

/// A jump of the motion from one stable branch to the other stable branch. The picture shows the jump as an
/// arrow.
struct Jump {
    x: f64,
    from: f64,
    to: f64,
    colour: String,
}

/// Draws column `y` over column `x`, with one line for each branch.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let (x, y) = (table.label(selection.columns.x), table.label(selection.columns.y));
    let lines = family(table, selection)?;
    let shown = scale::even(lines.len(), MOST_CURVES);
    if shown.len() < lines.len() {
        let (drawn, all) = (shown.len(), lines.len());
        console::say(&format!("{drawn} of {all} curves are drawn, evenly chosen; --where chooses one curve"));
    }
    let curves = (shown.iter())
        .map(|&number| curve(table, selection, &lines[number], (x.factor, y.factor)))
        .collect::<Result<Vec<Curve>, Failure>>()?;
    let drawn: Vec<(f64, f64)> = curves.iter().flat_map(|curve| curve.branches.concat()).collect();
    let Some([width, height]) = scale::extent(&drawn) else {
        return Err(selection.no_numbers(table, selection.columns.y));
    };

    let (mut plots, mut jumps) = (Vec::new(), Vec::new());
    for (place, curve) in curves.iter().enumerate() {
        let mut named = false;
        for kind in 0..BRANCHES.len() {
            let mut look = if selection.columns.by.is_some() {
                let name = if named { String::new() } else { curve.name.clone() };
                Look::new(name, ink::line_colour(place, curves.len(), ordered(table, selection)))
            } else {
                Look::new(BRANCHES[kind].name, BRANCHES[kind].colour)
            };
            look.dashed = kind == UNSTABLE;
            // The branch down often coincides with the branch up, so the line below is wider.
            look.width = if selection.columns.by.is_some() { 1.8 } else { [4.0, 1.8, 1.6][kind] };
            jumps.extend(curve.jumps(kind, &look.colour));
            let lines = ink::line(&curve.with_gaps(kind), &look);
            named |= !lines.is_empty();
            plots.extend(lines);
        }
    }
    let mut notes = selection.notes.clone();
    let missing = drawn.iter().filter(|point| !point.1.is_finite()).count();
    if missing > 0 {
        notes.push(format!("{missing} of {} points without a value", drawn.len()));
    }
    let bands = if let [only] = &curves[..] { only.compared.bands.clone() } else { Vec::new() };
    notes.extend(bistable(&bands, &x));
    let has_unstable = || curves.iter().any(|curve| !curve.branches[UNSTABLE].is_empty());
    if selection.columns.by.is_some() && has_unstable() {
        notes.push("dashed: unstable".to_owned());
    }
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        x: Axis::linear(x.text(), scale::padded(width, 0.02)),
        y: Axis::linear(y.text(), scale::from_zero(height)),
        plots,
        legend: Some(selection.columns.by.map_or_else(String::new, |by| table.label(by).text())),
        bar: false,
    };
    let mut layout = panel.layout(size);
    for (low, high) in bands {
        let region = ShadedRegion::vertical(low, high).with_color(BISTABLE).with_opacity(0.75);
        layout = layout.with_shaded_region(region);
    }
    let frame = ComputedLayout::from_layout(&layout);
    let mut scene = panel.scene_in(layout);
    for jump in &jumps {
        jump.draw(&mut scene, &frame);
    }
    Ok(scene)
}

/// Returns the branches of a design, and a comparison of the rising and the falling branch.
fn curve(table: &Table, selection: &Selection, line: &Line, factors: (f64, f64)) -> Result<Curve, Failure> {
    let (x, y) = (table.numbers(selection.columns.x)?, table.numbers(selection.columns.y)?);
    let is_branch = words(table, "branch")?;
    let is_bistable = words(table, "bistable")?;
    let mut branches = BRANCHES.map(|_| Vec::new());
    let mut bistable = BRANCHES.map(|_| Vec::new());
    for &row in &line.rows {
        let Some(kind) = BRANCHES.iter().position(|branch| is_branch(row, branch.name)) else { continue };
        branches[kind].push((x[row] * factors.0, y[row] * factors.1));
        bistable[kind].push(is_bistable(row, "true"));
    }
    let [up, down] =
        [0, 1].map(|kind: usize| -> (Vec<f64>, Vec<f64>) { branches[kind].iter().copied().unzip() });
    let compared = compared(
        Way { x: &up.0, y: &up.1, bistable: &bistable[0] },
        Way { x: &down.0, y: &down.1, bistable: &bistable[1] },
    );
    Ok(Curve { name: line.name.clone(), branches, compared })
}

/// Returns a function of a row and a word. The function returns true if the cell of the row in column `name`
/// contains the word.
fn words<'t>(table: &'t Table, name: &str) -> Result<impl Fn(usize, &str) -> bool + 't, Failure> {
    let column = table.find(name)?;
    let Cells::Words { codes, words } = &table.columns[column].cells else {
        return Err(Failure::usage(format!("column `{name}` contains numbers, not text"))
            .help("draw the results of `flap respond --out`"));
    };
    Ok(move |row: usize, word: &str| words.get(codes[row] as usize).is_some_and(|known| known == word))
}

impl Curve {
    /// Returns the positions of the branch's points after which the motion jumps.
    fn after(&self, kind: usize) -> &[usize] {
        self.compared.jumps.get(kind).map_or(&[], Vec::as_slice)
    }

    /// Returns the points of a branch with a gap at each jump, because flap computed no motion between the
    /// two points at a jump.
    fn with_gaps(&self, kind: usize) -> Vec<(f64, f64)> {
        let mut points = Vec::new();
        for (row, point) in self.branches[kind].iter().enumerate() {
            points.push(*point);
            if self.after(kind).contains(&row) {
                points.push((f64::NAN, f64::NAN));
            }
        }
        points
    }

    /// Returns the jumps of a branch. The arrow of a jump is halfway between the points before and after the
    /// jump.
    fn jumps(&self, kind: usize, colour: &str) -> impl Iterator<Item = Jump> {
        let points = &self.branches[kind];
        self.after(kind).iter().map(move |&row| Jump {
            x: f64::midpoint(points[row].0, points[row + 1].0),
            from: points[row].1,
            to: points[row + 1].1,
            colour: colour.to_owned(),
        })
    }
}

impl Jump {
    /// Draws the jump as a thin dashed arrow.
    fn draw(&self, scene: &mut Scene, frame: &ComputedLayout) {
        const HEAD: f64 = 5.0;
        let (x, from, to) = (frame.map_x(self.x), frame.map_y(self.from), frame.map_y(self.to));
        ink::dashes(scene, (x, from), (x, to), (&self.colour, 1.0));
        let back = to - HEAD * (to - from).signum() * 1.4;
        scene.add(Primitive::PolyLine {
            points: vec![(x - HEAD, back), (x, to), (x + HEAD, back)],
            stroke: self.colour.as_str().into(),
            stroke_width: 1.0,
            stroke_dasharray: None,
        });
    }
}

/// Returns the note below the title about bistable bands, or `None` if there are none.
fn bistable(bands: &[(f64, f64)], x: &Label) -> Option<String> {
    let ends = |&(low, high): &(f64, f64)| format!("{} to {}", digits(low, 6), digits(high, 6));
    let listed: Vec<String> = bands.iter().map(ends).collect();
    (!bands.is_empty())
        .then(|| format!("shaded: bistable, {} {}", listed.join(" and "), x.unit).trim_end().to_owned())
}
