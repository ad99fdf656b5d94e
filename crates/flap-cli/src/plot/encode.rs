//! Writes pictures in the formats SVG and PNG.

use std::path::Path;

use kuva::backend::raster::RasterBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::{Primitive, Scene};

use super::canvas::{Canvas, Print};
use crate::failure::Failure;

/// The format of a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

/// Returns the bytes of the file for a picture.
pub(super) fn bytes(scene: Scene, format: Format, canvas: &Canvas) -> Result<Vec<u8>, String> {
    match format {
        Format::Svg => {
            let svg = SvgBackend::new().render_scene(&scene);
            let svg = match canvas.print {
                Some(print) => with_print_size(&svg, &scene, print)?,
                None => svg,
            };
            Ok(svg.into_bytes())
        }
        Format::Png => png(scene, canvas),
    }
}

/// Returns the SVG with the width and height on paper (mm) instead of pixels.
fn with_print_size(svg: &str, scene: &Scene, print: Print) -> Result<String, String> {
    // Without the rounding errors of inches.
    let [width, height] = print.sides.map(|side| (side * 1e4).round() / 1e4);
    let start = svg.find(" width=").zip(svg.find(" height=")).filter(|(width, height)| width < height);
    let end = start.and_then(|(_, height)| Some(height + 9 + svg[height + 9..].find('"')? + 1));
    let ((start, _), end) = start.zip(end).ok_or("an SVG without a size")?;
    let size = format!(
        r#" width="{width}mm" height="{height}mm" viewBox="0 0 {:.3} {:.3}""#,
        scene.width, scene.height
    );
    Ok(svg[..start].to_owned() + &size + &svg[end..])
}

/// Returns the picture format that the ending of a file name sets.
pub(super) fn format(out: &Path) -> Result<Format, Failure> {
    match ending(out).as_str() {
        "svg" => Ok(Format::Svg),
        "png" => Ok(Format::Png),
        ending => {
            let failure = Failure::usage(format!("{}: names of pictures end in .svg or .png", out.display()));
            Err(match ending {
                "html" | "htm" => failure.help(format!("--html {} writes a page", out.display())),
                "pdf" | "eps" => failure.help(
                    "write an SVG and convert it, for example with: rsvg-convert --format pdf --output picture.pdf picture.svg",
                ),
                _ => failure,
            })
        }
    }
}

/// Returns the ending of a file name in lower case. The text is empty for a name without an ending.
pub(super) fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Pictures are drawn at double size and then averaged, unless the double size has more pixels than this
/// number.
const MOST_PIXELS: f64 = 1e8;

/// Returns the bytes of a picture in the format PNG.
///
/// The picture is first drawn at double size, and then groups of four pixels are averaged, so that lines and
/// points look smooth.
fn png(mut scene: Scene, canvas: &Canvas) -> Result<Vec<u8>, String> {
    // The library rounds up, so a rounding error would add a pixel.
    const LESS: f64 = 1e-2;
    let [width, height] = canvas.pixels.map(f64::from);
    let scale = width / canvas.size.width;
    (scene.width, scene.height) = ((width - LESS) / scale, (height - LESS) / scale);
    scene.elements = scene.elements.into_iter().flat_map(dashes).collect();
    let rotated = take_rotated_text(&mut scene);
    let is_large = 4.0 * width * height > MOST_PIXELS;
    let draw = |scene: &Scene| {
        let scale = if is_large { scale } else { 2.0 * scale };
        #[expect(clippy::cast_possible_truncation, reason = "a few pixels per unit")]
        let scale = scale as f32;
        Image::read(&RasterBackend::new().with_scale(scale).render_scene(scene)?)
    };
    let mut image = draw(&scene)?;
    if let Some(rotated) = rotated {
        image.darken_rotated(&draw(&rotated)?);
    }
    let image = if is_large { image } else { image.halved() };
    image.write(canvas.print.map(|print| print.dpi))
}

/// An image as rows of pixels. Each pixel has three or four bytes.
struct Image {
    width: usize,
    height: usize,
    channels: usize,
    bytes: Vec<u8>,
}

impl Image {
    fn read(png: &[u8]) -> Result<Image, String> {
        let mut reader =
            png::Decoder::new(std::io::Cursor::new(png)).read_info().map_err(|error| error.to_string())?;
        let size = reader.output_buffer_size().ok_or("an image too large")?;
        let mut bytes = vec![0; size];
        let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
        let channels = info.color_type.samples();
        Ok(Image { width: info.width as usize, height: info.height as usize, channels, bytes })
    }

