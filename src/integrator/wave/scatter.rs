//! [`Vertices`]: a block of path vertices, and the stages that turn its hits into shadow rays and next rays.

use glam::Vec2;

use super::dimension;
use super::escape::Escaped;
use super::paths::{Path, PathList, PathsWide, Values};
use super::pushed::MOST;
use super::rules::{PathRules, power_heuristic};
use super::shadow_rays::ShadowRays;
use crate::accel::Hit;
use crate::bxdf::{Arena, BsdfBlock, BsdfSamples};
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::geometry::{Bounded, Ray, Xyz};
use crate::interaction::{FoundHits, HitBlock};
use crate::light::{LightSamples, Receivers};
use crate::sampling::{SampleId, Sampler};
use crate::scene::Scene;
use crate::simd::{
    Block, BlockKernel, LaneMask, ROW, Row, RowMask, Rows, groups, indices, lanes_within,
};
use crate::spectrum::Bands;

/// What the stages of all blocks at one depth read.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    pub rules: &'a PathRules,
    pub scene: &'a Scene,
    pub sampler: &'a dyn Sampler,
    pub arena: &'a Arena,
    pub depth: u32,
    /// The paths, with the ray and the hit of each.
    pub states: &'a [Path],
    pub samples: &'a [u32],
    pub rays: &'a [Ray],
    pub hits: &'a [Hit],
    /// Those that hit a surface, and their sample values. A *vertex* is an index into either.
    pub active: &'a [u32],
    pub values: &'a Values,
}

/// A block of path vertices on one material. Row element i belongs to `vertices[i]`.
pub struct Vertices<'a> {
    stage: Stage<'a>,
    hits: HitBlock<'a>,
    bsdfs: BsdfBlock<'a>,
    len: usize,
    vertices: [u32; ROW],
    /// The path of each.
    paths: [u32; ROW],
    lights: LightSamples,
    /// 1 where multiple importance sampling weights the light sample, else 0.
    is_weighed: Row,
    f: Rows<3>,
    pdf: Row,
    u: [Vec2; ROW],
    samples: BsdfSamples,
    next: Escaped,
    eta_scale: Row,
}

impl<'a> Vertices<'a> {
    /// An empty block.
    pub fn new(stage: Stage<'a>) -> Self {
        let row = Row::splat(0.0);
        Self {
            stage,
            hits: stage.scene.hit_block(),
            bsdfs: BsdfBlock::new(),
            len: 0,
            vertices: [0; ROW],
            paths: [0; ROW],
            lights: LightSamples::new(),
            is_weighed: row,
            f: Rows::splat(0.0),
            pdf: row,
            u: [Vec2::ZERO; ROW],
            samples: BsdfSamples::new(),
            next: Escaped::new(),
            eta_scale: row,
        }
    }

    /// Replaces the block by vertices on this material: fetches the hits, computes their geometry, textures and lobes.
    pub fn fill(&mut self, material: u32, vertices: &[u32]) {
        let Stage { scene, arena, rays, hits, active, .. } = self.stage;
        self.len = vertices.len();
        self.vertices[..self.len].copy_from_slice(vertices);
        for (path, &vertex) in self.paths.iter_mut().zip(vertices) {
            *path = active[vertex as usize];
        }
        self.hits.fill(&HitsOfPaths { paths: &self.paths[..self.len], hits, rays });
        scene.scatter_block(material, &mut self.hits, arena, &mut self.bsdfs);
    }

    /// Takes the number of [rejected](crate::bxdf::Bsdf::rejected) results of the block's lobes.
    pub fn take_rejected(&mut self) -> u64 {
        self.bsdfs.take_rejected()
    }

    /// Samples the light of a slot at each vertex, or the light that it selects, and adds shadow rays that carry
    /// β f Li |cos θ| w / pdf.
    pub fn sample_lights(&mut self, slot: usize, shadow: &mut ShadowRays) {
        let Stage { rules, scene, states, samples, .. } = self.stage;
        self.draw_light_points(slot);
        if rules.lights.draws() {
            self.sample_drawn_lights();
        } else {
            let light = rules.lights.pick(slot, 0.0);
            self.is_weighed = Row::splat(f32::from(rules.uses_mis(light)));
            let receivers = Receivers {
                instruction_set: scene.instruction_set(),
                len: self.len,
                p: self.hits.p(),
                u: &self.u,
            };
            scene.lights()[light].sample_li_block(&receivers, &mut self.lights);
        }
        let Self { hits, bsdfs, lights, f, pdf, is_weighed, paths, .. } = self;
        bsdfs.f_and_pdf(hits, &lights.wi, [&lights.pdf, is_weighed], f, pdf);
        let carry = Carry { hits, lights, f, pdf, is_weighed, paths, states, samples, shadow };
        scene.instruction_set().run_block(carry);
    }

