//! Curves of error: the error of a right method falls, that of a wrong one flattens and is reported as bias.
//!
//! The truth is the crate's own picture of a pyramid under the sky, by another estimator and with other seeds than the
//! methods have. Two methods are wrong on purpose: one clamps bright samples, one divides by another density than it sampled
//! from.

use std::sync::atomic::AtomicBool;

use lobe::bxdf::BxdfFlags;
use lobe::glam::{UVec2, Vec3};
use lobe::integrator::{DirectIntegrator, Estimator, Integrator, Wave, dimension};
use lobe::light::{LightStrategy, SkyLight};
use lobe::metrics::convergence::{
    Bias, Curve, Distrust, Method, Other, Reference, Run, RunError, RunningMean, Study,
    pareto_front,
};
use lobe::render::{SamplerSettings, Sampling, render_with};
use lobe::sampling::{IndependentSampler, SampleId, Sampler, SamplerKind};
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, RenderOptions, RenderSettings, Scene,
    Spectrum, TriangleMesh, View, render,
};

const SIZE: UVec2 = UVec2::new(40, 36);
const SEEDS: u64 = 8;
const PARTS: u32 = 6;
const BUDGETS: [u32; 6] = [1, 2, 4, 8, 16, 32];

fn scene() -> Scene {
    let floor =
        TriangleMesh::parallelogram(Vec3::new(-4.0, 0.0, -4.0), Vec3::Z * 8.0, Vec3::X * 8.0);
    let pyramid = TriangleMesh {
        positions: vec![
            Vec3::new(-1.0, 0.0, -1.0),
            Vec3::new(1.0, 0.0, -1.0),
            Vec3::new(1.0, 0.0, 1.0),
            Vec3::new(-1.0, 0.0, 1.0),
            Vec3::new(0.0, 1.6, 0.0),
        ],
        indices: vec![[0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]],
        ..TriangleMesh::default()
    };
    Scene::builder()
        .material("clay", MatteMaterial::new([0.6, 0.3, 0.2]))
        .shape("floor", floor, "clay")
        .shape("pyramid", pyramid, "clay")
        .light(SkyLight::new(Spectrum::splat(1.0)))
        .build()
        .unwrap()
}

fn view() -> View {
    let camera = PerspectiveSettings {
        eye: Vec3::new(0.3, 2.5, -2.6),
        look_at: Vec3::ZERO,
        ..Default::default()
    };
    View::perspective(&camera, FilmSettings::new(SIZE.x, SIZE.y)).unwrap()
}

/// Renders the parts of a reference, from seeds that no method has.
fn reference(scene: &Scene) -> Reference {
    let mut pool = RunningMean::default();
    for part in 0..u64::from(PARTS) {
        let sampler = SamplerSettings {
            kind: SamplerKind::SOBOL,
            spp: 256,
            seed: 1000 + part,
            replicates: 1,
        };
        let integrator = DirectIntegrator { strategy: LightStrategy::Light };
        let settings = RenderSettings::new(sampler, integrator);
        let rendered = render(scene, &view(), &settings, &RenderOptions::default()).unwrap();
        pool.add(&rendered.picture.color);
    }
    Reference::new(&pool, SIZE)
}

/// The right method, or the same with an integrator of this test.
fn method<'a>(scene: &'a Scene, name: &str, wrong: Option<&'a dyn Integrator>) -> Method<'a> {
    let right = DirectIntegrator::default();
    Method::new(name, scene.build_seconds(), move |spp, seed| {
        let sampler = IndependentSampler::new(seed);
        let sampling = Sampling::new(&sampler, spp);
        let integrator = wrong.unwrap_or(&right);
        render_with(scene, &view(), integrator, sampling, &RenderOptions::default())
    })
}

/// Clamps bright samples, as is done against fireflies.
struct Clamped(DirectIntegrator);

impl Integrator for Clamped {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(ClampedEstimator(self.0.prepare(scene)))
    }
}