    /// Rotates `marks`, an image with dark text on white, by a quarter turn to the left, and darkens this
    /// image where the rotated text is.
    fn darken_rotated(&mut self, marks: &Image) {
        for row in 0..self.height.min(marks.width) {
            for column in 0..self.width.min(marks.height) {
                let from = (column * marks.width + marks.width - 1 - row) * marks.channels;
                let to = (row * self.width + column) * self.channels;
                for channel in 0..3 {
                    let share = u16::from(marks.bytes[from + channel]) * u16::from(self.bytes[to + channel]);
                    #[expect(clippy::cast_possible_truncation, reason = "a share of a byte is a byte")]
                    let darker = ((share + 127) / 255) as u8;
                    self.bytes[to + channel] = darker;
                }
            }
        }
    }

    /// Returns the image at half size. Every pixel is the mean of two by two pixels.
    fn halved(&self) -> Image {
        let (width, height) = (self.width / 2, self.height / 2);
        let mut bytes = Vec::with_capacity(width * height * 3);
        let at = |row: usize, column: usize, channel: usize| {
            u16::from(self.bytes[(row * self.width + column) * self.channels + channel])
        };
        for row in (0..2 * height).step_by(2) {
            for column in (0..2 * width).step_by(2) {
                for channel in 0..3 {
                    let sum = at(row, column, channel)
                        + at(row + 1, column, channel)
                        + at(row, column + 1, channel)
                        + at(row + 1, column + 1, channel);
                    #[expect(clippy::cast_possible_truncation, reason = "a mean of bytes is a byte")]
                    bytes.push(((sum + 2) / 4) as u8);
                }
            }
        }
        Image { width, height, channels: 3, bytes }
    }

    /// Returns the red, green and blue byte of each pixel, without the byte for opacity.
    fn rgb(&self) -> Vec<u8> {
        self.bytes.chunks(self.channels).flat_map(|pixel| pixel[..3].to_vec()).collect()
    }

