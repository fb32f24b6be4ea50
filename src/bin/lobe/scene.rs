//! Arguments that select a scene, shared by all subcommands.

use std::path::PathBuf;

use clap::Args;
use lobe::scene_file::{LoadedScene, SceneFileError, read_scene};

#[derive(Args)]
pub struct SceneArguments {
    /// The scene file
    #[arg(value_name = "SCENE")]
    pub path: PathBuf,

    /// Sets a value of the scene, in TOML, whether the file has the key or not; may be repeated. Paths in it
    /// are relative to the current directory
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl SceneArguments {
    pub fn load(&self) -> Result<LoadedScene, SceneFileError> {
        read_scene(&self.path, &self.overrides())
    }

    pub fn overrides(&self) -> Vec<&str> {
        self.set.iter().map(String::as_str).collect()
    }
}
