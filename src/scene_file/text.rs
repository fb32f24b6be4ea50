//! Texts of files.

use std::path::Path;

use super::document::file_place;
use super::error::{SceneFileError, TextProblem};
use crate::file;
use crate::params::{Fault, Mark};

/// Maximum size of a file, in MiB: for scenes of more than three million materials.
const MOST: u64 = 128;

/// The text of a scene file, whose name ends in .toml.
pub fn of_scene(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        file::open(path).map_err(unreadable)?;
        return Err(SceneFileError::Ending(path.to_owned()));
    }
    of_file(path)
}

/// The text of a TOML file.
pub fn of_file(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    String::from_utf8(file::read(path, MOST).map_err(unreadable)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let place = file_place(path, error.as_bytes(), offset);
        let problem = TextProblem::Toml("the text is not UTF-8".into());
        SceneFileError::Wrong { place, problem: Fault::new(Mark::default(), problem).problem }
    })
}
