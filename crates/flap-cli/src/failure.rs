//! Failures of commands, and exit codes.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use anstyle::{AnsiColor, Style};
use flap_core::parameter::Invalid;
use flap_core::simulate::Unfinished;
use flap_sweep::files::inputs::Overlap;
use flap_sweep::files::integrity::OpenError;
use flap_sweep::files::job::{self, JobError};
use flap_sweep::files::merge::MergeError;
use flap_sweep::files::output::CreateError;
use flap_sweep::files::record::RecordError;
use flap_sweep::files::results::FormatError;
use flap_sweep::files::session::ResumeError;
use flap_sweep::files::sidecar;
use flap_sweep::grid::ReadError;
use flap_sweep::grid::diagnostic::{self, Mistakes};
use flap_sweep::input::InputError;
use flap_sweep::notation::text::shortened;
use flap_sweep::notation::{UserError, nearest};
use flap_sweep::plan::ChangeError;
use flap_sweep::run::RunError;

use crate::console;

/// The help line of commands that can read damaged results.
pub(crate) const IGNORE_HELP: &str = "--ignore-damage uses the rows that can be read";

/// The exit code of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    Done = 0,
    /// The command finished without an error, but not everything succeeded. Some points are not periodic
    /// (with `--strict`), some results could not be verified, or no design satisfies the conditions of `flap
    /// optimise`.
    NotAll = 1,
    Usage = 2,
    System = 3,
    Bug = 101,
    Interrupted = 130,
}

/// The reason why a command failed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line or the grid file has a mistake. The fields of the variant are the message and the
    /// help lines.
    Usage(String, Vec<String>),
    /// The grid file has mistakes.
    Grid(Mistakes),
    /// The operating system returned an error, or results are damaged. The fields of the variant are the
    /// message and the help lines.
    System(String, Vec<String>),
    /// An internal error in flap.
    Bug(String),
    /// A signal stopped the command before there was a result.
    Interrupted,
    /// The program that reads stdout, such as `head`, closed stdout. A closed stdout is not an error.
    ClosedPipe,
}

impl Failure {
    /// Returns the failure for a mistake of the user.
    pub(crate) fn usage(message: impl Into<String>) -> Failure {
        Failure::Usage(message.into(), Vec::new())
    }

    /// Returns the failure for an operation that the operating system rejected, or for damaged results.
    pub(crate) fn system(message: impl Into<String>) -> Failure {
        Failure::System(message.into(), Vec::new())
    }

    /// Returns the failure for an input file that does not exist.
    pub(crate) fn missing(path: &Path) -> Failure {
        Failure::usage(format!("{}: {}", path.display(), InputError::Missing))
    }