    /// The sample values for points on the light of a slot.
    fn draw_light_points(&mut self, slot: usize) {
        let Stage { rules, sampler, values, .. } = self.stage;
        if !rules.needs_light_u {
            return;
        }
        for (u, &vertex) in self.u.iter_mut().zip(&self.vertices[..self.len]) {
            *u = match slot {
                0 => values.light[vertex as usize],
                _ => {
                    let dimension = dimension::MORE_LIGHTS + slot as u32 - 1;
                    sampler.get_2d(values.ids[vertex as usize], dimension)
                }
            };
        }
    }

    /// Samples the light that each vertex selects: all vertices with the same light together.
    fn sample_drawn_lights(&mut self) {
        let Stage { rules, scene, values, .. } = self.stage;
        let mut drawn = [0; ROW];
        for (light, &vertex) in drawn.iter_mut().zip(&self.vertices[..self.len]) {
            *light = rules.lights.pick(0, values.choice[vertex as usize]);
        }
        let mut left = RowMask::MAX >> (ROW - self.len);
        let (mut p, mut u) = (Rows::splat(0.0), [Vec2::ZERO; ROW]);
        let mut samples = LightSamples::new();
        while left != 0 {
            let light = drawn[left.trailing_zeros() as usize];
            let same =
                (0..self.len).fold(0, |same, i| same | RowMask::from(drawn[i] == light) << i);
            for (to, from) in indices(same).enumerate() {
                p.set(to, self.hits.p().get(from));
                u[to] = self.u[from];
            }
            let (instruction_set, len) = (scene.instruction_set(), same.count_ones() as usize);
            let receivers = Receivers { instruction_set, len, p: &p, u: &u };
            scene.lights()[light].sample_li_block(&receivers, &mut samples);
            let probability = rules.lights.probability(light);
            for (from, to) in indices(same).enumerate() {
                self.lights.copy(to, &samples, from, probability);
                self.is_weighed.set(to, f32::from(rules.uses_mis(light)));
            }
            left &= !same;
        }
    }

    /// Samples the next direction of each path: a ray with β f |cos θ| / pdf, if it can contribute.
    pub fn sample_directions(&mut self, next: &mut PathList, shadow: &mut ShadowRays) {
        let Stage { rules, scene, sampler, values, depth, states, samples, .. } = self.stage;
        let set = scene.instruction_set();
        let of_block = &self.vertices[..self.len];
        for (u, &vertex) in self.u.iter_mut().zip(of_block) {
            *u = values.direction[vertex as usize];
        }
        let uc = |i: usize| {
            let id: SampleId = values.ids[of_block[i] as usize];
            sampler.get_1d(id, dimension::event(depth))
        };
        self.bsdfs.sample_f(&self.hits, uc, &self.u, &mut self.samples);
        let mut roulette = None;
        if rules.uses_roulette(depth) {
            let row = roulette.insert(Row::splat(0.0));
            for (i, &vertex) in of_block.iter().enumerate() {
                row.set(i, values.roulette[vertex as usize]);
            }
        }
        let Self { hits, samples: directions, paths, next: ahead, eta_scale, .. } = self;
        let mask = set.run_block(Advance {
            hits,
            directions,
            paths,
            states,
            roulette: roulette.as_ref(),
            specular_only: !rules.contributes(depth, false),
            next: ahead,
            eta_scale,
        });
        if rules.extends_path(depth) {
            let push =
                PushNext { hits, directions, paths, samples, mask, from: ahead, eta_scale, next };
            set.run_block(push);
            return;
        }
        // Only infinite lights are left to be hit: a shadow ray tests whether they are visible.
        ahead.find(rules, scene, hits.len(), &directions.wi, true);
        let push = PushEscaped { hits, directions, paths, samples, mask, from: ahead, shadow };
        set.run_block(push);
    }
}

/// The hits of some paths.
struct HitsOfPaths<'a, 'b> {
    paths: &'b [u32],
    hits: &'a [Hit],
    rays: &'a [Ray],
}

