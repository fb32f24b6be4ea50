//! Renders that go on from a checkpoint, that end in time, and that are divided into parts.

mod scenes;

use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use lobe::glam::{UVec2, Vec3};
use lobe::image::Window;
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::render::{
    Checkpoint, Part, Progress, RenderError, Rendered, ResumeError, SamplerSettings, Saving,
};
use lobe::sampling::SamplerKind;
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings,
    Scene, Spectrum, View, render,
};
use scenes::{ball, ball_over_floor, chapter_camera};

fn scene() -> Scene {
    ball_over_floor().light(SkyLight::new(Spectrum::new(0.1, 0.2, 0.3))).build().unwrap()
}

/// A crop, whose tiles begin at its corner.
fn view() -> View {
    let crop = Some(Window { min: UVec2::new(2, 3), max: UVec2::new(19, 16) });
    let film = FilmSettings { crop, ..FilmSettings::new(21, 18) };
    View::perspective(&chapter_camera(), film).unwrap()
}

fn settings(kind: SamplerKind, spp: u32) -> RenderSettings {
    let sampler = SamplerSettings { kind, spp, seed: 5, replicates: 3 };
    RenderSettings::new(sampler, PathIntegrator::new(3))
}

fn options() -> RenderOptions<'static> {
    RenderOptions { tile_size: 8, layers: true, ..RenderOptions::default() }
}

/// Everything but the time.
fn assert_same(a: &Rendered, b: &Rendered, what: &str) {
    assert!(a.picture == b.picture, "{what}");
    assert_eq!(a.counters, b.counters, "{what}");
    assert_eq!(
        (a.samples_per_pixel, a.complete, a.empty_pixels, a.non_finite),
        (b.samples_per_pixel, b.complete, b.empty_pixels, b.non_finite),
        "{what}"
    );
}

/// The bytes of all checkpoints of a render, one after each tile.
fn checkpoints(settings: &RenderSettings, options: &RenderOptions) -> (Rendered, Vec<Vec<u8>>) {
    let stored = Mutex::new(Vec::new());
    let to = |checkpoint: &Checkpoint| {
        let mut bytes = Vec::new();
        checkpoint.write(&mut bytes).unwrap();
        stored.lock().unwrap().push(bytes);
    };
    let options = RenderOptions {
        save: Some(Saving { every: Duration::ZERO, on_checkpoint: &to }),
        ..*options
    };
    let rendered = render(&scene(), &view(), settings, &options).unwrap();
    (rendered, stored.into_inner().unwrap())
}

/// From every checkpoint, with other numbers of threads. Seen to fail with the marks of tiles left out, with the counters
/// not stored, with the pass begun anew, and with squares of the variance not stored.
#[test]
fn a_resumed_render_is_the_same_to_the_bit() {
    for (kind, spp, layers) in [
        (SamplerKind::SOBOL, 150, true),
        (SamplerKind::INDEPENDENT, 71, true),
        (SamplerKind::STRATIFIED, 81, false),
        (SamplerKind::BLUE_NOISE, 1, true),
    ] {
        let settings = settings(kind, spp);
        let options = RenderOptions { layers, ..options() };
        let whole = render(&scene(), &view(), &settings, &options).unwrap();
        assert!(whole.complete);
        let (rendered, stored) = checkpoints(&settings, &options);
        assert_same(&rendered, &whole, "saving changes nothing");
        for (number, bytes) in stored.iter().enumerate() {
            let threads = NonZeroUsize::new(1 + number % 3);
            let (all, done) = (17 * 13, Mutex::new(17 * 13));
            let progress = |now: Progress| *done.lock().unwrap() = now.pixels;
            let options = RenderOptions { threads, resume: Some(bytes), ..options };
            let options = RenderOptions { progress: Some(&progress), ..options };
            let resumed = render(&scene(), &view(), &settings, &options).unwrap();
            assert_eq!(*done.lock().unwrap(), all, "{kind:?}, from checkpoint {number}");
            assert_same(&resumed, &whole, &format!("{kind:?}, from checkpoint {number}"));
            assert!(resumed.seconds > 0.0);
        }
    }
}

/// A cancelled render is stored once more, with what it has, and its picture is that of the checkpoint.
#[test]
fn a_cancelled_render_is_stored() {
    let settings = settings(SamplerKind::SOBOL, 140);
    let whole = render(&scene(), &view(), &settings, &options()).unwrap();
    for tiles in [0, 1, 5, 6, 7, 15] {
        let (cancel, done) = (AtomicBool::new(tiles == 0), Mutex::new(0));
        let progress = |_| {
            let mut done = done.lock().unwrap();
            *done += 1;
            cancel.fetch_or(*done == tiles, Ordering::Relaxed);
        };
        let stored = Mutex::new(Vec::new());
        let to = |checkpoint: &Checkpoint| {
            let mut stored = stored.lock().unwrap();
            stored.clear();
            checkpoint.write(&mut *stored).unwrap();
        };
        let cancelled = RenderOptions {
            threads: NonZeroUsize::new(1),
            cancel: Some(&cancel),
            progress: Some(&progress),
            save: Some(Saving { every: Duration::MAX, on_checkpoint: &to }),
            ..options()
        };
        let rendered = render(&scene(), &view(), &settings, &cancelled).unwrap();
        assert!(!rendered.complete);
        let stored = stored.into_inner().unwrap();
        let options = RenderOptions { resume: Some(&stored), ..options() };
        let resumed = render(&scene(), &view(), &settings, &options).unwrap();
        assert_same(&resumed, &whole, &format!("cancelled after {tiles} tiles"));
        // Cancelled at once, it is what it was.
        let cancel = AtomicBool::new(true);
        let options = RenderOptions { cancel: Some(&cancel), ..options };
        let again = render(&scene(), &view(), &settings, &options).unwrap();
        assert_same(&again, &rendered, &format!("cancelled after {tiles} tiles, twice"));
    }
}

