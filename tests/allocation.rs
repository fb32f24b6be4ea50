//! Rendering allocates no memory: a worker allocates its buffers when it starts, and the arena for lobes of other
//! crates stops growing after the hit that needs most.

mod scenes;

use std::alloc::{GlobalAlloc, Layout, System};
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags};
use lobe::film::GaussianFilter;
use lobe::glam::Vec3;
use lobe::integrator::{ChapterIntegrator, DirectIntegrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{LightStrategy, SkyLight};
use lobe::material::{Material, MetalMaterial, Roughness};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::{
    FilmSettings, PointLight, RenderOptions, RenderSettings, Spectrum, TriangleMesh, View, render,
};
use scenes::{any, ball_over_floor, chapter_camera};

/// The system's allocator, which counts its calls.
struct Counting;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call is forwarded to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::SeqCst);
        // SAFETY: the caller keeps the contract of this function.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of this function.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::SeqCst);
        // SAFETY: the caller keeps the contract of this function.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// A lobe defined outside the crate, which has to be stored in the arena.
#[derive(Clone, Copy)]
struct Foreign;

impl BxDF for Foreign {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::splat(0.1)
    }
}

struct ForeignMaterial;

impl Material for ForeignMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::along_u(si);
        bsdf.add(arena.lobe(Foreign));
        bsdf.add(arena.lobe(Foreign));
        bsdf
    }
}

/// In a single pass: each sets its workers up. Counts allocations between the end of tile 30, by which every kind of hit has occurred, and the end of the last
/// tile.
///
/// All cases are in one test, since the counter is global to the process. Seen to fail with a box around each
/// hit's material call, with a new `Wave` for each tile, and with tables of metals that are made at the first hit.
#[test]
fn rendering_allocates_nothing_after_set_up() {
    // What a metal of a texture needs is there before its first hit.
    let texture = |si: &SurfaceInteraction| Spectrum::splat(si.uv().x);
    let metal = MetalMaterial::reflecting(texture).with_roughness(Roughness::alpha(0.3));
    let mesh = TriangleMesh::parallelogram(Vec3::ZERO, Vec3::Z, Vec3::X);
    let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.3, 0.3, 0.4], Vec3::Y);
    let arena = Arena::new();
    let before = ALLOCATIONS.load(Ordering::SeqCst);
    let bsdf = metal.compute_scattering(&mut si, &arena);
    assert_eq!(ALLOCATIONS.load(Ordering::SeqCst) - before, 0, "a metal's first hit");
    drop(bsdf);

    let chapter = ChapterIntegrator { highlight: true };
    for (integrator, kind) in [
        (any(chapter), SamplerKind::INDEPENDENT),
        (any(DirectIntegrator::default()), SamplerKind::INDEPENDENT),
        (any(DirectIntegrator::default()), SamplerKind::STRATIFIED),
        (any(DirectIntegrator { strategy: LightStrategy::Mis }), SamplerKind::SOBOL),
        (any(PathIntegrator::new(6)), SamplerKind::SOBOL),
        (any(PathIntegrator::new(6)), SamplerKind::BLUE_NOISE),
    ] {
        let sampler = SamplerSettings { kind, spp: 16, ..Default::default() };
        let film = FilmSettings::new(100, 80).with_filter(GaussianFilter::default());
        let view = View::perspective(&chapter_camera(), film).unwrap();
        let scene = ball_over_floor()
            .material("red", ForeignMaterial)
            .light(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))
            .light(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::splat(20.0)))
            .light(SkyLight::new(Spectrum::splat(0.1)))
            .build()
            .unwrap();
        // (tiles done, allocations so far), after tile 30 and after the latest tile.
        let seen = Mutex::new([(0, 0); 2]);
        let progress = |_| {
            let count = ALLOCATIONS.load(Ordering::SeqCst);
            let mut seen = seen.lock().unwrap();
            let tiles = seen[1].0 + 1;
            seen[1] = (tiles, count);
            // The arena grows at the first lobe of another crate, some tiles into the picture.
            if tiles == 30 {
                seen[0] = (tiles, count);
            }
        };
        let options = RenderOptions {
            threads: NonZeroUsize::new(1),
            tile_size: 8,
            layers: true,
            progress: Some(&progress),
            ..RenderOptions::default()
        };
        let settings = RenderSettings::new(sampler, integrator.clone());
        render(&scene, &view, &settings, &options).unwrap();
        let [first, last] = *seen.lock().unwrap();
        assert!(first.0 == 30 && last.0 == 130, "{first:?}, {last:?}");
        let allocations = last.1 - first.1;
        assert_eq!(allocations, 0, "{integrator:?} {kind:?}: {allocations} in 100 tiles");
    }
}
