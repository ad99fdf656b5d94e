//! Pictures with a size in print: millimetres, points and pixels per inch.

use std::fs;

use super::{folder, refused};
use crate::support::Folder;

/// Width and height of a PNG, and its pixels per metre, or 0 if the PNG has no resolution.
fn pixels(folder: &Folder, name: &str) -> [u32; 3] {
    let bytes = fs::read(folder.path(name)).unwrap();
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    let physical = bytes.windows(4).position(|four| four == b"pHYs");
    [number(16), number(20), physical.map_or(0, |at| number(at + 4))]
}

#[test]
fn a_png_has_the_resolution_of_its_size_in_print() {
    let folder = folder();
    for (options, expected) in [
        // 84 mm at 300 pixels per inch are 992.1 pixels; 300 per inch are 11811 per metre.
        ("--size 84x60mm", [992, 709, 11811]),
        ("--size 178mm,110mm --dpi 150", [1051, 650, 5906]),
        ("--size 3.3x2.4in --font-size 7 --dpi 600", [1980, 1440, 23622]),
        ("--size 84x60mm --font-size 6.3 --dpi 317", [1048, 749, 12480]),
        ("--size 400x300", [800, 600, 0]),
    ] {
        for file in ["sweep.csv", "motion.csv"] {
            folder.ends(0, &format!("plot {file} --out out.png --force {options}"));
            assert_eq!(pixels(&folder, "out.png"), expected, "{file} {options}");
        }
    }
}

/// In an SVG, a unit of drawing is a twelfth of the font size.
#[test]
fn an_svg_has_its_size_in_millimetres() {
    let folder = folder();
    folder.ends(0, "plot sweep.csv --out out.svg --size 8.4x6cm --font-size 9 --title Stroke");
    let svg = folder.read("out.svg");
    let head = svg.split('>').next().unwrap();
    assert!(head.contains(r#"width="84mm" height="60mm" viewBox="0 0 "#), "{head}");
    let sides = head.split_once("viewBox=\"0 0 ").unwrap().1.split_once('"').unwrap().0;
    let (width, height) = sides.split_once(' ').unwrap();
    let points = |units: &str| units.parse::<f64>().unwrap() * 9.0 / 12.0;
    assert!((points(width) - 84.0 / 25.4 * 72.0).abs() < 0.01, "{sides}");
    assert!((points(height) - 60.0 / 25.4 * 72.0).abs() < 0.01, "{sides}");
    // The title is larger; labels, ticks and legends have the font size.
    let sizes: Vec<&str> =
        svg.split("font-size=\"").skip(1).map(|text| text.split('"').next().unwrap()).collect();
    assert!(sizes.len() > 10 && sizes.iter().filter(|size| **size == "14").count() == 1, "{sizes:?}");
    assert!(sizes.iter().all(|size| ["12", "14"].contains(size)), "{sizes:?}");
}

/// In a narrow picture, the numbers along the horizontal axis do not overlap.
#[test]
fn numbers_of_a_narrow_picture_do_not_overlap() {
    let folder = Folder::new();
    let mut lines = vec!["point,share,status,lift_mean_mn".to_owned()];
    lines.extend((0..7).map(|i| format!("{i},0.000{}1,periodic,{i}", 3 + i)));
    fs::write(folder.path("fine.csv"), lines.join("\n") + "\n").unwrap();
    folder.ends(0, "plot fine.csv --out out.svg --size 60x60mm");
    let svg = folder.read("out.svg");
    let mut places: Vec<f64> = (svg.split("<text").skip(1))
        .filter(|text| text.split_once('>').is_some_and(|(_, text)| text.starts_with("0.000")))
        .map(|text| text.split_once("x=\"").unwrap().1.split('"').next().unwrap().parse().unwrap())
        .collect();
    places.sort_by(f64::total_cmp);
    let widths = places.windows(2).map(|two| two[1] - two[0]);
    assert!(places.len() >= 2 && widths.clone().all(|width| width > 6.0 * 0.6 * 12.0), "{places:?}");
}

#[test]
fn sizes_in_print_have_limits() {
    let folder = folder();
    for (options, message) in [
        (
            &["--size", "84x60mm", "--font-size", "24"][..],
            "a picture with text of 24 pt is at least 141 mm wide and high",
        ),
        (
            &["--size", "600x600mm", "--dpi", "1200"],
            "a picture of 28346 x 28346 pixels with text of 8 pt is too large",
        ),
        (&["--font-size", "8"], "--font-size requires a --size with a unit of length: mm, cm or in (inch)"),
        (
            &["--size", "900x560", "--dpi", "300"],
            "--dpi requires a --size with a unit of length: mm, cm or in (inch)",
        ),
        (&["--size", "84mm"], "expected WxH with a unit of length"),
        (&["--out", "out.pdf"], "rsvg-convert"),
    ] {
        let arguments = [&["sweep.csv"][..], options].concat();
        refused(&folder, &arguments).says(message);
    }
}
