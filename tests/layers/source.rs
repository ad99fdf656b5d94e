//! The source files of the crates.

use std::fs;
use std::path::Path;

/// A source file.
pub(crate) struct SourceFile {
    /// Path below `src`.
    pub(crate) path: String,
    pub(crate) text: String,
}

impl SourceFile {
    /// The modules on the path from the root of the crate to the file: `["run", "queue"]` for `run/queue.rs`, `["run"]`
    /// for `run/mod.rs`, and an empty list for `lib.rs`.
    pub(crate) fn module(&self) -> Vec<String> {
        let stem = self.path.trim_end_matches(".rs");
        let mut modules: Vec<String> = stem.split('/').map(str::to_owned).collect();
        if ["mod", "lib", "main"].contains(&modules[modules.len() - 1].as_str()) {
            modules.pop();
        }
        modules
    }

    /// The lines with their numbers, without comments.
    pub(crate) fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(i, line)| (i + 1, line.split("//").next().unwrap_or("")))
    }
}

/// All source files of a crate.
pub(crate) fn source_files(name: &str) -> Vec<SourceFile> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name).join("src");
    let mut files = Vec::new();
    collect(&source, &source, &mut files);
    // flap-experiments, the smallest crate, has five files.
    assert!(files.len() >= 5, "{name} has more than {} source files", files.len());
    assert!(files.iter().any(|file| file.path == "lib.rs"), "{name} has no lib.rs");
    files.sort_by(|one, other| one.path.cmp(&other.path));
    files
}

fn collect(source: &Path, folder: &Path, files: &mut Vec<SourceFile>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            collect(source, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).expect("the file can be read");
            let below = path.strip_prefix(source).expect("it is below src");
            files.push(SourceFile { path: below.to_string_lossy().replace('\\', "/"), text });
        }
    }
}
