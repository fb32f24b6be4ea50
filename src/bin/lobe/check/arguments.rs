//! The arguments of `lobe check`.

use std::path::PathBuf;

use clap::{ArgGroup, Args, value_parser};
use lobe::check::Options;

use super::help;
use crate::arguments::ThreadsArgument;
use crate::scene::SceneArguments;

/// Checks that materials keep the contracts of lobes: samples, values, densities, energy, reciprocity
#[derive(Args)]
#[command(after_help = help::text())]
#[command(group(ArgGroup::new("what").required(true).args(["path", "breaks"])))]
pub struct Arguments {
    #[command(flatten)]
    pub scene: Option<SceneArguments>,

    /// The name of a material of the scene file [default: all]
    #[arg(value_name = "MATERIAL")]
    pub material: Option<String>,

    /// Samples from each of eight directions
    #[arg(long, value_name = "N", default_value_t = Options::default().samples, value_parser = value_parser!(u32).range(i64::from(Options::LEAST_SAMPLES)..=1 << 28))]
    pub samples: u32,

    /// Seed of the samples
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,

    /// The materials promise to return all light, within 1e-3
    #[arg(long)]
    pub white: bool,

    /// Writes a page with the verdicts, the albedo over the angle and the shape of the lobes
    #[arg(long, value_name = "FILE.html")]
    pub page: Option<PathBuf>,

    /// Writes a picture of the scene with three estimates of the albedo as red, green and blue, .png or .exr: a tint is a bug
    #[arg(long, value_name = "FILE")]
    pub image: Option<PathBuf>,

    /// With --image: samples per pixel
    #[arg(long, value_name = "N", default_value_t = 64, requires = "image", value_parser = value_parser!(u32).range(1..1 << 24))]
    pub spp: u32,

    /// Checks the check: lobes that are wrong on purpose, in place of a scene. Exits with code 1 if a fault is not named
    #[arg(long = "break", conflicts_with_all = ["material", "set", "white", "page", "image"])]
    pub breaks: bool,

    #[command(flatten)]
    pub threads: ThreadsArgument,
}
