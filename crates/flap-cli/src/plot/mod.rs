//! `flap plot`: pictures and pages of results.

mod axes;
mod choose;
mod chosen;
mod columns;
mod front;
mod hysteresis;
mod ink;
mod label;
mod map;
mod page;
mod pareto;
mod raster;
mod response;
mod scale;
mod trajectory;

use std::io::Write;
use std::path::{Path, PathBuf};

use choose::Wishes;
use chosen::Chosen;
use columns::{Source, Table};
use flap_sweep::text::printable;
use kuva::render::render::Scene;

use crate::args::{PictureKind, PlotArgs, Size};
use crate::failure::{Exit, Failure};
use crate::{console, job};

pub(crate) fn run(args: &PlotArgs) -> Result<Exit, Failure> {
    let out = match (&args.out, &args.html) {
        (Some(out), _) => Some(out.clone()),
        (None, Some(_)) => None,
        (None, None) => Some(default_name(&args.results)),
    };
    for path in out.iter().chain(&args.html) {
        if is_same(path, &args.results) {
            return Err(Failure::usage(format!("{} is the results themselves", path.display())));
        }
    }
    if let Some(out) = &out {
        picture(args, out)?;
    }
    if let Some(html) = &args.html {
        let bytes = page::page(args, &heading(args))?;
        write(html, args.force, bytes.as_bytes())?;
        console::say(&format!("a page in {}: open it in a browser", html.display()));
    }
    Ok(Exit::Done)
}

/// Draws into the file `out`.
fn picture(args: &PlotArgs, out: &Path) -> Result<(), Failure> {
    let format = format(out)?;
    let source = Source::open(&args.results)?;
    let wishes = Wishes::of(&source, args)?;
    let table = source.read(|column| wishes.wants(column), usize::MAX)?;
    let chosen = wishes.choose(&table, heading(args))?;
    let scene = draw(&table, &chosen, args.size)?;
    let bytes = ink::bytes(scene, format).map_err(Failure::Bug)?;
    write(out, args.force, &bytes)?;
    console::say(&format!("{} in {}", chosen.kind.name(), out.display()));
    Ok(())
}

fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    match chosen.kind {
        PictureKind::Response => response::draw(table, chosen, size),
        PictureKind::Map => map::draw(table, chosen, size),
        PictureKind::Pareto => pareto::draw(table, chosen, size),
        PictureKind::Trajectory => trajectory::draw(table, chosen, size),
        PictureKind::Hysteresis => hysteresis::draw(table, chosen, size),
    }
}

/// The heading: the one asked for, or the file's name. XML has no place for control characters.
fn heading(args: &PlotArgs) -> String {
    let name = || args.results.file_name().map(|name| name.to_string_lossy().into_owned());
    printable(&args.title.clone().or_else(name).unwrap_or_default())
}

/// The name of a picture of `results`, in the working directory.
fn default_name(results: &Path) -> PathBuf {
    let name = results.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let endings = [".csv.zst", ".csv", ".parquet", ".zst"];
    let stem = endings.iter().find_map(|ending| name.strip_suffix(ending)).unwrap_or(&name);
    PathBuf::from(format!("{stem}.svg"))
}

fn format(out: &Path) -> Result<ink::Format, Failure> {
    let ending = out.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    match ending.as_str() {
        "svg" => Ok(ink::Format::Svg),
        "png" => Ok(ink::Format::Png),
        "html" | "htm" => {
            Err(Failure::usage(format!("{} is no picture", out.display())).help("--html writes a page"))
        }
        _ => Err(Failure::usage(format!("{}: pictures end in .svg or .png", out.display()))),
    }
}

fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Writes all of a file or nothing.
fn write(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    let written = job::make(path, force, |mut file| file.write_all(bytes))?;
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
