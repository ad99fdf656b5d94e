//! The paths that a source file uses, and the names that the file re-exports.

use std::collections::BTreeMap;

use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemMacro, ItemUse, Macro, UseTree, Visibility};

use crate::source::SourceFile;

/// A path from the root of the crate, such as `["run", "queue", "Queue"]`.
pub(crate) type Path = Vec<String>;

/// The names of a file.
pub(crate) struct Names {
    /// The paths that the file's code uses. A path to another crate is replaced by the path of the file itself.
    pub(crate) used: Vec<Path>,
    /// The names that the file re-exports with `pub use`, with their paths.
    pub(crate) handed_on: BTreeMap<String, Path>,
    /// The macros that the file defines for the root of the crate.
    pub(crate) macros: Vec<String>,
}

impl Names {
    /// The names of a file, except names in modules of tests.
    pub(crate) fn of(file: &SourceFile) -> Names {
        let parsed = syn::parse_file(&file.text).unwrap_or_else(|error| panic!("{}: {error}", file.path));
        let mut reader = Reader { module: file.module(), ..Reader::default() };
        reader.visit_file(&parsed);
        let Reader { module, imported, handed_on, written, macros } = reader;
        let from_root = |path: Path| match imported.get(&path[0]).or(handed_on.get(&path[0])) {
            Some(known) => [known, &path[1..]].concat(),
            None => absolute(&module, &path),
        };
        let mut used: Vec<Path> = written.into_iter().map(from_root).collect();
        used.extend(imported.into_values());
        Names { used, handed_on, macros }
    }
}

/// The path from the root of the crate for a path `written` in `module`.
fn absolute(module: &[String], written: &[String]) -> Path {
    let up = written.iter().take_while(|name| *name == "super").count();
    let (above, below) = match written[0].as_str() {
        "crate" => (&module[..0], &written[1..]),
        "self" => (module, &written[1..]),
        _ => (&module[..module.len().saturating_sub(up)], &written[up..]),
    };
    [above, below].concat()
}

/// Visits the syntax tree of a file.
#[derive(Default)]
struct Reader {
    /// The file's module.
    module: Path,
    /// The names that `use` imports, with their paths from the root.
    imported: BTreeMap<String, Path>,
    /// The names that `pub use` re-exports, with their paths from the root.
    handed_on: BTreeMap<String, Path>,
    /// All other paths, as the file writes them.
    written: Vec<Path>,
    macros: Vec<String>,
}

impl Reader {
    fn read_use(&mut self, public: bool, begin: &[String], tree: &UseTree) {
        let (last, name) = match tree {
            UseTree::Path(part) => {
                let begin = [begin, &[part.ident.to_string()]].concat();
                return self.read_use(public, &begin, &part.tree);
            }
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.read_use(public, begin, tree));
            }
            UseTree::Name(name) => (&name.ident, &name.ident),
            UseTree::Rename(rename) => (&rename.ident, &rename.rename),
            // All of a module counts as the module.
            UseTree::Glob(_) => {
                let path = absolute(&self.module, begin);
                self.imported.insert(format!("{}::*", path.join("::")), path);
                return;
            }
        };
        let (last, mut name) = (last.to_string(), name.to_string());
        let path = if last == "self" { begin.to_vec() } else { [begin, &[last]].concat() };
        if name == "self" {
            name.clone_from(&path[path.len() - 1]);
        }
        let names = if public { &mut self.handed_on } else { &mut self.imported };
        names.insert(name, absolute(&self.module, &path));
    }
}

fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<syn::Ident>().is_ok_and(|condition| condition == "test")
    })
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_item(&mut self, item: &'ast Item) {
        if !matches!(item, Item::Mod(module) if is_for_tests(&module.attrs)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.read_use(!matches!(item.vis, Visibility::Inherited), &[], &item.tree);
    }

    /// The path in `pub(in path)` is not a use of a file.
    fn visit_visibility(&mut self, _: &'ast Visibility) {}

    fn visit_item_macro(&mut self, item: &'ast ItemMacro) {
        let exported = item.attrs.iter().any(|attribute| attribute.path().is_ident("macro_export"));
        self.macros.extend(item.ident.as_ref().filter(|_| exported).map(ToString::to_string));
        visit::visit_item_macro(self, item);
    }

    /// The brackets of a macro contain no syntax tree, so paths are found by their colons, outside of string literals.
    fn visit_macro(&mut self, called: &'ast Macro) {
        visit::visit_macro(self, called);
        let text = called.tokens.to_string();
        let text = text.split('"').step_by(2).collect::<String>().replace(" :: ", "::");
        for word in text.split(|c: char| !(c.is_alphanumeric() || "_:".contains(c))) {
            let path: Path = word.split("::").map(str::to_owned).collect();
            if path.len() > 1 && path.iter().all(|name| !name.is_empty()) {
                self.written.push(path);
            }
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.leading_colon.is_none() {
            self.written.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        visit::visit_path(self, path);
    }
}
