//! The sculptor's command line:
//!
//! ```text
//! cargo run --release -p sculpt_dragon -- [dragon|object] [--triangles N] [-o FILE]
//! ```

mod options;

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use options::Request;
use sculpt_dragon::{PROMISES, Subject, sculpt, write_obj};

fn main() -> ExitCode {
    match options::parse(std::env::args().skip(1)) {
        Ok(Request::Help) => {
            println!("{}", options::HELP);
            ExitCode::SUCCESS
        }
        Ok(Request::Sculpt { subject, triangles, file }) => match run(subject, triangles, &file) {
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
fn run(subject: Subject, triangles: usize, file: &Path) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let sculpted =
        sculpt(subject, triangles, threads).map_err(|fault| format!("nothing written: {fault}"))?;
    let name = |error| format!("cannot write {}: {error}", file.display());
    let mut out = BufWriter::new(File::create(file).map_err(name)?);
    let uv = subject.uv(&sculpted.mesh);
    write_obj(&mut out, subject.title(), &sculpted.mesh, &sculpted.normals, uv.as_ref())
        .map_err(name)?;
    out.flush().map_err(name)?;

    let mesh = &sculpted.mesh;
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
        sculpted.quality
    );
    println!("checked: {}", PROMISES);
    println!("{:.1} s on {threads} threads", start.elapsed().as_secs_f64());
    Ok(())
}