struct ClampedEstimator<'a>(Box<dyn Estimator + 'a>);

impl Estimator for ClampedEstimator<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        self.0.shade(sampler, wave);
        for radiance in &mut wave.radiance {
            *radiance = Spectrum::from(radiance.to_array().map(|band| band.min(0.5)));
        }
    }

    fn shadow_rays(&self) -> usize {
        self.0.shadow_rays()
    }
}

/// Samples directions uniformly over the sphere, but divides by the cosine-weighted density of the hemisphere.
struct WrongPdf;

impl Integrator for WrongPdf {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(WrongPdfEstimator(scene))
    }
}

struct WrongPdfEstimator<'a>(&'a Scene);

impl Estimator for WrongPdfEstimator<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        let scene = self.0;
        let Wave { ids, rays, hits, radiance, shadow, arena, .. } = wave;
        for (sample, (ray, hit)) in rays.iter().zip(&*hits).enumerate() {
            if !hit.is_hit() {
                radiance[sample] = Spectrum::splat(1.0);
                continue;
            }
            let mut si = scene.interaction(ray, hit);
            let bsdf = scene.bsdf(hit, &mut si, arena);
            let u = sampler.get_2d(ids[sample], dimension::FIRST_LIGHT);
            let (z, phi) = (1.0 - 2.0 * u.x, std::f32::consts::TAU * u.y);
            let r = (1.0 - z * z).max(0.0).sqrt();
            let wi = Vec3::new(r * phi.cos(), r * phi.sin(), z);
            let (f, pdf) = bsdf.f_and_pdf(si.wo(), wi, BxdfFlags::all());
            if pdf > 0.0 {
                let cosine = si.shading_n().dot(wi).abs();
                shadow.push(sample, si.spawn_ray(wi), f * (cosine / pdf));
            }
        }
        shadow.trace(scene, radiance);
        arena.reset();
    }
}

/// All runs of a method, and its bias at the largest budget.
fn measure(method: &Method, reference: &Reference) -> (Vec<Run>, Bias) {
    let (mut runs, mut pool) = (Vec::new(), RunningMean::default());
    for spp in BUDGETS {
        for seed in 0..SEEDS {
            let (run, image) = method.run(spp, seed, reference).unwrap();
            runs.push(run);
            if spp == BUDGETS[BUDGETS.len() - 1] {
                pool.add(&image.pixels);
            }
        }
    }
    let part = (SEEDS * u64::from(BUDGETS[BUDGETS.len() - 1])) as f64 / f64::from(PARTS * 256);
    (runs, Bias::new(&pool, reference, part))
}

/// Seen to fail with the right density in place of the wrong one.
#[test]
fn wrong_methods_flatten_and_are_called_biased() {
    let scene = scene();
    let reference = reference(&scene);
    assert_eq!(reference.distrust(), None);
    let clamped = Clamped(DirectIntegrator::default());
    let methods = [
        method(&scene, "right", None),
        method(&scene, "clamped", Some(&clamped)),
        method(&scene, "wrong pdf", Some(&WrongPdf)),
    ];
    let (mut curves, mut biases) = (Vec::new(), Vec::new());
    for method in &methods {
        let (runs, bias) = measure(method, &reference);
        curves.push(Curve::new(method.name(), &runs, &reference));
        biases.push(Some(bias));
    }
    let slopes: Vec<f64> = curves.iter().map(|curve| curve.slope_by_samples().unwrap()).collect();
    // Independent samples: -1/2. With as many seeds and pixels as here the slope scatters by 0.005.
    assert!((slopes[0] + 0.5).abs() < 0.03, "{slopes:?}");
    assert!(!biases[0].unwrap().is_certain(), "{:?}", biases[0]);
    for (curve, bias) in curves.iter().zip(&biases).skip(1) {
        let (name, bias) = (&curve.method, bias.unwrap());
        let [before, last] = curve.points.last_chunk().unwrap();
        let (before, last) = (before.error.unwrap()[1], last.error.unwrap()[1]);
        assert!(bias.is_certain(), "{name}: {bias:?}");
        // The remaining error is bias, which twice the samples hardly reduce.
        assert!(bias.error < last && last < 1.4 * bias.error, "{name}: {last}, {bias:?}");
        assert!(last > 0.8 * before, "{name}: {before}, {last}");
    }
    assert!(biases[1].unwrap().mean.0 < 0.0, "clamped pictures are too dark");

    let study = Study { scene: "pyramid".into(), reference, curves, biases, others: Vec::new() };
    let svg = study.error_by_samples().svg();
    assert!(svg.contains("right, slope") && svg.contains("clamped, biased by"), "{svg}");
    assert!(svg.contains("wrong pdf, biased by"), "{svg}");
}

