//! Results that have changed since they were written: flap detects and rejects them, but reads them with
//! `--ignore-damage`.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use csv::StringRecord;
use flap_sweep::files::beside::sidecar_of;
use flap_sweep::files::integrity::{self, Integrity, OnDamage};
use flap_sweep::files::job::{self, Begun, Job, OnExisting};
use flap_sweep::files::journal;
use flap_sweep::files::results::{Format, Provenance, Writer};
use flap_sweep::files::session::SessionOptions;
use flap_sweep::files::sidecar::{Sidecar, State};
use flap_sweep::run::RunOptions;

use crate::support::{Folder, quick, start, wait};

const ENDINGS: [&str; 3] = ["csv", "csv.zst", "parquet"];

/// Number of corruptions of each file.
const CORRUPTIONS: usize = 300;

/// Number of rows: three blocks, and the last block is not full.
const ROWS: u64 = 700;

/// Finished results in every format.
fn finished() -> Folder {
    let folder = Folder::with_grid(&quick(ROWS));
    for ending in ENDINGS {
        folder.ends(0, &format!("sweep --grid grid.toml --out rows.{ending}"));
    }
    folder
}

/// Random numbers that are the same in every run (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).unwrap() % limit
    }
}

/// Returns the bytes of a file with a change that disks, transfers or editors can cause.
fn corrupted(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let mut other = bytes.to_vec();
    let at = random.below(bytes.len());
    match random.below(5) {
        0 => other[at] ^= 1 << random.below(8),
        1 => other[at] = other[at].wrapping_add(1 + u8::try_from(random.below(255)).unwrap()),
        // Nothing at all would be a sweep that has not begun.
        2 => other.truncate(at.max(1)),
        3 => {
            let end = (at + 1 + random.below(64)).min(bytes.len());
            other.drain(at..end);
        }
        _ => {
            let end = (at + 1 + random.below(64)).min(bytes.len());
            other[at..end].fill(0);
        }
    }
    other
}

/// Returns the text with changed rows.
fn edited(random: &mut Random, text: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let at = 1 + random.below(lines.len() - 1);
    match random.below(6) {
        0 => {
            lines.remove(at);
        }
        1 => {
            lines.pop();
        }
        2 => lines.insert(at, lines[at].clone()),
        3 => {
            let other = 1 + random.below(lines.len() - 1);
            lines.swap(at, other);
        }
        4 => {
            let digits: Vec<usize> =
                lines[at].match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at).collect();
            let digit = digits[random.below(digits.len())];
            let now = if &lines[at][digit..=digit] == "7" { "8" } else { "7" };
            lines[at].replace_range(digit..=digit, now);
        }
        _ => lines[at] = lines[at].replace("unsettled", "peridoic"),
    }
    lines.join("\n") + "\n"
}

/// The rows of `text` in a format; the file is valid for the format.
fn written(folder: &Folder, format: Format, text: &str, provenance: &Provenance) -> Vec<u8> {
    match format {
        Format::Csv => text.as_bytes().to_vec(),
        Format::CsvZstd => zstd::encode_all(text.as_bytes(), 3).unwrap(),
        Format::Parquet => {
            let path = folder.path("edited.parquet");
            let mut writer = Writer::new(File::create(&path).unwrap(), format, provenance).unwrap();
            let mut reader = csv::Reader::from_reader(text.as_bytes());
            let mut row = StringRecord::new();
            while reader.read_record(&mut row).unwrap() {
                writer.row(&row).unwrap();
            }
            writer.finish().unwrap();
            fs::read(path).unwrap()
        }
    }
}

fn is_damaged(path: &Path) -> bool {
    match integrity::verify(path) {
        Ok(Integrity::Damaged(damage)) => {
            assert!(!damage.to_string().is_empty());
            true
        }
        Ok(_) => false,
        Err(_) => true,
    }
}

/// True if `flap results resume` reports complete results.
fn is_complete(path: &Path) -> bool {
    let sidecar = Sidecar::read(&sidecar_of(path)).unwrap();
    let plan = sidecar.plan(flap_core::simulate::all()).unwrap();
    let options = SessionOptions { run: RunOptions::default(), checkpoint_interval: Duration::ZERO };
    let job =
        Job { plan: &plan, out: path.to_owned(), on_existing: OnExisting::Continue, options, origin: None };
    matches!(job::begin(&job), Ok(Begun::Complete { .. }))
}

