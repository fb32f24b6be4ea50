//! Imports between files.

use std::collections::{BTreeMap, BTreeSet};

use super::modules::{Files, Module, modules};

/// Imports from one file to another: names with their lines.
pub type Imports = BTreeMap<(String, String), BTreeSet<String>>;

/// The imports between the files of one crate, and from the library `lobe` if it is another crate.
#[derive(Default)]
pub struct Found {
    pub imports: Imports,
    /// Names that files of the library take from its root and that are no modules: `file:line name`.
    pub through_the_door: BTreeSet<String>,
}

/// A crate, and the library `lobe` if it is another one.
struct Crate<'a> {
    modules: Vec<Module>,
    lobe: Option<&'a Crate<'a>>,
}

/// The target of a path.
#[derive(Clone, Copy)]
enum Place<'a> {
    Module(&'a Crate<'a>, usize),
    /// An item, by the file that defines it.
    Item(&'a str),
}

/// The imports of the library, and those of the command if there is one.
pub fn imports(files: &Files) -> Found {
    let library = Crate { modules: modules(files, "src/lib.rs"), lobe: None };
    let mut found = Found::default();
    library.collect(&mut found);
    let main = "src/bin/lobe/main.rs";
    if files.contains_key(main) {
        Crate { modules: modules(files, main), lobe: Some(&library) }.collect(&mut found);
    }
    found
}

impl<'a> Crate<'a> {
    fn collect(&'a self, found: &mut Found) {
        for (number, module) in self.modules.iter().enumerate() {
            let uses = module.uses.iter().filter_map(|name| {
                // A re-export that the module does not use itself is no import.
                let is_import = !name.is_public || module.words.contains(&name.name);
                is_import.then_some((&name.path, name.line))
            });
            let paths = module.paths.iter().map(|(path, line)| (path, *line));
            for (path, line) in uses.chain(paths.filter(|(path, _)| path.len() > 1)) {
                let name = format!("{}, line {line}", path.join("::"));
                if self.is_through_the_door(number, path) {
                    found.through_the_door.insert(format!("{}: {name}", module.file));
                }
                let file = match self.resolve(number, path, 0) {
                    Some(Place::Item(file)) => file,
                    // All names of a module.
                    Some(Place::Module(of, target)) if path.ends_with(&["*".into()]) => {
                        &of.modules[target].file
                    }
                    _ => continue,
                };
                if file != module.file {
                    let files = (module.file.clone(), file.to_owned());
                    found.imports.entry(files).or_default().insert(name);
                }
            }
        }
    }

    /// The module that a path starts from, and the rest of the path.
    fn start<'p>(&'a self, from: usize, path: &'p [String]) -> Option<(usize, &'p [String])> {
        let (mut module, mut rest) = match path[0].as_str() {
            "crate" => (0, &path[1..]),
            "self" => (from, &path[1..]),
            "super" => (from, path),
            name => {
                let here = &self.modules[from];
                let is_known = here.children.contains_key(name)
                    || here.uses.iter().any(|import| import.name == name);
                return is_known.then_some((from, path));
            }
        };
        while rest.first().is_some_and(|name| name == "super") {
            (module, rest) = (self.modules[module].parent?, &rest[1..]);
        }
        Some((module, rest))
    }

    fn is_through_the_door(&'a self, from: usize, path: &[String]) -> bool {
        let Some((0, [name, ..])) = self.start(from, path) else { return false };
        self.lobe.is_none() && from != 0 && !self.modules[0].children.contains_key(name)
    }

    /// Follows a path, through re-exports, to the file that defines its item. `None` for other crates' items.
    fn resolve(&'a self, from: usize, path: &[String], steps: usize) -> Option<Place<'a>> {
        if steps > 20 {
            return None; // A name of another crate that is imported under the crate's name.
        }
        if let (Some(lobe), "lobe") = (self.lobe, path[0].as_str()) {
            return lobe.walk(0, &path[1..], steps);
        }
        let (module, rest) = self.start(from, path)?;
        self.walk(module, rest, steps)
    }

    fn walk(&'a self, module: usize, path: &[String], steps: usize) -> Option<Place<'a>> {
        let Some((name, rest)) = path.split_first() else {
            return Some(Place::Module(self, module));
        };
        let here = &self.modules[module];
        if let Some(&child) = here.children.get(name) {
            return self.walk(child, rest, steps);
        }
        if name == "*" {
            return Some(Place::Module(self, module));
        }
        if let Some(import) = here.uses.iter().find(|import| import.name == *name) {
            return match self.resolve(module, &import.path, steps + 1)? {
                Place::Module(of, target) => of.walk(target, rest, steps + 1),
                item => Some(item),
            };
        }
        let globs = here.uses.iter().filter(|import| import.name == "*");
        let in_glob = globs.filter(|_| !here.items.contains(name)).find_map(|import| {
            match self.resolve(module, &import.path, steps + 1)? {
                Place::Module(of, target) if of.modules[target].items.contains(name) => {
                    Some(Place::Item(&of.modules[target].file))
                }
                _ => None,
            }
        });
        Some(in_glob.unwrap_or(Place::Item(&here.file)))
    }
}
