//! Cost of shading, in nanoseconds per element: `cargo bench shading`.
//!
//! - `shading/lobe/*`: one method of a hit's Bsdf.
//! - `shading/storage/*`: construction of a Bsdf, f and pdf, for each way to store its lobes.
//! - `shading/texture/*`: a constant read in place, and behind a pointer.
//! - `shading/sampler/*`: one point of each sampler, by a call of its own and together with the pixel's others.
//! - `shading/hit/*`: the chapter's estimator at a hit, through the traits and as
//!   arithmetic written by hand.
//! - `shading/render/*`: a whole picture of the dragon with the crate's kinds, and with one of another crate in place of
//!   one of them, in turns; a sample is the element.
//!
//! All run over one fixed pool of hits.

use std::f32::consts::{FRAC_1_PI, PI};
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use bumpalo::Bump;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use lobe::accel::Hit;
use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, LambertianReflection, OrenNayar};
use lobe::geometry::{Frame, Ray};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::interaction::SurfaceInteraction;
use lobe::light::{BoundingSphere, Light, LightSample};
use lobe::material::Material;
use lobe::render::SamplerSettings;
use lobe::sampling::{
    BlueNoiseSampler, IndependentSampler, SampleId, Sampler, SobolSampler, StratifiedSampler,
    cosine_hemisphere, uniform_hemisphere, uniform_triangle,
};
use lobe::shape::read_obj;
use lobe::texture::{ConstantTexture, Texture, TextureHandle};
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings,
    Scene, Spectrum, TriangleMesh, View, render,
};
use smallbox::SmallBox;
use smallbox::space::S4;

/// Number of hits: few enough to stay in the first-level cache, so that computation is measured, not memory.
const POOL: usize = 256;
const RED: Spectrum = Spectrum::new(0.8, 0.1, 0.2);
const LIGHT: Vec3 = Vec3::new(10.0, 10.0, -10.0);

/// A hit with directions that are above its surface.
struct Sample {
    ray: Ray,
    hit: Hit,
    index: usize,
    frame: Frame,
    wo: Vec3,
    wi: Vec3,
    uc: f32,
    u: Vec2,
}

/// Hits on a tent of two triangles, at points and from directions of a lattice.
fn pool(mesh: &TriangleMesh) -> Vec<Sample> {
    let lattice = |i: usize, step: f32| (i as f32 * step).fract();
    (0..POOL)
        .map(|i| {
            let u = Vec2::new((i as f32 + 0.5) / POOL as f32, lattice(i, 0.618_034));
            let v = Vec2::new(lattice(i, 0.754_878), lattice(i, 0.569_840));
            let triangle = i % 2;
            let frame = Frame::from_normal(mesh.geometric_normal(triangle));
            let [wo, wi] = [u, v].map(|u| frame.to_world(uniform_hemisphere::sample(u)));
            let b = uniform_triangle::sample(v);
            let hit =
                Hit { t: 1.0, b: [b.x, b.y, 1.0 - b.x - b.y], shape: 0, triangle: triangle as u32 };
            let uc = lattice(i, 0.819_173);
            Sample { ray: Ray::new(wo, -wo), hit, index: i, frame, wo, wi, uc, u }
        })
        .collect()
}

fn tent() -> TriangleMesh {
    TriangleMesh {
        positions: vec![Vec3::ZERO, Vec3::new(2.0, 0.3, 0.0), Vec3::new(0.0, 0.1, 2.0), Vec3::ONE],
        indices: vec![[0, 2, 1], [1, 2, 3]],
        ..TriangleMesh::default()
    }
}

/// Runs `each` over the pool and reports the time for one element.
fn measure<R>(
    group: &mut BenchmarkGroup<WallTime>,
    name: &str,
    pool: &[Sample],
    mut each: impl FnMut(&Sample) -> R,
) {
    group.throughput(Throughput::Elements(pool.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for sample in pool {
                black_box(each(black_box(sample)));
            }
        });
    });
}

