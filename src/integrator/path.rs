//! [`PathIntegrator`]: path tracing. The loop and its stages are in this file, from top to bottom.
//!
//! Names are the letters of the equations: β path throughput divided by path density, f the BSDF, Li and Le
//! incident and emitted radiance, pdf densities, w the weight of multiple importance sampling. `wave/rules.rs` says
//! which stages a scene needs, and has the weight of light that a path finds; `wave/vertices.rs` has the last stage
//! again, for four flat Lambertian hits at a time.

use std::sync::Arc;

use arrayvec::ArrayVec;

use super::traits::{Estimator, Integrator, Read};
use super::wave::flat::{BLOCK, Fetched, FlatHits};
use super::wave::{Path, PathRules, Paths, Vertices, Wave, dimension, power_heuristic};
use crate::accel::Hit;
use crate::bxdf::BxdfFlags;
use crate::geometry::Ray;
use crate::geometry::four::four;
use crate::light::{LightChoice, LightHit, LightSample, LightStrategy};
use crate::params::{Choice, Fault, Key, Kind, Table};
use crate::sampling::{SampleId, Sampler};
use crate::scene::Scene;

/// Unidirectional path tracing with next-event estimation (PBRT 3rd edition, section 14.5.4): each hit samples
/// a light, and the path may also hit lights itself. Multiple importance sampling combines both
/// (section 13.10.1).
///
/// With several lights, one is selected at each hit: see [`LightSampler`](crate::light::LightSampler). The
/// estimate is unbiased up to `max_depth` reflections.
#[doc(alias = "path tracer")]
#[doc(alias = "global illumination")]
#[doc(alias = "russian roulette")]
#[doc(alias = "next-event estimation")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathIntegrator {
    /// Maximum number of reflections and refractions: 0 shows only light sources, 1 is direct light. Longer paths
    /// are left out, which darkens scenes with much interreflection. (A faceted glass ball in a white furnace,
    /// which should give 1, gives 0.9976 with 64 and 1.0000 with 8192.)
    pub max_depth: u32,
    /// Russian roulette: from the fourth reflection on, paths of low throughput are ended at random, and the
    /// weight of the survivors is increased, so that the estimate stays unbiased.
    #[doc(alias = "russian roulette")]
    pub roulette: bool,
    /// How directions to lights are sampled.
    pub strategy: LightStrategy,
}

impl PathIntegrator {
    /// Up to `max_depth` reflections, with Russian roulette and the strategy [`LightStrategy::Auto`].
    pub const fn new(max_depth: u32) -> Self {
        Self { max_depth, roulette: true, strategy: LightStrategy::Auto }
    }
}

impl Default for PathIntegrator {
    /// Five reflections, as in PBRT.
    fn default() -> Self {
        Self::new(MAX_DEPTH.default_value())
    }
}

impl Integrator for PathIntegrator {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        let Self { max_depth, roulette, strategy } = *self;
        Box::new(PathTracer::new(scene, max_depth, roulette, strategy, LightChoice::One))
    }

    fn describe(&self) -> String {
        let Self { max_depth, roulette, strategy } = *self;
        let (name, strategy) = (KIND.name, strategy.name());
        let roulette = if roulette { "roulette" } else { "no roulette" };
        format!("{name}, up to {max_depth} reflections, {roulette}, strategy {strategy}")
    }
}

/// A path integrator prepared for one scene.
pub(super) struct PathTracer<'a> {
    scene: &'a Scene,
    rules: PathRules,
}

impl<'a> PathTracer<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        max_depth: u32,
        roulette: bool,
        strategy: LightStrategy,
        choice: LightChoice,
    ) -> Self {
        Self { scene, rules: PathRules::new(scene, max_depth, roulette, strategy, choice) }
    }
}

impl Estimator for PathTracer<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        let Self { scene, rules } = self;
        if !rules.has_lights() {
            return;
        }
        wave.paths.start(wave.rays.len());
        for depth in 0..=rules.max_depth {
            // L += β Le w, for lights that the rays hit.
            self.add_emitted(wave, depth);
            let is_last = depth == rules.max_depth || wave.paths.by_hit.active.is_empty();
            // Nothing but this ends paths among white walls, if there is no roulette and no limit.
            if is_last || wave.is_cancelled() {
                break;
            }
            // Sample values, dimension by dimension.
            self.draw_samples(sampler, &wave.ids, &mut wave.paths, depth);
            // Shadow rays that carry β f Li |cos θ| w / pdf, and next rays with β f |cos θ| / pdf.
            self.scatter(sampler, wave, depth);
            // L += the radiance that a shadow ray carries, if it is not occluded.
            wave.counters.shadow_rays += wave.shadow.trace(scene, &mut wave.radiance);
            // Closest hits of the next rays.
            wave.counters.scattered_rays += wave.paths.trace(scene);
        }
    }

    /// One for each light sample, and a last one to the environment.
    fn shadow_rays(&self) -> usize {
        self.rules.lights.slots() + 1
    }
}