    /// Returns the image as the bytes of a PNG. `dpi` is the resolution on paper (pixels per inch).
    fn write(&self, dpi: Option<f64>) -> Result<Vec<u8>, String> {
        let side = |length: usize| u32::try_from(length).map_err(|error| error.to_string());
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, side(self.width)?, side(self.height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        // Areas of one colour repeat byte by byte, and compress best without a filter.
        encoder.set_filter(png::Filter::NoFilter);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 2400 per inch")]
        let per_metre = dpi.map(|dpi| (dpi / 0.0254).round() as u32);
        encoder.set_pixel_dims(per_metre.map(|ppu| png::PixelDimensions {
            xppu: ppu,
            yppu: ppu,
            unit: png::Unit::Meter,
        }));
        let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
        writer.write_image_data(&self.rgb()).map_err(|error| error.to_string())?;
        writer.finish().map_err(|error| error.to_string())?;
        Ok(png)
    }
}

/// If `element` is a dashed line, returns its dashes as separate lines. The drawing library restarts the
/// dashes at every point, so that a dashed line with many points would look solid.
fn dashes(element: Primitive) -> Vec<Primitive> {
    const ON: f64 = 7.0;
    const OFF: f64 = 5.0;
    let Primitive::PolyLine { points, stroke, stroke_width, stroke_dasharray: Some(_) } = &element else {
        return vec![element];
    };
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let (mut on, mut left) = (true, ON);
    let mut piece: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    for two in points.windows(2) {
        let (mut from, to) = (two[0], two[1]);
        loop {
            let length = (to.0 - from.0).hypot(to.1 - from.1);
            if length <= left {
                left -= length;
                piece.push(to);
                break;
            }
            let share = left / length;
            from = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            piece.push(from);
            if on {
                pieces.push(std::mem::take(&mut piece));
            }
            on = !on;
            left = if on { ON } else { OFF };
            piece = vec![from];
        }
    }
    if on && piece.len() > 1 {
        pieces.push(piece);
    }
    let line = |points| Primitive::PolyLine {
        points,
        stroke: stroke.clone(),
        stroke_width: *stroke_width,
        stroke_dasharray: None,
    };
    pieces.into_iter().map(line).collect()
}

/// Removes the rotated text from `scene`. Returns a new scene that contains the removed text without
/// rotation. The width of the new scene is the height of `scene`.
///
/// The drawing library draws rotated letters bold and without smooth edges, so flap rotates the drawn text
/// itself. A quarter turn of the new scene to the left moves the text to its position.
fn take_rotated_text(scene: &mut Scene) -> Option<Scene> {
    let mut rotated = Scene::new(scene.height, scene.width);
    rotated.text_color.clone_from(&scene.text_color);
    rotated.font_family.clone_from(&scene.font_family);
    // The offsets of nested groups.
    let mut groups = vec![(0.0, 0.0)];
    for element in &mut scene.elements {
        match element {
            Primitive::GroupStart { transform, .. } => {
                let (x, y) = groups.last().copied().unwrap_or_default();
                let (right, down) = transform.as_deref().and_then(shift).unwrap_or_default();
                groups.push((x + right, y + down));
            }
            Primitive::GroupEnd => drop(groups.pop()),
            Primitive::Text { x, y, content, rotate: Some(angle), size, anchor, bold, color }
                if (*angle + 90.0).abs() < 1e-6 =>
            {
                let (left, top) = groups.last().copied().unwrap_or_default();
                rotated.add(Primitive::Text {
                    x: scene.height - (*y + top),
                    y: *x + left,
                    content: std::mem::take(content),
                    size: *size,
                    anchor: *anchor,
                    rotate: None,
                    bold: *bold,
                    color: color.clone(),
                });
            }
            _ => {}
        }
    }
    (!rotated.elements.is_empty()).then_some(rotated)
}

/// Returns the shift (x, y) of an SVG transformation `translate(x, y)`.
fn shift(transform: &str) -> Option<(f64, f64)> {
    let inside = transform.strip_prefix("translate(")?.strip_suffix(')')?;
    let (x, y) = inside.split_once([',', ' ']).unwrap_or((inside, "0"));
    Some((x.trim().parse().ok()?, y.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kuva::render::color::Color;
    use kuva::render::render::TextAnchor;

    #[test]
    fn dashes_do_not_depend_on_how_many_points_a_line_has() {
        let ends = |count: u32| {
            let line = Primitive::PolyLine {
                points: (0..=count).map(|i| (f64::from(i) * 60.0 / f64::from(count), 0.0)).collect(),
                stroke: Color::from("#000000"),
                stroke_width: 1.0,
                stroke_dasharray: Some("8 4".to_owned()),
            };
            let pieces = dashes(line).into_iter().filter_map(|piece| match piece {
                Primitive::PolyLine { points, .. } => {
                    Some((points[0].0.round(), points[points.len() - 1].0.round()))
                }
                _ => None,
            });
            pieces.collect::<Vec<_>>()
        };
        let five = [(0.0, 7.0), (12.0, 19.0), (24.0, 31.0), (36.0, 43.0), (48.0, 55.0)];
        assert_eq!(ends(1), five);
        assert_eq!(ends(100), five);
    }

    #[test]
    fn marks_are_rotated_to_the_left() {
        // Two by one pixels: dark, then white. After the rotation to the left, dark is below.
        let marks = Image { width: 2, height: 1, channels: 3, bytes: vec![0, 0, 0, 255, 255, 255] };
        let mut image = Image { width: 1, height: 2, channels: 4, bytes: vec![200; 8] };
        image.darken_rotated(&marks);
        assert_eq!(image.rgb(), [200, 200, 200, 0, 0, 0]);
    }

    #[test]
    fn images_are_averaged() {
        let bytes = [0, 0, 0, 4, 8, 12, 0, 0, 0, 4, 8, 12].to_vec();
        let image = Image { width: 2, height: 2, channels: 3, bytes }.halved();
        assert_eq!((image.width, image.height), (1, 1));
        assert_eq!(image.bytes, [2, 4, 6]);
        let again = Image::read(&image.write(None).unwrap()).unwrap();
        assert_eq!(again.bytes, image.bytes);
    }

    #[test]
    fn rotated_text_is_taken_with_the_place_of_its_group() {
        let text = |rotate: Option<f64>| Primitive::Text {
            x: 10.0,
            y: 20.0,
            content: "a".to_owned(),
            size: 12,
            anchor: TextAnchor::Middle,
            rotate,
            bold: false,
            color: None,
        };
        let mut scene = Scene::new(300.0, 200.0);
        scene.add(text(None));
        assert!(take_rotated_text(&mut scene).is_none());
        scene.add(Primitive::GroupStart {
            transform: Some("translate(100,5.5)".to_owned()),
            title: None,
            extra_attrs: None,
        });
        scene.add(text(Some(-90.0)));
        let rotated = take_rotated_text(&mut scene).unwrap();
        assert_eq!((rotated.width, rotated.height, rotated.elements.len()), (200.0, 300.0, 1));
        let Primitive::Text { x, y, content, rotate: None, .. } = &rotated.elements[0] else {
            panic!("text")
        };
        assert_eq!((*x, *y, content.as_str()), (200.0 - 25.5, 110.0, "a"));
        assert!(take_rotated_text(&mut scene).is_none_or(|left| {
            left.elements
                .iter()
                .all(|one| matches!(one, Primitive::Text { content, .. } if content.is_empty()))
        }));
    }
}
