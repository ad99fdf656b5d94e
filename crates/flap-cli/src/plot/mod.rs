//! `flap plot`: draws results as pictures, and writes pages on which users explore results.

mod canvas;
mod effects;
mod encode;
mod histogram;
mod hysteresis;
mod ink;
mod kind;
mod label;
mod map;
mod matrix;
mod nearest;
mod page;
mod panel;
mod pareto;
mod request;
mod response;
mod scale;
mod scatter;
mod selection;
mod shades;
mod slices;
mod tornado;
mod trajectory;

use std::io::Write;
use std::path::{Path, PathBuf};

use canvas::{Canvas, Size};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::results::Format;
use flap_sweep::notation::text::printable;
use kuva::render::render::Scene;
use request::Request;
use selection::Selection;

use crate::args::{PictureKind, PlotArgs};
use crate::cmd::outputs;
use crate::data::columns::Table;
use crate::data::filter::Filters;
use crate::data::source::Source;
use crate::failure::{Exit, Failure};
use crate::{console, job};

pub(crate) fn run(args: &PlotArgs) -> Result<Exit, Failure> {
    let out = match (&args.out, &args.html) {
        (Some(out), _) => Some(out.clone()),
        (None, Some(_)) => None,
        (None, None) => Some(default_name(&args.results)),
    };
    let mut inputs = Inputs::new();
    inputs.add_results("the results", &args.results);
    outputs::check(&inputs, [out.as_deref(), args.html.as_deref()])?;
    args.html.iter().try_for_each(|html| require_html(html))?;
    if let (Some(_), Some(over)) = (&args.html, args.best_over.first()) {
        let message = format!("--html shows all rows of the file, without the choice of --best-over {over}");
        return Err(Failure::usage(message)
            .help("draw the best rows with --out FILE.png, and write the page without --best-over"));
    }
    if let Some(out) = &out {
        picture(args, out)?;
    }
    if let Some(html) = &args.html {
        // Warnings about the results are printed once.
        let bytes = page::page(args, &heading(args), out.is_none())?;
        write(html, args.overwrite.force, bytes.as_bytes())?;
        console::say(&format!("page in {}: open it in a browser", html.display()));
    }
    Ok(Exit::Done)
}

/// Draws a picture into the file `out`.
fn picture(args: &PlotArgs, out: &Path) -> Result<(), Failure> {
    let format = encode::format(out)?;
    let canvas = Canvas::of(args)?;
    let mut source = Source::open(&args.results, &args.read, true)?;
    let plan = source.take_plan();
    let request = Request::of(&source, args)?;
    let filters = Filters::of(&args.comparisons(), &source)?;
    let table = filters.read(source, |column| request.uses(column), usize::MAX)?;
    let selection = selection::select(&request, &table, heading(args))?;
    let scene = if args.derivatives {
        effects::draw(&table, &selection, plan.as_ref(), canvas.size)?
    } else {
        draw(&table, &selection, canvas.size)?
    };
    let bytes = encode::bytes(scene, format, &canvas).map_err(Failure::Bug)?;
    write(out, args.overwrite.force, &bytes)?;
    console::say(&format!("{} in {}", selection.columns.kind.name(), out.display()));
    Ok(())
}

fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    match selection.columns.kind {
        PictureKind::Response => response::draw(table, selection, size),
        PictureKind::Map => map::draw(table, selection, size),
        PictureKind::Scatter => scatter::draw(table, selection, size),
        PictureKind::Histogram => histogram::draw(table, selection, size),
        PictureKind::Tornado => tornado::draw(table, selection, size),
        PictureKind::Pareto => pareto::draw(table, selection, size),
        PictureKind::Trajectory => trajectory::draw(table, selection, size),
        PictureKind::Hysteresis => hysteresis::draw(table, selection, size),
        PictureKind::Matrix => matrix::draw(table, selection, size),
    }
}

/// Returns the heading of the picture: the text of `--title`, or the name of the results file. Control
/// characters are removed, because XML forbids them.
fn heading(args: &PlotArgs) -> String {
    let name = || args.results.file_name().map(|name| name.to_string_lossy().into_owned());
    printable(&args.title.clone().or_else(name).unwrap_or_default())
}

/// Returns the default name of the picture file: the name of `results` with the ending `.svg`, in the working
/// directory.
fn default_name(results: &Path) -> PathBuf {
    let name = results.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let (stem, _) = Format::split_ending(&name);
    PathBuf::from(format!("{stem}.svg"))
}

fn require_html(html: &Path) -> Result<(), Failure> {
    match encode::ending(html).as_str() {
        "html" | "htm" => Ok(()),
        _ => Err(Failure::usage(format!(
            "{}: --html writes pages, whose names end in .html or .htm",
            html.display()
        ))),
    }
}

/// Writes a file. After an error, no incomplete file remains.
fn write(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    let written = job::make(path, force, |mut file| file.write_all(bytes).map(|()| None))?;
    written.map_err(|error: std::io::Error| Failure::cannot_write(path, &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_named_after_results() {
        for (results, picture) in [
            ("a/b.csv", "b.svg"),
            ("b.csv.zst", "b.svg"),
            ("b.parquet", "b.svg"),
            ("b", "b.svg"),
            ("b.2of8.csv", "b.2of8.svg"),
        ] {
            assert_eq!(default_name(Path::new(results)), Path::new(picture));
        }
    }
}
