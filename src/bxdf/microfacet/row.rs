//! [`Row`]: the losses of directions with one azimuth.

use glam::Vec3;

use super::Ggx;
use super::returned::{Interface, Lattice};
use crate::simd::Float;

/// Number of nodes over the polar angle.
const NODES: usize = 128;

/// What single scattering loses at directions with one azimuth, at equal distances of [`position`].
#[derive(Clone, Debug)]
pub struct Row([f32; NODES]);

impl Row {
    /// Integrates the losses of directions with this cos² φ.
    pub fn new(lattice: &Lattice, interface: Interface, ggx: Ggx, cos2_phi: f32) -> Self {
        // At the horizon, all is returned.
        let mut row = [0.0; NODES];
        for (node, lost) in row.iter_mut().enumerate().skip(1) {
            let cos = cosine(node as f64 / f64::from(LAST), alpha_at(ggx, cos2_phi));
            let sin = ((1.0 - cos) * (1.0 + cos)).sqrt() as f32;
            let wo = Vec3::new(sin * cos2_phi.sqrt(), sin * (1.0 - cos2_phi).sqrt(), cos as f32);
            *lost = (1.0 - lattice.returned(interface, ggx, wo)).clamp(0.0, 1.0) as f32;
        }
        Self(row)
    }

    /// At a [`position`].
    #[inline]
    pub fn at(&self, position: f32) -> f32 {
        let (node, within) = split(position * LAST, NODES);
        self.0[node] + within * (self.0[node + 1] - self.0[node])
    }

    /// The mean of a row over cos² θ: the mean over directions, cosine-weighted. Between nodes, a row is linear in [`position`].
    pub fn mean(&self, ggx: Ggx, cos2_phi: f32) -> f32 {
        const STEPS: usize = 8;
        let cos2_at = |step: usize| {
            cosine(step as f64 / (f64::from(LAST) * STEPS as f64), alpha_at(ggx, cos2_phi)).powi(2)
        };
        let (mut sum, mut from) = (0.0, 0.0);
        for step in 0..(NODES - 1) * STEPS {
            let to = cos2_at(step + 1);
            let [low, high] = [self.0[step / STEPS], self.0[step / STEPS + 1]].map(f64::from);
            let within = ((step % STEPS) as f64 + 0.5) / STEPS as f64;
            sum += (low + within * (high - low)) * (to - from);
            from = to;
        }
        sum as f32
    }
}

const LAST: f32 = (NODES - 1) as f32;

/// Where a direction stands among the nodes, in `[0, 1]`, from its cosine and s(w) of [`Ggx`].
///
/// Losses change with cos θ / s, along the surface over angles as small as the roughness, and with cos θ where indices differ little.
/// The roots are what makes them nearly straight lines along the surface.
#[inline(always)]
pub fn position<F: Float>(cos: F, stretched_length: F) -> F {
    F::splat(0.5) * ((cos / stretched_length).sqrt() + cos.sqrt().sqrt())
}

/// The cosine at a position, where `alpha` is the roughness in the plane of the direction and the normal.
fn cosine(at: f64, alpha: f64) -> f64 {
    let [mut low, mut high] = [0.0_f64, 1.0];
    for _ in 0..60 {
        let root = 0.5 * (low + high);
        let cos2 = root.powi(8);
        let stretch = (cos2 + alpha * alpha * (1.0 - cos2)).sqrt();
        let position = 0.5 * ((root.powi(4) / stretch).sqrt() + root);
        if position < at { low = root } else { high = root }
    }
    high.powi(4)
}

/// The index before a position among `count`, with another after it, and the fraction that remains.
#[inline]
pub fn split(at: f32, count: usize) -> (usize, f32) {
    let index = (at as usize).min(count - 2);
    (index, at - index as f32)
}

/// The roughness in the plane of directions with this cos² φ.
pub fn alpha_at(ggx: Ggx, cos2_phi: f32) -> f64 {
    let w = Vec3::new(cos2_phi.sqrt(), (1.0 - cos2_phi).sqrt(), 0.0);
    f64::from(ggx.stretched_length(w.into()))
}
