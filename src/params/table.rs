//! [`Document`], and [`Table`], one table of it, which is read key by key.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::error::{Fault, Problem};
use super::hint::hint;
use super::key::{AnyKey, Key};
use super::param::Param;
use super::shown::{Shown, quoted, shortened};
use super::tree::{Entry, Mark, Node, Value};

/// A tree of values, and the folder of each source, against which its relative paths are resolved.
#[derive(Debug)]
pub struct Document {
    /// The top-level table.
    pub root: Node,
    /// Folders, by [`Mark::source`]. Sources without one use the current directory.
    pub folders: Vec<PathBuf>,
    files: Mutex<Vec<PathBuf>>,
}

/// A table of a document. A table that is left out reads as an empty one. It records which keys may be read and which
/// have been.
pub struct Table<'a> {
    /// Full name; empty for the root.
    name: String,
    /// Name in messages.
    title: String,
    node: &'a Node,
    document: &'a Document,
    keys: Vec<&'static str>,
    read: RefCell<Vec<&'static str>>,
    cost: Cell<u32>,
}

/// Replacement for tables that are left out.
static EMPTY: Node = Node { mark: Mark { source: 0, offset: 0 }, value: Value::Table(Vec::new()) };

impl Document {
    /// A tree whose paths are relative to the current directory.
    pub fn new(root: Node) -> Self {
        Self::in_folders(root, Vec::new())
    }

    /// A tree whose paths are relative to these folders, by [`Mark::source`].
    pub fn in_folders(root: Node, folders: Vec<PathBuf>) -> Self {
        Self { root, folders, files: Mutex::default() }
    }

