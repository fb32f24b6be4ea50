//! [`PathIntegrator`]: light of any number of reflections. The whole path tracer, from top to bottom.
//!
//! Letters are those of the equations: β path throughput divided by path density, f the Bsdf, Li and Le light
//! that arrives and is emitted, p densities, w the weight of multiple importance sampling. `wave/` has what
//! the stages work on, and the same stages for four flat Lambertian hits at a time.

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

/// Unidirectional path tracing with next-event estimation: at each hit a light is sampled, and the path also
/// finds lights by itself (PBRT 3rd edition, section 14.5.4). Both are weighed by multiple importance sampling
/// (section 13.10.1).
///
/// With several lights, one is drawn at each hit: see [`LightSampler`](crate::light::LightSampler). The
/// estimate is unbiased up to `max_depth` reflections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathIntegrator {
    /// The most times that light is reflected or refracted: 0 shows the lights alone, 1 is direct light. Light
    /// that takes longer is left out, which darkens what is bright by many reflections. (A faceted ball of
    /// glass in a white furnace, which should give 1, gives 0.9976 with 64 and 1.0000 with 8192.)
    pub max_depth: u32,
    /// Russian roulette: from the fourth reflection on, paths with little throughput end at random, and the
    /// survivors are weighted up, so that nothing is lost on average.
    pub roulette: bool,
    /// How the directions that light comes from are drawn.
    pub strategy: LightStrategy,
}

impl PathIntegrator {
    /// Up to `max_depth` reflections, with Russian roulette and the strategy that suits each light.
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

/// Paths through one scene.
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
        if !rules.finds_light() {
            return;
        }
        wave.paths.start(wave.rays.len());
        for depth in 0..=rules.max_depth {
            // L += β Le w, of the lights that the rays have met.
            self.add_emitted(wave, depth);
            if depth == rules.max_depth || wave.paths.met.active.is_empty() {
                break;
            }
            // Uniform numbers, dimension by dimension.
            self.draw_samples(sampler, &wave.ids, &mut wave.paths, depth);
            // Shadow rays that carry β f Li |cos θ| w / p, and next rays with β f |cos θ| / p.
            self.scatter(sampler, wave, depth);
            // L += what a shadow ray carries, where nothing stands between.
            wave.counters.shadow_rays += wave.shadow.trace(scene, &mut wave.radiance);
            // The surfaces that the next rays meet.
            wave.counters.scattered_rays += wave.paths.trace(scene);
        }
    }

    /// One to each light that is asked, and a last one into the sky.
    fn shadow_rays(&self) -> usize {
        self.rules.lights.slots() + 1
    }
}

