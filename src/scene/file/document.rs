//! [`Document`]: the text of a scene with its overrides, as one tree.

use std::path::{Path, PathBuf};

use toml::de::DeTable;

use super::error::{Place, Problem, SceneFileError};
use super::overrides;
use super::tree::{Mark, Node};

/// A problem at a mark, before the mark is turned into a place.
pub struct Fault {
    pub mark: Mark,
    pub problem: Problem,
}

/// The tree of a scene file after the overrides, and the texts it came from: number 0 is the file,
/// the others are the overrides in their order.
pub struct Document<'a> {
    path: &'a Path,
    text: &'a str,
    overrides: &'a [&'a str],
    pub root: Node,
}

impl<'a> Document<'a> {
    /// Parses a text and applies the overrides to it, one after the other.
    pub fn parse(
        path: &'a Path,
        text: &'a str,
        overrides: &'a [&'a str],
    ) -> Result<Self, SceneFileError> {
        let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
        let mark = Mark { source: 0, offset: 0 };
        let root = Node { mark, value: super::tree::Value::Table(Vec::new()) };
        let mut document = Self { path, text, overrides, root };
        document.root = document.place(parse(text, 0))?;
        for (i, text) in overrides.iter().enumerate() {
            let applied = overrides::apply(&mut document.root, text, i + 1);
            document.place(applied)?;
        }
        Ok(document)
    }

    /// Turns the mark of a fault into a place.
    pub fn place<T>(&self, result: Result<T, Fault>) -> Result<T, SceneFileError> {
        result.map_err(|Fault { mark, problem }| {
            let place = match mark.source {
                0 => file_place(self.path, self.text.as_bytes(), mark.offset),
                i => Place::Override { text: self.overrides[i - 1].to_owned() },
            };
            SceneFileError::Wrong { place, problem }
        })
    }

    /// A fault at the value that these keys lead to, or at the table where it is missing.
    pub fn fault(&self, keys: &[&str], problem: impl Into<Problem>) -> Fault {
        Fault { mark: self.root.follow(keys).mark, problem: problem.into() }
    }

    /// A path that stands at a mark: in the file it is relative to the file's folder, in an override
    /// to the current directory.
    pub fn resolve(&self, mark: Mark, path: &str) -> PathBuf {
        let folder = self.path.parent().filter(|_| mark.source == 0);
        folder.unwrap_or(Path::new("")).join(path)
    }
}

/// The tree of a text, whose number is `source`.
pub fn parse(text: &str, source: usize) -> Result<Node, Fault> {
    match DeTable::parse(text) {
        Ok(table) => Ok(Node::from_table(&table, source)),
        Err(error) => {
            let offset = error.span().map_or(0, |span| span.start);
            Err(Fault {
                mark: Mark { source, offset },
                problem: Problem::Toml(error.message().into()),
            })
        }
    }
}

/// Line and column of a byte.
pub fn file_place(path: &Path, text: &[u8], offset: usize) -> Place {
    let before = &text[..offset.min(text.len())];
    let line_start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    Place::File {
        path: path.to_owned(),
        line: before.iter().filter(|&&byte| byte == b'\n').count() + 1,
        column: String::from_utf8_lossy(&before[line_start..]).chars().count() + 1,
    }
}
