//! The system calls with which a command changes files. Tests count and record the calls, let them fail, or kill the
//! command before them.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io;
use std::os::unix::fs::FileExt;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};

use nix::errno::Errno;
use nix::sys::ptrace::{self, Options};
use nix::sys::signal::{Signal, kill};
use nix::sys::wait::{WaitPidFlag, WaitStatus, waitpid};
use nix::unistd::Pid;

use crate::support::Folder;

/// A system call that changes files in the folder of the command, or makes changes durable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Call {
    pub(crate) name: &'static str,
    /// The names of the call's files in the folder; `.` is the folder itself, and `?` is a temporary name.
    pub(crate) files: Vec<String>,
}

/// The action of the test on a system call.
pub(crate) enum Fate {
    Goes,
    /// The command is killed before the call.
    Killed,
    /// The call has no effect and returns this error.
    Fails(Errno),
}

/// The result of a traced command.
pub(crate) struct Traced {
    /// The exit code; none if it was killed.
    pub(crate) code: Option<i32>,
    pub(crate) stderr: String,
    pub(crate) calls: Vec<Call>,
}

/// Runs `flap` with the words of `arguments`. `fate` returns the action for each call; its first argument is the number
/// of the call.
pub(crate) fn trace(folder: &Folder, arguments: &str, mut fate: impl FnMut(usize, &Call) -> Fate) -> Traced {
    let said = folder.path("../").canonicalize().unwrap().join(format!("{}.stderr", unique()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_flap"));
    command.args(arguments.split_whitespace()).current_dir(folder.path(""));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(File::create(&said).unwrap());
    let traced = || ptrace::traceme().map_err(io::Error::from);
    #[expect(unsafe_code, reason = "only the child can ask to be traced")]
    // SAFETY: the closure makes one system call.
    unsafe {
        command.pre_exec(traced)
    };
    #[expect(clippy::zombie_processes, reason = "`waitpid` waits for it")]
    let child = command.spawn().unwrap();
    let main = Pid::from_raw(child.id().cast_signed());
    let place = folder.path("").canonicalize().unwrap();
    let mut calls = Vec::new();
    let mut failing: HashMap<Pid, Errno> = HashMap::new();
    // Only children of this thread: other tests wait for theirs.
    let flags = WaitPidFlag::__WALL | WaitPidFlag::__WNOTHREAD;
    let mut is_set = false;
    let code = loop {
        match waitpid(Pid::from_raw(-1), Some(flags)).unwrap() {
            WaitStatus::Exited(pid, code) if pid == main => break Some(code),
            WaitStatus::Signaled(pid, ..) if pid == main => break None,
            WaitStatus::PtraceSyscall(pid) => {
                // A thread that is being killed has no registers.
                let Ok(mut registers) = ptrace::getregs(pid) else { continue };
                if let Some(error) = failing.remove(&pid) {
                    registers.rax = (-i64::from(error as i32)).cast_unsigned();
                    ptrace::setregs(pid, registers).unwrap();
                } else if registers.rax.cast_signed() == -i64::from(Errno::ENOSYS as i32)
                    && let Some(call) = call(pid, &registers, &place)
                {
                    match fate(calls.len(), &call) {
                        Fate::Goes => {}
                        Fate::Killed => kill(main, Signal::SIGKILL).unwrap(),
                        Fate::Fails(error) => {
                            registers.orig_rax = u64::MAX;
                            ptrace::setregs(pid, registers).unwrap();
                            failing.insert(pid, error);
                        }
                    }
                    calls.push(call);
                }
                let _ = ptrace::syscall(pid, None);
            }
            WaitStatus::Stopped(pid, signal) => {
                if !is_set {
                    ptrace::setoptions(pid, Options::PTRACE_O_TRACESYSGOOD | Options::PTRACE_O_TRACECLONE)
                        .unwrap();
                    is_set = true;
                }
                // Stops of the tracer's own making are not handed on.
                let own = matches!(signal, Signal::SIGTRAP | Signal::SIGSTOP);
                let _ = ptrace::syscall(pid, Some(signal).filter(|_| !own));
            }
            WaitStatus::PtraceEvent(pid, ..) => {
                let _ = ptrace::syscall(pid, None);
            }
            _ => {}
        }
    };
    let stderr = fs::read_to_string(&said).unwrap();
    fs::remove_file(&said).unwrap();
    Traced { code, stderr, calls }
}

fn unique() -> String {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NEXT: AtomicU32 = AtomicU32::new(0);
    format!("flap-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed))
}

/// The lower half of a register, which holds an argument of the type `int`.
fn int(register: u64) -> i32 {
    let [a, b, c, d, ..] = register.to_le_bytes();
    i32::from_le_bytes([a, b, c, d])
}

/// The call that a stopped thread begins; `None` if the call changes nothing in the folder `place`.
fn call(pid: Pid, registers: &libc::user_regs_struct, place: &Path) -> Option<Call> {
    let of_descriptor = |descriptor: u64| {
        let descriptor = int(descriptor);
        let link = if descriptor == libc::AT_FDCWD {
            format!("/proc/{pid}/cwd")
        } else {
            format!("/proc/{pid}/fd/{descriptor}")
        };
        Some(fs::read_link(link).ok()?.to_string_lossy().into_owned())
    };
    let of_path = |folder: u64, path: u64| {
        let folder = of_descriptor(folder)?;
        Some(Path::new(&folder).join(text(pid, path)?).to_string_lossy().into_owned())
    };
    let here = i64::from(libc::AT_FDCWD).cast_unsigned();
    let (a, b, c, d) = (registers.rdi, registers.rsi, registers.rdx, registers.r10);
    let changes = |flags: u64| int(flags) & (libc::O_CREAT | libc::O_ACCMODE) != libc::O_RDONLY;
    let (name, files) = match registers.orig_rax.cast_signed() {
        libc::SYS_open if changes(b) => ("open", [of_path(here, a), None]),
        libc::SYS_openat if changes(c) => ("open", [of_path(a, b), None]),
        libc::SYS_write => ("write", [of_descriptor(a), None]),
        libc::SYS_ftruncate => ("truncate", [of_descriptor(a), None]),
        libc::SYS_fsync | libc::SYS_fdatasync => ("sync", [of_descriptor(a), None]),
        libc::SYS_flock => ("lock", [of_descriptor(a), None]),
        libc::SYS_rename => ("rename", [of_path(here, a), of_path(here, b)]),
        libc::SYS_renameat | libc::SYS_renameat2 => ("rename", [of_path(a, b), of_path(c, d)]),
        libc::SYS_linkat => ("link", [of_path(c, d), None]),
        libc::SYS_unlink => ("remove", [of_path(here, a), None]),
        libc::SYS_unlinkat => ("remove", [of_path(a, b), None]),
        _ => return None,
    };
    let files: Vec<String> = files.into_iter().flatten().filter_map(|path| within(&path, place)).collect();
    (!files.is_empty()).then_some(Call { name, files })
}

/// The name of a file in the folder.
fn within(path: &str, place: &Path) -> Option<String> {
    let name = Path::new(path).strip_prefix(place).ok()?.to_string_lossy().into_owned();
    Some(match name.as_str() {
        "" | "." => ".".to_owned(),
        name if name.starts_with(['.', '#']) => "?".to_owned(),
        name => name.to_owned(),
    })
}

/// The text at an address of a process.
fn text(pid: Pid, address: u64) -> Option<String> {
    let memory = File::open(format!("/proc/{pid}/mem")).ok()?;
    let mut bytes = vec![0; 4096];
    // A page may end before.
    let here = 4096 - (address % 4096) as usize;
    let mut read = memory.read_at(&mut bytes[..here], address).ok()?;
    read += memory.read_at(&mut bytes[here..], address + here as u64).unwrap_or(0);
    let end = bytes[..read].iter().position(|&byte| byte == 0)?;
    Some(String::from_utf8_lossy(&bytes[..end]).into_owned())
}
