//! Measures how often three ways of moving a ray's origin off its surface fail, and charts it.
//!
//! ```text
//! cargo run --release --example ray_origins -- [-o DIR] [--rays N]
//! ```
//!
//! It writes into DIR (`docs` unless told otherwise) `ray-origins.csv` with all counts, and two charts:
//! `ray-origins.svg` with the crate's triangle test and `ray-origins-plain.svg` with a plain one. The
//! same N gives the same counts everywhere: the random numbers are the example's own, and of the
//! mathematical functions only the square root takes part. 100,000 rays for each point, the
//! default, take half a minute on one core.
//!
//! **Methods** (`method`): a fixed epsilon of 1e-4 along the geometric normal; Waechter and Binder 2019; the
//! crate's error bounds; and no offset at all, the control which shows that the trials catch failures. All
//! get the same hits, points and directions. The rays are tried with two tests (`triangle_test`): the
//! crate's, which takes no hit at a t within the bound of its error, and Möller and Trumbore's with
//! t > 0. That bound is one half of PBRT's method, and it protects the rays of the other methods too.
//!
//! **Trials** (`scene`): a triangle of random shape, and the three that continue it beyond its edges,
//! exactly in its plane. A ray hits one of the four, and another leaves the hit to a random side along
//! `w`; half of the directions are laid towards the surface, down to a sine of 1e-6. The
//! coordinates are within twice the scale of a centre at the given distance from the origin.
//!
//! **Failures** (`measure`), each against a truth in f64 from the f32 numbers as they are:
//!
//! - False self-hit: the leaving ray hits one of the four triangles. The exact hit point lies in their
//!   plane and `w` leaves it, so that there is no such hit. Only directions at a sine of at least 1e-6
//!   from the plane count: closer to it, the rounding of `w` and of the normal may decide on the side.
//! - Lost contact: a plate, parallel to the surface at a gap of 1e-3 or 1e-5 of the scale, is not hit by
//!   the leaving ray. Only rays count for which the plate holds, with a margin, both the hit of the
//!   exact ray and the foot of the perpendicular: then the ray hits it from every start between the
//!   exact point and that foot. The gap must be at least the spacing of floats at that distance, and at
//!   the corners of the plate, rounded to f32, between half and one and a half of what it should be.
//!
//! Where rounding leaves fewer such rays than asked for, nothing is reported.

mod chart;
mod measure;
mod method;
mod options;
mod panel;
mod rng;
mod scene;
mod table;
mod triangle_test;

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use options::Request;

fn main() -> ExitCode {
    let done = options::parse(std::env::args().skip(1)).map_err(Into::into).and_then(|request| {
        match request {
            Request::Help => {
                println!("{}", options::HELP);
                Ok(())
            }
            Request::Measure { rays, folder } => run(rays, &folder),
        }
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("ray_origins: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Measures and writes both files.
fn run(rays: u32, folder: &Path) -> Result<(), Box<dyn Error>> {
    if !folder.is_dir() {
        return Err(format!("there is no folder {}", folder.display()).into());
    }
    let rows: Vec<_> =
        measure::places().into_iter().flat_map(|place| measure::measure(place, rays)).collect();
    for (name, text) in [
        ("ray-origins.csv", table::csv(&rows)),
        ("ray-origins.svg", chart::svg(&rows, rays, 0)),
        ("ray-origins-plain.svg", chart::svg(&rows, rays, 1)),
    ] {
        let file = folder.join(name);
        std::fs::write(&file, text)
            .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
        println!("{}", file.display());
    }
    Ok(())
}
