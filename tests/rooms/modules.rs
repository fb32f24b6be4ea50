//! The modules of a crate: the file of each, its declarations and the paths in it.

use std::collections::{BTreeMap, BTreeSet};

use super::tokens::{Token, is_word, tokens};

/// Files by name, such as `src/lib.rs`.
pub type Files = BTreeMap<String, String>;

/// A module, in a file of its own or in its parent's.
#[derive(Default)]
pub struct Module {
    pub file: String,
    pub parent: Option<usize>,
    pub children: BTreeMap<String, usize>,
    pub uses: Vec<Use>,
    /// Paths outside of `use`, with their lines.
    pub paths: Vec<(Vec<String>, usize)>,
    /// Names of the items that are defined here.
    pub items: BTreeSet<String>,
    /// First names of all paths outside of `use`.
    pub words: BTreeSet<String>,
    /// Where the files of its children are.
    folder: String,
}

/// One name of a `use`.
pub struct Use {
    /// The name in this module; `*` for all names of a module.
    pub name: String,
    pub path: Vec<String>,
    /// Whether it is a re-export.
    pub is_public: bool,
    pub line: usize,
}

/// All modules reachable from `root`, which comes first, without items behind `#[cfg(test)]`.
pub fn modules(files: &Files, root: &str) -> Vec<Module> {
    let folder = root.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
    let mut modules = vec![Module { file: root.to_owned(), folder, ..Module::default() }];
    read(files, &mut modules, 0);
    modules
}

/// Reads the file of a module.
fn read(files: &Files, modules: &mut Vec<Module>, module: usize) {
    let tokens = tokens(&files[&modules[module].file]);
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text.as_str());
    // Open modules, each with the number of braces that were open before it.
    let (mut open, mut depth) = (vec![(module, 0)], 0);
    let mut i = 0;
    while i < tokens.len() {
        let here = open.last().expect("the file's module stays open").0;
        match text(i) {
            "#" if is_test(&tokens[i..]) => i = end_of_item(&tokens, i),
            "mod" if is_word(text(i + 1)) && matches!(text(i + 2), ";" | "{") => {
                let child = add_child(files, modules, here, text(i + 1), text(i + 2) == ";");
                if text(i + 2) == "{" {
                    open.push((child, depth));
                    depth += 1;
                }
                i += 3;
            }
            "use" if text(i + 1) != "<" => {
                let is_public = i > 0 && matches!(text(i - 1), "pub" | ")");
                let (first, line) = (modules[here].uses.len(), tokens[i].line);
                i = add_uses(&tokens, i + 1, Vec::new(), &mut modules[here].uses);
                for name in &mut modules[here].uses[first..] {
                    (name.is_public, name.line) = (is_public, line);
                }
            }
            "{" => (depth, i) = (depth + 1, i + 1),
            "}" => {
                (depth, i) = (depth - 1, i + 1);
                if open.len() > 1 && open[open.len() - 1].1 == depth {
                    open.pop();
                }
            }
            word if is_word(word) => {
                if is_definition(word, text(i + 1)) {
                    let name = i + if word == "macro_rules" { 2 } else { 1 };
                    modules[here].items.insert(text(name).to_owned());
                }
                i = add_path(&tokens, i, &mut modules[here]);
            }
            _ => i += 1,
        }
    }
}

/// Whether an attribute leaves the next item to tests.
fn is_test(tokens: &[Token]) -> bool {
    let words: Vec<&str> = tokens.iter().take(7).map(|token| token.text.as_str()).collect();
    matches!(
        words[..],
        ["#", "[", "cfg", "(", "test" | "doctest", ..] | ["#", "[", "cfg", "(", "all", "(", "test"]
    )
}

/// The index after the item that starts at `i` with its attributes.
fn end_of_item(tokens: &[Token], mut i: usize) -> usize {
    let mut depth = 0;
    while i < tokens.len() {
        match tokens[i].text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" => depth -= 1,
            "}" => {
                depth -= 1;
                if depth == 0 {
                    return i + 1;
                }
            }
            ";" if depth == 0 => return i + 1,
            _ => {}
        }
        i += 1;
    }
    i
}

fn add_child(
    files: &Files,
    modules: &mut Vec<Module>,
    parent: usize,
    name: &str,
    has_file: bool,
) -> usize {
    let folder = format!("{}/{name}", modules[parent].folder);
    let file = match has_file {
        false => modules[parent].file.clone(),
        true => [format!("{folder}.rs"), format!("{folder}/mod.rs")]
            .into_iter()
            .find(|file| files.contains_key(file))
            .unwrap_or_else(|| panic!("{}: no file of `mod {name};`", modules[parent].file)),
    };
    let child = modules.len();
    modules[parent].children.insert(name.to_owned(), child);
    modules.push(Module { file, folder, parent: Some(parent), ..Module::default() });
    if has_file {
        read(files, modules, child);
    }
    child
}

fn is_definition(word: &str, next: &str) -> bool {
    let defines = ["struct", "enum", "union", "trait", "type", "fn", "const", "static"];
    (defines.contains(&word) && is_word(next)) || (word == "macro_rules" && next == "!")
}

/// Adds the path that starts at `i`, and returns the index after it.
fn add_path(tokens: &[Token], mut i: usize, module: &mut Module) -> usize {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text.as_str());
    let is_start = i == 0 || !matches!(text(i - 1), "::" | ".");
    let (mut path, line) = (vec![text(i).to_owned()], tokens[i].line);
    while text(i + 1) == "::" && is_word(text(i + 2)) {
        i += 2;
        path.push(text(i).to_owned());
    }
    if is_start {
        module.words.insert(path[0].clone());
        module.paths.push((path, line));
    }
    i + 1
}

/// Adds the names in the tree of a `use` that starts at `i`, behind `prefix`. Returns the index after it.
fn add_uses(tokens: &[Token], mut i: usize, prefix: Vec<String>, uses: &mut Vec<Use>) -> usize {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text.as_str());
    let mut path = prefix;
    loop {
        match text(i) {
            "::" => i += 1,
            "{" => {
                i += 1;
                while text(i) != "}" {
                    i = add_uses(tokens, i, path.clone(), uses);
                    i += usize::from(text(i) == ",");
                }
                return i + 1;
            }
            "self" if !path.is_empty() && path.last().is_some_and(|last| last != "self") => i += 1,
            word => {
                assert!(is_word(word) || word == "*", "line {}: `{word}` in a use", tokens[i].line);
                path.push(word.to_owned());
                i += 1;
            }
        }
        if text(i) == "as" {
            uses.push(Use { name: text(i + 1).into(), path, is_public: false, line: 0 });
            return i + 2;
        }
        if matches!(text(i), ";" | "," | "}") {
            let name = path.last().expect("a use names something").clone();
            uses.push(Use { name, path, is_public: false, line: 0 });
            return i;
        }
    }
}
