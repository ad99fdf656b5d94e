//! Formats of picture files.

use std::path::Path;

use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene;

use super::raster;
use crate::failure::Failure;

/// The format of a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

/// The bytes of a picture.
pub(super) fn bytes(scene: Scene, format: Format) -> Result<Vec<u8>, String> {
    match format {
        Format::Svg => Ok(SvgBackend::new().render_scene(&scene).into_bytes()),
        Format::Png => raster::bytes(scene),
    }
}

/// The format that the ending of a name stands for.
pub(super) fn format(out: &Path) -> Result<Format, Failure> {
    match ending(out).as_str() {
        "svg" => Ok(Format::Svg),
        "png" => Ok(Format::Png),
        "html" | "htm" => {
            let failure = Failure::usage(format!(
                "{}: --out writes pictures, which end in .svg or .png",
                out.display()
            ));
            Err(failure.help(format!("--html {} writes a page", out.display())))
        }
        _ => Err(Failure::usage(format!("{}: pictures end in .svg or .png", out.display()))),
    }
}

/// The ending of a name in small letters; empty if there is none.
pub(super) fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}