    /// The files that have been read from the document so far: all values of keys for paths.
    pub fn files(&self) -> Vec<PathBuf> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The root table, with `title` as its name in messages. Its keys have to be among `keys`.
    ///
    /// # Errors
    /// The first unknown key.
    pub fn table(&self, title: &str, keys: &[&'static str]) -> Result<Table<'_>, Fault> {
        let table = Table::new(self, String::new(), title.into(), &self.root);
        let table = Table { keys: keys.to_vec(), ..table };
        table.refuse_unknown().map(|()| table)
    }
}

impl<'a> Table<'a> {
    fn new(document: &'a Document, name: String, title: String, node: &'a Node) -> Self {
        let (keys, read, cost) = (Vec::new(), RefCell::default(), Cell::default());
        Self { name, title, node, document, keys, read, cost }
    }

    /// The largest [`cost`](Self::cost) of a table. Tables that refer to others twice would double it with each, and evaluation is recursive.
    pub const MAX_COST: u32 = 1000;

    /// Adds the cost of what the value at `mark` names, in evaluations at each point.
    ///
    /// # Errors
    /// If the sum is above [`MAX_COST`](Self::MAX_COST).
    pub fn charge(&self, mark: Mark, cost: u32) -> Result<(), Fault> {
        let cost = self.cost.get().saturating_add(cost);
        self.cost.set(cost);
        if cost <= Self::MAX_COST {
            return Ok(());
        }
        let (table, most) = (self.title.clone(), Self::MAX_COST);
        Err(Fault { mark, problem: Problem::Costly { table, cost, most } })
    }

    /// The sum of what was [charged](Self::charge).
    pub fn cost(&self) -> u32 {
        self.cost.get()
    }

    /// The table with this key, or an empty one.
    ///
    /// # Errors
    /// If the value is not a table.
    pub fn table(&self, key: &str) -> Result<Self, Fault> {
        self.enter(key, self.node.get(key).unwrap_or(&EMPTY))
    }

    /// All tables in the table with this key, with their names, in the order of the document.
    ///
    /// # Errors
    /// The first value that is not a table.
    pub fn tables(&self, key: &str) -> Result<Vec<(&'a str, Self)>, Fault> {
        let table = self.table(key)?;
        let enter = |entry: &'a Entry| Ok((&*entry.key, table.enter(&entry.key, &entry.node)?));
        table.node.entries().iter().map(enter).collect()
    }

    fn enter(&self, key: &str, node: &'a Node) -> Result<Self, Fault> {
        let name = full_name(&self.name, key);
        match node.value {
            Value::Table(_) => {
                Ok(Self::new(self.document, name.clone(), format!("[{name}]"), node))
            }
            _ => Err(self.wrong(key, node, node.value.to_string(), "a table".into())),
        }
    }

    /// The same table, restricted to the keys `selector` and `keys`.
    pub(super) fn with_keys(
        mut self,
        selector: &'static str,
        keys: impl Iterator<Item = &'static str>,
    ) -> Result<Self, Fault> {
        self.keys = [selector].into_iter().chain(keys).collect();
        self.read = RefCell::new(vec![selector]);
        // The keys of a table depend on its kind, so name it in the message.
        if let Some(kind) = self.node.get(selector) {
            let kind = kind.value.to_string();
            self.title = format!("{} of {selector} {}", self.title, Shown::name(&kind));
        }
        self.refuse_unknown()?;
        self.title = format!("[{}]", self.name);
        Ok(self)
    }

    fn refuse_unknown(&self) -> Result<(), Fault> {
        let is_unknown = |entry: &&Entry| self.keys.iter().all(|key| *key != entry.key);
        let unknown = self.node.entries().iter().find(is_unknown);
        unknown.map_or(Ok(()), |Entry { key, mark, .. }| {
            let hint = hint(key, self.keys.iter().copied());
            let (key, table) = (Shown::name(key).to_string(), self.title.clone());
            Err(Fault { mark: *mark, problem: Problem::UnknownKey { key, table, hint } })
        })
    }

    /// The value of a key, or its default.
    ///
    /// # Errors
    /// If the value has another type, is out of range, or is missing and has no default; or if the table's kind does
    /// not declare the key.
    pub fn get<T: Param>(&self, key: &Key<T>) -> Result<T, Fault> {
        let Some(node) = self.value(key)? else {
            return key.get_default().cloned().ok_or_else(|| self.missing(key));
        };
        let folder = self.document.folders.get(node.mark.source);
        match T::from_value(&node.value, key.limits()) {
            Some(value) => {
                let value = value.placed(folder.map_or(Path::new(""), |folder| folder));
                if let Some(file) = value.file() {
                    let mut files =
                        self.document.files.lock().unwrap_or_else(PoisonError::into_inner);
                    files.push(file.to_owned());
                }
                Ok(value)
            }
            None => Err(self.unfit(key, node, node.value.to_string(), key.expected())),
        }
    }

    /// The unconverted value of a key, for types that [`Table::get`] cannot read.
    ///
    /// # Errors
    /// If the table's kind does not declare the key.
    pub fn value(&self, key: &dyn AnyKey) -> Result<Option<&'a Node>, Fault> {
        let key = key.name();
        if !self.keys.contains(&key) {
            let problem = Problem::Undeclared { key, table: self.title.clone() };
            return Err(Fault { mark: self.node.mark, problem });
        }
        self.read.borrow_mut().push(key);
        Ok(self.node.get(key))
    }

    /// Returns an error for a known key that was not read: it has no effect beside the others.
    pub(super) fn finish(&self) -> Result<(), Fault> {
        let read = self.read.borrow();
        let is_unread = |entry: &&Entry| read.iter().all(|key| *key != entry.key);
        let unread = self.node.entries().iter().find(is_unread);
        unread.map_or(Ok(()), |Entry { key, mark, .. }| {
            let key = full_name(&self.name, key);
            Err(Fault { mark: *mark, problem: Problem::Unused { key } })
        })
    }

    /// Position of the value of a key, or of the table if the key is left out.
    pub fn mark(&self, key: &dyn AnyKey) -> Mark {
        self.node.follow(&[key.name()]).mark
    }

    /// The error that a required key is missing.
    pub fn missing(&self, key: &dyn AnyKey) -> Fault {
        self.lacks(key, key.expected())
    }

    /// The error that a key is missing that others may stand for: what is `expected` names them.
    pub fn lacks(&self, key: &dyn AnyKey, expected: impl Into<String>) -> Fault {
        self.without(key.name(), expected.into())
    }

    /// The error that the value of a key, `found` at `node`, is invalid.
    pub fn unfit(&self, key: &dyn AnyKey, node: &Node, found: String, expected: String) -> Fault {
        self.wrong(key.name(), node, found, expected)
    }

    pub(super) fn node(&self) -> &'a Node {
        self.node
    }

    pub(super) fn without(&self, key: &'static str, expected: String) -> Fault {
        let problem = Problem::MissingKey { table: self.title.clone(), key, expected };
        Fault { mark: self.node.mark, problem }
    }

    pub(super) fn wrong(&self, key: &str, node: &Node, found: String, expected: String) -> Fault {
        let found = shortened(&found).into_owned();
        let key = full_name(&self.name, key);
        Fault { mark: node.mark, problem: Problem::Value { key, found, expected } }
    }
}

/// Full name of a key in the table `table`, in the syntax of a scene file; of long keys a part.
fn full_name(table: &str, key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let dot = if table.is_empty() { "" } else { "." };
    if !key.is_empty() && key.chars().all(is_bare) {
        format!("{table}{dot}{}", shortened(key))
    } else {
        format!("{table}{dot}{}", quoted(key))
    }
}
