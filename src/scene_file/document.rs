//! [`Source`]: the texts of a scene, and the document that they form.

use std::path::{Path, PathBuf};

use super::error::{Place, SceneFileError};
use super::overrides;
use super::toml_tree::parse;
use crate::params::{Document, Fault};

/// The texts of a scene: index 0 is the file, the others are the overrides in their order.
pub struct Source<'a> {
    path: &'a Path,
    text: &'a str,
    overrides: &'a [&'a str],
}

impl<'a> Source<'a> {
    pub fn new(path: &'a Path, text: &'a str, overrides: &'a [&'a str]) -> Self {
        Self { path, text: text.strip_prefix('\u{FEFF}').unwrap_or(text), overrides }
    }

    /// Parses the file and applies the overrides in order. Paths in the file are relative to its folder, paths in
    /// overrides to the current directory.
    pub fn parse(&self) -> Result<Document, SceneFileError> {
        let mut root = self.place(parse(self.text, 0))?;
        for (i, text) in self.overrides.iter().enumerate() {
            self.place(overrides::apply(&mut root, text, i + 1))?;
        }
        let folder = self.path.parent().map_or(PathBuf::new(), Path::to_owned);
        Ok(Document::in_folders(root, vec![folder]))
    }

    /// Converts the mark of a fault to a place in a file or an override.
    pub fn place<T>(&self, result: Result<T, Fault>) -> Result<T, SceneFileError> {
        result.map_err(|Fault { mark, problem }| {
            let place = match mark.source {
                0 => file_place(self.path, self.text.as_bytes(), mark.offset),
                i => Place::Override { text: self.overrides[i - 1].to_owned() },
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
