//! `lobe merge`: adds up the parts of a render.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::Args;
use lobe::film::Film;
use lobe::glam::UVec2;
use lobe::image::{Display, Image, ImageFile, Metadata, PartMetadata};
use lobe::params::Choice;
use lobe::params::Shown;

use crate::identity::difference;
use crate::output::Output;
use crate::summary::Summary;

const EXAMPLES: &str = "\
Examples:
  lobe render scene.toml --spp 4096 --shard 1/8         writes scene-1-of-8.exr; and so on up to 8/8, anywhere
  lobe merge scene-*-of-8.exr -o scene.exr -o scene.png

Parts can be given in any order. Each sample has to be in one of them, and none in two. The picture
is that of one render with all samples, and so is its variance, up to the rounding of their sums.";

/// Adds up the parts that lobe render --shard wrote
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The parts: EXR files
    #[arg(value_name = "PART", required = true)]
    parts: Vec<PathBuf>,

    /// A file to write, .exr or .png; may be repeated
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Vec<PathBuf>,

    /// Most memory that reading one part may take, in MiB
    #[arg(long, value_name = "N", default_value_t = Image::DEFAULT_LIMIT >> 20)]
    max_image_mb: u64,

    /// Prints nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// A part whose header was read.
struct Part<'a> {
    path: &'a Path,
    size: UVec2,
    metadata: Metadata,
    part: PartMetadata,
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let outputs = Output::all(&arguments.output, "".as_ref(), &[])?;
    Output::check_own(&outputs, &arguments.parts)?;
    let limit = arguments.max_image_mb.saturating_mul(1 << 20);
    // One file is open at a time: there may be thousands.
    let header = |path: &'_ PathBuf| {
        let file = ImageFile::open(path, limit)?;
        let metadata = file.part()?;
        let part = metadata.part.clone().unwrap_or_default();
        Ok::<_, Box<dyn Error>>((file.size(), metadata, part))
    };
    let mut parts = Vec::new();
    for path in &arguments.parts {
        let (size, metadata, part) = header(path)?;
        parts.push(Part { path, size, metadata, part });
    }
    parts.sort_by_key(|part| part.part.samples.start);
    check(&parts)?;

    let (mut film, mut non_finite) = (None, 0);
    for Part { path, part, .. } in &parts {
        let (picture, _) = ImageFile::open(path, limit)?.decode_part()?;
        let damaged =
            || format!("`{}` lacks what its film kept: render it again", Shown::path(path));
        let most = part.samples.end - part.samples.start;
        let of_part = Film::from_planes(picture.resolution, picture.window, &picture.planes, most)?;
        let of_part = of_part.ok_or_else(damaged)?;
        non_finite += part.non_finite;
        let all: &mut Film = match &mut film {
            None => {
                film = Some(of_part);
                continue;
            }
            Some(film) => film,
        };
        if !all.fits(&of_part) {
            return Err(damaged().into());
        }
        all.merge(&of_part);
    }
    let film = film.ok_or("there are no parts")?;
    let (picture, fireflies) = (film.develop(), film.fireflies());
    let metadata = Metadata {
        samples_per_pixel: parts[0].part.all_samples,
        seconds: parts.iter().map(|part| part.metadata.seconds).sum(),
        part: None,
        ..parts[0].metadata.clone()
    };
    Output::write_or_keep(&outputs, &picture, display(&parts[0].part), &metadata)?;
    if !arguments.quiet {
        let mut summary = Summary::default();
        summary.add("scene", &metadata.scene);
        summary.add("parts", parts.len());
        summary.add("samples", format!("{} per pixel", metadata.samples_per_pixel));
        summary.add("render", format!("{:.3} s, of all parts together", metadata.seconds));
        summary.add_error(&picture);
        summary.add_fireflies(fireflies);
        summary.add("non-finite", format!("{non_finite} samples"));
        outputs.iter().for_each(|output| summary.add("wrote", output.path.display()));
        summary.print()?;
    }
    Ok(())
}

/// Checks that parts, which are sorted, are of one render, and that each sample is in one of them.
fn check(parts: &[Part]) -> Result<(), Box<dyn Error>> {
    let (first, mut end) = (&parts[0], 0);
    for (index, Part { path, size, part, .. }) in parts.iter().enumerate() {
        let places = [first.path, path].map(|path| format!("in `{}`", Shown::path(path)));
        let [in_first, in_this] = places.each_ref().map(String::as_str);
        let (one, other) = (&first.part.identity, &part.identity);
        if let Some(difference) = difference(one, other, [in_first, in_this]) {
            return Err(format!("the parts are of different renders: {difference}").into());
        }
        if *size != first.size || part.all_samples != first.part.all_samples {
            return Err(format!("`{}` is damaged: render it again", Shown::path(path)).into());
        }
        if part.samples.start < end {
            let (a, b) = (Shown::path(parts[index - 1].path), Shown::path(path));
            let sample = part.samples.start;
            return Err(format!("`{a}` and `{b}` both have sample {sample}: leave one out").into());
        }
        if part.samples.start > end {
            return Err(missing(end, part.samples.start, part).into());
        }
        end = part.samples.end;
    }
    if end < first.part.all_samples {
        return Err(missing(end, first.part.all_samples, &first.part).into());
    }
    Ok(())
}

fn missing(start: u32, end: u32, part: &PartMetadata) -> String {
    let (last, all) = (end - 1, part.all_samples);
    let which = if start == last {
        format!("sample {start}")
    } else {
        format!("samples {start} to {last}")
    };
    format!(
        "{which} of 0 to {} are in none of the parts: name all files, or render what is missing",
        all - 1
    )
}

/// The display curve of the scene.
fn display(part: &PartMetadata) -> Display {
    let name = part.identity.lines().find_map(|line| line.strip_prefix("film.display = "));
    let named = |(known, _): &&(&str, Display)| name == Some(&format!("{known:?}"));
    Display::CHOICES.iter().find(named).map_or_else(Display::default, |(_, display)| *display)
}
