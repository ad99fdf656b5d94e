//! Journals, and sessions that continue from a journal.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use flap_sweep::files::beside::journal_of;
use flap_sweep::files::journal::{self, Checkpoint, Header, Journal};
use flap_sweep::files::output;
use flap_sweep::files::results::{FileSum, Format};
use flap_sweep::files::session::{ResumeError, Resumed, Session, SessionOptions};
use flap_sweep::grid;
use flap_sweep::plan::Plan;
use flap_sweep::plan::selection::Shard;
use flap_sweep::run::identity::Identity;
use flap_sweep::run::{InvalidPoint, Progress, RunError, Sink, Summary, Written};
use flap_sweep::table::layout::Cell;
use temp_dir::TempDir;

use crate::fake::{Fake, Fault};
use crate::support::{csv, options, plan, plan_with, resume};

/// Session options with a checkpoint at every opportunity.
pub(crate) fn often() -> SessionOptions {
    SessionOptions { run: options(2, 100), checkpoint_interval: Duration::ZERO }
}

pub(crate) fn start(path: &Path, plan: &Plan) -> Session {
    let file = output::create(path, false).unwrap().0;
    Session::start(file, (path, Format::of(path).unwrap()), plan, &often(), "2026-01-02".to_owned(), false)
        .unwrap()
}

/// Runs until `stop_at` rows are written, and ends as if the machine lost its power.
pub(crate) fn run_to(session: &mut Session, plan: &Plan, before: Summary, stop_at: u64) -> Option<Summary> {
    let mut sink = Crash { session, stop_at };
    match resume(plan, &often().run, before, &mut sink, &AtomicBool::new(false), &mut |_| {}) {
        Ok(summary) => {
            session.end(&summary).unwrap();
            Some(summary)
        }
        Err(RunError::Sink(_)) => None,
        Err(error) => panic!("{error}"),
    }
}

/// A sink that fails when `stop_at` points are done.
struct Crash<'a> {
    session: &'a mut Session,
    stop_at: u64,
}

impl Sink for Crash<'_> {
    fn written(&self) -> std::io::Result<Written> {
        self.session.written()
    }

    fn begin(&mut self) -> std::io::Result<()> {
        self.session.begin()
    }

    fn write(&mut self, cells: &[Cell]) -> std::io::Result<()> {
        self.session.write(cells)
    }

    fn after_point(&mut self, so_far: &Summary) -> std::io::Result<()> {
        self.session.after_point(so_far)?;
        if so_far.done() == self.stop_at { Err(std::io::Error::other("no power")) } else { Ok(()) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.session.flush()
    }

    fn finish(&mut self) -> std::io::Result<()> {
        self.session.finish()
    }
}

/// Wherever a run ends, the continued run has the same bytes and the same summary as one run.
#[test]
fn a_session_goes_on_where_the_last_one_ended() {
    let listed = plan(Fake::leak(Fault::None, 8), 5000);
    let listed = listed.with_points((0..5000).filter(|index| index % 7 < 3).collect()).unwrap();
    let shard = plan(Fake::leak(Fault::None, 8), 3000).with_shard("2/3".parse().unwrap());
    for plan in [plan(Fake::leak(Fault::None, 8), 1000), listed, shard] {
        let (text, summary) = csv(&plan, &options(2, 100));
        let summary = summary.unwrap();
        for name in ["rows.csv", "rows.csv.zst"] {
            let folder = TempDir::new().unwrap();
            let path = folder.path().join(name);
            assert_eq!(run_to(&mut start(&path, &plan), &plan, Summary::default(), 1), None);
            for stop_at in [200, 256, 300, 512, 700] {
                let resumed = Session::resume(&path, &plan, &often()).unwrap();
                assert!(resumed.before.done() <= stop_at);
                let at_least = if name == "rows.csv" { stop_at.min(200) } else { stop_at / 256 * 256 };
                let mut session = resumed.session;
                assert_eq!(run_to(&mut session, &plan, resumed.before, stop_at), None);
                drop((session, resumed.lock));
                let resumed = Session::resume(&path, &plan, &often()).unwrap();
                assert!(resumed.before.done() >= at_least, "{} of {stop_at}", resumed.before.done());
                assert_eq!(resumed.lost, 0);
                assert_eq!(resumed.started, "2026-01-02");
            }
            let resumed = Session::resume(&path, &plan, &often()).unwrap();
            let mut session = resumed.session;
            assert_eq!(run_to(&mut session, &plan, resumed.before, u64::MAX), Some(summary.clone()));
            drop((session, resumed.lock));
            let bytes = fs::read(&path).unwrap();
            let rows = if name == "rows.csv" { bytes } else { zstd::decode_all(&bytes[..]).unwrap() };
            assert!(String::from_utf8(rows).unwrap() == text, "{name}");
            // The job removes the journal, after the sidecar.
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        }
    }
}

