//! Counts the instructions that a piece of work executes, by single steps.
//!
//! The program starts itself again as a child process, with the name of the work in its environment. The child is
//! traced and stops at the beginning and at the end of the work. Between the two stops, the parent lets the child
//! execute one instruction at a time. This method needs no hardware counters, and counts the instructions of every
//! backend. The number is the same in every run, except for a few instructions of the allocator, even on a busy
//! machine.

use std::io;
use std::process::{Child, Command, Stdio};

use nix::sched::{CpuSet, sched_getaffinity, sched_getcpu, sched_setaffinity};
use nix::sys::ptrace;
use nix::sys::signal::{Signal, raise};
use nix::sys::wait::{WaitStatus, waitpid};
use nix::unistd::Pid;

/// The environment variable that names the work to a child.
const WORK: &str = "FLAP_COUNTED_WORK";

/// A repeated string instruction counts once per repetition. With these settings, glibc does not use string
/// instructions for copying, which would copy a byte at a time.
const NO_STRING_INSTRUCTIONS: (&str, &str) = (
    "GLIBC_TUNABLES",
    "glibc.cpu.x86_rep_movsb_threshold=0x7fffffff:glibc.cpu.x86_rep_stosb_threshold=0x7fffffff",
);

const THIS_THREAD: Pid = Pid::from_raw(0);

/// The name of the work for which this process was started; `None` if the process is not a child.
pub(crate) fn work_of_child() -> Option<String> {
    std::env::var(WORK).ok()
}

/// Runs `work` in the child, on its main thread. `work` calls its argument at the beginning and at the end of the
/// count.
pub(crate) fn be_counted(work: impl FnOnce(&mut dyn FnMut())) -> nix::Result<()> {
    ptrace::traceme()?;
    let mut stopped = Ok(());
    work(&mut || stopped = stopped.and(raise(Signal::SIGSTOP)));
    stopped
}

/// In the parent: the number of instructions that a child executes in `work`. `each` is called before each instruction.
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

/// Executes a child step by step from the first stop of the child to its second stop.
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