fn bsdf(sample: &Sample, lobe: impl Into<lobe::bxdf::Lobe<'static>>) -> Bsdf<'static> {
    let mut bsdf = Bsdf::new(sample.frame, sample.frame.n);
    bsdf.add(lobe);
    bsdf
}

fn lobes(criterion: &mut Criterion) {
    let pool = pool(&tent());
    let mut group = criterion.benchmark_group("shading/lobe");
    let all = BxdfFlags::all();
    let smooth: Vec<_> = pool.iter().map(|s| bsdf(s, LambertianReflection::new(RED))).collect();
    measure(&mut group, "f lambertian", &pool, |s| smooth[s.index].f(s.wo, s.wi, all));
    measure(&mut group, "f by hand", &pool, |s| {
        if same_side(s, s.wi) { RED * FRAC_1_PI } else { Spectrum::BLACK }
    });
    measure(&mut group, "pdf lambertian", &pool, |s| smooth[s.index].pdf(s.wo, s.wi, all));
    measure(&mut group, "pdf by hand", &pool, |s| {
        if same_side(s, s.wi) { s.wi.dot(s.frame.n).abs() * FRAC_1_PI } else { 0.0 }
    });
    measure(&mut group, "sample_f lambertian", &pool, |s| {
        smooth[s.index].sample_f(s.wo, s.uc, s.u, all)
    });
    measure(&mut group, "sample_f by hand", &pool, |s| {
        let local = cosine_hemisphere::sample(s.u);
        (RED * FRAC_1_PI, s.frame.to_world(local), local.z * FRAC_1_PI)
    });
    let rough: Vec<_> = pool.iter().map(|s| bsdf(s, OrenNayar::new(RED, 20.0))).collect();
    measure(&mut group, "f oren-nayar", &pool, |s| rough[s.index].f(s.wo, s.wi, all));
    measure(&mut group, "sample_f oren-nayar", &pool, |s| {
        rough[s.index].sample_f(s.wo, s.uc, s.u, all)
    });
}

fn same_side(s: &Sample, wi: Vec3) -> bool {
    s.wo.dot(s.frame.n) * wi.dot(s.frame.n) > 0.0
}

/// f and pdf of a list of lobes that is stored in another way than in [`Bsdf`].
fn ask<'a, B: BxDF + ?Sized + 'a>(
    s: &Sample,
    lobes: impl Iterator<Item = &'a B>,
) -> (Spectrum, f32) {
    let (wo, wi) = (s.frame.to_local(s.wo), s.frame.to_local(s.wi));
    lobes
        .fold((Spectrum::BLACK, 0.0), |(f, pdf), lobe| (f + lobe.f(wo, wi), pdf + lobe.pdf(wo, wi)))
}

fn storage(criterion: &mut Criterion) {
    let pool = pool(&tent());
    let mut group = criterion.benchmark_group("shading/storage");
    let all = BxdfFlags::all();
    let f_and_pdf = |bsdf: &Bsdf, s: &Sample| (bsdf.f(s.wo, s.wi, all), bsdf.pdf(s.wo, s.wi, all));
    measure(&mut group, "enum", &pool, |s| {
        f_and_pdf(&black_box(bsdf(s, LambertianReflection::new(RED))), s)
    });
    let mut arena = Arena::new();
    measure(&mut group, "arena dyn", &pool, |s| {
        let answer = {
            let mut bsdf = Bsdf::new(s.frame, s.frame.n);
            bsdf.add(arena.lobe(LambertianReflection::new(RED)));
            f_and_pdf(&black_box(bsdf), s)
        };
        arena.reset();
        answer
    });
    // The same without Bsdf's guards, so that only the storage differs.
    measure(&mut group, "bare enum", &pool, |s| {
        let lobes = [lobe::bxdf::Lobe::from(LambertianReflection::new(RED))];
        ask(s, black_box(lobes).iter())
    });
    let mut bump = Bump::new();
    measure(&mut group, "bare arena dyn", &pool, |s| {
        let lobe: &dyn BxDF = black_box(bump.alloc(LambertianReflection::new(RED)));
        let answer = ask(s, std::iter::once(lobe));
        bump.reset();
        answer
    });
    measure(&mut group, "bare inline dyn", &pool, |s| {
        let lobe: SmallBox<dyn BxDF, S4> = smallbox::smallbox!(LambertianReflection::new(RED));
        ask(s, std::iter::once(&*black_box(lobe)))
    });
    measure(&mut group, "bare boxed dyn", &pool, |s| {
        let lobe: Box<dyn BxDF> = Box::new(LambertianReflection::new(RED));
        ask(s, std::iter::once(&*black_box(lobe)))
    });
}

fn textures(criterion: &mut Criterion) {
    let mesh = tent();
    let pool = pool(&mesh);
    let mut group = criterion.benchmark_group("shading/texture");
    let interaction = |s: &Sample| SurfaceInteraction::on_triangle(&mesh, 0, s.hit.b, s.wo);
    let si = interaction(&pool[0]);
    let constant = RED.into_handle();
    measure(&mut group, "constant in place", &pool, |_| black_box(&constant).evaluate(&si));
    let shared = TextureHandle::Shared(Arc::new(ConstantTexture::new(RED)));
    measure(&mut group, "constant behind a pointer", &pool, |_| black_box(&shared).evaluate(&si));
}

fn samplers(criterion: &mut Criterion) {
    let resolution = UVec2::splat(500);
    let samplers: [(&str, &dyn Sampler); 4] = [
        ("independent", &IndependentSampler::new(0)),
        ("stratified", &StratifiedSampler::new(64, 0)),
        ("sobol", &SobolSampler::new(0)),
        ("blue noise", &BlueNoiseSampler::new(resolution, 64, 0)),
    ];
    let ids: Vec<_> = (0..16 * 64)
        .map(|i| SampleId { pixel: UVec2::new(250 + i / 64, 99), set: 0, index: i % 64 })
        .collect();
    let mut group = criterion.benchmark_group("shading/sampler");
    group.throughput(Throughput::Elements(ids.len() as u64));
    let mut points = vec![Vec2::ZERO; ids.len()];
    for (name, sampler) in samplers {
        group.bench_function(format!("get_2d {name}"), |bencher| {
            bencher.iter(|| ids.iter().map(|&id| black_box(sampler).get_2d(id, 3)).sum::<Vec2>());
        });
        group.bench_function(format!("fill_2d {name}"), |bencher| {
            bencher.iter(|| sampler.fill_2d(black_box(&ids), 3, &mut points));
        });
    }
}

fn hits(criterion: &mut Criterion) {
    let mesh = tent();
    let pool = pool(&mesh);
    let scene = Scene::builder()
        .material("red", MatteMaterial::new(RED))
        .shape("tent", mesh.clone(), "red")
        .light(PointLight::new(LIGHT, Spectrum::WHITE))
        .build()
        .expect("the scene is sound");
    let mut group = criterion.benchmark_group("shading/hit");
    let arena = Arena::new();
    let all = BxdfFlags::all();
    measure(&mut group, "interaction", &pool, |s| scene.interaction(&s.ray, &s.hit));
    let matte = MatteMaterial::new(RED);
    measure(&mut group, "bsdf by hand", &pool, |s| {
        (Frame::from_normal(s.frame.n), RED * FRAC_1_PI)
    });
    let mut interactions: Vec<_> = pool.iter().map(|s| scene.interaction(&s.ray, &s.hit)).collect();
    measure(&mut group, "bsdf of a matte hit", &pool, |s| {
        matte.compute_scattering(&mut interactions[s.index], &arena)
    });
    measure(&mut group, "through the traits", &pool, |s| {
        let mut si = scene.interaction(&s.ray, &s.hit);
        let bsdf = scene.bsdf(&s.hit, &mut si, &arena);
        let light = scene.lights()[0].sample_li(si.p(), s.u).expect("the light is elsewhere");
        bsdf.f(si.wo(), light.wi, all) * (bsdf.pdf(si.wo(), light.wi, all) * 3.0)
    });
    measure(&mut group, "by hand", &pool, |s| {
        let [p0, p1, p2] = mesh.corners(s.hit.triangle as usize);
        let p = s.hit.b[0] * p0 + s.hit.b[1] * p1 + s.hit.b[2] * p2;
        let n = (p1 - p0).cross(p2 - p0).normalize();
        let wi = (LIGHT - p).normalize();
        let (cos_o, cos_i) = (-s.ray.d.dot(n), wi.dot(n));
        if cos_o * cos_i > 0.0 { RED * (3.0 * cos_i.abs() / (PI * PI)) } else { Spectrum::BLACK }
    });
}

/// A matte material as another crate writes it: it answers for single hits.
struct ForeignMaterial(Spectrum);

impl Material for ForeignMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(LambertianReflection::new(self.0));
        bsdf
    }
}