    /// Returns the failure for a file that cannot be written.
    pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
        Failure::system(format!("cannot write {}: {error}", path.display()))
    }

    /// Returns the failure for a damaged file, for example results that another program has changed.
    pub(crate) fn damaged(message: String) -> Failure {
        Failure::system(message).help("replace the file by an undamaged copy")
    }

    /// Returns a failure if `path` is a grid file or a sidecar instead of results.
    pub(crate) fn unless_results(path: &Path) -> Result<(), Failure> {
        let name = path.to_string_lossy();
        if let Some(results) = name.strip_suffix(".meta.toml") {
            let message = format!("{name} is the sidecar of results, not a file of results");
            return Err(Failure::usage(message).help(format!("give the file of results instead: {results}")));
        }
        if !name.ends_with(".toml") {
            return Ok(());
        }
        let message = format!("{name} is a grid file, not a file of results");
        Err(Failure::usage(message).help(format!("`flap sweep {name}` writes its results")))
    }

    /// Converts the error of a job that writes results to `out` into a failure.
    pub(crate) fn of_job(error: JobError, out: &Path) -> Failure {
        let resumable =
            matches!(error, JobError::Write { resumable: true, .. } | JobError::Run { resumable: true, .. });
        let failure = match error {
            JobError::Overlap(error) => error.into(),
            JobError::Format(error) => error.into(),
            JobError::Create(error) => error.into(),
            JobError::Exists { ref changed, .. } => {
                edited(Failure::usage(error.to_string()), changed.as_ref())
                    .help("use --out FILE to write to another file, or --restart to replace the file")
            }
            JobError::Resume { error: error @ ResumeError::Changed { .. }, changed, continues } => {
                unfinished(Failure::usage(error.to_string()), out, changed.as_ref(), continues)
            }
            JobError::Resume { error, .. } => error.into(),
            JobError::Open(OpenError::Damaged { .. }) => Failure::damaged(error.to_string())
                .help("run the same command with --restart to compute the rows again"),
            JobError::Open(error) => error.into(),
            JobError::Write { path, source, .. } => Failure::cannot_write(&path, &source),
            JobError::Run { error, .. } => error.into(),
        };
        if !resumable {
            return failure;
        }
        let failure = failure.help(format!("`flap results resume {}` continues the run", out.display()));
        failure.helps(still_kept(out))
    }

    /// Adds a help line.
    pub(crate) fn help(mut self, line: impl Into<String>) -> Failure {
        if let Failure::Usage(_, help) | Failure::System(_, help) = &mut self {
            help.push(line.into());
        }
        self
    }

    /// Adds help lines.
    pub(crate) fn helps<L: Into<String>>(self, lines: impl IntoIterator<Item = L>) -> Failure {
        lines.into_iter().fold(self, Failure::help)
    }

    /// Adds the help line "did you mean ...?" with the name in `names` that is most similar to `name`. If no
    /// name is similar, adds the help line `otherwise`.
    pub(crate) fn nearest<'n>(
        self,
        name: &str,
        names: impl IntoIterator<Item = &'n str>,
        otherwise: &str,
    ) -> Failure {
        match nearest(name, names) {
            Some(nearest) => self.help(format!("did you mean `{nearest}`?")),
            None => self.help(otherwise),
        }
    }

    /// Prints the failure to stderr and returns the exit code.
    pub(crate) fn report(self) -> Exit {
        match self {
            Failure::Usage(message, help) => {
                complain(&message, &help);
                Exit::Usage
            }
            Failure::Grid(mistakes) => {
                console::complain(&diagnostic::render(&mistakes, true));
                Exit::Usage
            }
            Failure::System(message, help) => {
                complain(&message, &help);
                Exit::System
            }
            Failure::Bug(message) => {
                complain(&message, &["this is an error in flap: please report it".to_owned()]);
                Exit::Bug
            }
            Failure::Interrupted => {
                console::say("interrupted: there is no result yet");
                Exit::Interrupted
            }
            Failure::ClosedPipe => Exit::Done,
        }
    }
}

/// If the user edited the grid file, adds a help line with the first edited line of the file.
fn edited(failure: Failure, changed: Option<&String>) -> Failure {
    let Some(line) = changed else { return failure };
    failure
        .help(line.clone())
        .help("an edited grid is another sweep: write its rows to another file with --out FILE")
}

/// Adds help lines for unfinished results at `out`. The last help line is about `--restart`, which deletes
/// rows.
///
/// If `continues` is true, a help line suggests `flap results resume`.
fn unfinished(failure: Failure, out: &Path, changed: Option<&String>, continues: bool) -> Failure {
    let grid = if changed.is_some() { " with its original grid" } else { "" };
    let resume = || format!("`flap results resume {}` continues the run{grid}", out.display());
    edited(failure.helps(continues.then(resume)), changed)
        .help("use --restart to delete the rows of this file and start over")
}

/// Returns a help line if `out` contains earlier results that the new results will replace, otherwise `None`.
pub(crate) fn still_kept(out: &Path) -> Option<String> {
    let is_kept = job::unfinished(out).is_some() && out.exists();
    is_kept
        .then(|| format!("until the new results are complete, {} keeps the earlier results", out.display()))
}

fn complain(message: &str, help: &[String]) {
    let error = Style::new().bold().fg_color(Some(AnsiColor::BrightRed.into()));
    let advice = Style::new().bold().fg_color(Some(AnsiColor::BrightCyan.into()));
    let mut text = format!("{error}error{error:#}: {message}");
    for line in help {
        let _ = write!(text, "\n{advice}help{advice:#}: {line}");
    }
    console::complain(&shortened(&text));
}