impl PathTracer<'_> {
    /// Partitions paths by what their rays hit, and adds the emission of lights among the hits.
    #[inline(never)]
    fn add_emitted(&self, wave: &mut Wave, depth: u32) {
        let Self { scene, rules } = self;
        let Wave { rays, hits, radiance, paths, .. } = wave;
        let Paths { first, states, by_hit, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        by_hit.partition(scene, hits);
        if !rules.infinite.is_empty() {
            for i in by_hit.escaped.iter().map(|&i| i as usize) {
                let (path, ray) = (&states[i], &rays[i]);
                let origin = if depth == 0 { ray.o } else { path.p };
                radiance[path.sample as usize] += rules.escaped(scene, origin, ray.d, path);
            }
        }
        if !rules.has_area_lights {
            return;
        }
        for i in by_hit.active.iter().map(|&i| i as usize) {
            let (path, ray, hit) = (&states[i], &rays[i], &hits[i]);
            if let Some(light) = scene.light_at(hit) {
                let si = scene.interaction(ray, hit);
                // The surface point, not the offset ray origin: `sample_li` gets the same point.
                let origin = if depth == 0 { ray.o } else { path.p };
                let at = LightHit::on_surface(origin, &si);
                radiance[path.sample as usize] += rules.emitted(scene, light, &at, path);
            }
        }
    }

    /// Generates the sample values of the active paths.
    #[inline(never)]
    fn draw_samples(&self, sampler: &dyn Sampler, ids: &[SampleId], paths: &mut Paths, depth: u32) {
        let rules = &self.rules;
        let Paths { first, states, by_hit, values, .. } = paths;
        let states = if depth == 0 { first } else { states };
        if !(rules.samples_direction(depth) || rules.needs_light_u || rules.lights.draws()) {
            return;
        }
        values.ids.clear();
        values.ids.extend(by_hit.active.iter().map(|&i| ids[states[i as usize].sample as usize]));
        let first = dimension::of_depth(depth);
        if rules.samples_direction(depth) {
            sampler.fill_2d(&values.ids, first + dimension::DIRECTION, &mut values.direction);
        }
        if rules.needs_light_u {
            sampler.fill_2d(&values.ids, first + dimension::LIGHT, &mut values.light);
        }
        if rules.lights.draws() {
            sampler.fill_1d(&values.ids, first + dimension::CHOICE, &mut values.choice);
        }
        if rules.uses_roulette(depth) {
            sampler.fill_1d(&values.ids, first + dimension::ROULETTE, &mut values.roulette);
        }
    }

    /// Samples lights and new directions at the hits: shadow rays and the next rays.
    #[inline(never)]
    fn scatter(&self, sampler: &dyn Sampler, wave: &mut Wave, depth: u32) {
        let Self { scene, rules } = self;
        let Wave { rays, hits, paths, shadow, arena, counters, .. } = wave;
        let Paths { first, states, by_hit, values, next_states, next_rays, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        let at = |i: u32| {
            let i = i as usize;
            (&states[i], &rays[i], &hits[i])
        };
        let mut vertices = Vertices {
            rules,
            scene,
            sampler,
            values,
            depth,
            shadow,
            next_states,
            next_rays,
            arena,
            rejected: 0,
        };
        // Flat Lambertian hits, four at a time, in three short loops: out-of-order execution then overlaps
        // several iterations of each. `lane` is the index of a hit in its block.
        let mut fetched = Fetched::new();
        let mut flat = ArrayVec::<_, { BLOCK / 4 }>::new();
        let (fours, _) = by_hit.active[..by_hit.flat].as_chunks::<4>();
        for (block, fours) in fours.chunks(BLOCK / 4).enumerate() {
            for (lane, &path) in fours.as_flattened().iter().enumerate() {
                let (_, ray, hit) = at(path);
                fetched.set(lane, scene, ray, hit);
            }
            flat.clear();
            for (i, paths) in fours.iter().enumerate() {
                flat.push(FlatHits::new(&fetched, i, four(|lane| at(paths[lane]).0)));
            }
            vertices.scatter_flat(BLOCK * block, &flat);
            for (i, _) in flat.iter().enumerate().filter(|(_, hits)| !hits.sound) {
                for (vertex, &path) in (BLOCK * block + 4 * i..).zip(&fours[i]) {
                    scatter_one(&mut vertices, vertex, at(path));
                }
            }
        }
        // All others, one by one.
        for (vertex, &path) in by_hit.active.iter().enumerate().skip(4 * fours.len()) {
            scatter_one(&mut vertices, vertex, at(path));
        }
        counters.rejected += vertices.rejected;
        arena.reset();
    }
}

/// Scatters one path at one vertex: light samples, and the next ray.
#[inline(never)]
fn scatter_one(vertices: &mut Vertices, vertex: usize, (path, ray, hit): (&Path, &Ray, &Hit)) {
    let Vertices { rules, scene, sampler, values, depth, arena, .. } = *vertices;
    let mut si = scene.interaction(ray, hit);
    let bsdf = scene.bsdf(hit, &mut si, arena);
    let (wo, beta, all) = (si.wo(), path.beta, BxdfFlags::all());

    // Light samples, each weighted against hitting the light by BSDF sampling: β f Li |cos θ| w / pdf.
    for slot in 0..rules.lights.slots() {
        let (index, u) = vertices.choose_light(slot, vertex);
        let light = &*scene.lights()[index];
        let Some(LightSample { li, wi, pdf, from }) = light.sample_li(si.p(), u) else { continue };
        let pdf = pdf * rules.lights.probability(index);
        let (f, w) = if rules.uses_mis(index) {
            let (f, scattering_pdf) = bsdf.f_and_pdf(wo, wi, all);
            (f, power_heuristic(pdf, scattering_pdf))
        } else {
            (bsdf.f(wo, wi, all), 1.0)
        };
        // No shadow ray for light that is not reflected.
        if !f.is_black() {
            let carried = beta * f * li * (bsdf.abs_cos_theta(wi) * w / pdf);
            let ray = from.map_or_else(|| si.spawn_ray(wi), |from| si.spawn_ray_to(from));
            vertices.shadow.push(path.sample as usize, ray, carried);
        }
    }

    // The next direction: β f |cos θ| / pdf.
    let sample = rules.samples_direction(depth).then(|| {
        let uc = match bsdf.uses_uc() {
            true => sampler.get_1d(values.ids[vertex], dimension::event(depth)),
            false => f32::NAN,
        };
        bsdf.sample_f(wo, uc, values.direction[vertex], all)
    });
    vertices.rejected += u64::from(bsdf.rejected());
    let Some(sample) = sample.flatten() else { return };
    let mut next = Path {
        beta: beta * sample.f * (bsdf.abs_cos_theta(sample.wi) / sample.pdf),
        p: si.p(),
        // Light sampling cannot find the direction of a delta event: its weight has to be 1.
        pdf: if sample.is_specular() { f32::INFINITY } else { sample.pdf },
        eta_scale: path.eta_scale * sample.eta * sample.eta,
        sample: path.sample,
    };
    if next.beta.is_black()
        || !rules.contributes(depth, sample.is_specular())
        || (rules.uses_roulette(depth) && !next.survives(values.roulette[vertex]))
    {
        return;
    }
    let ray = si.spawn_ray(sample.wi);
    if rules.extends_path(depth) {
        vertices.next_states.push(next);
        vertices.next_rays.push(ray);
    } else {
        // Only infinite lights are left to be hit: a shadow ray tests whether they are visible.
        let found = rules.escaped(scene, next.p, sample.wi, &next);
        if !found.is_black() {
            vertices.shadow.push(next.sample as usize, ray, found);
        }
    }
}

/// PBRT's default.
const MAX_DEPTH: Key<u32> =
    Key::new("max_depth", "maximum number of reflections and refractions").default(5);
const ROULETTE: Key<bool> =
    Key::new("roulette", "Russian roulette: whether paths of low throughput end at random")
        .default(true);

/// `type = "path"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "path",
    meaning: "Light that is reflected up to max_depth times",
    keys: &[&MAX_DEPTH, &ROULETTE, &LightStrategy::KEY],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Integrator>, Fault> {
    Ok(Arc::new(PathIntegrator {
        max_depth: table.get(&MAX_DEPTH)?,
        roulette: table.get(&ROULETTE)?,
        strategy: table.get(&LightStrategy::KEY)?,
    }))
}
