//! `lobe compare`: errors of an image against a reference.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::Args;
use lobe::image::{Image, check_writable, write_files};
use lobe::metrics::{CompareError, ErrorMap, Errors, Exposures, Viewing, ZTest, z_test};

use crate::images::MemoryArgument;
use crate::summary::Summary;

const EXAMPLES: &str = "\
Examples:
  lobe compare a.exr reference.exr
  lobe compare a.exr reference.exr --fail-above relmse=1e-3    exit code 1 if relMSE is above 1e-3
  lobe compare a.exr reference.exr --maps error        error-absolute.png, error-signed.png, error-flip.png

relMSE is the mean of (a - b)² / (b² + 0.01), where b is the reference. The peak of PSNR is
1 for PNG files and the reference's largest value for radiance. FLIP is the perceived
difference when flipping between both images, 0.7 m in front of a 4K screen 0.7 m wide; for
radiance it is the maximum over several exposures.

The Z-test tells whether noise explains the difference, by the variance layers of both files. A
difference over its standard error follows Student's t distribution if both pictures agree; z is
what a normal variable exceeds as rarely. The fewer degrees of freedom, which are stored in the
files, the larger a difference has to be. If none are stored, they are taken to be infinite.";

/// Compares an image with a reference: MSE, MAE, relMSE, PSNR, FLIP, and whether noise explains the difference
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The image: .exr, .jpg, .pfm or .png
    #[arg(value_name = "IMAGE")]
    image: PathBuf,

    /// The reference: .exr, .jpg, .pfm or .png
    #[arg(value_name = "REFERENCE")]
    reference: PathBuf,

    /// Exits with code 1 if mse, rmse, mae, relmse or flip is above the value, or psnr below it. May be repeated
    #[arg(long, value_name = "METRIC=VALUE", value_parser = limit)]
    fail_above: Vec<(Metric, f64)>,

    /// Writes three error maps, each with a legend: PREFIX-absolute.png and PREFIX-signed.png (means over the
    /// bands) and PREFIX-flip.png
    #[arg(long, value_name = "PREFIX")]
    maps: Option<PathBuf>,

    #[command(flatten)]
    memory: MemoryArgument,
}

/// Names of the maps.
const MAPS: [&str; 3] = ["absolute", "signed", "flip"];

/// A metric that `--fail-above` can limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Metric {
    Mse,
    Rmse,
    Mae,
    RelMse,
    Psnr,
    Flip,
}

const METRICS: [(&str, Metric); 6] = [
    ("mse", Metric::Mse),
    ("rmse", Metric::Rmse),
    ("mae", Metric::Mae),
    ("relmse", Metric::RelMse),
    ("psnr", Metric::Psnr),
    ("flip", Metric::Flip),
];

fn limit(text: &str) -> Result<(Metric, f64), String> {
    let expected = "expected METRIC=VALUE with mse, rmse, mae, relmse, psnr or flip";
    let (name, value) = text.split_once('=').ok_or(expected)?;
    let found = METRICS.iter().find(|(known, _)| name.eq_ignore_ascii_case(known));
    let (_, metric) = *found.ok_or(expected)?;
    let value: f64 = value.parse().map_err(|_| format!("`{value}` is not a number"))?;
    if value.is_nan() { Err("a limit cannot be NaN".into()) } else { Ok((metric, value)) }
}

/// Degrees of freedom of both variances.
fn degrees_of_freedom(images: [&Image; 2]) -> String {
    let [image, reference] =
        images.map(|image| match (&image.variance, image.degrees_of_freedom) {
            (None, _) => "no variance".to_owned(),
            (Some(_), Some(degrees)) => degrees.to_string(),
            (Some(_), None) => "unknown, taken as infinite".to_owned(),
        });
    format!("{image} (image), {reference} (reference)")
}

