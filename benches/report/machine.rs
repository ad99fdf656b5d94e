//! The machine that the numbers were measured on.

use std::fs;
use std::process::Command;
use std::thread;

use flap_core::num::Backend;

pub(crate) fn print() {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let backends: Vec<&str> = Backend::available().into_iter().map(Backend::name).collect();
    println!(
        "## Machine\n\n| | |\n|---|---|\n| processor | {} |\n| hardware threads | {threads} |\n\
         | instructions | {} |\n| compiler | {} |\n| load average | {} |\n",
        processor(),
        backends.join(", "),
        compiler(),
        fs::read_to_string("/proc/loadavg").map_or("unknown".into(), |text| first_words(&text, 3)),
    );
}

fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name =
        text.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split_once(": "));
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.to_owned())
}

fn compiler() -> String {
    let said = Command::new("rustc").arg("--version").output().ok();
    said.map_or("unknown".into(), |said| first_words(&String::from_utf8_lossy(&said.stdout), 2))
}

fn first_words(text: &str, count: usize) -> String {
    text.split_whitespace().take(count).collect::<Vec<_>>().join(" ")
}