#[test]
fn no_corruption_goes_unnoticed() {
    let folder = finished();
    let text = folder.read("rows.csv");
    for ending in ENDINGS {
        let path = folder.path(&format!("rows.{ending}"));
        let format = Format::of(&path).unwrap();
        let sound = fs::read(&path).unwrap();
        let sidecar = Sidecar::read(&sidecar_of(&path)).unwrap();
        let plan = sidecar.plan(flap_core::simulate::all()).unwrap();
        let provenance = Provenance::of(&plan, &sidecar.identity);
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let mut corruptions = 0;
        while corruptions < CORRUPTIONS {
            let (kind, bytes) = if random.below(3) == 0 {
                let rows = edited(&mut random, &text);
                if rows == text {
                    continue;
                }
                ("edited", written(&folder, format, &rows, &provenance))
            } else {
                ("corrupted", corrupted(&mut random, &sound))
            };
            if bytes == sound {
                continue;
            }
            corruptions += 1;
            fs::write(&path, &bytes).unwrap();
            let what = format!("{ending}: {kind} number {corruptions}");
            assert!(is_damaged(&path), "verify: {what}");
            assert!(integrity::open(&path, OnDamage::Refuse).is_err(), "convert: {what}");
            assert!(!is_complete(&path), "resume: {what}");
        }
        fs::write(&path, &sound).unwrap();
        assert_eq!(integrity::verify(&path).unwrap(), Integrity::Sound { rows: ROWS }, "{ending}");
        assert!(is_complete(&path));
    }
}

#[test]
fn no_corruption_of_a_sidecar_goes_unnoticed() {
    let folder = finished();
    let path = folder.path("rows.csv.meta.toml");
    let sound = fs::read(&path).unwrap();
    let mut random = Random(77);
    let mut corruptions = 0;
    while corruptions < CORRUPTIONS {
        let bytes = corrupted(&mut random, &sound);
        if bytes == sound {
            continue;
        }
        corruptions += 1;
        fs::write(&path, &bytes).unwrap();
        assert!(Sidecar::read(&path).is_err(), "number {corruptions}: {}", folder.read("rows.csv.meta.toml"));
    }
}

/// Each command reports the damage, and with `--ignore-damage` each command works.
#[test]
fn commands_refuse_what_is_damaged() {
    let folder = finished();
    assert_eq!(folder.flap("sweep --grid grid.toml --shard 1/2").code, 0);
    assert_eq!(folder.flap("sweep --grid grid.toml --shard 2/2").code, 0);
    for ending in ENDINGS {
        let name = format!("rows.{ending}");
        let bytes = fs::read(folder.path(&name)).unwrap();
        let rows = folder.read("rows.csv").replacen(",unsettled,", ",periodic,", 1);
        let sidecar = Sidecar::read(&folder.path(&format!("{name}.meta.toml"))).unwrap();
        let plan = sidecar.plan(flap_core::simulate::all()).unwrap();
        let provenance = Provenance::of(&plan, &sidecar.identity);
        let edited = written(&folder, Format::of(Path::new(&name)).unwrap(), &rows, &provenance);
        fs::write(folder.path(&name), edited).unwrap();
        let told = "rows 1 to 256 have changed since they were written";

        let ended = folder.ends(3, &format!("results verify {name} grid.1of2.csv"));
        assert_eq!(ended.stdout, format!("{name}: damaged: {told}\ngrid.1of2.csv: sound: 350 rows\n"));
        for command in [
            "results resume NAME",
            "results rerun NAME --status periodic --out out.csv",
            "results convert NAME out.csv",
            "plot NAME --y cycles",
        ] {
            let command = command.replace("NAME", &name);
            let ended = folder.ends(3, &command);
            assert!(
                ended.stderr.starts_with(&format!("error: {name} is damaged: {told}\nhelp: ")),
                "{}",
                ended.stderr
            );
            assert!(!folder.path("out.csv").exists());
            let ended = folder.ends(0, &format!("{command} --ignore-damage"));
            assert!(
                ended.stderr.starts_with(&format!("warning: {name} is damaged: {told}\n")),
                "{}",
                ended.stderr
            );
            for left in ["out.csv", "out.csv.meta.toml", "rows.svg"] {
                let _ = fs::remove_file(folder.path(left));
            }
        }
        fs::write(folder.path(&name), bytes).unwrap();
        assert_eq!(
            folder.flap(&format!("results verify {name}")).stdout,
            format!("{name}: sound: {ROWS} rows\n")
        );
    }

    let shard = folder.read("grid.2of2.csv");
    fs::write(folder.path("grid.2of2.csv"), shard.replacen(",unsettled,", ",periodic,", 1)).unwrap();
    let merge = "results merge merged.csv grid.1of2.csv grid.2of2.csv";
    let ended = folder.ends(3, merge);
    assert!(ended.stderr.starts_with("error: grid.2of2.csv is damaged: rows 1 to 256"), "{}", ended.stderr);
    folder.ends(0, &format!("{merge} --ignore-damage"));
    let ended = folder.ends(1, "results verify merged.csv");
    assert_eq!(ended.stdout, "merged.csv: unverified: the sidecar has no checksums\n");
}

