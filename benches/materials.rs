//! Cost of each lobe and of each material, in nanoseconds per element: `cargo bench shading`.
//!
//! - `shading/lobes/*`: f, pdf and sample_f of one lobe, without a Bsdf.
//! - `shading/materials/*`: the same of the Bsdf that a material makes, and to make it, with the interaction of the hit.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lobe::bxdf::fresnel::Fresnel;
use lobe::bxdf::{
    Arena, BoundaryLosses, Bsdf, BxDF, BxdfFlags, CoatedDiffuse, EnergyPreservingOrenNayar,
    FresnelMicrofacet, FresnelSpecular, LambertianReflection, LambertianTransmission, Losses,
    MicrofacetReflection, OrenNayar, RetroReflection, Roughnesses, SpecularReflection,
    SpecularTransmission, ThinFresnelSpecular,
};
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::material::{
    GlassMaterial, Material, MetalMaterial, MirrorMaterial, MixMaterial, PlasticMaterial,
    RetroMaterial, Roughness, ThinGlassMaterial, TranslucentMaterial,
};
use lobe::sampling::uniform_hemisphere;
use lobe::{MatteMaterial, Spectrum, TriangleMesh};

const RED: Spectrum = Spectrum::new(0.8, 0.1, 0.2);
const GOLD: Fresnel = Fresnel::Conductor { eta: [0.2, 0.4, 1.3], k: [3.2, 2.5, 1.9] };
const ALPHA: [f32; 2] = [0.3, 0.3];
const ETA: f32 = 1.5;

/// Directions above the surface, and sample values.
struct Sample {
    wo: Vec3,
    wi: Vec3,
    uc: f32,
    u: Vec2,
}

/// A lattice of few enough to stay in the first-level cache.
fn pool() -> Vec<Sample> {
    let lattice = |i: usize, step: f32| (i as f32 * step + 0.5).fract();
    let sample = |i| {
        let u = Vec2::new(lattice(i, 0.819_173), lattice(i, 0.671_044));
        let v = Vec2::new(lattice(i, 0.754_878), lattice(i, 0.569_840));
        let [wo, wi] = [u, v].map(uniform_hemisphere::sample);
        Sample { wo, wi, uc: lattice(i, 0.549_700), u: v }
    };
    (0..256).map(sample).collect()
}

fn measure<R>(
    criterion: &mut Criterion,
    group: &str,
    name: &str,
    pool: &[Sample],
    each: impl Fn(&Sample) -> R,
) {
    let mut group = criterion.benchmark_group(format!("shading/{group}"));
    group.throughput(Throughput::Elements(pool.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for sample in pool {
                black_box(each(black_box(sample)));
            }
        });
    });
}

fn lobes(criterion: &mut Criterion) {
    let (pool, white) = (pool(), Spectrum::WHITE);
    let constant = Roughnesses::Constant(ALPHA);
    let (mirrors, coat) = (Losses::of_mirrors(constant), Losses::of_coat(ETA, constant));
    let boundary = BoundaryLosses::new(ETA, constant);
    let facets = MicrofacetReflection::new(ALPHA, GOLD);
    let all: [(&str, &dyn BxDF); 14] = [
        ("lambertian", &LambertianReflection::new(RED)),
        ("lambertian transmission", &LambertianTransmission::new(RED)),
        ("oren-nayar", &OrenNayar::new(RED, 20.0)),
        ("energy-preserving oren-nayar", &EnergyPreservingOrenNayar::new(RED, 0.5)),
        ("specular reflection", &SpecularReflection::new(RED, GOLD)),
        ("specular transmission", &SpecularTransmission::new(RED, ETA)),
        ("fresnel specular", &FresnelSpecular::new(white, white, ETA)),
        ("thin fresnel specular", &ThinFresnelSpecular::new(white, white, ETA)),
        ("microfacet, once", &facets),
        ("microfacet", &facets.and_multiple(&mirrors, GOLD.mean())),
        ("fresnel microfacet", &FresnelMicrofacet::new(white, white, ALPHA, &boundary)),
        ("coat", &MicrofacetReflection::new(ALPHA, Fresnel::Dielectric { eta: ETA })),
        ("coated diffuse", &CoatedDiffuse::new(RED, ALPHA, &coat)),
        ("retro-reflection", &RetroReflection::new(facets.and_multiple(&mirrors, GOLD.mean()))),
    ];
    for (name, lobe) in all {
        measure(criterion, "lobes", &format!("f {name}"), &pool, |s| lobe.f(s.wo, s.wi));
        measure(criterion, "lobes", &format!("pdf {name}"), &pool, |s| lobe.pdf(s.wo, s.wi));
        let sample = |s: &Sample| lobe.sample_f(s.wo, s.uc, s.u);
        measure(criterion, "lobes", &format!("sample_f {name}"), &pool, sample);
    }
}

fn materials(criterion: &mut Criterion) {
    let (pool, rough) = (pool(), || Roughness::alpha(0.3));
    let gold = || MetalMaterial::named("gold").expect("gold has a name");
    let plastic = || PlasticMaterial::new([0.8, 0.1, 0.2], ETA);
    let all: [(&str, &dyn Material); 14] = [
        ("matte", &MatteMaterial::new(RED)),
        ("rough matte", &MatteMaterial::new(RED).with_roughness(0.5)),
        ("mirror", &MirrorMaterial::new(RED)),
        ("glass", &GlassMaterial::new(ETA)),
        ("rough glass", &GlassMaterial::new(ETA).with_roughness(rough())),
        ("thin glass", &ThinGlassMaterial::new(ETA)),
        ("metal", &gold()),
        ("rough metal", &gold().with_roughness(rough())),
        ("brushed metal", &gold().with_roughness(rough().across(0.1))),
        ("plastic", &plastic()),
        ("rough plastic", &plastic().with_roughness(rough())),
        ("translucent", &TranslucentMaterial::new(RED, 0.5)),
        ("retro", &RetroMaterial::new(RED, 0.5).with_roughness(rough())),
        ("mix", &MixMaterial::new(gold().with_roughness(rough()), plastic(), 0.5)),
    ];
    let mesh = TriangleMesh::parallelogram(Vec3::ZERO, Vec3::X, Vec3::Y);
    let (arena, flags) = (Arena::new(), BxdfFlags::all());
    let hit = || SurfaceInteraction::on_triangle(&mesh, 0, [0.3, 0.3, 0.4], Vec3::Z);
    for (name, material) in all {
        let bsdf: Bsdf = material.compute_scattering(&mut hit(), &arena);
        measure(criterion, "materials", &format!("make {name}"), &pool, |_| {
            material.compute_scattering(&mut hit(), &arena)
        });
        measure(criterion, "materials", &format!("f {name}"), &pool, |s| bsdf.f(s.wo, s.wi, flags));
        measure(criterion, "materials", &format!("pdf {name}"), &pool, |s| {
            bsdf.pdf(s.wo, s.wi, flags)
        });
        measure(criterion, "materials", &format!("sample_f {name}"), &pool, |s| {
            bsdf.sample_f(s.wo, s.uc, s.u, flags)
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(600));
    targets = lobes, materials
}
criterion_main!(benches);
