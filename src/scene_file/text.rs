//! Texts of files.

use std::path::Path;

use super::document::file_place;
use super::error::{SceneFileError, TextProblem};
use crate::file;
use crate::params::{Fault, Mark};

/// Maximum size of a file, in MiB: for scenes of more than three million materials.
const MOST: u64 = 128;

/// Endings of models and scenes of other programs.
const FOREIGN: [&str; 18] = [
    "3ds", "abc", "blend", "dae", "fbx", "glb", "gltf", "mtl", "pbrt", "ply", "stl", "usd", "usda",
    "usdc", "usdz", "wrl", "x3d", "xml",
];

/// The text of a scene file. Its name must not tell that it is something else.
pub fn of_scene(path: &Path) -> Result<String, SceneFileError> {
    let ending = path.extension().unwrap_or_default();
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    if FOREIGN.iter().any(|foreign| ending.eq_ignore_ascii_case(foreign)) {
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
