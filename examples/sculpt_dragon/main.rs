//! Sculpts the dragon of `assets/dragon.obj`.
//!
//! The dragon is a field: tubes about splines, balls, cones and ellipsoids, smoothly joined, with scales laid out in
//! the tubes' own coordinates (`anatomy`). Its zero surface is found by marching tetrahedra (`lattice`), evened out (`relax`)
//! and decimated by quadric error (`decimate`); the normals are the field's gradient. Each step keeps the mesh a closed
//! two-manifold; that and more is checked at the end (`verify`), and a mesh that fails is not written.
//!
//! ```text
//! cargo run --release --example sculpt_dragon -- [--triangles N] [-o FILE]
//! ```

mod anatomy;
mod curve;
mod decimate;
mod field;
mod halfedge;
mod lattice;
mod mesh;
mod obj;
mod options;
mod parallel;
mod quadric;
mod relax;
mod scales;
mod sculpt;
mod sculpture;
mod shape;
mod tube;
mod verify;

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use options::Request;

fn main() -> ExitCode {
    match options::parse(std::env::args().skip(1)) {
        Ok(Request::Help) => {
            println!("{}", options::HELP);
            ExitCode::SUCCESS
        }
        Ok(Request::Sculpt { triangles, file }) => match run(triangles, &file) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => fail(&error.to_string()),
        },
        Err(sentence) => fail(&sentence),
    }
}

fn fail(sentence: &str) -> ExitCode {
    eprintln!("sculpt_dragon: {sentence}");
    ExitCode::FAILURE
}

/// Sculpts, writes and tells.
fn run(triangles: usize, file: &Path) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let dragon =
        sculpt::sculpt(triangles, threads).map_err(|fault| format!("nothing written: {fault}"))?;
    let name = |error| format!("cannot write {}: {error}", file.display());
    let mut out = BufWriter::new(File::create(file).map_err(name)?);
    obj::write(&mut out, &dragon.mesh, &dragon.normals).map_err(name)?;
    out.flush().map_err(name)?;

    let mesh = &dragon.mesh;
    let (low, high) = mesh.bounds();
    println!(
        "{}: {} vertices, {} triangles",
        file.display(),
        mesh.positions.len(),
        mesh.triangles.len()
    );
    println!(
        "bounds: ({:.3}, {:.3}, {:.3}) to ({:.3}, {:.3}, {:.3})",
        low.x, low.y, low.z, high.x, high.y, high.z
    );
    println!(
        "area {:.2}, volume {:.3}, worst triangle quality {:.3}",
        mesh.area(),
        mesh.volume(),
        dragon.quality
    );
    println!("checked: {}", verify::PROMISES);
    println!("{:.1} s on {threads} threads", start.elapsed().as_secs_f64());
    Ok(())
}
