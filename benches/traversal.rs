//! Cost of finding hits, in rays per second, and of building the tree, in triangles per second:
//! `cargo bench traversal`; `cargo bench traversal -- 100k` skips the large dragon.
//!
//! The chapter's scene, dragon and floor, with a dragon of 100,000 triangles and one of 2,000,000:
//! - `camera`: the closest hits of 512 x 512 camera rays, in tiles of 8 x 8 pixels;
//! - `shadow`: occlusion between those hits and the light, as many;
//! - `diffuse`: the closest hits of cosine-weighted rays from those hits, as many;
//! - `build`: the tree.
//!
//! `single` traces one ray at a time and `batch` 1024, as many as a renderer's wave has. The
//! large dragon is sculpted the first time (38 s of processor time) and kept as a file in cargo's target
//! folder: delete `dragon-2000000.obj` there after a change of the sculptor.

use std::cell::LazyCell;
use std::error::Error;
use std::fs;
use std::hint::black_box;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::camera::{Camera, PerspectiveCamera, PerspectiveSettings};
use lobe::geometry::{Frame, Ray};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::sampling::cosine_hemisphere;
use lobe::shape::read_obj;
use sculpt_dragon::{PROMISES, Subject, sculpt, write_obj};

/// Pixels along each side of the image.
const SIDE: u32 = 512;
/// Rays of each kind. Where fewer pixels see something, their hits send several rays.
const RAYS: usize = (SIDE * SIDE) as usize;
/// Rays in a batch.
const BATCH: usize = 1024;
const EYE: Vec3 = Vec3::new(-3.0, 1.5, -3.0);
const LIGHT: Vec3 = Vec3::new(10.0, 10.0, -10.0);

/// A scene and the rays that are sent through it.
struct Fixture {
    meshes: [TriangleMesh; 2],
    accel: Accel,
    camera: Vec<Ray>,
    shadow: Vec<Ray>,
    diffuse: Vec<Ray>,
}

impl Fixture {
    fn new(dragon: TriangleMesh) -> Self {
        let meshes = [dragon, floor()];
        let accel = Accel::build(&meshes);
        let camera = camera_rays();
        let (mut shadow, mut diffuse) = (Vec::new(), Vec::new());
        let hits = camera.iter().map(|ray| (ray, accel.intersect1(ray)));
        let hits: Vec<(&Ray, Hit)> = hits.filter(|(_, hit)| hit.is_hit()).collect();
        for (number, (ray, hit)) in hits.into_iter().cycle().take(RAYS).enumerate() {
            let mesh = &meshes[hit.shape as usize];
            let si = SurfaceInteraction::on_triangle(mesh, hit.triangle as usize, hit.b, -ray.d);
            shadow.push(si.spawn_ray_to(LIGHT));
            let n = if si.n().dot(ray.d) > 0.0 { -si.n() } else { si.n() };
            let local = cosine_hemisphere::sample(lattice_point(number));
            diffuse.push(si.spawn_ray(Frame::from_normal(n).to_world(local)));
        }
        Self { meshes, accel, camera, shadow, diffuse }
    }
}

/// The dragon of `assets/`.
fn small_dragon() -> TriangleMesh {
    stand(&Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/dragon.obj"))
}

/// A dragon of twenty times as many triangles, from the file of an earlier run if there is one.
fn large_dragon() -> TriangleMesh {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dragon-2000000.obj");
    if !file.exists() {
        sculpt_to(&file, 2_000_000).expect("the dragon is sculpted and written");
    }
    stand(&file)
}

/// Sculpts a dragon into a file, which is renamed into place when it is complete.
fn sculpt_to(file: &Path, triangles: usize) -> Result<(), Box<dyn Error>> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let dragon = sculpt(Subject::Dragon, triangles, threads).map_err(|fault| fault.to_string())?;
    let unfinished: PathBuf = file.with_extension("unfinished");
    let mut out = BufWriter::new(fs::File::create(&unfinished)?);
    write_obj(&mut out, Subject::Dragon.title(), &dragon.mesh, &dragon.normals, None)?;
    out.flush()?;
    fs::rename(unfinished, file)?;
    let quality = dragon.quality;
    println!("{}: {}; worst quality {quality:.3}", file.display(), PROMISES);
    Ok(())
}

