//! [`Source`]: the texts of a scene, and the document that they form.

use std::path::{Path, PathBuf};

use super::error::{Place, SceneFileError};
use super::overrides;
use super::toml_tree::parse;
use crate::params::{Document, Fault, Node};

/// The texts of a scene: index 0 is the file, the others are the overrides in their order.
pub struct Source<'a> {
    path: &'a Path,
    origin: Origin<'a>,
    overrides: &'a [&'a str],
}

/// Where source 0 comes from.
enum Origin<'a> {
    Text(&'a str),
    /// It was made for the model at the path.
    Tree(Node),
}

impl<'a> Source<'a> {
    pub fn new(path: &'a Path, text: &'a str, overrides: &'a [&'a str]) -> Self {
        let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
        Self { path, origin: Origin::Text(text), overrides }
    }

    /// A scene that was made for the model at `path`.
    pub fn of_model(path: &'a Path, tree: Node, overrides: &'a [&'a str]) -> Self {
        Self { path, origin: Origin::Tree(tree), overrides }
    }

    /// Parses the file and applies the overrides in order. Paths in the file are relative to its folder, paths in
    /// overrides and in scenes of models to the current directory.
    pub fn parse(&self) -> Result<Document, SceneFileError> {
        let (mut root, folder) = match &self.origin {
            Origin::Text(text) => {
                let folder = self.path.parent().map_or(PathBuf::new(), Path::to_owned);
                (self.place(parse(text, 0))?, folder)
            }
            Origin::Tree(tree) => (tree.clone(), PathBuf::new()),
        };
        let of_model = matches!(self.origin, Origin::Tree(_));
        for (i, text) in self.overrides.iter().enumerate() {
            self.place(overrides::apply(&mut root, text, i + 1, of_model))?;
        }
        Ok(Document::in_folders(root, vec![folder]))
    }

    /// Converts the mark of a fault to a place in a file or an override.
    pub fn place<T>(&self, result: Result<T, Fault>) -> Result<T, SceneFileError> {
        result.map_err(|Fault { mark, problem }| {
            let place = match (mark.source, &self.origin) {
                (0, Origin::Text(text)) => file_place(self.path, text.as_bytes(), mark.offset),
                (0, Origin::Tree(_)) => Place::Model { path: self.path.to_owned() },
                (i, _) => Place::Override { text: self.overrides[i - 1].to_owned() },
            };
            SceneFileError::Wrong { place, problem }
        })
    }
}

/// Line and column of a byte offset.
pub fn file_place(path: &Path, text: &[u8], offset: usize) -> Place {
    let before = &text[..offset.min(text.len())];
    let line_start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    Place::File {
        path: path.to_owned(),
        line: before.iter().filter(|&&byte| byte == b'\n').count() + 1,
        column: String::from_utf8_lossy(&before[line_start..]).chars().count() + 1,
    }
}
