//! [`Kind`], a line of a registry, and [`Section`], the tables of a document that a registry reads.

use super::error::Fault;
use super::hint::one_of;
use super::key::AnyKey;
use super::table::Table;
use super::tree::Value;

/// One kind of material, light, ...: a line of a registry. `R` is how it is read, mostly a function from a
/// [`Table`]; each registry chooses its own.
#[derive(Clone, Copy, Debug)]
pub struct Kind<R: 'static> {
    /// What documents and the command line call it.
    pub name: &'static str,
    /// What it is, in one line.
    pub meaning: &'static str,
    /// All keys that it reads.
    pub keys: &'static [&'static dyn AnyKey],
    /// How it is read.
    pub read: R,
}

/// The tables of a document that are read by one registry, such as all `[material.NAME]`.
#[derive(Clone, Copy, Debug)]
pub struct Section<R: 'static> {
    /// The table's key: "material".
    pub key: &'static str,
    /// What the kinds are called together: "materials".
    pub plural: &'static str,
    /// Whether there are any number of them, each with a name.
    pub is_named: bool,
    /// The key that names the kind: "type".
    pub selector: &'static str,
    /// The kind if none is named; without it the selector is required.
    pub default: Option<&'static str>,
    /// Keys that all kinds have.
    pub common: &'static [&'static dyn AnyKey],
    /// The registry.
    pub kinds: &'static [Kind<R>],
}

impl<R> Section<R> {
    /// Reads a table: finds the kind that it names, refuses keys that this kind does not have, and calls `read` with
    /// the kind.
    ///
    /// # Errors
    /// What is wrong with the keys, what `read` finds wrong, or a key that `read` had no use for.
    pub fn read<T>(
        &self,
        table: Table,
        read: impl FnOnce(&'static Kind<R>, &Table) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let kind = self.choose(&table)?;
        let keys = kind.keys.iter().chain(self.common).map(|key| key.name());
        let table = table.with_keys(self.selector, keys)?;
        let value = read(kind, &table)?;
        table.finish()?;
        Ok(value)
    }

    fn choose(&self, table: &Table) -> Result<&'static Kind<R>, Fault> {
        let names = || one_of(self.kinds.iter().map(|kind| format!("{:?}", kind.name)));
        let named = |name: &str| self.kinds.iter().find(|kind| kind.name == name);
        let Some(node) = table.node().get(self.selector) else {
            let default = self.default.and_then(named);
            return default.ok_or_else(|| table.lacks(self.selector, names()));
        };
        let kind = if let Value::Text(name) = &node.value { named(name) } else { None };
        kind.ok_or_else(|| table.wrong(self.selector, node, node.value.to_string(), names()))
    }
}

/// A [`Section`] of any registry, for tables and tests.
pub trait AnySection: Sync {
    /// The table's key: "material".
    fn key(&self) -> &'static str;

    /// What the kinds are called together: "materials".
    fn plural(&self) -> &'static str;

    /// Whether there are any number of them, each with a name.
    fn is_named(&self) -> bool;

    /// The key that names the kind.
    fn selector(&self) -> &'static str;

    /// The kind if none is named.
    fn default(&self) -> Option<&'static str>;

    /// Keys that all kinds have.
    fn common(&self) -> &'static [&'static dyn AnyKey];

    /// The kinds, without how they are read.
    fn kinds(&self) -> Vec<Kind<()>>;
}

impl<R: Sync> AnySection for Section<R> {
    fn key(&self) -> &'static str {
        self.key
    }

    fn plural(&self) -> &'static str {
        self.plural
    }

    fn is_named(&self) -> bool {
        self.is_named
    }

    fn selector(&self) -> &'static str {
        self.selector
    }

    fn default(&self) -> Option<&'static str> {
        self.default
    }

    fn common(&self) -> &'static [&'static dyn AnyKey] {
        self.common
    }

    fn kinds(&self) -> Vec<Kind<()>> {
        let bare = |kind: &Kind<R>| Kind {
            name: kind.name,
            meaning: kind.meaning,
            keys: kind.keys,
            read: (),
        };
        self.kinds.iter().map(bare).collect()
    }
}
