//! [`Vertices`]: a block of path vertices, and the stages that turn its hits into shadow rays and next rays.

use arrayvec::ArrayVec;
use bytemuck::Zeroable;
use glam::{Vec2, Vec3};

use super::dimension;
use super::paths::{Path, PathList, PathsAt, PathsWide, Values};
use super::rules::{PathRules, ROULETTE_WEIGHT, power_heuristic};
use super::shadow_rays::ShadowRays;
use crate::bxdf::{Arena, BsdfBlock, BsdfSamples};
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::geometry::{PixelCone, Xyz};
use crate::interaction::HitBlock;
use crate::light::{LightSamples, Receivers};
use crate::sampling::{SampleId, Sampler};
use crate::scene::Scene;
use crate::simd::{
    Block, BlockKernel, LaneMask, MAX_LANES, ROW, Row, RowMask, Rows, groups, indices, lanes_within,
};
use crate::spectrum::Bands;

/// What the stages of all blocks at one depth read.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    pub rules: &'a PathRules,
    pub scene: &'a Scene,
    pub sampler: &'a dyn Sampler,
    pub arena: &'a Arena,
    pub cone: Option<&'a PixelCone>,
    pub depth: u32,
    pub paths: PathsAt<'a>,
    /// Paths that hit a surface, and their sample values. A *vertex* is an index into either.
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
    /// The path of each; beyond the last, that of the last.
    path_of: [u32; ROW],
    lights: LightSamples,
    /// 1 where multiple importance sampling weights the light sample, else 0.
    is_weighed: Row,
    f: Rows<3>,
    pdf: Row,
    /// Sample values for points on lights; zeros where lights need none.
    light_u: [Vec2; ROW],
    direction_u: [Vec2; ROW],
    directions: BsdfSamples,
}

impl<'a> Vertices<'a> {
    /// An empty block.
    pub fn new(stage: Stage<'a>) -> Self {
        Self {
            stage,
            hits: stage.scene.hit_block(stage.cone),
            bsdfs: BsdfBlock::new(),
            len: 0,
            vertices: [0; ROW],
            path_of: [0; ROW],
            lights: LightSamples::zeroed(),
            is_weighed: Row::splat(0.0),
            f: Rows::splat(0.0),
            pdf: Row::splat(0.0),
            light_u: [Vec2::ZERO; ROW],
            direction_u: [Vec2::ZERO; ROW],
            directions: BsdfSamples::zeroed(),
        }
    }

    /// Replaces the block by vertices on this material: fetches the hits, computes their geometry, textures and lobes.
    ///
    /// # Panics
    /// If there are none, or more than [`ROW`].
    pub fn fill(&mut self, material: u32, vertices: &[u32]) {
        let Stage { scene, arena, active, paths, .. } = self.stage;
        self.len = vertices.len();
        self.vertices[..self.len].copy_from_slice(vertices);
        self.path_of.fill(active[vertices[self.len - 1] as usize]);
        for (path, &vertex) in self.path_of.iter_mut().zip(vertices) {
            *path = active[vertex as usize];
        }
        self.hits.fill(&self.path_of[..self.len], paths.rays, paths.hits);
        scene.scatter_block(material, &mut self.hits, arena, &mut self.bsdfs);
    }

    /// Takes the number of [rejected](crate::bxdf::Bsdf::rejected) results of the block's lobes.
    pub fn take_rejected(&mut self) -> u64 {
        self.bsdfs.take_rejected()
    }

    /// Samples the light of a slot at each vertex, or the light that it selects, and adds shadow rays that carry
    /// β f Li |cos θ| w / pdf.
    pub fn sample_lights(&mut self, slot: usize, shadow: &mut ShadowRays) {
        let Stage { rules, scene, paths, .. } = self.stage;
        if self.bsdfs.is_specular() {
            return;
        }
        if rules.needs_light_u {
            self.draw_light_points(slot);
        }
        self.lights.clear();
        if rules.lights.draws() {
            self.sample_drawn_lights();
        } else {
            let (light, _) = rules.lights.pick(slot, Vec3::ZERO, 0.0);
            self.is_weighed = Row::splat(f32::from(rules.uses_mis(light)));
            let receivers = Receivers {
                instruction_set: scene.instruction_set(),
                len: self.len,
                p: self.hits.p(),
                u: &self.light_u,
            };
            scene.lights()[light].sample_li_block(&receivers, &mut self.lights);
        }
        let Self { hits, bsdfs, lights, f, pdf, is_weighed, path_of, .. } = self;
        bsdfs.f_and_pdf(hits, &lights.wi, [&lights.pdf, is_weighed], f, pdf);
        let carry = Carry { hits, lights, f, pdf, is_weighed, path_of, paths, shadow };
        scene.instruction_set().run_block(carry);
    }