/// Whole messages. Seen to fail with any number taken that Rust parses, and with names whose quotes are not doubled.
#[test]
fn lines_that_are_no_runs_are_refused() {
    let good = "\"a, \"\"b\"\"\",4,7,0.25,1e-3,0,2,-3";
    let run: Run = good.parse().unwrap();
    assert_eq!((run.method.as_str(), run.spp, run.seed, run.mean), ("a, \"b\"", 4, 7, -3.0));
    let whole = "a whole number from 1 to 4294967295";
    let positive = "a finite number of at least 0";
    for (line, problem) in [
        ("", format!("expected {}", Run::HEADER)),
        ("\"a\",1,2", format!("expected {}", Run::HEADER)),
        ("a,4,7,0,0,0,0,0", format!("expected {}", Run::HEADER)),
        ("\"a\"b\",4,7,0,0,0,0,0", format!("expected {}", Run::HEADER)),
        ("\"a\",4,7,0,0,0,0,0,0", format!("expected {}", Run::HEADER)),
        ("\"a\",0,7,0,0,0,0,0", format!("spp is `0`, expected {whole}")),
        ("\"a\",4294967296,7,0,0,0,0,0", format!("spp is `4294967296`, expected {whole}")),
        ("\"a\",4,-7,0,0,0,0,0", "seed is `-7`, expected a whole number".into()),
        ("\"a\",4,7,-1,0,0,0,0", format!("set_up_s is `-1`, expected {positive}")),
        ("\"a\",4,7,0,inf,0,0,0", format!("render_s is `inf`, expected {positive}")),
        ("\"a\",4,7,0,0,NaN,0,0", format!("relmse is `NaN`, expected {positive}")),
        ("\"a\",4,7,0,0,0,1e999,0", format!("mse is `1e999`, expected {positive}")),
        ("\"a\",4,7,0,0,0,0,nan", "mean is `nan`, expected a finite number".into()),
    ] {
        let message = line.parse::<Run>().unwrap_err().to_string();
        assert_eq!(message, format!("`{line}` is not a line of runs.csv: {problem}"));
    }
    let long = format!("\"\u{1b}{}", "x".repeat(200)).parse::<Run>().unwrap_err().to_string();
    let shown = format!("`\"\\u{{1b}}{}`", "x".repeat(200));
    assert_eq!(long, format!("{shown} is not a line of runs.csv: expected {}", Run::HEADER));
}

