//! Traces rays from files against a mesh and reports how many hit, and how fast.
//!
//! `cargo run --release --example trace_rays -- MESH.obj FILE.rays... [--threads N] [--mode closest|any|batch|any-batch]
//! [--isa portable|avx2|avx512] [--check N]`
//!
//! A ray file is a flat array of rays, each 8 little-endian f32: origin, t_min, direction, t_max. Each file is traced
//! nine times. A line gives the number of rays and hits, the sum of t over the hits (0 in the any-hit
//! modes), and the median and best of millions of rays per second.
//!
//! `--isa` builds the tree for an instruction set and traces with it; the default is the fastest that the processor has.
//! `--check` also tests every N-th ray against all triangles one by one, and reports the number of equal results.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit, InstructionSet};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::{ShearedRay, TriangleHit, read_obj};

const REPETITIONS: usize = 9;
/// Rays per call in the batch modes: as many as a renderer's wave has.
const BATCH: usize = 1024;

#[derive(Clone, Copy)]
enum Mode {
    Closest,
    Any,
    Batch,
    AnyBatch,
}

struct Options {
    mesh: PathBuf,
    rays: Vec<PathBuf>,
    threads: usize,
    mode: Mode,
    isa: InstructionSet,
    check: Option<usize>,
}

fn options() -> Result<Options, Box<dyn Error>> {
    let (mut files, mut threads, mut mode, mut check) = (Vec::new(), 1, Mode::Closest, None);
    let mut isa = InstructionSet::fastest();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--threads" => {
                let count = arguments.next().and_then(|n| n.parse().ok()).filter(|&n| n > 0);
                threads = count.ok_or("--threads needs a number of at least 1")?;
            }
            "--check" => {
                check = arguments.next().and_then(|n| n.parse().ok()).filter(|&n| n > 0);
                check.ok_or("--check needs a number of at least 1")?;
            }
            "--isa" => {
                let name = arguments.next().ok_or("--isa needs portable, avx2 or avx512")?;
                isa = name.parse().map_err(|error| format!("--isa: {error}"))?;
            }
            "--mode" => {
                mode = match arguments.next().as_deref() {
                    Some("closest") => Mode::Closest,
                    Some("any") => Mode::Any,
                    Some("batch") => Mode::Batch,
                    Some("any-batch") => Mode::AnyBatch,
                    _ => return Err("--mode needs closest, any, batch or any-batch".into()),
                }
            }
            option if option.starts_with('-') => {
                return Err(format!("there is no option {option}; see the top of this file").into());
            }
            file => files.push(PathBuf::from(file)),
        }
    }
    if files.len() < 2 {
        return Err(
            "usage: trace_rays MESH.obj FILE.rays... [--threads N] [--mode closest|any|batch|any-batch] \
             [--isa portable|avx2|avx512] [--check N]"
                .into(),
        );
    }
    let rays = files.split_off(1);
    Ok(Options { mesh: files.remove(0), rays, threads, mode, isa, check })
}

fn read_rays(path: &Path) -> Result<Vec<Ray>, Box<dyn Error>> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let (rays, rest) = bytes.as_chunks::<32>();
    if !rest.is_empty() {
        return Err(format!("{}: its size is not a multiple of 32 bytes", path.display()).into());
    }
    Ok(rays.iter().map(ray).collect())
}

fn ray(bytes: &[u8; 32]) -> Ray {
    let number = |i: usize| f32::from_le_bytes(std::array::from_fn(|byte| bytes[4 * i + byte]));
    let vector = |i: usize| Vec3::new(number(i), number(i + 1), number(i + 2));
    Ray { o: vector(0), t_min: number(3), d: vector(4), t_max: number(7) }
}

/// Number of hits, and the sum of their t.
fn count(hits: impl Iterator<Item = Hit>) -> (usize, f64) {
    hits.filter(Hit::is_hit).fold((0, 0.0), |(n, sum), hit| (n + 1, sum + f64::from(hit.t)))
}

