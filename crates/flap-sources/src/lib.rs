#![doc = include_str!("../README.md")]

use std::path::{Path, PathBuf};
use std::{env, fs, io};

use xxhash_rust::xxh3::Xxh3Default;

/// Packages whose code affects the exact bytes of the rows that flap computes.
const PACKAGES: [&str; 8] =
    ["chacha20", "fearless_simd", "itoa", "libm", "nalgebra", "rand", "rand_core", "zmij"];

/// Possible paths of the lock file: in a published package, and in the repository.
const LOCKS: [&str; 2] = ["Cargo.lock", "../../Cargo.lock"];

/// Prints a line with which cargo sets the environment variable `FLAP_SOURCES`. The value is the hash of the
/// current package, written as 16 hexadecimal digits.
///
/// # Errors
/// The error of the operating system if a source or the lock file cannot be read.
#[expect(clippy::print_stdout, reason = "a build script talks to cargo so")]
pub fn print() -> io::Result<()> {
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    println!("cargo::rerun-if-changed=src");
    let lock = LOCKS.into_iter().find(|lock| package.join(lock).exists());
    let versions = match lock {
        Some(lock) => {
            println!("cargo::rerun-if-changed={lock}");
            versions(&fs::read_to_string(package.join(lock))?)
        }
        None => Vec::new(),
    };
    println!("cargo::rustc-env=FLAP_SOURCES={:016x}", hash(&package.join("src"), &versions)?);
    Ok(())
}

/// Returns the lines `name version` of the packages that affect rows, in the order of a lock file, which is
/// alphabetical.
pub fn versions(lock: &str) -> Vec<String> {
    let value = |line: Option<&str>, key: &str| {
        let value = line?.strip_prefix(key)?.strip_prefix(" = \"")?.strip_suffix('"')?;
        Some(value.to_owned())
    };
    let version = |entry: &str| {
        let mut lines = entry.trim_start().lines();
        let name = value(lines.next(), "name").filter(|name| PACKAGES.contains(&name.as_str()))?;
        Some(format!("{name} {}", value(lines.next(), "version")?))
    };
    lock.split("[[package]]").filter_map(version).collect()
}

/// Returns the hash of all Rust files in `folder` and of the `versions` of other packages.
///
/// # Errors
/// The error of the operating system if a file cannot be read.
pub fn hash(folder: &Path, versions: &[String]) -> io::Result<u64> {
    let mut files = Vec::new();
    list(folder, "", &mut files)?;
    files.sort();
    let mut hash = Xxh3Default::new();
    for (name, path) in files {
        let text = fs::read_to_string(path)?;
        hash.update(name.as_bytes());
        for line in text.lines() {
            // A separator that no line contains.
            hash.update(b"\n");
            hash.update(line.as_bytes());
        }
        hash.update(b"\0");
    }
    hash.update(versions.join("\n").as_bytes());
    Ok(hash.digest())
}

/// Adds the files in `folder` and its subfolders, with their relative names. The relative names contain `/`
/// between folders on every system.
fn list(folder: &Path, name: &str, files: &mut Vec<(String, PathBuf)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{name}/{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            list(&entry.path(), &name, files)?;
        } else if entry.path().extension().is_some_and(|extension| extension == "rs") {
            files.push((name, entry.path()));
        }
    }
    Ok(())
}