/// Times and errors by hand: medians, quartiles, the reference's own error subtracted, and the Pareto front.
#[test]
fn curves_are_those_by_hand() {
    let mut pool = RunningMean::default();
    // Two parts, 0.01 apart in each band: the variance of their mean is 0.005², and 1 + 0.01 divides it.
    for value in [0.995, 1.005] {
        pool.add(&[Spectrum::splat(value); 64]);
    }
    let reference = Reference::new(&pool, UVec2::splat(8));
    let floor = reference.floor();
    assert!((floor - 0.005 / 1.01_f64.sqrt()).abs() < 1e-6, "{floor}");

    let run = |method: &str, spp, seed, seconds, error: f64| Run {
        method: method.into(),
        spp,
        seed,
        set_up: 0.25,
        seconds,
        rel_mse: error * error + floor * floor,
        mse: 0.0,
        mean: 0.0,
    };
    let runs = [
        run("a", 1, 0, 1.0, 0.1),
        run("a", 1, 1, 3.0, 0.3),
        run("a", 1, 2, 2.0, 0.2),
        run("a", 2, 0, 4.0, 0.05),
        run("a", 4, 0, 8.0, 0.9 * floor),
        run("b", 1, 0, 2.5, 0.15),
        run("b", 2, 0, 5.0, 0.06),
    ];
    for run in &runs {
        assert_eq!(run.to_string().parse(), Ok(run.clone()));
    }
    let curves = ["a", "b"].map(|method| Curve::new(method, &runs, &reference));
    let first = &curves[0].points[0];
    assert_eq!((first.runs, first.seconds, first.time()), (3, 2.0, 2.25));
    let [q1, median, q3] = first.error.unwrap();
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-9, "{x}, expected {y}");
    close(median, 0.2);
    // Of squares, half way: (0.1² + 0.2²) / 2 and (0.2² + 0.3²) / 2.
    close(q1, 0.025_f64.sqrt());
    close(q3, 0.065_f64.sqrt());
    assert_eq!(curves[0].points[2].error, None, "below the reference's own error");
    // At 2.25 s, 2.75 s, 4.25 s; the point at 5.25 s is beaten.
    let front: Vec<_> =
        pareto_front(&curves).iter().map(|(number, point)| (*number, point.spp)).collect();
    assert_eq!(front, [(0, 1), (1, 1), (0, 2)]);
    close(curves[0].error_at((2.25_f64 * 4.25).sqrt()).unwrap(), 0.1);
    assert_eq!(curves[0].error_at(2.0), None);

    let others = vec![Other { label: "other, \"one\"".into(), seconds: 3.0, rel_mse: 0.01 }];
    let study = Study {
        scene: "s".into(),
        reference,
        curves: curves.into(),
        biases: vec![None; 2],
        others,
    };
    let csv = study.csv();
    assert_eq!(csv.lines().count(), 1 + 5 + 1);
    assert!(
        csv.lines()
            .all(|line| line.replace("\"other, \"\"one\"\"\"", "o").split(',').count() == 11),
        "{csv}"
    );
    assert!(study.error_by_time().svg().contains("other, &quot;one&quot;"));
}

/// A bias by hand: two pictures and two parts of a reference, each pair with the same mean and variance in all pixels. Seen to
/// fail without the reference's own variance.
#[test]
fn bias_is_that_by_hand() {
    let size = UVec2::new(16, 24);
    let pool = |mean: f32, half: f32| {
        let mut pool = RunningMean::default();
        // The variance of the mean of two is the square of half their difference.
        for value in [mean - half, mean + half] {
            pool.add(&[Spectrum::splat(value); 16 * 24]);
        }
        pool
    };
    let (variance, own) = (0.02 * 0.02, 0.05 * 0.05);
    let reference = Reference::new(&pool(1.0, 0.05), size);
    // With half as many samples as the reference, pictures that saw all light have twice its variance.
    let bias = Bias::new(&pool(1.1, 0.02), &reference, 0.5);
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-5 * y, "{x}, expected {y}");
    let square = (0.1 * 0.1 - variance - own) / 1.01;
    close(bias.square.0, square);
    close(bias.error, square.sqrt());
    close(bias.mean.0, 0.1);
    let (both, pixels) = (2.0 * own + own, f64::from(size.element_product()));
    close(bias.square.1, 2.0_f64.sqrt() * both / 1.01 / pixels.sqrt());
    close(bias.mean.1, (both / pixels).sqrt());
}

