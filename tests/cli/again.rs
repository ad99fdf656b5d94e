//! Sweeps whose results already exist, and grids from stdin.

use std::fs;

use crate::support::{Folder, frequencies, quick};

const COMPLETE: &str = "is complete: nothing is left to run; use --restart to run its points again\n";

#[test]
fn a_second_sweep_of_the_same_grid_runs_nothing() {
    for ending in ["csv", "csv.zst", "parquet"] {
        let folder = Folder::with_grid(&frequencies(3));
        let sweep = format!("sweep grid.toml --out rows.{ending}");
        folder.ends(0, &sweep).says(&format!("3 rows in rows.{ending}\n"));
        let rows = fs::read(folder.path(&format!("rows.{ending}"))).unwrap();
        let sidecar = folder.read(&format!("rows.{ending}.meta.toml"));
        let again = folder.ends(0, &sweep);
        assert_eq!(again.stderr, format!("rows.{ending} {COMPLETE}"));
        assert_eq!(again.stdout, "");
        assert!(fs::read(folder.path(&format!("rows.{ending}"))).unwrap() == rows);
        assert_eq!(folder.read(&format!("rows.{ending}.meta.toml")), sidecar);
        assert!(!folder.path(&format!("rows.{ending}.journal")).exists());
        folder.ends(0, &format!("{sweep} --force")).says("3 periodic in ");
    }
}

#[test]
fn the_exit_code_is_that_of_the_first_sweep() {
    let folder = Folder::with_grid(&quick(3));
    folder.ends(1, "sweep grid.toml --strict");
    assert_eq!(folder.ends(1, "sweep grid.toml --strict").stderr, format!("grid.csv {COMPLETE}"));
    folder.ends(0, "sweep grid.toml").says(COMPLETE);
}

#[test]
fn rows_of_another_grid_or_shard_are_not_replaced_unasked() {
    let folder = Folder::with_grid(&quick(3));
    folder.ends(0, "sweep grid.toml");
    let rows = folder.read("grid.csv");
    fs::write(folder.path("grid.toml"), quick(3).replace("rtol = 1e-3", "rtol = 1e-4")).unwrap();
    let ended = folder.ends(2, "sweep grid.toml");
    assert_eq!(
        ended.stderr,
        "error: grid.csv exists already, with other rows: the grid file differs; the solver settings differ\n\
         help: line 7 of the grid was `rtol = 1e-3`, it is `rtol = 1e-4`\n\
         help: an edited grid is another sweep: write its rows to another file with --out FILE\n\
         help: use --out FILE to write to another file, or --restart to replace the file\n"
    );
    fs::write(folder.path("grid.toml"), quick(3)).unwrap();
    folder
        .ends(2, "sweep grid.toml --shard 1/2 --out grid.csv")
        .says("with other rows: the rows cover all points, not shard 1/2\n");
    folder.rewrite_sidecar("grid.csv", |sidecar| sidecar.identity.build = "0123456789abcdef".to_owned());
    folder
        .ends(2, "sweep grid.toml")
        .says("with other rows: the rows were computed by build 0123456789abcdef of flap");
    assert_eq!(folder.read("grid.csv"), rows);
}

#[test]
fn damaged_rows_do_not_count_as_complete() {
    let folder = Folder::with_grid(&quick(3));
    folder.ends(0, "sweep grid.toml");
    let rows = folder.read("grid.csv").replacen("unsettled", "periodic!", 1);
    fs::write(folder.path("grid.csv"), &rows).unwrap();
    folder
        .ends(3, "sweep grid.toml")
        .says("grid.csv is damaged")
        .says("run the same command with --restart to compute the rows again");
    assert_eq!(folder.read("grid.csv"), rows);
}

#[test]
fn a_grid_is_named_once() {
    let folder = Folder::with_grid(&quick(1));
    let named = folder.ends(0, "sweep --grid grid.toml --out -").stdout;
    assert_eq!(folder.ends(0, "sweep grid.toml --out -").stdout, named);
    assert_eq!(folder.ends(0, "sweep -g grid.toml --out -").stdout, named);
    folder
        .ends(2, "sweep grid.toml --grid grid.toml")
        .says("the argument '[GRID]' cannot be used with '--grid <GRID>'")
        .says("Usage: flap sweep");
    folder.ends(2, "sweep").says("<GRID>");
    folder.ends(2, "sweep a.meta.toml").says("help: name the file of the results with --out FILE");
    folder.ends(2, "sweep a.meta.toml --out b.csv --shard 1/2").says("--shard requires a grid file");
}

#[test]
fn a_grid_may_come_from_stdin() {
    let folder = Folder::with_grid(&quick(3));
    let grid = quick(3);
    let reading = |arguments: &[&str]| folder.flap_reading(&grid, arguments);
    assert_eq!(
        reading(&["check", "-"]).stdout.lines().next(),
        Some("3 points of direct-drive from ozaki2018-large")
    );
    assert_eq!(reading(&["run", "-", "--point", "2"]).code, 0);
    let streamed = reading(&["sweep", "-", "--out", "-"]);
    assert_eq!((streamed.code, streamed.stdout.lines().count()), (0, 4), "{}", streamed.stderr);

    let nameless = reading(&["sweep", "-"]);
    assert_eq!(
        (nameless.code, nameless.stderr.as_str()),
        (
            2,
            "error: a grid from stdin requires a name for its results\n\
             help: name the file of the results with --out FILE, or with `path` in [output] of the grid\n"
        )
    );

    // The rows are those of a grid file, and what follows them needs no grid file either.
    assert_eq!(reading(&["sweep", "-", "--out", "rows.csv"]).code, 0);
    folder.ends(0, "sweep grid.toml");
    assert_eq!(folder.read("rows.csv"), folder.read("grid.csv"));
    assert!(reading(&["sweep", "-", "--out", "rows.csv"]).stderr.contains("nothing is left to run"));
    assert_eq!(
        folder.flap("results resume rows.csv").stderr,
        "rows.csv is complete: nothing is left to run; use --restart to run its points again\n"
    );
    folder.ends(0, "results convert rows.csv rows.parquet");
    let with_path = grid.clone() + "[output]\npath = \"here.csv\"\n";
    assert_eq!(folder.flap_reading(&with_path, &["sweep", "-", "--shard", "1/2"]).code, 0);
    assert!(folder.path("here.1of2.csv").exists());
}

#[test]
fn mistakes_on_stdin_have_their_place() {
    let folder = Folder::new();
    let ended = folder.flap_reading("preset = \"ozaki2018-large\"\n[param]\n", &["check", "-"]);
    assert_eq!(ended.code, 2);
    ended.says("<stdin>:2:2");
    let results = folder.flap_reading("point,status\n0,periodic\n", &["check", "-"]);
    results.says("<stdin> contains results and is not a grid file");
    let empty = folder.flap_reading("", &["sweep", "-", "--out", "-"]);
    assert_eq!(empty.code, 2);
    empty.says("<stdin>");
}
