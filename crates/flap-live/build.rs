//! Joins the modules of each page's code into one script.
//!
//! A page is one file that works without a network. Browsers cannot load modules from a folder.
//! In the script, each module becomes a function after the modules that it imports. The imports of a module become
//! variables.
//! The Content Security Policy of the pages allows only inline scripts, which include the joined script.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=web");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    for page in ["live", "results"] {
        let mut joined = Joined::default();
        joined.add(&format!("{page}/page.js"), &mut Vec::new());
        fs::write(out.join(format!("{page}.js")), joined.script).expect("OUT_DIR can be written");
    }
}

/// The script of a page, and the paths of the modules in the script.
#[derive(Default)]
struct Joined {
    script: String,
    modules: BTreeSet<String>,
}

impl Joined {
    /// Adds a module after the modules that it imports. `importers` is a list of modules: each module imports
    /// the next module, and the last module imports `module`.
    fn add(&mut self, module: &str, importers: &mut Vec<String>) {
        if self.modules.contains(module) {
            return;
        }
        assert!(!importers.iter().any(|each| each == module), "{module} imports itself by {importers:?}");
        importers.push(module.to_owned());
        let source = fs::read_to_string(Path::new("web").join(module));
        let source = source.unwrap_or_else(|error| panic!("{error}: the module at the end of {importers:?}"));
        let source = without_comments(&source);
        let (imports, body) = split(&source);
        let mut variables = String::new();
        for (names, path) in imports {
            let imported = resolved(module, path);
            self.add(&imported, importers);
            let _ = writeln!(variables, "const {} = modules[\"{imported}\"];", names.replace(" as ", ": "));
        }
        let exports: Vec<&str> = body.lines().filter_map(exported).collect();
        let (body, exports) = (body.replace("\nexport ", "\n"), exports.join(", "));
        let function = format!("(() => {{\n{variables}{body}return {{ {exports} }};\n}})()");
        let _ = writeln!(self.script, "modules[\"{module}\"] = {function};");
        importers.pop();
        self.modules.insert(module.to_owned());
    }
}

/// Returns the code of a module without comments `/** … */`, which contain types, and without lines that
/// contain only a comment.
///
/// The text begins with an empty line, so that every import follows a line break.
fn without_comments(source: &str) -> String {
    let mut parts = source.split("/**");
    let mut code = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (_, rest) = part.split_once("*/").expect("a comment ends");
        code += rest.strip_prefix(' ').unwrap_or(rest);
    }
    let lines = code.lines().filter(|line| !line.trim().is_empty() && !line.trim().starts_with("//"));
    lines.fold(String::from("\n"), |kept, line| kept + line + "\n")
}

/// Returns the imports of a module, and the text of the module without its imports. An import consists of the
/// imported names in braces, and the path of the imported module.
fn split(source: &str) -> (Vec<(&str, &str)>, String) {
    let (mut imports, mut body) = (Vec::new(), String::new());
    let mut rest = source;
    while let Some((before, after)) = rest.split_once("\nimport ") {
        let (import, after) = after.split_once(';').expect("an import ends with a semicolon");
        let (names, path) = import.split_once(" from ").expect("an import is `import { … } from \"…\";`");
        imports.push((names, path.trim_matches('"')));
        body += before;
        rest = after;
    }
    body += rest;
    (imports, body)
}

/// Returns the name that a line of code exports.
fn exported(line: &str) -> Option<&str> {
    let line = line.strip_prefix("export ")?;
    let kinds = ["const ", "class ", "function ", "async function "];
    // Importers would keep the first value of a variable that changes.
    let declared = kinds.iter().find_map(|kind| line.strip_prefix(kind));
    let declared = declared.unwrap_or_else(|| panic!("no constant, class or function: {line}"));
    declared.split(|letter: char| !(letter.is_alphanumeric() || letter == '_')).next()
}

/// Returns the path of the module that `module` imports by a relative path.
fn resolved(module: &str, path: &str) -> String {
    let mut parts: Vec<&str> = module.split('/').collect();
    parts.pop();
    for part in path.split('/').filter(|part| *part != ".") {
        if part == ".." {
            assert!(parts.pop().is_some(), "{module}: {path} leads out of the folder");
        } else {
            parts.push(part);
        }
    }
    parts.join("/")
}