/// Compressed rows are checkpointed at the ends of frames of 256 rows, and plain rows after each row.
#[test]
fn an_interrupted_run_computes_less_than_a_frame_again() {
    let plan = plan(Fake::leak(Fault::None, 8), 20_000);
    let seldom = SessionOptions { run: options(2, 100), checkpoint_interval: Duration::from_hours(1) };
    for (name, frame) in [("rows.csv", 1), ("rows.csv.zst", 256)] {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join(name);
        let file = output::create(&path, false).unwrap().0;
        let begun = (path.as_path(), Format::of(&path).unwrap());
        let mut session =
            Session::start(file, begun, &plan, &seldom, "2026-01-02".to_owned(), false).unwrap();
        let stop = AtomicBool::new(false);
        let mut stop_after_some = |now: Progress| stop.store(now.finished >= 1000, Ordering::SeqCst);
        let summary =
            resume(&plan, &seldom.run, Summary::default(), &mut session, &stop, &mut stop_after_some)
                .unwrap();
        assert!(summary.is_interrupted() && summary.rows >= 1000, "{summary:?}");
        session.end(&summary).unwrap();
        drop(session);
        let resumed = Session::resume(&path, &plan, &seldom).unwrap();
        assert_eq!(resumed.before.rows, summary.rows / frame * frame, "{name}");
    }
}

/// Excluded points, derived parameters, measures of the user and a sample, with thirteen sizes.
const FORMULAS: &str = r#"
[sample]
method = "latin-hypercube"
n = 200
[sample.parameters]
drive_frequency = { mean = 50, sd = 20 }
[derived]
span = "size - 0.5"
[where]
not_slow = "drive_frequency > 40"
not_two_or_nine = "size != 2 and size != 9"
[measure]
work = "power_mean_mw / drive_frequency"
strong = "lift_mean_mn > 0.05 * drive_frequency"
"#;

#[test]
fn a_session_with_formulas_goes_on_where_the_last_one_ended() {
    let mut plan = plan_with(Fake::leak(Fault::None, 8), 13, FORMULAS);
    let (whole, _) = csv(&plan, &options(2, 100));
    for selection in ["1/1", "2/3"] {
        let shard: Shard = selection.parse().unwrap();
        plan = plan.with_shard(shard);
        let (text, summary) = csv(&plan, &options(2, 100));
        let summary = summary.unwrap();
        let mut lines = whole.lines();
        let header = lines.next();
        let of_shard = |row: &&str| shard.contains(row.split(',').next().unwrap().parse().unwrap());
        assert!(text.lines().eq(header.into_iter().chain(lines.filter(of_shard))), "{selection}");
        assert!(summary.excluded > summary.points / 3 && summary.rows > summary.points / 3);
        assert!(text.contains(",true,") && text.contains(",false,") && text.contains("invalid"));
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("rows.csv");
        let mut stops: Vec<u64> = (1..summary.points).step_by(97).collect();
        let mut session = start(&path, &plan);
        assert_eq!(run_to(&mut session, &plan, Summary::default(), stops.remove(0)), None);
        drop(session);
        let mut done = 1;
        for stop_at in stops {
            let Resumed { mut session, before, .. } = Session::resume(&path, &plan, &often()).unwrap();
            // After excluded points too.
            assert_eq!(before.done(), done);
            assert_eq!(run_to(&mut session, &plan, before, stop_at), None);
            done = stop_at;
        }
        let Resumed { mut session, before, .. } = Session::resume(&path, &plan, &often()).unwrap();
        assert_eq!(run_to(&mut session, &plan, before, u64::MAX), Some(summary));
        assert!(fs::read_to_string(&path).unwrap() == text, "{selection}");
    }
}

#[test]
fn a_changed_file_of_points_is_not_resumed() {
    let folder = TempDir::new().unwrap();
    let [path, points] = ["rows.csv", "points.csv"].map(|name| folder.path().join(name));
    let plan = |sizes: &str| {
        fs::write(&points, format!("size\n{sizes}\n")).unwrap();
        let grid = "preset = \"fake2020\"\n[sample]\nmethod = \"file\"\npath = \"points.csv\"\n";
        let name = folder.path().join("grid.toml").display().to_string();
        grid::parse(&name, grid, &[Fake::leak(Fault::None, 8)]).unwrap()
    };
    let (first, other) = (plan("1\n2\n3"), plan("1\n2\n8"));
    assert_eq!(run_to(&mut start(&path, &first), &first, Summary::default(), 2), None);
    match Session::resume(&path, &other, &often()).map(|_| ()) {
        Err(ResumeError::Changed { changes, .. }) => assert_eq!(changes, ["the file of points differs"]),
        other => panic!("{other:?}"),
    }
    let Resumed { mut session, before, .. } = Session::resume(&path, &first, &often()).unwrap();
    assert_eq!(run_to(&mut session, &first, before, u64::MAX).unwrap().rows, 3);
}