/// Damaged rows stay damaged in another format.
#[test]
fn conversion_does_not_heal() {
    let folder = finished();
    let rows = folder.read("rows.csv");
    let lines: Vec<&str> = rows.lines().collect();
    let missing = [&lines[..300], &lines[301..]].concat().join("\n") + "\n";
    fs::write(folder.path("rows.csv"), missing).unwrap();
    let told =
        "rows 257 to 700 have changed since they were written; it contains 699 rows, but 700 were written";
    assert_eq!(folder.flap("results verify rows.csv").stdout, format!("rows.csv: damaged: {told}\n"));
    assert_eq!(folder.flap("results convert rows.csv out.parquet --ignore-damage").code, 0);
    let ended = folder.flap("results verify out.parquet");
    assert_eq!((ended.code, ended.stdout), (3, format!("out.parquet: damaged: {told}\n")));
}

/// With `--ignore-damage`, flap leaves out lines that are not rows.
#[test]
fn what_is_no_row_is_left_out() {
    let folder = finished();
    let rows = folder.read("rows.csv");
    let broken = rows.replacen("\n5,", "\n5,7,", 1).replacen("\n6,", "\n9999,", 1);
    fs::write(folder.path("rows.csv"), broken).unwrap();
    folder
        .ends(0, "results convert rows.csv out.csv --ignore-damage")
        .says("warning: rows.csv: 2 lines are not rows and are left out\n");
    assert_eq!(folder.read("out.csv").lines().count(), 1 + 698);
}

/// Without checksums, flap checks that the rows are rows of the grid.
#[test]
fn rows_without_checksums_must_be_those_of_the_grid() {
    let folder = finished();
    let mut sidecar = Sidecar::read(&folder.path("rows.csv.meta.toml")).unwrap();
    sidecar.checksums = None;
    sidecar.write(&folder.path("rows.csv.meta.toml")).unwrap();
    let ended = folder.ends(1, "results verify rows.csv");
    assert_eq!(ended.stdout, "rows.csv: unverified: the sidecar has no checksums\n");
    let ended = folder.ends(0, "results convert rows.csv out.csv");
    assert!(ended.stderr.starts_with("warning: rows.csv could not be verified: "), "{}", ended.stderr);
    assert_eq!(folder.flap("results verify out.csv").code, 0, "the copy has checksums");

    let rows = folder.read("rows.csv");
    let lines: Vec<&str> = rows.lines().collect();
    let (first, second) = (lines[4], lines[5]);
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let without = |place: usize| joined(&[&lines[..place], &lines[place + 1..]].concat());
    for (edited, message) in [
        (rows.replacen("unsettled", "peridoic", 1), "row 1: `peridoic` is not a status"),
        (without(4), "row 4 belongs to point 4: the row of point 3 is missing"),
        (without(700), "it contains 699 rows, but 700 were written"),
        (
            rows.replacen(first, &format!("{first}\n{first}"), 1),
            "row 5 belongs to point 3: it is repeated or out of order",
        ),
        (
            rows.replacen(&format!("{first}\n{second}"), &format!("{second}\n{first}"), 1),
            "row 4 belongs to point 4: the row of point 3",
        ),
        (
            rows.clone() + "700" + lines[700].strip_prefix("699").unwrap() + "\n",
            "row 701 belongs to point `700`, which was not run",
        ),
    ] {
        fs::write(folder.path("rows.csv"), edited).unwrap();
        folder.ends(3, "results convert rows.csv other.csv").says(message);
        assert!(!folder.path("other.csv").exists());
    }
}

