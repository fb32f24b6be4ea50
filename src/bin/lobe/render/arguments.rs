//! The arguments of `lobe render`.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, value_parser};
use lobe::render::Part;

use crate::arguments::{ThreadsArgument, part, seconds};
use crate::scene::{IsaArgument, SceneArguments};

const EXAMPLES: &str = r#"Examples:
  lobe render chapter8.toml                             writes chapter8.png and chapter8.exr here
  lobe render chapter8.toml -o a.png --spp 256          writes only a.png, with less noise
  lobe render model.obj                                 an OBJ file with its MTL file: writes model.png and model.exr
  lobe render model.obj --set shape.model.rotate=[1,0,0,-90]    if z is up in it
  lobe render dragon-sky.toml --time 10                 the best picture in ten seconds
  lobe render dragon-sky.toml --spp 65536 --resume      goes on where it was ended or killed
  lobe render dragon-sky.toml --shard 3/8               one of eight parts, for lobe merge
  lobe render chapter8.toml --set film.resolution=[100,100] --set camera.fov=40
  lobe render chapter8.toml --set 'shape.dragon.obj="other.obj"'    strings need their quotes

A model, .obj, is rendered under a grey sky and a key light, by a camera that sees all of it from the front, right and above.
Its world is right-handed with y up; scene files have PBRT's left-handed camera unless they say otherwise. `lobe info
model.obj --scene` prints the whole scene, to be changed.

A PNG is for viewing. An EXR contains linear radiance, its variance, the number of samples, and
normal, depth and albedo of the first hits; only with one is the error of the picture printed.

Ctrl-C, SIGTERM or a closed terminal ends a render: what there is of the picture is written, and the exit code is 130. Ctrl-C
again ends it at once.

With --resume, a file NAME.state beside the picture has all that the render needs to go on. It
is replaced, and so is the picture, every --save-every. The same command goes on from it, with
any number of threads, and gives the same picture as if it had never stopped. The file is
removed when all samples are taken or --time is over. A part (--shard) that is complete
already is left as it is."#;

/// Renders a scene file or a model to PNG and EXR
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pub scene: SceneArguments,

    #[command(flatten)]
    pub isa: IsaArgument,

    /// A file to write, .png or .exr; may be repeated [default: both, named after the scene]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Samples per pixel, in place of the scene's; with --time, their maximum
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub spp: Option<u32>,

    /// Time limit, with what a resumed render took before. Renders in passes, each as long as all before it together,
    /// and shorter ones at the end, while the next one is expected to end in time. Sobol samples ("sobol") are best for this, since they are well distributed after every pass
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time: Option<Duration>,

    /// Seed of the samples, in place of the scene's
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// Goes on with the render that NAME.state holds, if there is one, and keeps that file while rendering
    #[arg(long)]
    pub resume: bool,

    /// With --resume: how often the state and the picture so far are written
    #[arg(long, value_name = "TIME", value_parser = seconds, default_value = "60s", requires = "resume")]
    pub save_every: Duration,

    /// Renders part K of N of the samples, for lobe merge [default output: NAME-K-of-N.exr]
    #[arg(long, value_name = "K/N", value_parser = part, conflicts_with = "time")]
    pub shard: Option<Part>,

    #[command(flatten)]
    pub threads: ThreadsArgument,

    /// Leaves out normal, depth and albedo from the EXR, which saves a tenth of the time
    #[arg(long)]
    pub no_layers: bool,

    /// Prints nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

impl Arguments {
    /// How many samples a pixel gets, in words.
    pub fn samples(&self, spp: u32) -> String {
        match (self.time, self.spp) {
            (Some(_), None) => "as many as time allows".to_owned(),
            _ => spp.to_string(),
        }
    }
}
