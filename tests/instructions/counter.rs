//! Counts the instructions that a piece of work executes, by single steps.
//!
//! The program starts itself again with the work's name in its environment. That child asks to be traced and
//! stops at the beginning and at the end of the work; its parent lets it go from the one stop to the other
//! instruction by instruction. This needs no hardware counters, counts the instructions of every backend, and gives the
//! same number every time (but for a handful in the allocator), however busy the machine is.

use std::io;
use std::process::{Child, Command, Stdio};

use nix::sched::{CpuSet, sched_getaffinity, sched_getcpu, sched_setaffinity};
use nix::sys::ptrace;
use nix::sys::signal::{Signal, raise};
use nix::sys::wait::{WaitStatus, waitpid};
use nix::unistd::Pid;

/// The environment variable that names the work to a child.
const WORK: &str = "FLAP_COUNTED_WORK";

/// A repeated string instruction counts once per repetition. These settings keep glibc from copying with
/// them, which it would do a byte at a time.
const NO_STRING_INSTRUCTIONS: (&str, &str) = (
    "GLIBC_TUNABLES",
    "glibc.cpu.x86_rep_movsb_threshold=0x7fffffff:glibc.cpu.x86_rep_stosb_threshold=0x7fffffff",
);

const THIS_THREAD: Pid = Pid::from_raw(0);

/// The name of the work that this process has been started for, if it is a child.
pub(crate) fn work_of_child() -> Option<String> {
    std::env::var(WORK).ok()
}

/// In the child, on its main thread: does `work`, which calls its argument where the count begins and where it
/// ends.
pub(crate) fn be_counted(work: impl FnOnce(&mut dyn FnMut())) -> nix::Result<()> {
    ptrace::traceme()?;
    let mut stopped = Ok(());
    work(&mut || stopped = stopped.and(raise(Signal::SIGSTOP)));
    stopped
}

/// In the parent: the number of instructions that a child executes in `work`. `each` is called before each of them.
pub(crate) fn count(work: &str, each: &mut dyn FnMut(Pid) -> io::Result<()>) -> io::Result<u64> {
    // On one processor, switching between child and parent is several times faster.
    let affinity = sched_getaffinity(THIS_THREAD)?;
    let mut here = CpuSet::new();
    here.set(sched_getcpu()?)?;
    sched_setaffinity(THIS_THREAD, &here)?;
    let count = start(work).and_then(|mut child| {
        let count = follow(&child, each);
        if count.is_ok() {
            child.kill()?;
            child.wait()?;
        }
        count
    });
    sched_setaffinity(THIS_THREAD, &affinity)?;
    count.map_err(|error| io::Error::new(error.kind(), format!("cannot count \"{work}\": {error}")))
}

fn start(work: &str) -> io::Result<Child> {
    let (name, value) = NO_STRING_INSTRUCTIONS;
    Command::new(std::env::current_exe()?)
        .env(WORK, work)
        .env(name, value)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
}

/// Steps through a child from its first stop to its second.
fn follow(child: &Child, each: &mut dyn FnMut(Pid) -> io::Result<()>) -> io::Result<u64> {
    let pid = Pid::from_raw(child.id().cast_signed());
    match waitpid(pid, None)? {
        WaitStatus::Stopped(_, Signal::SIGSTOP) => {}
        status => return Err(unexpected(status)),
    }
    let mut count = 0;
    loop {
        each(pid)?;
        ptrace::step(pid, None)?;
        match waitpid(pid, None)? {
            WaitStatus::Stopped(_, Signal::SIGTRAP) => count += 1,
            WaitStatus::Stopped(_, Signal::SIGSTOP) => return Ok(count),
            status => return Err(unexpected(status)),
        }
    }
}

fn unexpected(status: WaitStatus) -> io::Error {
    io::Error::other(format!(
        "the traced process should have stopped, but: {status:?} (is ptrace forbidden here?)"
    ))
}
