//! [`Kind`], an entry of a registry, and [`Section`], the tables of a document that one registry reads.

use super::error::Fault;
use super::hint::one_of;
use super::key::AnyKey;
use super::table::Table;
use super::tree::Value;

/// An entry of a registry: one kind of material, light, and so on. `R` is usually a function that reads a [`Table`];
/// each registry defines its own type.
#[derive(Clone, Copy, Debug)]
pub struct Kind<R: 'static> {
    /// Its name in documents and on the command line.
    pub name: &'static str,
    /// Short description, in one line.
    pub meaning: &'static str,
    /// All keys that it reads.
    pub keys: &'static [&'static dyn AnyKey],
    /// The function that reads it.
    pub read: R,
}

/// The tables of a document that one registry reads, such as all `[material.NAME]`.
#[derive(Clone, Copy, Debug)]
pub struct Section<R: 'static> {
    /// Key of the table, such as "material".
    pub key: &'static str,
    /// Plural for headings, such as "materials".
    pub plural: &'static str,
    /// Whether there can be any number of these tables, each with a name.
    pub is_named: bool,
    /// The key that selects the kind, such as "type".
    pub selector: &'static str,
    /// The default kind; `None` if the selector is required.
    pub default: Option<&'static str>,
    /// Keys that all kinds share.
    pub common: &'static [&'static dyn AnyKey],
    /// The registry.
    pub kinds: &'static [Kind<R>],
}

impl<R> Section<R> {
    /// Reads a table: finds the kind that the selector names, checks that the kind declares all keys of the table, and
    /// calls `read` with it.
    ///
    /// # Errors
    /// Unknown or missing keys, errors of `read`, and keys that `read` did not read.
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
            return default.ok_or_else(|| table.without(self.selector, names()));
        };
        let kind = if let Value::Text(name) = &node.value { named(name) } else { None };
        kind.ok_or_else(|| table.wrong(self.selector, node, node.value.to_string(), names()))
    }
}

/// A [`Section`] of any registry, for documentation and tests.
pub trait AnySection: Sync {
    /// Key of the table, such as "material".
    fn key(&self) -> &'static str;

    /// Plural for headings, such as "materials".
    fn plural(&self) -> &'static str;

    /// Whether there can be any number of these tables, each with a name.
    fn is_named(&self) -> bool;

    /// The key that selects the kind.
    fn selector(&self) -> &'static str;

    /// The default kind; `None` if the selector is required.
    fn default(&self) -> Option<&'static str>;

    /// Keys that all kinds share.
    fn common(&self) -> &'static [&'static dyn AnyKey];

    /// All kinds, without their read functions.
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