impl<'a> FoundHits<'a> for HitsOfPaths<'a, '_> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.paths.len()
    }
    #[inline(always)]
    fn place(&self, i: usize) -> [u32; 2] {
        let Hit { shape, triangle, .. } = self.hits[self.paths[i] as usize];
        [shape, triangle]
    }
    #[inline(always)]
    fn t_and_b(&self, i: usize) -> &'a [f32; 4] {
        // The words of shape and triangle have no meaning as numbers, and are left out.
        let words: &[f32; 6] = bytemuck::cast_ref(&self.hits[self.paths[i] as usize]);
        words.first_chunk().expect("more than four words")
    }
    #[inline(always)]
    fn ray(&self, i: usize) -> &'a Ray {
        &self.rays[self.paths[i] as usize]
    }
}

/// Adds the shadow rays of light samples.
struct Carry<'a> {
    hits: &'a HitBlock<'a>,
    lights: &'a LightSamples,
    f: &'a Rows<3>,
    pdf: &'a Row,
    is_weighed: &'a Row,
    paths: &'a [u32; ROW],
    states: &'a [Path],
    samples: &'a [u32],
    shadow: &'a mut ShadowRays,
}

impl BlockKernel for Carry<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { hits, lights, f, pdf, is_weighed, paths, states, samples, shadow } = self;
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        for at in groups::<F>(hits.len()) {
            let (f, light_pdf) = (Bands::<F>(f.load(at)), lights.pdf.load::<F>(at));
            let exists = light_pdf.gt(zero) & !f.is_black();
            let mask = exists.bits() & lanes_within::<F>(at, hits.len());
            if mask == 0 {
                continue;
            }
            let of_hits = hits.load::<F>(at);
            let wi = Xyz::from(lights.wi.load(at));
            let weighed = is_weighed.load::<F>(at).gt(zero);
            let weight = F::select(weighed, power_heuristic(light_pdf, pdf.load(at)), one);
            let factor = wi.dot(of_hits.shading_n).abs() * weight / light_pdf;
            let beta = PathsWide::gather(|lane| &states[paths[at + lane] as usize]).beta;
            let Bands([r, g, b]) = beta * f * Bands(lights.li.load(at)) * factor;
            let (point, n) = (hits.points::<F>(at), of_hits.n);
            let (from, t_max) = (Xyz::from(lights.from.load(at)), lights.t_max.load::<F>(at));
            let is_near = t_max.le(F::splat(ONE_MINUS_EPSILON));
            let o = point.ray_origin(n, Xyz::select(is_near, from - point.p, wi));
            let d = Xyz::select(is_near, from - o, wi);
            let mut rays = [[0.0; 8]; MOST];
            F::scatter([o.x, o.y, o.z, zero, d.x, d.y, d.z, t_max], &mut rays);
            let mut carried = [[0.0; 4]; MOST];
            F::scatter4([r, g, b, zero], &mut carried);
            let ids = samples_of::<F>(samples, paths, at);
            shadow.push_some(mask, &ids[..F::LANES], &rays[..F::LANES], &carried[..F::LANES]);
        }
    }
}

/// The samples of the paths in the lanes from `at` on.
#[inline(always)]
fn samples_of<F: Block>(samples: &[u32], paths: &[u32; ROW], at: usize) -> [u32; MOST] {
    let mut ids = [0; MOST];
    for (id, &path) in ids.iter_mut().zip(&paths[at..][..F::LANES]) {
        *id = samples[path as usize];
    }
    ids
}

/// Computes the states of next paths, and returns which there are.
struct Advance<'a> {
    hits: &'a HitBlock<'a>,
    directions: &'a BsdfSamples,
    paths: &'a [u32; ROW],
    states: &'a [Path],
    /// Sample values for Russian roulette, if it is applied.
    roulette: Option<&'a Row>,
    /// Whether only paths that leave by a specular event can contribute.
    specular_only: bool,
    next: &'a mut Escaped,
    eta_scale: &'a mut Row,
}