impl PathTracer<'_> {
    /// Sorts paths by what their rays hit, and adds the emission of lights that they hit.
    #[inline(never)]
    fn add_emitted(&self, wave: &mut Wave, depth: u32) {
        let Self { scene, rules } = self;
        let Wave { rays, hits, radiance, paths, .. } = wave;
        let Paths { first, states, met, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        met.sort(scene, hits);
        if !rules.infinite.is_empty() {
            for place in met.escaped.iter().map(|&place| place as usize) {
                let (path, ray) = (&states[place], &rays[place]);
                let origin = if depth == 0 { ray.o } else { path.p };
                radiance[path.sample as usize] += rules.escaped(scene, origin, ray.d, path);
            }
        }
        if !rules.on_surfaces {
            return;
        }
        for place in met.active.iter().map(|&place| place as usize) {
            let (path, ray, hit) = (&states[place], &rays[place], &hits[place]);
            if let Some(light) = scene.light_at(hit) {
                let si = scene.interaction(ray, hit);
                // The surface point, not the offset ray origin: `sample_li` is asked about it, too.
                let origin = if depth == 0 { ray.o } else { path.p };
                let at = LightHit::on_surface(origin, &si);
                radiance[path.sample as usize] += rules.found(scene, light, &at, path);
            }
        }
    }

    /// Sample values for the paths that go on.
    #[inline(never)]
    fn draw_samples(&self, sampler: &dyn Sampler, ids: &[SampleId], paths: &mut Paths, depth: u32) {
        let rules = &self.rules;
        let Paths { first, states, met, values, .. } = paths;
        let states = if depth == 0 { first } else { states };
        if !(rules.goes_on(depth) || rules.has_places || rules.lights.draws()) {
            return;
        }
        values.ids.clear();
        values
            .ids
            .extend(met.active.iter().map(|&place| ids[states[place as usize].sample as usize]));
        let first = dimension::of_depth(depth);
        if rules.goes_on(depth) {
            sampler.fill_2d(&values.ids, first + dimension::DIRECTION, &mut values.direction);
        }
        if rules.has_places {
            sampler.fill_2d(&values.ids, first + dimension::LIGHT, &mut values.light);
        }
        if rules.lights.draws() {
            sampler.fill_1d(&values.ids, first + dimension::CHOICE, &mut values.choice);
        }
        if rules.throws(depth) {
            sampler.fill_1d(&values.ids, first + dimension::ROULETTE, &mut values.roulette);
        }
    }

    /// Samples lights and new directions at the hits: shadow rays and the next rays.
    #[inline(never)]
    fn scatter(&self, sampler: &dyn Sampler, wave: &mut Wave, depth: u32) {
        let Self { scene, rules } = self;
        let Wave { rays, hits, paths, shadow, arena, counters, .. } = wave;
        let Paths { first, states, met, values, next_states, next_rays, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        let at = |place: u32| {
            let place = place as usize;
            (&states[place], &rays[place], &hits[place])
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
        // several iterations of each.
        let mut fetched = Fetched::new();
        let mut flat = ArrayVec::<_, { BLOCK / 4 }>::new();
        let (fours, _) = met.active[..met.flat].as_chunks::<4>();
        for (block, fours) in fours.chunks(BLOCK / 4).enumerate() {
            for (i, &place) in fours.as_flattened().iter().enumerate() {
                let (_, ray, hit) = at(place);
                fetched.set(i, scene, ray, hit);
            }
            flat.clear();
            for (i, places) in fours.iter().enumerate() {
                flat.push(FlatHits::new(&fetched, i, four(|i| at(places[i]).0)));
            }
            vertices.scatter_flat(BLOCK * block, &flat);
            for (i, _) in flat.iter().enumerate().filter(|(_, hits)| !hits.sound) {
                for (turn, &place) in (BLOCK * block + 4 * i..).zip(&fours[i]) {
                    scatter_one(&mut vertices, turn, at(place));
                }
            }
        }
        // All others, one by one.
        for (turn, &place) in met.active.iter().enumerate().skip(4 * fours.len()) {
            scatter_one(&mut vertices, turn, at(place));
        }
        counters.rejected += vertices.rejected;
        arena.reset();
    }
}

/// One vertex of one path: light samples, and the next ray.
#[inline(never)]
fn scatter_one(vertices: &mut Vertices, turn: usize, (path, ray, hit): (&Path, &Ray, &Hit)) {
    let Vertices { rules, scene, sampler, values, depth, arena, .. } = *vertices;
    let mut si = scene.interaction(ray, hit);
    let bsdf = scene.bsdf(hit, &mut si, arena);
    let (wo, beta, all) = (si.wo(), path.beta, BxdfFlags::all());

    // Light samples, weighed against finding the light by reflection: β f Li |cos θ| w / p.
    for slot in 0..rules.lights.slots() {
        let (number, u) = vertices.drawn(slot, turn);
        let light = &*scene.lights()[number];
        let Some(LightSample { li, wi, pdf, from }) = light.sample_li(si.p(), u) else { continue };
        let pdf = pdf * rules.lights.probability(number);
        let (f, w) = if rules.weighs(number) {
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

    // The next direction: β f |cos θ| / p.
    let sample = rules.goes_on(depth).then(|| {
        let uc = match bsdf.uses_uc() {
            true => sampler.get_1d(values.ids[turn], dimension::event(depth)),
            false => f32::NAN,
        };
        bsdf.sample_f(wo, uc, values.direction[turn], all)
    });
    vertices.rejected += u64::from(bsdf.rejected());
    let Some(sample) = sample.flatten() else { return };
    let mut next = Path {
        beta: beta * sample.f * (bsdf.abs_cos_theta(sample.wi) / sample.pdf),
        p: si.p(),
        // Light sampling never finds the direction of a delta lobe: no weight for it.
        pdf: if sample.is_specular() { f32::INFINITY } else { sample.pdf },
        eta_scale: path.eta_scale * sample.eta * sample.eta,
        sample: path.sample,
    };
    if next.beta.is_black() || (rules.throws(depth) && !next.survives(values.roulette[turn])) {
        return;
    }
    let ray = si.spawn_ray(sample.wi);
    if rules.walks_on(depth) {
        vertices.next_states.push(next);
        vertices.next_rays.push(ray);
    } else {
        // Only lights that surround the scene are left to be found: a shadow ray tells whether they are.
        let found = rules.escaped(scene, next.p, sample.wi, &next);
        if !found.is_black() {
            vertices.shadow.push(next.sample as usize, ray, found);
        }
    }
}

/// As many as in PBRT by default.
const MAX_DEPTH: Key<u32> =
    Key::new("max_depth", "the most times that light is reflected").default(5);
const ROULETTE: Key<bool> =
    Key::new("roulette", "whether paths that carry little end at random").default(true);

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
