//! Pages to explore results in a browser.

use std::fmt::Write as _;
use std::fs;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

use super::{HEADER, count, folder, refused, sweep};
use crate::support::Folder;

/// The text of a page's data.
fn data_text(page: &str) -> &str {
    let start = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap().1;
    start.split_once("</script>").unwrap().0
}

/// The data of a page.
fn data(page: &str) -> Value {
    serde_json::from_str(data_text(page)).unwrap()
}

/// A column of a page.
fn column(page: &str, name: &str) -> Value {
    let data = data(page);
    let columns = data["columns"].as_array().unwrap();
    columns.iter().find(|column| column["name"] == name).unwrap().clone()
}

/// The bytes of a column's numbers or codes.
fn bytes(column: &Value) -> Vec<u8> {
    STANDARD.decode(column["data"].as_str().unwrap()).unwrap()
}

/// The numbers of a column in a page; NaN for empty cells.
fn numbers(page: &str, name: &str) -> Vec<f64> {
    let column = column(page, name);
    let bytes = bytes(&column);
    match column["values"].as_array() {
        Some(values) => {
            assert_eq!(column["type"], "u8");
            bytes.iter().map(|code| values[usize::from(*code)].as_f64().unwrap_or(f64::NAN)).collect()
        }
        None => bytes.chunks(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect(),
    }
}

#[test]
fn a_page_holds_the_rows_and_needs_no_network() {
    let folder = folder();
    folder.ends(0, "plot sweep.csv --html page.html");
    assert!(!folder.path("sweep.svg").exists(), "a picture only if it is asked for");
    let page = folder.read("page.html");
    // Names of a namespace, of a project in a comment, of a part of the picture itself; and an empty icon.
    let harmless = [
        "http://www.w3.org/2000/svg",
        "https://github.com/leeoniya/uPlot",
        "url(#inside)",
        "href=\"data:,\"",
    ];
    let asks = harmless.iter().fold(page.clone(), |text, name| text.replace(name, ""));
    for outside in ["http:", "https:", "//cdn", "src=", "href=", "import(", "fetch(", "url(", "@import", "{{"]
    {
        assert!(!asks.contains(outside), "{outside}");
    }
    assert!(page.contains("default-src 'none'"), "the browser refuses what would be fetched");
    let rows: Vec<Vec<String>> =
        sweep().lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect();
    for (place, name) in HEADER.split(',').enumerate() {
        let cells = rows.iter().map(|row| row[place].as_str());
        if ["status", "stable"].contains(&name) {
            let column = column(&page, name);
            let (words, codes) = (column["words"].as_array().unwrap(), bytes(&column));
            let word = |code: &u8| words.get(usize::from(*code)).map_or("", |word| word.as_str().unwrap());
            let found = codes.iter().map(word);
            assert!(found.eq(cells), "{name}");
        } else {
            let wanted: Vec<u64> = cells.map(|cell| cell.parse().unwrap_or(f64::NAN).to_bits()).collect();
            let found: Vec<u64> = numbers(&page, name).into_iter().map(f64::to_bits).collect();
            assert_eq!(found, wanted, "{name}");
        }
    }
    let hinge = column(&page, "hinge_stiffness");
    assert_eq!((&hinge["unit"], &hinge["factor"]), (&"µN·m/rad".into(), &1e6.into()));
    assert_eq!(hinge["title"], "Hinge stiffness (µN·m/rad)");
    // It begins as the picture would.
    let start = &data(&page)["start"];
    assert_eq!(start["kind"], "line");
    assert_eq!((&start["x"], &start["y"], &start["by"]), (&2.into(), &5.into(), &1.into()));
    let ended = refused(&folder, &["sweep.csv", "--html", "page.html"]);
    ended.says("page.html exists already");
}

#[test]
fn a_page_cannot_be_broken_by_names() {
    let folder = Folder::new();
    let evil = "</script><script>alert(1)</script>";
    fs::write(
        folder.path("evil.csv"),
        format!("point,{evil},status,\"a\"\"b\\c{{{{data}}}}\"\n0,1,{evil},3\n1,2,<b>,4\n"),
    )
    .unwrap();
    folder.ends_with(
        0,
        &["plot", "evil.csv", "--html", "page.html", "--title", "<img src=x onerror=alert(1)>"],
    );
    let page = folder.read("page.html");
    assert_eq!(count(&page, "<script"), 2);
    assert_eq!(count(&page, "</script>"), 2);
    assert!(!page.contains("<img"));
    assert!(page.contains("&lt;img src=x onerror=alert(1)&gt;"));
    assert!(!data_text(&page).contains(['<', '>', '&']), "texts cannot be markup");
    assert_eq!(
        column(&page, "a\"b\\c{{data}}")["type"],
        "f64",
        "what looks like a place in the page is a name"
    );
    assert_eq!(column(&page, evil)["name"], evil);
    let ended =
        folder.flap_with(&["plot", "evil.csv", "--x", evil, "--y", "a\"b\\c{{data}}", "--title", evil]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(!folder.read("evil.svg").contains("<script"));
}

#[test]
fn a_page_of_any_table() {
    let folder = folder();
    fs::write(folder.path("other.csv"), "a,b\n1,2\n3,4\n").unwrap();
    for file in ["response.csv", "motion.csv", "other.csv"] {
        folder.ends(0, &format!("plot {file} --html {file}.html"));
    }
    assert_eq!(data(&folder.read("response.csv.html"))["branch"], 1);
    assert_eq!(numbers(&folder.read("other.csv.html"), "b"), [2.0, 4.0]);
    folder.ends(0, "plot response.csv --html both.html --out both.png");
    assert!(folder.path("both.html").exists() && folder.path("both.png").exists());
}

/// If results have too many rows for a page, the page contains every second row and a note.
#[test]
fn pages_of_many_rows_are_thinned() {
    let folder = Folder::new();
    let mut text = "point,a,status,b\n".to_owned();
    for point in 0..140_000 {
        let _ = writeln!(text, "{point},{},periodic,{}", point % 3, point % 1000);
    }
    fs::write(folder.path("many.csv"), text).unwrap();
    folder
        .ends(0, "plot many.csv --x a --y b --html many.html")
        .says("70000 of 140000 rows are in the page, evenly chosen");
    let page = folder.read("many.html");
    let told = data(&page);
    assert_eq!((&told["rows"], &told["of"], &told["stride"]), (&70_000.into(), &140_000.into(), &2.into()));
    assert_eq!(told["single"], true);
    // Single precision: no whole number of this size is changed.
    let bytes = bytes(&column(&page, "point"));
    let points = bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap()));
    assert!(points.map(f64::from).eq((0..70_000).map(|point| f64::from(2 * point))));
}
