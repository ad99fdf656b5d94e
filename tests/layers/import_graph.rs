//! The imports of files by other files of the same crate.

use std::collections::{BTreeMap, BTreeSet};

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;

use crate::names::{Names, Path};
use crate::source::SourceFile;

/// The files of a crate, each with the files that it imports.
pub(crate) struct ImportGraph {
    /// The path of each file, by its module.
    files: BTreeMap<Path, String>,
    names: BTreeMap<Path, Names>,
    /// The modules that export macros, by the macro's name.
    macros: BTreeMap<String, Path>,
}

impl ImportGraph {
    pub(crate) fn new(files: &[SourceFile]) -> ImportGraph {
        let names: BTreeMap<Path, Names> =
            files.iter().map(|file| (file.module(), Names::of(file))).collect();
        let macros = names
            .iter()
            .flat_map(|(module, names)| names.macros.iter().map(|name| (name.clone(), module.clone())));
        ImportGraph {
            macros: macros.collect(),
            files: files.iter().map(|file| (file.module(), file.path.clone())).collect(),
            names,
        }
    }

    /// The module of the file that defines a path. The path contains the module, or a module of the path re-exports the
    /// name.
    fn definer(&self, path: &Path) -> Path {
        let mut path = path.clone();
        // As often as a name can be handed on.
        for _ in 0..10 {
            let depth = (0..=path.len()).rev().find(|&depth| self.files.contains_key(&path[..depth]));
            let depth = depth.expect("the root of the crate is a file");
            let (module, rest) = path.split_at(depth);
            let known = rest.first().and_then(|name| {
                let macros = self.macros.get(name).filter(|_| module.is_empty());
                self.names[module].handed_on.get(name).or(macros).map(|known| (known, name))
            });
            match known {
                Some((known, name)) if self.macros.get(name) == Some(known) => return known.clone(),
                // A macro that its own file hands on.
                Some((known, _)) if *known == path => return module.to_vec(),
                Some((known, _)) => path = [known, &rest[1..]].concat(),
                None => return module.to_vec(),
            }
        }
        panic!("{} is handed on in a cycle", path.join("::"));
    }

    /// Each pair of two files, as paths below `src`: the first file imports the second file.
    pub(crate) fn imports(&self) -> BTreeSet<(&str, &str)> {
        let mut imports = BTreeSet::new();
        for (module, names) in &self.names {
            for path in &names.used {
                let used = self.definer(path);
                // Names that are not the crate's lead to the module itself, or to the root.
                if used != *module && !used.is_empty() {
                    imports.insert((&*self.files[module], &*self.files[&used]));
                }
            }
        }
        imports
    }

    /// The cycles: groups of files in which each file imports all other files, directly or through other files.
    pub(crate) fn cycles(&self) -> Vec<Vec<&str>> {
        let graph: DiGraphMap<&str, ()> = self.imports().into_iter().collect();
        let mut cycles: Vec<Vec<&str>> =
            tarjan_scc(&graph).into_iter().filter(|files| files.len() > 1).collect();
        for files in &mut cycles {
            files.sort_unstable();
        }
        cycles
    }
}