#[test]
fn results_without_a_sidecar_could_not_be_verified() {
    let folder = finished();
    fs::remove_file(folder.path("rows.csv.meta.toml")).unwrap();
    let ended = folder.ends(1, "results verify rows.csv");
    assert_eq!(ended.stdout, "rows.csv: unverified: there is no sidecar beside the file\n");
    folder
        .ends(0, "plot rows.csv --y cycles")
        .says("warning: rows.csv could not be verified: there is no sidecar");
    let missing = folder.ends(3, "results verify missing.csv");
    assert_eq!(missing.stdout, "missing.csv: unreadable: there is no such file\n");
    assert_eq!(folder.flap("results verify").code, 2);
}

#[test]
fn an_edited_sidecar_is_noticed() {
    let folder = finished();
    let sidecar = folder.read("rows.csv.meta.toml").replace("max_cycles = 1\n", "max_cycles = 2\n");
    fs::write(folder.path("rows.csv.meta.toml"), sidecar).unwrap();
    for command in [
        "results resume rows.csv",
        "results convert rows.csv out.csv",
        "plot rows.csv",
        "results verify rows.csv",
        "sweep rows.csv.meta.toml --out out.csv",
    ] {
        let ended = folder.ends(3, command);
        let told = ended.stderr + &ended.stdout;
        assert!(told.contains("rows.csv.meta.toml is damaged: its first line is not the checksum"), "{told}");
    }
    assert_eq!(folder.flap("plot rows.csv --y cycles --ignore-damage").code, 0);

    // One whose checksum was made anew still has the hash of its grid.
    let mut edited = Sidecar::read_damaged(&folder.path("rows.csv.meta.toml")).unwrap();
    edited.grid.text = edited.grid.text.replace("rtol = 1e-3", "rtol = 1e-4");
    edited.write(&folder.path("rows.csv.meta.toml")).unwrap();
    folder
        .ends(2, "sweep rows.csv.meta.toml --out out.csv")
        .says("the recorded grid was edited after the sweep");
    assert!(!folder.path("out.csv").exists());
}

/// Unfinished results as a killed sweep leaves them: the header, rows up to a checkpoint, and incomplete rows.
fn unfinished(ending: &str) -> Folder {
    unfinished_of(&quick(100_000_000), ending)
}

