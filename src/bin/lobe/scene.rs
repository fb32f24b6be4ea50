//! Arguments that select a scene, shared by all subcommands.

use std::path::PathBuf;

use clap::Args;
use lobe::accel::InstructionSet;
use lobe::scene_file::{LoadedScene, SceneFileError, read_scene, read_scene_for};

#[derive(Args)]
pub struct SceneArguments {
    /// A scene file, .toml, or a model, .obj
    #[arg(value_name = "SCENE")]
    pub path: PathBuf,

    /// Sets a value of the scene, in TOML, whether the file has the key or not; may be repeated. Paths in it
    /// are relative to the current directory
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// The instruction set, for subcommands that trace rays or report the tree.
#[derive(Args)]
pub struct IsaArgument {
    /// Instruction set to trace rays with: portable, avx2 or avx512, for measuring; the picture is the same
    /// [default: the fastest that the processor has]
    #[arg(long, value_name = "NAME")]
    isa: Option<InstructionSet>,
}

impl SceneArguments {
    pub fn load(&self) -> Result<LoadedScene, SceneFileError> {
        read_scene(&self.path, &self.overrides())
    }

    pub fn load_for(&self, isa: &IsaArgument) -> Result<LoadedScene, SceneFileError> {
        read_scene_for(isa.isa.unwrap_or_default(), &self.path, &self.overrides())
    }

    pub fn overrides(&self) -> Vec<&str> {
        self.set.iter().map(String::as_str).collect()
    }
}