/// A picture whose error is concentrated in few pixels is reported, with the place.
#[test]
fn rare_samples_are_not_trusted() {
    let mut pool = RunningMean::default();
    for part in 0..4 {
        let mut pixels = vec![Spectrum::splat(0.5 + 0.001 * part as f32); 2000];
        pixels[1234] = Spectrum::splat(if part == 2 { 100.0 } else { 0.5 });
        pool.add(&pixels);
    }
    let reference = Reference::new(&pool, UVec2::new(50, 40));
    let Some(Distrust::Rare { share, worst }) = reference.distrust() else {
        panic!("{:?}", reference.distrust());
    };
    assert!(*share > 0.9 && *worst == UVec2::new(34, 24), "{share} {worst}");
}

/// Pictures that miss rare bright samples look biased, but must not be reported as such: one sample in 2000 has all the
/// light of a pixel, and pictures of 4 samples mostly have none. Seen to fail with the scatter of the pictures alone.
#[test]
fn rare_samples_are_no_bias() {
    let picture = |seed: u64, samples: u64| -> Vec<Spectrum> {
        let pixel = |place: u64| {
            let id = |index| SampleId { pixel: UVec2::new(place as u32, 0), set: 0, index };
            let sampler = IndependentSampler::new(seed);
            let is_hit = |index: u64| sampler.get_1d(id(index as u32), 0) < 1.0 / 2000.0;
            let hits = (0..samples).filter(|&index| is_hit(index)).count();
            Spectrum::splat(2000.0 * hits as f32 / samples as f32)
        };
        (0..256).map(pixel).collect()
    };
    let mut truth = RunningMean::default();
    (0..8).for_each(|seed| truth.add(&picture(100 + seed, 4096)));
    let mut named = 0;
    for trial in 0..50 {
        let mut method = RunningMean::default();
        (0..8).for_each(|seed| method.add(&picture(1000 + 8 * trial + seed, 4)));
        let bias = Bias::new(&method, &Reference::new(&truth, UVec2::new(16, 16)), 4.0 / 4096.0);
        named += u32::from(bias.is_certain());
    }
    assert_eq!(named, 0, "of 50 unbiased methods");
}

/// A picture without all of its samples is not accepted as a run. Seen to fail with whatever the render returns taken for a picture.
#[test]
fn a_cancelled_render_is_no_run() {
    let (scene, view) = (scene(), view());
    let run = |cancel: bool| {
        let cancel = AtomicBool::new(cancel);
        let options = RenderOptions { cancel: Some(&cancel), ..RenderOptions::default() };
        let method = Method::of_settings(&scene, &view, "m", RenderSettings::default(), options);
        method.render(1, 0).map(|(image, _)| image.size)
    };
    assert_eq!(run(false), Ok(SIZE));
    assert_eq!(run(true), Err(RunError::Cancelled));
}

/// A running mean that is stored and loaded continues as if it had not been, up to f32.
#[test]
fn pools_go_on() {
    let picture = |n: u32| -> Vec<Spectrum> {
        (0..50).map(|i| Spectrum::splat(((i * 7 + n * 13) % 17) as f32 * 0.1)).collect()
    };
    let (mut all, mut first) = (RunningMean::default(), RunningMean::default());
    (0..5).for_each(|n| all.add(&picture(n)));
    (0..3).for_each(|n| first.add(&picture(n)));
    let (pixels, variance) = first.pixels();
    let image = lobe::image::Image {
        size: UVec2::new(10, 5),
        pixels,
        variance,
        degrees_of_freedom: first.degrees_of_freedom(),
        encoding: lobe::image::Encoding::Linear,
    };
    let mut again = RunningMean::from_image(&image, 3);
    (3..5).for_each(|n| again.add(&picture(n)));
    assert_eq!(again.count(), 5);
    let ((a, va), (b, vb)) = (all.pixels(), again.pixels());
    for (a, b) in a.iter().zip(&b).chain(va.unwrap().iter().zip(&vb.unwrap())) {
        assert!(
            (a.max_component() - b.max_component()).abs() <= 1e-6 * a.max_component().abs() + 1e-9,
            "{a:?} {b:?}"
        );
    }
}