impl BlockKernel for Advance<'_> {
    type Output = RowMask;

    #[inline(always)]
    fn run<F: Block>(self) -> RowMask {
        let Self { hits, directions, paths, states, roulette, specular_only, next, eta_scale } =
            self;
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        let mut all = 0;
        for at in groups::<F>(hits.len()) {
            let path = PathsWide::<F>::gather(|lane| &states[paths[at + lane] as usize]);
            let (f, pdf) = (Bands::<F>(directions.f.load(at)), directions.pdf.load::<F>(at));
            let wi = Xyz::from(directions.wi.load(at));
            let cos = wi.dot(hits.load::<F>(at).shading_n).abs();
            let mut beta = path.beta * f * (cos / pdf);
            let mut goes_on = pdf.gt(zero) & !beta.is_black();
            let is_specular = directions.is_specular.load::<F>(at).gt(zero);
            if specular_only {
                goes_on = goes_on & is_specular;
            }
            let eta = directions.eta.load::<F>(at);
            let scale = path.eta_scale * eta * eta;
            if let Some(u) = roulette {
                // Russian roulette: a path that goes on is divided by the probability of that (PBRT 3rd edition,
                // section 14.5.4).
                let survival = (beta * scale).max_component().min(one);
                goes_on = goes_on & u.load::<F>(at).lt(survival);
                beta = beta / survival;
            }
            next.origin.store(at, hits.points::<F>(at).p.into());
            next.beta.store(at, beta.0);
            // Light sampling cannot find the direction of a delta event: its weight has to be 1.
            next.pdf.store(at, F::select(is_specular, F::splat(f32::INFINITY), pdf));
            eta_scale.store(at, scale);
            let mask = goes_on.bits() & lanes_within::<F>(at, hits.len());
            all |= RowMask::from(mask) << at;
        }
        all
    }
}

/// The rays that leave along the sampled directions, as records.
#[inline(always)]
fn next_rays<F: Block>(hits: &HitBlock, directions: &BsdfSamples, at: usize) -> [[f32; 8]; MOST] {
    let (point, n) = (hits.points::<F>(at), hits.load::<F>(at).n);
    let wi = Xyz::from(directions.wi.load(at));
    let o = Bounded::ray_origin(point, n, wi);
    let mut rays = [[0.0; 8]; MOST];
    let (zero, infinity) = (F::splat(0.0), F::splat(f32::INFINITY));
    F::scatter([o.x, o.y, o.z, zero, wi.x, wi.y, wi.z, infinity], &mut rays);
    rays
}

/// Adds paths to the list of the next depth.
struct PushNext<'a> {
    hits: &'a HitBlock<'a>,
    directions: &'a BsdfSamples,
    paths: &'a [u32; ROW],
    samples: &'a [u32],
    mask: RowMask,
    from: &'a Escaped,
    eta_scale: &'a Row,
    next: &'a mut PathList,
}

impl BlockKernel for PushNext<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { hits, directions, paths, samples, mask, from, eta_scale, next } = self;
        for at in groups::<F>(hits.len()) {
            let mask = (mask >> at) as u32;
            let states = PathsWide::<F> {
                beta: Bands(from.beta.load(at)),
                pdf: from.pdf.load(at),
                p: from.origin.load(at).into(),
                eta_scale: eta_scale.load(at),
            };
            let mut records = [Path::default(); MOST];
            states.scatter(&mut records);
            let rays = next_rays::<F>(hits, directions, at);
            let ids = samples_of::<F>(samples, paths, at);
            next.states.push_some(mask, &records[..F::LANES]);
            next.samples.push_some(mask, &ids[..F::LANES]);
            next.rays.push_some(mask, bytemuck::cast_slice(&rays[..F::LANES]));
        }
    }
}

/// Adds shadow rays to the light that is found beyond the scene.
struct PushEscaped<'a> {
    hits: &'a HitBlock<'a>,
    directions: &'a BsdfSamples,
    paths: &'a [u32; ROW],
    samples: &'a [u32],
    mask: RowMask,
    from: &'a Escaped,
    shadow: &'a mut ShadowRays,
}

impl BlockKernel for PushEscaped<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { hits, directions, paths, samples, mask, from, shadow } = self;
        for at in groups::<F>(hits.len()) {
            let found = Bands(from.found.load::<F>(at));
            let mask = (mask >> at) as u32 & (!found.is_black()).bits();
            let Bands([r, g, b]) = found;
            let mut carried = [[0.0; 4]; MOST];
            F::scatter4([r, g, b, F::splat(0.0)], &mut carried);
            let rays = next_rays::<F>(hits, directions, at);
            let ids = samples_of::<F>(samples, paths, at);
            shadow.push_some(mask, &ids[..F::LANES], &rays[..F::LANES], &carried[..F::LANES]);
        }
    }
}
