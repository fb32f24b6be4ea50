//! [`Escaped`]: light from beyond the scene, which paths find that leave it.

use super::paths::{Path, PathsWide};
use super::rules::{PathRules, Weighting};
use crate::geometry::{Ray, Xyz};
use crate::light::{Emitted, EscapedRays};
use crate::scene::Scene;
use crate::simd::{Block, BlockKernel, ROW, Row, Rows, groups};
use crate::spectrum::{Bands, Spectrum};

/// A block of paths that leave the scene.
pub struct Escaped {
    pub origin: Rows<3>,
    pub beta: Rows<3>,
    pub pdf: Row,
    /// The weighted radiance that they find: β Le w.
    pub found: Rows<3>,
    wi: Rows<3>,
    emitted: Emitted,
}

impl Escaped {
    /// A block of zeros.
    pub fn new() -> Self {
        let zeros = Rows::splat(0.0);
        Self {
            origin: zeros,
            beta: zeros,
            pdf: Row::splat(0.0),
            found: zeros,
            wi: zeros,
            emitted: Emitted::new(),
        }
    }

    /// Finds the radiance of all infinite lights for paths that leave their origins along `wi`.
    pub fn find(
        &mut self,
        rules: &PathRules,
        scene: &Scene,
        len: usize,
        wi: &Rows<3>,
        needs_pdf: bool,
    ) {
        let Self { origin, beta, pdf, found, emitted, .. } = self;
        *found = Rows::splat(0.0);
        for &light in &rules.infinite {
            scene.lights()[light]
                .escaped_block(&EscapedRays { len, origin, wi, needs_pdf }, emitted);
            let weighting = rules.weighting(light);
            let weigh = Weigh { len, beta, pdf, found, emitted, weighting };
            scene.instruction_set().run_block(weigh);
        }
    }
}

/// Adds β Le w of one light.
struct Weigh<'a> {
    len: usize,
    beta: &'a Rows<3>,
    pdf: &'a Row,
    found: &'a mut Rows<3>,
    emitted: &'a Emitted,
    weighting: Weighting,
}

impl BlockKernel for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { len, beta, pdf, found, emitted, weighting } = self;
        for at in groups::<F>(len) {
            let weight = weighting.weight::<F>(pdf.load(at), emitted.pdf.load(at));
            let le = Bands(emitted.le.load(at));
            let Bands([r, g, b]) = Bands(beta.load(at)) * le * weight;
            let [found_r, found_g, found_b] = found.load::<F>(at);
            found.store(at, [found_r + r, found_g + g, found_b + b]);
        }
    }
}

/// Gathers the states and rays of paths.
struct Gather<'a> {
    paths: &'a [u32],
    states: &'a [Path],
    rays: &'a [Ray],
    /// Whether the paths are at the camera: rays begin at their origins then.
    at_camera: bool,
    escaped: &'a mut Escaped,
}

impl BlockKernel for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { paths, states, rays, at_camera, escaped } = self;
        let Escaped { origin, beta, pdf, wi, .. } = escaped;
        let last = paths.len() - 1;
        for at in groups::<F>(paths.len()) {
            let path = |lane: usize| paths[(at + lane).min(last)] as usize;
            let of_paths = PathsWide::<F>::gather(|lane| &states[path(lane)]);
            let [ox, oy, oz, _, dx, dy, dz, _] =
                F::gather(|lane| bytemuck::cast_ref::<Ray, [f32; 8]>(&rays[path(lane)]));
            let from = if at_camera { Xyz { x: ox, y: oy, z: oz } } else { of_paths.p };
            origin.store(at, from.into());
            beta.store(at, of_paths.beta.0);
            pdf.store(at, of_paths.pdf);
            wi.store(at, [dx, dy, dz]);
        }
    }
}

/// Adds the light that escaped paths find to their samples. `at_camera` tells whether they are camera rays.
#[expect(clippy::too_many_arguments)]
pub fn add_escaped(
    rules: &PathRules,
    scene: &Scene,
    paths: &[u32],
    states: &[Path],
    samples: &[u32],
    rays: &[Ray],
    at_camera: bool,
    radiance: &mut [Spectrum],
) {
    let mut escaped = Escaped::new();
    for paths in paths.chunks(ROW) {
        let gather = Gather { paths, states, rays, at_camera, escaped: &mut escaped };
        scene.instruction_set().run_block(gather);
        let wi = escaped.wi;
        escaped.find(rules, scene, paths.len(), &wi, !at_camera);
        for (i, &path) in paths.iter().enumerate() {
            radiance[samples[path as usize] as usize] += Spectrum::from(escaped.found.get(i));
        }
    }
}
