//! Pictures as pixels.

use kuva::backend::raster::RasterBackend;
use kuva::render::render::{Primitive, Scene};

use super::turned;

/// Pixels per unit of a picture's size.
const SCALE: u32 = 2;

/// Most pixels of a picture that is drawn larger and averaged.
const MOST_PIXELS: f64 = 1e8;

/// A picture as PNG, with [`SCALE`] times as many pixels each way as it has units.
///
/// It is drawn twice as large and averaged, for smooth lines and points.
pub(super) fn bytes(mut scene: Scene) -> Result<Vec<u8>, String> {
    scene.elements = scene.elements.into_iter().flat_map(dashes).collect();
    let turned = turned::take(&mut scene);
    let fine = 2 * SCALE;
    let is_large = scene.width * scene.height * f64::from(fine * fine) > MOST_PIXELS;
    let draw = |scene: &Scene| {
        let scale = if is_large { SCALE } else { fine };
        Image::read(&RasterBackend::new().with_scale(scale as f32).render_scene(scene)?)
    };
    let mut image = draw(&scene)?;
    if let Some(turned) = turned {
        image.darken_turned(&draw(&turned)?);
    }
    if is_large { image.write() } else { image.halved().write() }
}

/// An image of rows of pixels, three or four bytes each.
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

    /// Lays dark marks on white over the image, after a quarter turn to the left.
    fn darken_turned(&mut self, marks: &Image) {
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

    /// Every pixel the mean of two by two.
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

    /// The bytes of the pixels' colours.
    fn opaque(&self) -> Vec<u8> {
        self.bytes.chunks(self.channels).flat_map(|pixel| pixel[..3].to_vec()).collect()
    }

    fn write(&self) -> Result<Vec<u8>, String> {
        let side = |length: usize| u32::try_from(length).map_err(|error| error.to_string());
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, side(self.width)?, side(self.height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        // Flat colours repeat byte by byte.
        encoder.set_filter(png::Filter::NoFilter);
        let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
        writer.write_image_data(&self.opaque()).map_err(|error| error.to_string())?;
        writer.finish().map_err(|error| error.to_string())?;
        Ok(png)
    }
}

/// A dashed line as its dashes: the library begins its pattern anew at every point, so that lines of many points come out
/// solid.
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

#[cfg(test)]
mod tests {
    use super::*;
    use kuva::render::color::Color;

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
    fn marks_are_turned_to_the_left() {
        // Two by one pixels: dark, then white. Turned to the left, dark is below.
        let marks = Image { width: 2, height: 1, channels: 3, bytes: vec![0, 0, 0, 255, 255, 255] };
        let mut image = Image { width: 1, height: 2, channels: 4, bytes: vec![200; 8] };
        image.darken_turned(&marks);
        assert_eq!(image.opaque(), [200, 200, 200, 0, 0, 0]);
    }

    #[test]
    fn images_are_averaged() {
        let bytes = [0, 0, 0, 4, 8, 12, 0, 0, 0, 4, 8, 12].to_vec();
        let image = Image { width: 2, height: 2, channels: 3, bytes }.halved();
        assert_eq!((image.width, image.height), (1, 1));
        assert_eq!(image.bytes, [2, 4, 6]);
        let again = Image::read(&image.write().unwrap()).unwrap();
        assert_eq!(again.bytes, image.bytes);
    }
}
