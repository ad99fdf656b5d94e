//! The source files of flap-core and the paths in them.

use std::fs;
use std::path::Path;

/// A source file.
pub(crate) struct SourceFile {
    /// Path below `src`.
    pub(crate) path: String,
    /// The first part of its path: the layer it belongs to, or `lib`.
    pub(crate) layer: String,
    /// How many modules up the root of the crate is.
    depth: usize,
    text: String,
}

/// All source files of flap-core.
pub(crate) fn source_files() -> Vec<SourceFile> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&source, &source, &mut files);
    assert!(files.len() > 20, "flap-core has more than {} source files", files.len());
    files
}

fn collect(source: &Path, folder: &Path, files: &mut Vec<SourceFile>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            collect(source, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).expect("the file can be read");
            files.push(SourceFile::new(path.strip_prefix(source).expect("it is below src"), text));
        }
    }
}

impl SourceFile {
    fn new(path: &Path, text: String) -> SourceFile {
        let mut modules: Vec<String> =
            path.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let layer = modules[0].clone();
        modules.retain(|module| module != "mod" && module != "lib");
        SourceFile { path: path.display().to_string(), layer, depth: modules.len(), text }
    }

    /// The lines with their numbers, without comments.
    pub(crate) fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(i, line)| (i + 1, line.split("//").next().unwrap_or("")))
    }

    /// What is used from the root of the crate, with line numbers: the names after `crate::`, and those after
    /// as many `super::` as lead there.
    pub(crate) fn used_from_root(&self) -> Vec<(usize, String)> {
        let root = "super::".repeat(self.depth);
        let mut used = Vec::new();
        for (line, code) in self.code() {
            let from_crate = code.split("crate::").skip(1);
            // Further in, `super` may be that of a module within the file.
            let from_super = code.split(&root).skip(1).filter(|_| self.depth > 0 && !code.starts_with(' '));
            used.extend(from_crate.chain(from_super).map(|rest| (line, first_name(rest))));
        }
        used
    }
}

/// The name with which a path begins; `{` if it is a list.
fn first_name(path: &str) -> String {
    let name: String = path.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    if name.is_empty() { path.chars().take(1).collect() } else { name }
}