fn unfinished_of(grid: &str, ending: &str) -> Folder {
    let folder = Folder::with_grid(grid);
    let out = format!("rows.{ending}");
    let mut child = start(&folder, &["sweep", "--grid", "grid.toml", "--out", &out, "--checkpoint", "5 ms"]);
    let journal = folder.path(&format!("{out}.journal"));
    let begun = Instant::now();
    while fs::metadata(&journal).map_or(0, |metadata| metadata.len()) < 1500 {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing is written");
        thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    wait(&mut child);
    let rows = if ending == "parquet" { format!("{out}.part") } else { out };
    let mut file = File::options().append(true).open(folder.path(&rows)).unwrap();
    file.write_all(b"17,junk").unwrap();
    folder
}

#[test]
fn unfinished_results_say_so_and_are_read_as_far_as_they_are_safe() {
    for ending in ENDINGS {
        let folder = unfinished(ending);
        let name = format!("rows.{ending}");
        let ended = folder.ends(0, &format!("results verify {name}"));
        let told = ended.stdout.strip_prefix(&format!("{name}: unfinished: sound so far (")).unwrap();
        let done: usize = told.strip_suffix(" points done)\n").unwrap().parse().unwrap();
        assert!(done > 0);
        let warning = format!(
            "warning: {name} is unfinished: {done} points done so far; `flap results resume` continues the run\n"
        );
        let ended = folder.ends(0, &format!("plot {name} --y cycles --html page.html"));
        assert!(ended.stderr.starts_with(&warning), "{}", ended.stderr);
        let ended = folder.flap(&format!("results convert {name} out.csv"));
        assert_eq!((ended.code, ended.stderr), (0, format!("{warning}{done} rows in out.csv\n")));
        let rows = folder.read("out.csv");
        assert_eq!(rows.lines().count(), 1 + done);
        assert!(rows.lines().last().unwrap().starts_with(&format!("{},", done - 1)));
        let sidecar = Sidecar::read(&folder.path("out.csv.meta.toml")).unwrap();
        assert_eq!((sidecar.state, sidecar.summary), (State::Running, None));
        let ended = folder.flap("plot out.csv --y cycles");
        assert!(ended.stderr.starts_with("warning: out.csv is unfinished: "), "{}", ended.stderr);

        // Rows that were changed meanwhile are noticed.
        let path = folder.path(&if ending == "parquet" { format!("{name}.part") } else { name.clone() });
        let mut bytes = fs::read(&path).unwrap();
        bytes[700] ^= 1;
        fs::write(&path, bytes).unwrap();
        for command in
            ["results verify NAME", "results convert NAME other.csv", "plot NAME --y cycles --force"]
        {
            let ended = folder.ends(3, &command.replace("NAME", &name));
            assert!((ended.stdout + &ended.stderr).contains("the file has changed since the sweep wrote it"));
        }
    }
}

/// The file of the rows of unfinished results.
fn rows_of(folder: &Folder, ending: &str) -> PathBuf {
    let part = if ending == "parquet" { ".part" } else { "" };
    folder.path(&format!("rows.{ending}{part}"))
}

/// Every row that the journal records must be in the file; one missing row is damage.
#[test]
fn lost_rows_of_unfinished_results_are_damage() {
    for ending in ENDINGS {
        let folder = unfinished(ending);
        let name = format!("rows.{ending}");
        let path = rows_of(&folder, ending);
        let sound = fs::read(&path).unwrap();
        let journal = journal::parse(&fs::read(folder.path(&format!("{name}.journal"))).unwrap()).unwrap();
        let (last, _) = journal.checkpoints.last().unwrap();
        let recorded = usize::try_from(last.file.bytes).unwrap();
        let mut random = Random(5);
        let mut cuts: Vec<usize> = (0..50).map(|_| random.below(recorded)).collect();
        cuts.extend([0, recorded - 1]);
        for bytes in cuts {
            fs::write(&path, &sound[..bytes]).unwrap();
            let safe =
                journal.checkpoints.iter().rfind(|(checkpoint, _)| checkpoint.file.bytes <= bytes as u64);
            let lost = last.summary.rows - safe.map_or(0, |(checkpoint, _)| checkpoint.summary.rows);
            let Integrity::Damaged(damage) = integrity::verify(&folder.path(&name)).unwrap() else {
                panic!("{ending}: {bytes} of {recorded} bytes are sound")
            };
            assert_eq!(damage.lost, lost, "{ending}: {bytes} bytes");
            assert!(integrity::open(&folder.path(&name), OnDamage::Refuse).is_err());
            let Ok(mut opened) = integrity::open(&folder.path(&name), OnDamage::Tolerate) else {
                assert!(
                    ending != "csv" && lost == last.summary.rows,
                    "{ending}: half of the frame of the header"
                );
                continue;
            };
            let mut row = StringRecord::new();
            let mut rows = 0;
            while opened.reader.next(&mut row).unwrap() {
                assert_eq!(row.get(0), Some(rows.to_string().as_str()), "{ending}");
                rows += 1;
            }
            assert!(
                rows <= last.summary.rows && rows + lost >= last.summary.rows,
                "{ending}: {rows} rows of {bytes} bytes"
            );
        }
        fs::write(&path, &sound[..recorded - 1]).unwrap();
        let ended = folder.ends(3, &format!("results verify {name}"));
        assert!(ended.stdout.starts_with(&format!("{name}: damaged: it lacks ")), "{}", ended.stdout);
        for command in [
            "results convert NAME out.csv",
            "plot NAME --y cycles",
            "results rerun NAME --status periodic --out out.csv",
        ] {
            let ended = folder.ends(3, &command.replace("NAME", &name));
            ended.says(&format!("error: {name} is damaged: it lacks "));
            ended.says(&format!("help: `flap results resume {name}` computes the rows again\n"));
        }
        folder.ends(0, &format!("results convert {name} out.csv --ignore-damage"));

        fs::write(&path, &sound).unwrap();
        let done = last.summary.rows;
        let ended = folder.ends(0, &format!("results verify {name}"));
        ended.prints(&format!("{name}: unfinished: sound so far ({done} points done)\n"));
    }
}

/// The journal identifies the sweep of the rows, so flap rejects a sidecar of another sweep.
#[test]
fn the_sidecar_of_another_sweep_is_noticed() {
    for ending in ENDINGS {
        let (folder, other) = (unfinished(ending), unfinished_of(&quick(99_999_999), ending));
        let name = format!("rows.{ending}");
        let sidecar = format!("{name}.meta.toml");
        let own = fs::read(folder.path(&sidecar)).unwrap();
        fs::copy(other.path(&sidecar), folder.path(&sidecar)).unwrap();
        let told =
            format!("{name} is damaged: its sidecar belongs to another sweep: the grid file differs\n");
        let ended = folder.ends(3, &format!("results verify {name}"));
        assert_eq!(ended.stdout, told.replace(" is damaged", ": damaged"));
        for command in [
            "results resume NAME",
            "results rerun NAME --status periodic --out out.csv",
            "results convert NAME out.csv",
            "plot NAME --y cycles",
            "top NAME --by cycles",
            "describe NAME",
        ] {
            let ended = folder.ends(3, &command.replace("NAME", &name));
            assert!(ended.stderr.starts_with(&format!("error: {told}help: ")), "{}", ended.stderr);
        }
        // The rows are sound, but nothing tells their grid.
        folder.ends(0, &format!("top {name} --by cycles --all --ignore-damage"));
        folder.ends(3, &format!("results convert {name} out.csv --ignore-damage")).says(&told);
        assert!(!folder.path("out.csv").exists());
        let opened = integrity::open(&folder.path(&name), OnDamage::Tolerate).unwrap();
        assert!(opened.sidecar.is_none());

        fs::write(folder.path(&sidecar), own).unwrap();
        folder.ends(0, &format!("results verify {name}"));
    }
}

/// Before its first checkpoint, a sweep has written no header.
#[test]
fn results_without_a_checkpoint_have_no_rows_yet() {
    for ending in ENDINGS {
        let folder = unfinished(ending);
        let name = format!("rows.{ending}");
        let journal = folder.path(&format!("{name}.journal"));
        let text = fs::read(&journal).unwrap();
        let header = text.iter().position(|&byte| byte == b'\n').unwrap() + 1;
        fs::write(&journal, &text[..header]).unwrap();
        for command in ["results convert NAME out.csv", "plot NAME --y cycles", "top NAME --by cycles"] {
            let ended = folder.ends(2, &command.replace("NAME", &name));
            ended.says(&format!("error: {name} has no rows yet: its sweep has not reached a checkpoint\n"));
        }
        assert!(!folder.path("out.csv").exists());
    }
}

/// The checksum of the sidecar is computed from bytes, also if the bytes are not text.
#[test]
fn a_sidecar_that_is_not_utf8_is_damaged() {
    let folder = Folder::with_grid(&format!("# \u{FFFD}\n{}", quick(3)));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "results verify rows.csv");
    let path = folder.path("rows.csv.meta.toml");
    let sound = fs::read(&path).unwrap();
    let place = sound.windows(3).position(|bytes| bytes == "\u{FFFD}".as_bytes()).unwrap();
    fs::write(&path, [&sound[..place], &[0xFF], &sound[place + 3..]].concat()).unwrap();
    folder
        .ends(3, "results verify rows.csv")
        .prints("rows.csv.meta.toml is damaged: its first line is not the checksum");
}

/// Rows of an unfinished sweep whose journal was lost.
#[test]
fn half_a_row_at_the_end_is_no_row() {
    let folder = finished();
    folder.rewrite_sidecar("rows.csv", |sidecar| {
        sidecar.state = State::Running;
        sidecar.checksums = None;
    });
    let rows = folder.read("rows.csv");
    fs::write(folder.path("rows.csv"), &rows[..rows.len() - 2]).unwrap();
    folder.ends(0, "results convert rows.csv out.csv").says("warning: rows.csv is unfinished: ");
    assert_eq!(folder.read("out.csv"), rows[..=rows.trim_end().rfind('\n').unwrap()]);
}