fn trace(accel: &Accel, rays: &[Ray], mode: Mode) -> (usize, f64) {
    match mode {
        Mode::Closest => {
            let mut tracer = accel.tracer();
            count(rays.iter().map(|ray| tracer.intersect1(ray)))
        }
        Mode::Any => {
            let mut tracer = accel.tracer();
            (rays.iter().filter(|ray| tracer.occluded1(ray)).count(), 0.0)
        }
        Mode::Batch => {
            let mut hits = [Hit::MISS; BATCH];
            rays.chunks(BATCH).fold((0, 0.0), |(n, sum), rays| {
                let hits = &mut hits[..rays.len()];
                accel.intersect(rays, hits);
                let (more, t) = count(hits.iter().copied());
                (n + more, sum + t)
            })
        }
        Mode::AnyBatch => {
            let mut occluded = [false; BATCH];
            let count = rays.chunks(BATCH).map(|rays| {
                let occluded = &mut occluded[..rays.len()];
                accel.occluded(rays, occluded);
                occluded.iter().filter(|&&occluded| occluded).count()
            });
            (count.sum(), 0.0)
        }
    }
}

/// Number of rays for which the tree gives the same results as a loop over all triangles.
fn same_as_loop(accel: &Accel, mesh: &TriangleMesh, rays: &[&Ray]) -> usize {
    let is_same = |ray: &&&Ray| {
        let sheared = ShearedRay::new(ray);
        let mut closest = Hit::MISS;
        for triangle in 0..mesh.indices.len() {
            let found = sheared.intersect(&mesh.corners(triangle), ray.t_min, ray.t_max);
            if let Some(TriangleHit { t, b }) = found.filter(|found| found.t < closest.t) {
                closest = Hit { t, b, shape: 0, triangle: triangle as u32 };
            }
        }
        accel.intersect1(ray) == closest && accel.occluded1(ray) == closest.is_hit()
    };
    rays.iter().filter(is_same).count()
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = options()?;
    let mesh = [read_obj(&options.mesh)?.mesh];
    let start = Instant::now();
    let accel = Accel::build_for(options.isa, &mesh);
    let seconds = start.elapsed().as_secs_f64();
    let (triangles, nodes) = (accel.triangle_count(), accel.node_count());
    let bytes = accel.memory() as f64 / triangles as f64;
    println!(
        "lobe build {seconds:.3} s, {triangles} triangles, {nodes} nodes, {bytes:.1} bytes per triangle, {}",
        accel.instruction_set()
    );
    for path in &options.rays {
        let rays = read_rays(path)?;
        let share = rays.len().div_ceil(options.threads).max(1);
        let mut seconds = Vec::new();
        let mut found = (0, 0.0);
        for _ in 0..REPETITIONS {
            let start = Instant::now();
            found = std::thread::scope(|scope| {
                let workers: Vec<_> = rays
                    .chunks(share)
                    .map(|rays| scope.spawn(|| trace(&accel, rays, options.mode)))
                    .collect();
                let joined =
                    workers.into_iter().map(|worker| worker.join().expect("no worker panics"));
                joined.fold((0, 0.0), |(n, sum), (hits, t)| (n + hits, sum + t))
            });
            seconds.push(start.elapsed().as_secs_f64());
        }
        seconds.sort_by(f64::total_cmp);
        // `PREFIX.camera.rays` is named "camera".
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let kind = stem.rsplit('.').next().unwrap_or_default();
        let name = match options.mode {
            Mode::Closest => kind.to_owned(),
            Mode::Any => format!("{kind}-any"),
            Mode::Batch => format!("{kind}-batch"),
            Mode::AnyBatch => format!("{kind}-any-batch"),
        };
        let speed = |seconds: f64| rays.len() as f64 / seconds / 1e6;
        println!(
            "lobe {name:16} rays {} hits {} sum_t {:.3}  Mrays/s median {:.3} best {:.3}",
            rays.len(),
            found.0,
            found.1,
            speed(seconds[REPETITIONS / 2]),
            speed(seconds[0])
        );
        if let Some(step) = options.check {
            let some: Vec<&Ray> = rays.iter().step_by(step).collect();
            let share = some.len().div_ceil(options.threads).max(1);
            let same: usize = std::thread::scope(|scope| {
                let (accel, mesh) = (&accel, &mesh[0]);
                let check = |rays| scope.spawn(move || same_as_loop(accel, mesh, rays));
                let workers: Vec<_> = some.chunks(share).map(check).collect();
                workers.into_iter().map(|worker| worker.join().expect("no worker panics")).sum()
            });
            println!("lobe {name:16} {same} of {} rays as a loop over all triangles", some.len());
        }
    }
    Ok(())
}
