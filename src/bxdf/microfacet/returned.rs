//! What single scattering returns of light from a direction, by integration over visible normals.

use glam::Vec3;

use super::Ggx;
use crate::bxdf::fresnel::boundary;
use crate::geometry::Xyz;
use crate::simd::{Block, BlockKernel, Float, InstructionSet};

/// Visible normals of each integral.
const SAMPLES: usize = 8192;

/// What reflects: mirrors, or a boundary.
#[derive(Clone, Copy, Debug)]
pub struct Interface {
    /// Index of refraction on the far side over that on the near side; `None` if all light is reflected.
    pub eta: Option<f32>,
    /// Whether refracted light counts as returned.
    pub transmits: bool,
}

impl Interface {
    /// Number of rows of losses for directions around the normal.
    pub fn azimuths(&self) -> usize {
        // Total reflection has edges.
        if self.transmits { 65 } else { 33 }
    }
}

/// Points of the unit square: multiples of the golden ratio.
pub struct Lattice {
    u: [Vec<f32>; 2],
    set: InstructionSet,
}

impl Lattice {
    pub fn new() -> Self {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let even = |i| (i as f64 + 0.5) / SAMPLES as f64;
        let golden = |i| (0.5 + GOLDEN * i as f64).fract();
        let u = [
            (0..SAMPLES).map(|i| even(i) as f32).collect(),
            (0..SAMPLES).map(|i| golden(i) as f32).collect(),
        ];
        Self { u, set: InstructionSet::default() }
    }

    /// E(wo): the mean over visible normals of what each returns.
    pub fn returned(&self, interface: Interface, ggx: Ggx, wo: Vec3) -> f64 {
        let mut returned = vec![0.0; SAMPLES];
        let [u, v] = &self.u;
        self.set.run_block(Return { u, v, interface, ggx, wo, returned: &mut returned });
        // In the same order on all instruction sets.
        returned.iter().map(|&x| f64::from(x)).sum::<f64>() / SAMPLES as f64
    }
}

struct Return<'a> {
    u: &'a [f32],
    v: &'a [f32],
    interface: Interface,
    ggx: Ggx,
    wo: Vec3,
    returned: &'a mut [f32],
}

impl BlockKernel for Return<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let (ggx, wo) = (Ggx::splat(self.ggx), Xyz::splat(self.wo));
        for at in (0..SAMPLES).step_by(F::LANES) {
            let u = [F::load(&self.u[at..]), F::load(&self.v[at..])];
            let m = ggx.sample_visible(wo, u);
            returned(self.interface, ggx, wo, m).store(&mut self.returned[at..]);
        }
    }
}

/// What a facet that is seen from `wo` returns.
#[inline(always)]
fn returned<F: Float>(interface: Interface, ggx: Ggx<F>, wo: Xyz<F>, m: Xyz<F>) -> F {
    let zero = F::splat(0.0);
    let cos = wo.dot(m).max(zero).min(F::splat(1.0));
    let reflected = unmasked(ggx, wo, m * (cos + cos) - wo);
    let Some(eta) = interface.eta else { return reflected };
    let eta = F::splat(eta);
    let [fresnel, cos_t] = boundary(cos, eta);
    let mut sum = fresnel * reflected;
    if interface.transmits {
        let refracted = m * (cos / eta - cos_t) - wo / eta;
        let mirrored = Xyz { z: -refracted.z, ..refracted };
        sum = sum + (F::splat(1.0) - fresnel) * unmasked(ggx, wo, mirrored);
    }
    sum
}

/// The fraction of light from a facet that is seen from `wo` that leaves towards `wi`: G(wo, wi) / G1(wo), 0 below the surface.
#[inline(always)]
fn unmasked<F: Float>(ggx: Ggx<F>, wo: Xyz<F>, wi: Xyz<F>) -> F {
    let leaves = (wo.z + ggx.stretched_length(wo)) * wi.z * ggx.twice_the_visibility(wo, wi);
    F::select(wi.z.gt(F::splat(0.0)), leaves, F::splat(0.0))
}
