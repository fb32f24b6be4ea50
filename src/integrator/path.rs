//! [`PathIntegrator`]: path tracing. The loop and its stages are in this file, from top to bottom.
//!
//! Names are the letters of the equations: β path throughput divided by path density, f the BSDF, Li and Le
//! incident and emitted radiance, pdf densities, w the weight of multiple importance sampling. `wave/rules.rs` says
//! which stages a scene needs, and has the weight of light that a path finds; `wave/scatter.rs` has the stages of a block
//! of hits.

use std::sync::Arc;

use glam::Vec2;

use super::traits::{Estimator, Integrator, Read};
use super::wave::{
    PathList, PathRules, Paths, PathsAt, Stage, Vertices, Wave, dimension, for_each_escaped,
};
use crate::geometry::Ray;
use crate::interaction::{BLOCK, Hit};
use crate::light::{LightChoice, LightHit, LightStrategy};
use crate::params::{Choice, Fault, Key, Kind, Table};
use crate::sampling::{SampleId, Sampler};
use crate::scene::Scene;
use crate::spectrum::Spectrum;

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
    /// Russian roulette: from the third reflection on, paths that carry less than a quarter of what they began with are ended at random, and
    /// the weight of the survivors is raised to a quarter, so that the estimate stays unbiased.
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
        let Paths { first, list, hits: list_hits, by_hit, .. } = paths;
        let at = paths_at(depth, [first, list], rays, [hits, list_hits]);
        by_hit.partition(at.hits);
        if !rules.infinite.is_empty() {
            let escaped = |i: usize| by_hit.escaped[i] as usize;
            for_each_escaped(rules, scene, &at, by_hit.escaped.len(), escaped, |path, found| {
                radiance[at.samples[path] as usize] += found;
            });
        }
        if !rules.has_area_lights {
            return;
        }
        for i in by_hit.active.iter().map(|&i| i as usize) {
            let (path, ray, hit) = (&at.states[i], &at.rays[i], &at.hits[i]);
            if let Some(index) = scene.light_at(hit) {
                let (light, si) = (&scene.lights()[index], scene.interaction(ray, hit));
                // The surface point, not the offset ray origin: `sample_li` gets the same point.
                let hit = LightHit::on_surface(if at.at_camera { ray.o } else { path.p }, &si);
                // Light sampling cannot find paths from the camera or from delta events.
                let found_only = path.pdf == f32::INFINITY;
                let weighting = match found_only {
                    true => rules.weighting_found_only(index),
                    false => rules.weighting(index, path.p),
                };
                let needs_pdf = weighting.needs_pdf() && !found_only;
                let light_pdf = if needs_pdf { light.pdf_li(&hit) } else { 1.0 };
                let weight = weighting.weight(path.pdf, light_pdf);
                if weight != 0.0 {
                    let found = Spectrum::from(path.beta) * light.le(&hit) * weight;
                    radiance[at.samples[i] as usize] += found;
                }
            }
        }
    }

    /// Generates the sample values of the active paths.
    #[inline(never)]
    fn draw_samples(&self, sampler: &dyn Sampler, ids: &[SampleId], paths: &mut Paths, depth: u32) {
        let rules = &self.rules;
        let Paths { first, list, by_hit, values, .. } = paths;
        let samples = if depth == 0 { first } else { list }.samples.as_slice();
        if !(rules.samples_direction(depth) || rules.needs_light_u || rules.lights.draws()) {
            return;
        }
        values.ids.clear();
        values.ids.extend(by_hit.active.iter().map(|&i| ids[samples[i as usize] as usize]));
        // Previous contents are overwritten.
        let (first, count) = (dimension::of_depth(depth), values.ids.len());
        if rules.samples_direction(depth) {
            values.direction.resize(count, Vec2::ZERO);
            sampler.fill_2d(&values.ids, first + dimension::DIRECTION, &mut values.direction);
        }
        if rules.needs_light_u {
            values.light.resize(count, Vec2::ZERO);
            sampler.fill_2d(&values.ids, first + dimension::LIGHT, &mut values.light);
        }
        if rules.lights.draws() {
            values.choice.resize(count, 0.0);
            sampler.fill_1d(&values.ids, first + dimension::CHOICE, &mut values.choice);
        }
        if rules.uses_roulette(depth) {
            values.roulette.resize(count, 0.0);
            sampler.fill_1d(&values.ids, first + dimension::ROULETTE, &mut values.roulette);
        }
    }

    /// Samples lights and new directions at the hits: shadow rays and the next rays.
    #[inline(never)]
    fn scatter(&self, sampler: &dyn Sampler, wave: &mut Wave, depth: u32) {
        let Self { scene, rules } = self;
        let Wave { rays, hits, paths, shadow, arena, counters, cone, .. } = wave;
        let cone = cone.as_ref();
        let Paths { first, list, hits: list_hits, next, by_hit, by_material, values } = paths;
        let at = paths_at(depth, [first, list], rays, [hits, list_hits]);
        let active = &by_hit.active[..];
        by_material
            .sort(active.len(), |vertex| scene.material_at(&at.hits[active[vertex] as usize]));
        let mut vertices = Vertices::new(Stage {
            rules,
            scene,
            sampler,
            arena,
            cone,
            depth,
            paths: at,
            active,
            values,
        });
        for (material, range) in by_material.runs() {
            for block in by_material.order()[range].chunks(BLOCK) {
                vertices.fill(material, block);
                for slot in 0..rules.lights.slots() {
                    vertices.sample_lights(slot, shadow);
                }
                if rules.samples_direction(depth) {
                    vertices.sample_directions(next);
                }
                counters.rejected += vertices.take_rejected();
            }
        }
        drop(vertices);
        arena.reset();
        if !rules.extends_path(depth) {
            // Only infinite lights are left to be hit: shadow rays test whether they are visible.
            let paths = next.view();
            for_each_escaped(
                rules,
                scene,
                &paths,
                paths.rays.len(),
                |i| i,
                |path, found| {
                    if !found.is_black() {
                        shadow.push(paths.samples[path] as usize, paths.rays[path], found);
                    }
                },
            );
            next.clear();
        }
    }
}

/// The paths at a depth: at the camera those of the wave, with its rays and hits.
fn paths_at<'a>(
    depth: u32,
    [first, list]: [&'a PathList; 2],
    rays: &'a [Ray],
    [hits, list_hits]: [&'a [Hit]; 2],
) -> PathsAt<'a> {
    match depth {
        0 => PathsAt { rays, hits, at_camera: true, ..first.view() },
        _ => PathsAt { hits: list_hits, ..list.view() },
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
