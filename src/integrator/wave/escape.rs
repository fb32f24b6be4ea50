//! [`for_each_escaped`]: light from beyond the scene, which paths find that leave it.

use bytemuck::Zeroable;

use super::paths::{PathsAt, PathsWide};
use super::rules::{PathRules, Weighting};
use crate::geometry::{Ray, Xyz};
use crate::light::{Emitted, EscapedRays};
use crate::scene::Scene;
use crate::simd::{Block, BlockKernel, ROW, Row, Rows, groups};
use crate::spectrum::{Bands, Spectrum};

/// Calls `found` for each of `count` paths that leave the scene, with its index and the weighted radiance of all lights
/// beyond, β Le w. `path` returns the indices.
pub fn for_each_escaped(
    rules: &PathRules,
    scene: &Scene,
    paths: &PathsAt,
    count: usize,
    path: impl Fn(usize) -> usize,
    mut found: impl FnMut(usize, Spectrum),
) {
    let mut block = Escaped::zeroed();
    let mut emitted = Emitted::zeroed();
    let set = scene.instruction_set();
    for first in (0..count).step_by(ROW) {
        let len = (count - first).min(ROW);
        let path = |i: usize| path(first + i.min(len - 1));
        set.run_block(Gather { len, path: &path, paths, block: &mut block });
        block.found = Rows::splat(0.0);
        for &light in &rules.infinite {
            let weighting = rules.weighting_from_anywhere(light);
            let needs_pdf = weighting.needs_pdf() && !paths.at_camera;
            let Escaped { origin, wi, .. } = &block;
            emitted.clear();
            let rays = EscapedRays { len, origin, wi, needs_pdf };
            scene.lights()[light].escaped_block(&rays, &mut emitted);
            set.run_block(Weigh { len, block: &mut block, emitted: &emitted, weighting });
        }
        for i in 0..len {
            found(path(i), block.found.get(i).into());
        }
    }
}

/// A block of paths that leave the scene.
#[derive(Clone, Copy, Zeroable)]
struct Escaped {
    origin: Rows<3>,
    wi: Rows<3>,
    beta: Rows<3>,
    pdf: Row,
    found: Rows<3>,
}

/// Gathers the states and rays of paths.
struct Gather<'a, P> {
    len: usize,
    path: &'a P,
    paths: &'a PathsAt<'a>,
    block: &'a mut Escaped,
}

impl<P: Fn(usize) -> usize> BlockKernel for Gather<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { len, path, paths: &PathsAt { states, rays, at_camera, .. }, block } = self;
        for at in groups::<F>(len) {
            let of_paths = PathsWide::<F>::gather(|lane| &states[path(at + lane)]);
            let [ox, oy, oz, _, dx, dy, dz, _] =
                F::gather(|lane| bytemuck::cast_ref::<Ray, [f32; 8]>(&rays[path(at + lane)]));
            // The surface point, not the offset ray origin: `sample_li` gets the same point.
            let from = if at_camera { Xyz { x: ox, y: oy, z: oz } } else { of_paths.p };
            block.origin.store(at, from.into());
            block.wi.store(at, [dx, dy, dz]);
            block.beta.store(at, of_paths.beta.0);
            block.pdf.store(at, of_paths.pdf);
        }
    }
}

/// Adds β Le w of one light.
struct Weigh<'a> {
    len: usize,
    block: &'a mut Escaped,
    emitted: &'a Emitted,
    weighting: Weighting,
}

impl BlockKernel for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { len, block: Escaped { beta, pdf, found, .. }, emitted, weighting } = self;
        for at in groups::<F>(len) {
            let weight = weighting.weight::<F>(pdf.load(at), emitted.pdf.load(at));
            let le = Bands(emitted.le.load(at));
            let more = (Bands(beta.load(at)) * le * weight).only(!weight.eq(F::splat(0.0)));
            let ([r, g, b], [more_r, more_g, more_b]) = (found.load::<F>(at), more.0);
            found.store(at, [r + more_r, g + more_g, b + more_b]);
        }
    }
}