/// Reads a dragon and moves it to the place of the chapter's.
fn stand(file: &Path) -> TriangleMesh {
    let mut mesh = read_obj(file).expect("the dragon is there").mesh;
    mesh.positions.iter_mut().for_each(|p| p.y -= 1.45);
    mesh
}

/// The chapter's floor: a square of two triangles.
fn floor() -> TriangleMesh {
    let at = |x: f32, z: f32| Vec3::new(x, -2.0, z);
    TriangleMesh {
        positions: vec![at(-6.0, 6.0), at(6.0, 6.0), at(-6.0, -6.0), at(6.0, -6.0)],
        indices: vec![[0, 1, 2], [1, 3, 2]],
        ..TriangleMesh::default()
    }
}

/// One ray for each pixel, tile after tile.
fn camera_rays() -> Vec<Ray> {
    let settings =
        PerspectiveSettings { eye: EYE, look_at: Vec3::ZERO, ..PerspectiveSettings::default() };
    let camera =
        PerspectiveCamera::new(&settings, UVec2::splat(SIDE)).expect("the settings are sound");
    let tiles = SIDE / 8;
    (0..SIDE * SIDE)
        .map(|i| {
            let (tile, pixel) = (i / 64, i % 64);
            let corner = 8 * UVec2::new(tile % tiles, tile / tiles);
            let pixel = corner + UVec2::new(pixel % 8, pixel / 8);
            camera.generate_ray(pixel, lattice_point(i as usize), Vec2::ZERO)
        })
        .collect()
}

/// A low-discrepancy sequence in the unit square: Roberts's R2. In f64, which has enough bits for its index.
fn lattice_point(i: usize) -> Vec2 {
    let coordinate = |step: f64| ((0.5 + i as f64 * step).fract() as f32).min(0.999_999);
    Vec2::new(coordinate(0.754_877_666_246_692_7), coordinate(0.569_840_290_998_053_3))
}

fn closest_single(accel: &Accel, rays: &[Ray]) {
    for ray in rays {
        black_box(accel.intersect1(ray));
    }
}

fn closest_batch(accel: &Accel, rays: &[Ray]) {
    let mut hits = [Hit::MISS; BATCH];
    for batch in rays.chunks(BATCH) {
        accel.intersect(batch, &mut hits[..batch.len()]);
        black_box(&hits);
    }
}

fn any_single(accel: &Accel, rays: &[Ray]) {
    for ray in rays {
        black_box(accel.occluded1(ray));
    }
}

fn any_batch(accel: &Accel, rays: &[Ray]) {
    let mut occluded = [false; BATCH];
    for batch in rays.chunks(BATCH) {
        accel.occluded(batch, &mut occluded[..batch.len()]);
        black_box(&occluded);
    }
}

/// Dragons by the number of their triangles.
type Dragon = fn() -> TriangleMesh;

const SIZES: [(&str, u64, Dragon); 2] =
    [("100k", 100_000, small_dragon), ("2M", 2_000_000, large_dragon)];

/// Rays and how they are traced.
type Rays = fn(&Fixture) -> &[Ray];
type Way = fn(&Accel, &[Ray]);

const CASES: [(&str, Rays, Way); 6] = [
    ("camera single", |f| &f.camera, closest_single),
    ("camera batch", |f| &f.camera, closest_batch),
    ("shadow single", |f| &f.shadow, any_single),
    ("shadow batch", |f| &f.shadow, any_batch),
    ("diffuse single", |f| &f.diffuse, closest_single),
    ("diffuse batch", |f| &f.diffuse, closest_batch),
];

fn traversal(criterion: &mut Criterion) {
    for (size, triangles, dragon) in SIZES {
        // Computed when the first selected benchmark needs it.
        let fixture = LazyCell::new(|| Fixture::new(dragon()));
        let mut group = criterion.benchmark_group(format!("traversal/{size}"));
        group.sample_size(10).warm_up_time(Duration::from_millis(500));
        group.measurement_time(Duration::from_secs(2));
        for (name, rays, way) in CASES {
            group.throughput(Throughput::Elements(RAYS as u64));
            group.bench_function(name, |bencher| {
                let rays = rays(&fixture);
                bencher.iter(|| way(&fixture.accel, black_box(rays)));
            });
        }
        group.throughput(Throughput::Elements(triangles));
        group.bench_function("build", |bencher| {
            bencher.iter_with_large_drop(|| Accel::build(black_box(&fixture.meshes)));
        });
    }
}

criterion_group!(benches, traversal);
criterion_main!(benches);
