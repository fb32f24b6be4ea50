//! [`Section`]: one table of a scene file, read key by key.

use super::document::Fault;
use super::error::Problem;
use super::hint::{hint, one_of};
use super::tree::{Entry, Mark, Node, Value};
use super::value::FromValue;

/// A table, or what stands for one that the file leaves out.
pub struct Section<'a> {
    /// Its full name; empty for the whole file.
    name: String,
    /// What messages call it.
    title: String,
    node: &'a Node,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub fn root(node: &'a Node) -> Self {
        Self { name: String::new(), title: "the scene".into(), node }
    }

    /// The table of that name, if there is one.
    pub fn section(&self, key: &str) -> Result<Option<Self>, Fault> {
        self.node.get(key).map(|node| self.enter(key, node)).transpose()
    }

    /// All tables in it, with their names.
    pub fn sections(&self) -> impl Iterator<Item = Result<(&'a str, Self), Fault>> {
        let enter = |entry: &'a Entry| {
            let section = self.enter(&entry.key, &entry.node)?;
            Ok((entry.key.as_str(), section))
        };
        self.node.entries().iter().map(enter)
    }

    fn enter(&self, key: &str, node: &'a Node) -> Result<Self, Fault> {
        let name = full_name(&self.name, key);
        match node.value {
            Value::Table(_) => Ok(Self { title: format!("[{name}]"), name, node }),
            _ => Err(wrong(name, node, "a table".into())),
        }
    }

    /// Refuses all keys but these.
    pub fn only(&self, known: &[&str]) -> Result<(), Fault> {
        let unknown = self.node.entries().iter().find(|e| !known.contains(&e.key.as_str()));
        unknown.map_or(Ok(()), |Entry { key, mark, .. }| {
            let hint = hint(key, known.iter().copied());
            // Which keys there are depends on the type, where a table has one.
            let table = match self.node.get("type") {
                Some(kind) => format!("{} of type {}", self.title, kind.value),
                None => self.title.clone(),
            };
            let key = key.escape_debug().to_string();
            Err(Fault { mark: *mark, problem: Problem::UnknownKey { key, table, hint } })
        })
    }

    /// Where the value of a key stands, or else the table.
    pub fn mark(&self, key: &str) -> Mark {
        self.node.follow(&[key]).mark
    }

    /// The value of a key, if it is there.
    pub fn get<T: FromValue>(&self, key: &str) -> Result<Option<T>, Fault> {
        let read = |node: &Node| {
            T::from_value(&node.value)
                .ok_or_else(|| wrong(full_name(&self.name, key), node, T::expected()))
        };
        self.node.get(key).map(read).transpose()
    }

    /// The value of a key, or a default.
    pub fn get_or<T: FromValue>(&self, key: &str, default: T) -> Result<T, Fault> {
        Ok(self.get(key)?.unwrap_or(default))
    }

    /// The value of a key that has no default.
    pub fn require<T: FromValue>(&self, key: &'static str) -> Result<T, Fault> {
        self.get(key)?.ok_or_else(|| self.lacks(key, T::expected()))
    }

    /// The one of some choices that a key names.
    pub fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<Option<T>, Fault> {
        let read = |node: &Node| {
            let is_it = |(name, _): &&(&str, T)| matches!(&node.value, Value::Text(t) if t == name);
            let found = choices.iter().find(is_it).map(|(_, choice)| *choice);
            found.ok_or_else(|| wrong(full_name(&self.name, key), node, names(choices)))
        };
        self.node.get(key).map(read).transpose()
    }

    /// The same for a key that has no default.
    pub fn require_choice<T: Copy>(
        &self,
        key: &'static str,
        choices: &[(&str, T)],
    ) -> Result<T, Fault> {
        self.choice(key, choices)?.ok_or_else(|| self.lacks(key, names(choices)))
    }

    fn lacks(&self, key: &'static str, expected: String) -> Fault {
        let problem = Problem::MissingKey { table: self.title.clone(), key, expected };
        Fault { mark: self.node.mark, problem }
    }
}

/// The name of a key with that of its table, as it could stand in a file.
pub fn full_name(table: &str, key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let dot = if table.is_empty() { "" } else { "." };
    if !key.is_empty() && key.chars().all(is_bare) {
        format!("{table}{dot}{key}")
    } else {
        format!("{table}{dot}{key:?}")
    }
}

fn names<T>(choices: &[(&str, T)]) -> String {
    one_of(choices.iter().map(|(name, _)| format!("{name:?}")))
}

fn wrong(key: String, node: &Node, expected: String) -> Fault {
    let mut found = node.value.to_string();
    if found.chars().count() > 60 {
        found = found.chars().take(59).chain(['…']).collect();
    }
    Fault { mark: node.mark, problem: Problem::Value { key, found, expected } }
}