/// Path of the map with this name.
fn map_path(prefix: &Path, name: &str) -> PathBuf {
    let mut path = prefix.to_owned().into_os_string();
    path.push(format!("-{name}.png"));
    path.into()
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if let Some(prefix) = &arguments.maps {
        MAPS.iter().try_for_each(|name| check_writable(map_path(prefix, name)))?;
    }
    let image = arguments.memory.open(&arguments.image)?;
    let reference = arguments.memory.open(&arguments.reference)?;
    // Before anything is decoded.
    if image.size() != reference.size() {
        return Err(CompareError::Size(image.size(), reference.size()).into());
    }
    let (image, reference) = (arguments.memory.decode(image)?, arguments.memory.decode(reference)?);
    let errors = Errors::between(&image, &reference)?;
    let (seen, exposures) = ErrorMap::flip(&image, &reference, Viewing::default())?;
    let flip = seen.mean();
    let value = |metric: Metric| match metric {
        Metric::Mse => errors.mse,
        Metric::Rmse => errors.rmse(),
        Metric::Mae => errors.mae,
        Metric::RelMse => errors.rel_mse,
        Metric::Psnr => errors.psnr(),
        Metric::Flip => flip,
    };
    let mut summary = Summary::default();
    summary.add("image", arguments.image.display());
    summary.add("reference", arguments.reference.display());
    summary.add("size", format!("{}x{} pixels", image.size.x, image.size.y));
    summary.add("mean", format!("{:+.6e} image minus reference", errors.mean));
    summary.add("mse", format!("{:.6e}", errors.mse));
    summary.add("rmse", format!("{:.6e}", errors.rmse()));
    summary.add("mae", format!("{:.6e}", errors.mae));
    summary.add("relmse", format!("{:.6e} mean of (a - b)^2 / (b^2 + 0.01)", errors.rel_mse));
    summary.add("psnr", format!("{:.4} dB for a peak of {}", errors.psnr(), errors.peak));
    let note = match exposures {
        Some(Exposures { start, stop, count }) => {
            format!(" maximum over {count} exposures from {start:+.2} to {stop:+.2} stops")
        }
        None => String::new(),
    };
    summary.add("flip", format!("{flip:.6}{note}"));
    if let Some(z) = z_test(&image, &reference)? {
        let ZTest { tested, failed, limit, largest: (largest, at), mean_square } = z;
        summary.add(
            "z-tested",
            format!("{tested} values, one for each band of each pixel with a variance"),
        );
        summary.add("z-degrees", degrees_of_freedom([&image, &reference]));
        summary.add("z-failed", format!("{failed} above {limit:.2} standard errors"));
        summary.add("z-largest", format!("{largest:.2} at ({}, {})", at.x, at.y));
        summary.add("z-square", format!("{mean_square:.4} mean of z^2; noise alone gives up to 1"));
        if failed > 0 {
            let note = "a few that fail may be pixels with rare or equal samples: their variance is underestimated";
            summary.add("z-note", note);
        }
    }
    if let Some(prefix) = &arguments.maps {
        let absolute = ErrorMap::absolute(&image, &reference)?;
        let signed = ErrorMap::signed(&image, &reference)?;
        let paths = MAPS.map(|name| map_path(prefix, name));
        let maps = [absolute, signed, seen].map(|map| map.png());
        let files: Vec<_> =
            paths.iter().zip(&maps).map(|(path, map)| (&**path, &map[..])).collect();
        write_files(&files)?;
        paths.iter().for_each(|path| summary.add("wrote", path.display()));
    }
    summary.print()?;
    for &(metric, limit) in &arguments.fail_above {
        let value = value(metric);
        let fails = if metric == Metric::Psnr { value < limit } else { value > limit };
        if fails {
            let (name, _) = METRICS[metric as usize];
            let side = if metric == Metric::Psnr { "below" } else { "above" };
            return Err(format!("{name} is {value}, {side} the limit of {limit}").into());
        }
    }
    Ok(())
}