/// A lobe as another crate writes it, and its material.
#[derive(Clone, Copy)]
struct ForeignLobe(Spectrum);

impl BxDF for ForeignLobe {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        self.0 * FRAC_1_PI
    }
}

impl Material for ForeignLobe {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(arena.lobe(*self));
        bsdf
    }
}

/// A point light as another crate writes it.
struct ForeignLight(PointLight);

impl Light for ForeignLight {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.0.sample_li(p, u)
    }
    fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
        self.0.power(scene)
    }
}

/// Renders with the crate's kinds and with foreign ones in turns, since machines drift, and prints the medians: time, and
/// its ratio to the time with the crate's kinds in the same round.
fn renders(_: &mut Criterion) {
    const SIDE: u32 = 96;
    const SPP: u32 = 64;
    let wanted = |name: &str| match std::env::args().skip(1).find(|arg| !arg.starts_with('-')) {
        Some(filter) => name.contains(&filter),
        None => true,
    };
    if !wanted("shading/render") {
        return;
    }
    let rounds = if std::env::args().any(|arg| arg == "--bench") { 25 } else { 1 };
    let dragon = read_obj(Path::new("assets/dragon.obj")).expect("a mesh of the project").mesh;
    let floor =
        TriangleMesh::parallelogram(Vec3::new(-6.0, 0.0, 6.0), Vec3::X * 12.0, Vec3::Z * -12.0);
    let lamp = PointLight::new(LIGHT, Spectrum::splat(900.0));
    let camera = PerspectiveSettings {
        eye: Vec3::new(-3.0, 2.5, -3.0),
        look_at: Vec3::new(0.0, 0.5, 0.0),
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::new(SIDE, SIDE)).expect("a view");
    let sampler = SamplerSettings { spp: SPP, ..SamplerSettings::default() };
    let settings = RenderSettings::new(sampler, PathIntegrator::new(5));
    let options =
        RenderOptions { threads: NonZeroUsize::new(1), layers: false, ..RenderOptions::default() };
    let scene = |material: Arc<dyn Material>, light: Arc<dyn Light>| {
        Scene::builder()
            .material("red", material)
            .shape("dragon", dragon.clone(), "red")
            .shape("floor", floor.clone(), "red")
            .light(light)
            .build()
            .expect("the scene is sound")
    };
    let matte = || Arc::new(MatteMaterial::new(RED));
    let closure = MatteMaterial::new(|_: &SurfaceInteraction| RED);
    let scenes = [
        ("the crate's kinds", scene(matte(), Arc::new(lamp))),
        ("foreign material", scene(Arc::new(ForeignMaterial(RED)), Arc::new(lamp))),
        ("foreign lobe", scene(Arc::new(ForeignLobe(RED)), Arc::new(lamp))),
        ("closure as texture", scene(Arc::new(closure), Arc::new(lamp))),
        ("foreign light", scene(matte(), Arc::new(ForeignLight(lamp)))),
    ];
    let mut times: [Vec<f64>; 5] = Default::default();
    for round in 0..rounds {
        for i in 0..scenes.len() {
            // Each scene comes first as often as the others.
            let i = (i + round) % scenes.len();
            let start = Instant::now();
            black_box(render(&scenes[i].1, &view, &settings, &options).expect("enough memory"));
            times[i].push(start.elapsed().as_secs_f64());
        }
    }
    let median = |mut of: Vec<f64>| {
        of.sort_by(f64::total_cmp);
        of[of.len() / 2]
    };
    for ((name, _), time) in scenes.iter().zip(&times) {
        let ratio = median(time.iter().zip(&times[0]).map(|(time, first)| time / first).collect());
        let ns = median(time.clone()) * 1e9 / f64::from(SIDE * SIDE * SPP);
        println!("shading/render/{name:20} {ns:6.1} ns a sample, ratio {ratio:.3}");
    }
}

criterion_group!(benches, lobes, storage, textures, samplers, hits, renders);
criterion_main!(benches);