    /// The sample values for points on the light of a slot.
    fn draw_light_points(&mut self, slot: usize) {
        let Stage { sampler, values, .. } = self.stage;
        let (of_block, light_u) = (&self.vertices[..self.len], &mut self.light_u[..self.len]);
        if slot == 0 {
            for (u, &vertex) in light_u.iter_mut().zip(of_block) {
                *u = values.light[vertex as usize];
            }
        } else {
            let dimension = dimension::MORE_LIGHTS + slot as u32 - 1;
            sampler.fill_2d(&ids_of(values, of_block), dimension, light_u);
        }
    }

    /// Samples the light that each vertex selects: all vertices with the same light together.
    fn sample_drawn_lights(&mut self) {
        let Stage { rules, scene, values, .. } = self.stage;
        let (mut drawn, mut probability) = ([0; ROW], [0.0; ROW]);
        for (i, &vertex) in self.vertices[..self.len].iter().enumerate() {
            let (p, u) = (self.hits.p().get(i).into(), values.choice[vertex as usize]);
            (drawn[i], probability[i]) = rules.lights.pick(0, p, u);
            let weighed = rules.uses_mis(drawn[i]);
            self.is_weighed.set(i, f32::from(weighed));
        }
        let mut left = RowMask::MAX >> (ROW - self.len);
        let (mut p, mut u) = (Rows::splat(0.0), [Vec2::ZERO; ROW]);
        let mut samples = LightSamples::zeroed();
        while left != 0 {
            let light = drawn[left.trailing_zeros() as usize];
            let same =
                indices(left).fold(0, |same, i| same | RowMask::from(drawn[i] == light) << i);
            left &= !same;
            let light = &scene.lights()[light];
            for (to, from) in indices(same).enumerate() {
                p.set(to, self.hits.p().get(from));
                u[to] = self.light_u[from];
            }
            let (instruction_set, len) = (scene.instruction_set(), same.count_ones() as usize);
            let receivers = Receivers { instruction_set, len, p: &p, u: &u };
            samples.clear();
            light.sample_li_block(&receivers, &mut samples);
            for (from, to) in indices(same).enumerate() {
                self.lights.copy(to, &samples, from, probability[to]);
            }
        }
    }

    /// Samples the next direction of each path: a ray with β f |cos θ| / pdf, if it can contribute.
    pub fn sample_directions(&mut self, next: &mut PathList) {
        let Stage { rules, scene, sampler, values, depth, paths, .. } = self.stage;
        let of_block = &self.vertices[..self.len];
        for (u, &vertex) in self.direction_u.iter_mut().zip(of_block) {
            *u = values.direction[vertex as usize];
        }
        let uc = |uc: &mut [f32]| {
            sampler.fill_1d(&ids_of(values, of_block), dimension::event(depth), uc);
        };
        self.bsdfs.sample_f(&self.hits, uc, &self.direction_u, &mut self.directions);
        let mut roulette = None;
        if rules.uses_roulette(depth) {
            let row = roulette.insert(Row::splat(0.0));
            for (i, &vertex) in of_block.iter().enumerate() {
                row.set(i, values.roulette[vertex as usize]);
            }
        }
        let Self { hits, directions, path_of, .. } = self;
        scene.instruction_set().run_block(Advance {
            hits,
            directions,
            path_of,
            paths,
            roulette: roulette.as_ref(),
            specular_only: !rules.contributes(depth, false),
            next,
        });
    }
}

/// The samples of vertices of a block.
fn ids_of(values: &Values, vertices: &[u32]) -> ArrayVec<SampleId, ROW> {
    vertices.iter().map(|&vertex| values.ids[vertex as usize]).collect()
}

/// Adds the shadow rays of light samples.
struct Carry<'a> {
    hits: &'a HitBlock<'a>,
    lights: &'a LightSamples,
    f: &'a Rows<3>,
    pdf: &'a Row,
    is_weighed: &'a Row,
    path_of: &'a [u32; ROW],
    paths: PathsAt<'a>,
    shadow: &'a mut ShadowRays,
}

