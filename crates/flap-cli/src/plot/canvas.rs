//! Sizes of pictures: in drawing units, in pixels, and on paper. A picture is drawn in drawing units, and 12
//! drawing units are the size of the text.

use crate::args::{PictureSize, PlotArgs};
use crate::failure::Failure;

/// The width and height of a picture or a panel, and its text sizes, in drawing units.
///
/// Text other than labels and titles has the size [`TEXT`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Size {
    pub(super) width: f64,
    pub(super) height: f64,
    /// Text size of the axis labels.
    pub(super) label: u32,
    /// Text size of the title.
    pub(super) title: u32,
}

/// Text size of ticks, legends and notes, in drawing units.
pub(super) const TEXT: u32 = 12;

/// In pictures narrower than this width (drawing units), panels are one below the other.
const NARROW: f64 = 600.0;

impl Size {
    /// Returns true if the picture is too narrow for two panels side by side.
    pub(super) fn is_narrow(self) -> bool {
        self.width < NARROW
    }
}

/// The size of a picture file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Canvas {
    /// The size in drawing units.
    pub(super) size: Size,
    /// Width and height of a PNG in pixels.
    pub(super) pixels: [u32; 2],
    /// The size on paper, if the user gave the size in a unit of length.
    pub(super) print: Option<Print>,
}

/// The size of a picture on paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Print {
    /// Width and height (mm).
    pub(super) sides: [f64; 2],
    /// Pixels per inch of a PNG.
    pub(super) dpi: f64,
}

const MM_PER_INCH: f64 = 25.4;
const POINTS_PER_INCH: f64 = 72.0;

/// Pixels of a PNG per drawing unit, if the user gave the size in pixels.
const SCALE: u32 = 2;

/// Default size of the text on paper (pt).
const FONT_SIZE: f64 = 8.0;

/// Default resolution of a PNG on paper (pixels per inch).
const DPI: f64 = 300.0;

/// Smallest allowed width and height of a picture, in drawing units.
const SMALLEST: f64 = 200.0;

/// Largest allowed width and height of a picture, in drawing units.
const LARGEST: f64 = 4000.0;

/// Largest allowed number of pixels of a PNG. The largest picture whose size the user can give in pixels has
/// this number of pixels.
const MOST_PIXELS: f64 = (LARGEST * SCALE as f64) * (LARGEST * SCALE as f64);

impl Canvas {
    /// Computes the size of the picture from the command-line options.
    ///
    /// # Errors
    /// `Usage` if the picture is too small for its text, or if it has too many pixels.
    pub(super) fn of(args: &PlotArgs) -> Result<Canvas, Failure> {
        match args.size {
            PictureSize::Pixels([width, height]) => {
                if args.font_size.is_some() || args.dpi.is_some() {
                    let option = if args.font_size.is_some() { "--font-size" } else { "--dpi" };
                    let message =
                        format!("{option} requires a --size with a unit of length: mm, cm or in (inch)");
                    return Err(Failure::usage(message).help("for example --size 84x60mm"));
                }
                let size = Size { width: width.into(), height: height.into(), label: 14, title: 17 };
                Ok(Canvas { size, pixels: [width, height].map(|side| SCALE * u32::from(side)), print: None })
            }
            PictureSize::Print(sides) => Canvas::printed(
                Print { sides, dpi: args.dpi.unwrap_or(DPI) },
                args.font_size.unwrap_or(FONT_SIZE),
            ),
        }
    }

    /// Returns the canvas for a size on paper. The text has a size of `font` points.
    fn printed(print: Print, font: f64) -> Result<Canvas, Failure> {
        let unit = font / f64::from(TEXT) * MM_PER_INCH / POINTS_PER_INCH;
        let [width, height] = print.sides.map(|side| side / unit);
        if width.min(height) < SMALLEST {
            let message = format!(
                "a picture with text of {font} pt is at least {:.0} mm wide and high",
                SMALLEST * unit
            );
            return Err(Failure::usage(message).help("set a larger --size or a smaller --font-size"));
        }
        let pixels = print.sides.map(|side| (side / MM_PER_INCH * print.dpi).round());
        if width.max(height) > LARGEST || pixels[0] * pixels[1] > MOST_PIXELS {
            let [across, up] = pixels;
            let message = format!("a picture of {across} x {up} pixels with text of {font} pt is too large");
            return Err(
                Failure::usage(message).help("set a smaller --size or --dpi, or a larger --font-size")
            );
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_PIXELS")]
        let pixels = pixels.map(|side| side as u32);
        // All text has the same size in print, except the title.
        let size = Size { width, height, label: TEXT, title: 14 };
        Ok(Canvas { size, pixels, print: Some(print) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_has_its_size_in_print() {
        let print = Print { sides: [84.0, 60.0], dpi: 300.0 };
        let canvas = Canvas::printed(print, 8.0).unwrap();
        assert_eq!(canvas.pixels, [992, 709]);
        // 84 mm are 238.1 pt: 29.76 letters of 8 pt, each of 12 units.
        assert!((canvas.size.width - 238.110_236 / 8.0 * 12.0).abs() < 1e-5, "{canvas:?}");
        assert!((canvas.size.width / canvas.size.height - 84.0 / 60.0).abs() < 1e-12);
        assert!(
            matches!(Canvas::printed(print, 24.0), Err(Failure::Usage(message, _)) if message.contains("at least 141 mm"))
        );
        let fine = Print { dpi: 2400.0, sides: [178.0, 120.0] };
        assert!(matches!(Canvas::printed(fine, 8.0), Err(Failure::Usage(..))));
    }
}
