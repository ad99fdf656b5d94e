//! In lanes, a right-hand side must take several times fewer instructions than on scalars.
//!
//! A lane function that is not inlined into the function with the target feature computes the correct numbers, but tens
//! of times more slowly. Run times would show the difference only on an idle machine. Numbers of instructions show the
//! difference on every machine.
#![expect(clippy::print_stdout, reason = "a test with its own harness")]

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod counter;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod judge;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod workload;

use std::process::ExitCode;

const TEST: &str = "lanes_take_fewer_instructions_than_scalars";

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[expect(clippy::print_stderr, reason = "a test with its own harness")]
fn main() -> ExitCode {
    if let Some(work) = counter::work_of_child() {
        return be_counted(&work);
    }
    if !is_wanted() {
        return ExitCode::SUCCESS;
    }
    match judge::judge() {
        Ok(()) => {
            println!("test {TEST} ... ok");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("test {TEST} ... FAILED\n\n{reason}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
fn main() -> ExitCode {
    if is_wanted() {
        println!("test {TEST} ... ignored, instructions are counted on x86-64 Linux only");
    }
    ExitCode::SUCCESS
}

/// Runs the work in the child process.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[expect(clippy::print_stderr, reason = "it tells the test's user")]
fn be_counted(name: &str) -> ExitCode {
    let Some(work) = workload::Work::by_name(name) else {
        eprintln!("there is no work \"{name}\"");
        return ExitCode::FAILURE;
    };
    match counter::be_counted(|mark| work.run(mark)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("this process cannot be traced: {error}");
            ExitCode::FAILURE
        }
    }
}

/// True if the arguments of the test program select this test.
fn is_wanted() -> bool {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |flag: &str| arguments.iter().any(|argument| argument == flag);
    if has("--ignored") {
        return false;
    }
    if has("--list") {
        println!("{TEST}: test");
        return false;
    }
    let mut names = arguments.iter().filter(|argument| !argument.starts_with('-')).peekable();
    names.peek().is_none() || names.any(|name| TEST.contains(name.as_str()))
}