/// After a crash, incomplete text after the last whole line is ignored.
#[test]
fn a_torn_last_line_is_dropped() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("rows.csv");
    let plan = plan(Fake::leak(Fault::None, 8), 1000);
    run_to(&mut start(&path, &plan), &plan, Summary::default(), 300);
    let whole = fs::read(journal_of(&path)).unwrap();
    let lines: Vec<&[u8]> = whole.split_inclusive(|&byte| byte == b'\n').collect();
    let last = lines[lines.len() - 1];
    for kept in [0, 1, 17, last.len() / 2, last.len() - 1] {
        let torn = [&whole[..whole.len() - last.len()], &last[..kept]].concat();
        fs::write(journal_of(&path), &torn).unwrap();
        let resumed = Session::resume(&path, &plan, &often()).unwrap();
        assert_eq!(resumed.before.done(), 299, "{kept} bytes of the last line");
    }
    // Nor does one whose checksum is wrong.
    let mut wrong = whole.clone();
    let digit = whole.len() - 4;
    wrong[digit] ^= 1;
    assert_eq!(journal::parse(&wrong).unwrap().checkpoints.len(), 299);
    assert_eq!(journal::parse(&whole).unwrap().checkpoints.len(), 300);
    assert_eq!(journal::parse(&whole[1..]), None, "without a first line nothing is known");
}

#[test]
fn checkpoints_read_back() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("journal");
    let plan = plan_with(Fake::leak(Fault::None, 8), 13, FORMULAS);
    let (_, summary) = csv(&plan, &options(2, 100));
    let mut summary = summary.unwrap();
    summary.invalid[0].reason = "a reason with 'all' \"quotes\", \\ and µ".to_owned();
    summary.invalid[1] = InvalidPoint { point: 7, reason: "two\nlines".to_owned() };
    let header = Header::new("2026-01-02".to_owned(), false, Identity::of(&plan, &options(2, 100)));
    let mut journal = Journal::create(&path, &header).unwrap();
    let file = FileSum { bytes: 12_345, xxh3: "000000000000feed".to_owned() };
    let checkpoint = Checkpoint::new(1.5, file, summary);
    journal.add(&checkpoint).unwrap();
    let past = journal::read(&path).unwrap().unwrap();
    assert_eq!(past.header, header);
    assert_eq!(past.checkpoints.len(), 1);
    assert_eq!(past.checkpoints[0].0, checkpoint);
    assert_eq!(checkpoint.summary.invalid[1].reason, "two lines");
}

#[test]
fn other_versions_and_machines_do_not_go_on() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("rows.csv");
    let plan = plan(Fake::leak(Fault::None, 8), 1000);
    let ours = Identity::of(&plan, &often().run);
    for (identity, change) in [
        (Identity { flap: "0.0.1".to_owned(), ..ours.clone() }, "the rows were computed by flap 0.0.1, not "),
        (
            Identity { build: "fed0".to_owned(), ..ours.clone() },
            "the rows were computed by build fed0 of flap ",
        ),
        (Identity { arithmetic: "other".to_owned(), ..ours.clone() }, "the arithmetic is other, not "),
        (Identity { grid: String::new(), ..ours.clone() }, "the grid file differs"),
    ] {
        Journal::create(&journal_of(&path), &Header::new(String::new(), false, identity)).unwrap();
        match Session::resume(&path, &plan, &often()).map(|_| ()) {
            Err(error @ ResumeError::Changed { .. }) => {
                assert!(error.to_string().contains(change), "{error}");
            }
            other => panic!("{other:?}"),
        }
        fs::remove_file(journal_of(&path)).unwrap();
    }
}

/// If a file is shorter than its journal records, the run continues from the last checkpoint within the file.
#[test]
fn lost_rows_are_computed_again() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("rows.csv");
    let plan = plan(Fake::leak(Fault::None, 8), 1000);
    let (text, _) = csv(&plan, &options(2, 100));
    run_to(&mut start(&path, &plan), &plan, Summary::default(), 300);
    let rows = fs::read(&path).unwrap();
    fs::write(&path, &rows[..rows.len() / 2]).unwrap();
    let resumed = Session::resume(&path, &plan, &often()).unwrap();
    assert!((100..200).contains(&resumed.before.done()), "{}", resumed.before.done());
    assert_eq!(resumed.lost + resumed.before.rows, 300);
    let mut session = resumed.session;
    run_to(&mut session, &plan, resumed.before, u64::MAX).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
}