/// Bytes of another render are refused, and so are damaged ones. Seen to fail without the check of the last pass, which let
/// the schedule run past the last sample.
#[test]
fn other_renders_are_refused() {
    let (sobol, options) = (settings(SamplerKind::SOBOL, 140), options());
    let (_, stored) = checkpoints(&sobol, &options);
    let bytes = &stored[stored.len() / 2];
    let refused = |settings: &RenderSettings, options: &RenderOptions, bytes: &[u8]| {
        let options = RenderOptions { resume: Some(bytes), ..*options };
        render(&scene(), &view(), settings, &options).map(|_| ()).unwrap_err()
    };
    let other = RenderError::Resume(ResumeError::OtherSettings);
    assert_eq!(refused(&settings(SamplerKind::SOBOL, 141), &options, bytes), other);
    let tiles = RenderOptions { tile_size: 16, ..options };
    assert_eq!(refused(&sobol, &tiles, bytes), other);
    let part = Some(Part { index: 0, count: NonZeroU32::new(2).unwrap() });
    assert_eq!(refused(&sobol, &RenderOptions { part, ..options }, bytes), other);
    assert_eq!(refused(&settings(SamplerKind::INDEPENDENT, 140), &options, bytes), other);

    let damaged = RenderError::Resume(ResumeError::Damaged);
    let no_layers = RenderOptions { layers: false, ..options };
    assert_eq!(refused(&sobol, &no_layers, bytes), damaged);
    assert_eq!(refused(&sobol, &options, &[]), damaged);
    assert_eq!(refused(&sobol, &options, &bytes[..bytes.len() - 1]), damaged);
    assert_eq!(refused(&sobol, &options, &[bytes, &[0][..]].concat()), damaged);
    // The pass: after five numbers of four bytes.
    for pass in [[0, 0], [64, 4], [0, u32::MAX]] {
        let mut bytes = bytes.clone();
        bytes[20..24].copy_from_slice(&pass[0].to_le_bytes());
        bytes[24..28].copy_from_slice(&pass[1].to_le_bytes());
        assert_eq!(refused(&sobol, &options, &bytes), damaged, "{pass:?}");
    }
}

/// The time that earlier runs took counts: of two hours, three are over. Seen to fail with the time of this run alone.
#[test]
fn time_goes_on_where_it_was() {
    let settings = settings(SamplerKind::SOBOL, 140);
    let (_, stored) = checkpoints(&settings, &options());
    let mut bytes = stored[2].clone();
    // Behind seven numbers of four bytes.
    bytes[28..36].copy_from_slice(&(3.0_f64 * 3600.0).to_le_bytes());
    let time = Some(Duration::from_secs(2 * 3600));
    let late = RenderOptions { time, spp: Some(140), resume: Some(&bytes), ..options() };
    let rendered = render(&scene(), &view(), &settings, &late).unwrap();
    assert!(!rendered.complete && rendered.seconds > 3.0 * 3600.0);
    assert!(rendered.empty_pixels > 0, "tiles were rendered after the end");
}

/// Paths among white walls never end by themselves, and one wave of them took for ever. Seen to hang with the time looked
/// at between passes, between tiles, or between waves.
#[test]
fn time_ends_a_render_within_a_wave() {
    let white = MatteMaterial::new([1.0; 3]);
    let scene = Scene::builder().material("white", white).shape("ball", ball(8), "white");
    let scene = scene.light(PointLight::new(Vec3::splat(9.0), Spectrum::WHITE)).build().unwrap();
    let integrator = PathIntegrator { roulette: false, ..PathIntegrator::new(u32::MAX) };
    let sampler = SamplerSettings::default();
    let options = RenderOptions { time: Some(Duration::from_millis(20)), ..options() };
    let camera = PerspectiveSettings { eye: Vec3::ZERO, look_at: Vec3::Z, ..Default::default() };
    let inside = View::perspective(&camera, FilmSettings::new(33, 21)).unwrap();
    let settings = RenderSettings::new(sampler, integrator);
    let rendered = render(&scene, &inside, &settings, &options).unwrap();
    assert!(!rendered.complete);
    assert_eq!((rendered.samples_per_pixel, rendered.empty_pixels), (0, 33 * 21));
}
