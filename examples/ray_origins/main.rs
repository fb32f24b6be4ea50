//! Measures how often three ways of moving a ray's origin off its surface fail, and charts it.
//!
//! ```text
//! cargo run --release --example ray_origins -- [-o DIR] [--rays N]
//! ```
//!
//! It writes `ray-origins.csv` and `ray-origins.svg` into DIR. The same N gives the same bytes: the random numbers
//! are the example's own, and of the mathematical functions only square roots stand between them and
//! the counts.
//!
//! The methods (`method`): a fixed epsilon of 1e-4 along the geometric normal; Waechter and Binder 2019; the
//! crate's error bounds. A fourth, no offset at all, is the control which shows that the trials catch failures. All
//! get the same hits and directions, and all rays are tried with the crate's triangle test.
//!
//! A trial (`scene`): a triangle of random shape, and the three that continue it beyond its edges, exactly in its
//! plane. A ray hits one of the four, and another leaves the hit to a random side in a random direction `w`; half
//! of the directions are laid towards the surface, down to a sine of 1e-6. Coordinates are within twice the scale
//! of a centre that is at the given distance from the origin.
//!
//! The failures (`measure`), each against a truth in f64 from the f32 numbers as they are:
//!
//! - **False self-hit**: the leaving ray hits one of the four triangles. The exact hit point lies in their plane and `w`
//!   leaves it, so there is no such hit. Only directions at a sine of at least 1e-6 from the plane count:
//!   closer to it the rounding of `w` and of the normal may decide on the side.
//! - **Lost contact**: a plate, parallel to the surface at a gap of 1e-3 or 1e-5 of the scale, is not hit by the leaving
//!   ray. Asked for are the rays for which the plate holds, with a margin, both the exact ray's hit and the foot of
//!   the perpendicular on it: then the ray hits it from every start between the exact hit point and
//!   that foot. Its corners, rounded to f32, must each keep half the gap to one and a half from
//!   the surface. Far from the origin they do not, as the gap is below the spacing of floats there, and
//!   nothing is counted.

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