/// Converts the error of a failed write to stdout into a failure.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::system(format!("cannot write to stdout: {error}")),
        }
    }
}

/// Converts errors of the given types into failures of the kind `Usage`. The messages of these errors contain
/// the remedy, because the user can correct the mistakes.
macro_rules! usage {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Failure {
                Failure::usage(error.to_string())
            }
        })*
    };
}

usage!(ChangeError, FormatError, Invalid, RecordError, Unfinished);

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Failure {
        match error {
            ReadError::Grid(mistakes) => Failure::Grid(mistakes),
            ReadError::Input { error: InputError::Unreadable(_), .. } => Failure::system(error.to_string()),
            _ => Failure::usage(error.to_string()).helps(error.help()),
        }
    }
}

impl From<UserError> for Failure {
    fn from(error: UserError) -> Failure {
        Failure::usage(error.message).helps(error.help)
    }
}

impl From<CreateError> for Failure {
    fn from(error: CreateError) -> Failure {
        match error {
            CreateError::Exists { .. } => Failure::usage(error.to_string())
                .help("use --force to overwrite the file, or choose another file"),
            CreateError::Unfinished(ref path) => Failure::usage(error.to_string()).help(format!(
                "`flap results resume {}` continues the run; --restart starts over",
                path.display()
            )),
            CreateError::InTheWay { .. } => Failure::usage(error.to_string())
                .help("rename or remove that file, or choose another name for the results"),
            CreateError::Busy { .. } | CreateError::Io { .. } => Failure::system(error.to_string()),
        }
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Failure {
        match error {
            OpenError::Format(error) => error.into(),
            OpenError::Sidecar(error) => error.into(),
            OpenError::Read { path, source } if source.kind() == io::ErrorKind::NotFound => {
                Failure::missing(&path)
            }
            OpenError::Read { .. } => Failure::system(error.to_string()),
            OpenError::Damaged { ref path, ref damage } => {
                let resume = || format!("`flap results resume {}` computes the rows again", path.display());
                let failure = Failure::damaged(error.to_string());
                failure.helps((damage.lost > 0).then(resume)).help(IGNORE_HELP)
            }
        }
    }
}

impl From<Overlap> for Failure {
    fn from(error: Overlap) -> Failure {
        Failure::usage(error.to_string()).help("inputs are never overwritten: choose another file")
    }
}

impl From<ResumeError> for Failure {
    fn from(error: ResumeError) -> Failure {
        let message = error.to_string();
        match error {
            ResumeError::Create(error) => error.into(),
            ResumeError::Format(error) => error.into(),
            ResumeError::NoJournal { .. } | ResumeError::Changed { .. } | ResumeError::Altered { .. } => {
                Failure::usage(message).help("use --restart to start over, or choose another file")
            }
        }
    }
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Failure {
        let message = error.to_string();
        match error {
            MergeError::Parts(_) => Failure::usage(message),
            MergeError::Builds(_) => Failure::usage(message)
                .help("sweep all shards with the same build, or use --mixed-builds to merge these shards"),
            MergeError::Write(source) if source.kind() == io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            MergeError::Read { .. } | MergeError::Write(_) => Failure::system(message),
        }
    }
}

impl From<sidecar::SidecarError> for Failure {
    fn from(error: sidecar::SidecarError) -> Failure {
        match &error {
            sidecar::SidecarError::Damaged { .. } => Failure::damaged(error.to_string()),
            sidecar::SidecarError::Io { path, source } if source.kind() == io::ErrorKind::NotFound => {
                Failure::missing(path)
            }
            sidecar::SidecarError::Io { .. } => Failure::system(error.to_string()),
            sidecar::SidecarError::Format { .. } => Failure::usage(error.to_string()),
        }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Failure {
        match error {
            RunError::Sink(source) if source.kind() == io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            RunError::Sink(_) | RunError::Threads(_) | RunError::Chunk(_) | RunError::Fetch(_) => {
                Failure::system(error.to_string())
            }
            RunError::Model(_) | RunError::Panic(_) => Failure::Bug(error.to_string()),
        }
    }
}