impl BlockKernel for Carry<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { hits, lights, f, pdf, is_weighed, path_of, paths, shadow } = self;
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        for at in groups::<F>(hits.len()) {
            let (f, light_pdf) = (Bands::<F>(f.load(at)), lights.pdf.load::<F>(at));
            // A density that is NaN shows in the sample, which is counted.
            let exists = !light_pdf.le(zero) & !f.is_black();
            let mask = exists.bits() & lanes_within::<F>(at, hits.len());
            if mask == 0 {
                continue;
            }
            let of_hits = hits.load::<F>(at);
            let wi = Xyz::from(lights.wi.load(at));
            let weighed = is_weighed.load::<F>(at).gt(zero);
            let weight = F::select(weighed, power_heuristic(light_pdf, pdf.load(at)), one);
            let factor = wi.dot(of_hits.shading_n).abs() * weight / light_pdf;
            let beta = PathsWide::gather(|lane| &paths.states[path_of[at + lane] as usize]).beta;
            let Bands([r, g, b]) = beta * f * Bands(lights.li.load(at)) * factor;
            let (point, n) = (hits.points::<F>(at), of_hits.n);
            let (from, t_max) = (Xyz::from(lights.from.load(at)), lights.t_max.load::<F>(at));
            let is_near = t_max.le(F::splat(ONE_MINUS_EPSILON));
            let o = point.ray_origin(n, Xyz::select(is_near, from - point.p, wi));
            let d = Xyz::select(is_near, from - o, wi);
            let mut rays = [[0.0; 8]; MAX_LANES];
            F::scatter([o.x, o.y, o.z, zero, d.x, d.y, d.z, t_max], &mut rays);
            let mut carried = [[0.0; 4]; MAX_LANES];
            F::scatter4([r, g, b, zero], &mut carried);
            let ids = samples_of::<F>(paths.samples, path_of, at);
            shadow.push_some(mask, &ids[..F::LANES], &rays[..F::LANES], &carried[..F::LANES]);
        }
    }
}

/// The samples of the paths in the lanes from `at` on.
#[inline(always)]
fn samples_of<F: Block>(samples: &[u32], path_of: &[u32; ROW], at: usize) -> [u32; MAX_LANES] {
    let mut ids = [0; MAX_LANES];
    for (id, &path) in ids.iter_mut().zip(&path_of[at..][..F::LANES]) {
        *id = samples[path as usize];
    }
    ids
}

/// Computes the next state and ray of each path, and adds those that go on.
struct Advance<'a> {
    hits: &'a HitBlock<'a>,
    directions: &'a BsdfSamples,
    path_of: &'a [u32; ROW],
    paths: PathsAt<'a>,
    /// Sample values for Russian roulette, if it is applied.
    roulette: Option<&'a Row>,
    /// Whether only paths that leave by a specular event can contribute.
    specular_only: bool,
    next: &'a mut PathList,
}

impl BlockKernel for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { hits, directions, path_of, paths, roulette, specular_only, next } = self;
        let (zero, one, infinity) = (F::splat(0.0), F::splat(1.0), F::splat(f32::INFINITY));
        for at in groups::<F>(hits.len()) {
            let path = PathsWide::<F>::gather(|lane| &paths.states[path_of[at + lane] as usize]);
            let (f, pdf) = (Bands::<F>(directions.f.load(at)), directions.pdf.load::<F>(at));
            let (of_hits, wi) = (hits.load::<F>(at), Xyz::from(directions.wi.load(at)));
            let cos = wi.dot(of_hits.shading_n).abs();
            let mut beta = path.beta * f * (cos / pdf);
            let mut goes_on = pdf.gt(zero) & !beta.is_black();
            let is_specular = directions.is_specular.load::<F>(at).gt(zero);
            if specular_only {
                goes_on = goes_on & is_specular;
            }
            let eta = directions.eta.load::<F>(at);
            let eta_scale = path.eta_scale * eta * eta;
            if let Some(u) = roulette {
                // Russian roulette: a path that goes on is divided by the probability of that (PBRT 3rd edition,
                // section 14.5.4).
                let carried = (beta * eta_scale).max_component();
                let survival = (carried / F::splat(ROULETTE_WEIGHT)).min(one);
                goes_on = goes_on & u.load::<F>(at).lt(survival);
                beta = beta / survival;
            }
            let mask = goes_on.bits() & lanes_within::<F>(at, hits.len());
            let point = hits.points::<F>(at);
            // Light sampling cannot find the direction of a delta event: its weight has to be 1.
            let pdf = F::select(is_specular, infinity, pdf);
            let mut states = [Path::default(); MAX_LANES];
            PathsWide { beta, pdf, p: point.p, eta_scale }.scatter(&mut states);
            let o = point.ray_origin(of_hits.n, wi);
            let mut rays = [[0.0; 8]; MAX_LANES];
            F::scatter([o.x, o.y, o.z, zero, wi.x, wi.y, wi.z, infinity], &mut rays);
            let ids = samples_of::<F>(paths.samples, path_of, at);
            next.states.push_some(mask, &states[..F::LANES]);
            next.samples.push_some(mask, &ids[..F::LANES]);
            next.rays.push_some(mask, bytemuck::cast_slice(&rays[..F::LANES]));
        }
    }
}
