//! [`PlainHits`]: the most common hits by far, four at a time.

use glam::{BVec4A, Vec2, Vec4};

use super::paths::Path;
use crate::Spectrum;
use crate::accel::Hit;
use crate::bxdf::BxDF;
use crate::geometry::Ray;
use crate::geometry::four::{BoundedPointx4, Framex4, Vec3x4, triangle_normals};
use crate::sampling::cosine_hemisphere;
use crate::scene::Scene;

/// Four hits on flat triangles with one constant Lambertian lobe.
///
/// All that is found here is found by the same operations as with a [`SurfaceInteraction`] and a [`Bsdf`],
/// in the same order, so that both give the same bits.
///
/// [`SurfaceInteraction`]: crate::interaction::SurfaceInteraction
/// [`Bsdf`]: crate::bxdf::Bsdf
pub struct PlainHits<'a> {
    pub paths: [&'a Path; 4],
    pub at: BoundedPointx4,
    pub n: Vec3x4,
    /// The value of the lobe.
    f: [Spectrum; 4],
    wo_n: Vec4,
}

impl<'a> PlainHits<'a> {
    /// What is known of the hits, if all are of the kind.
    #[inline(always)]
    pub fn new(
        scene: &Scene,
        paths: [&'a Path; 4],
        rays: [&Ray; 4],
        hits: [&Hit; 4],
    ) -> Option<Self> {
        let lobes = hits.map(|hit| scene.plain(hit));
        let [Some(a), Some(b), Some(c), Some(d)] = lobes else { return None };
        // A Lambertian lobe looks at no directions.
        let f = [a, b, c, d].map(|lobe| lobe.f(glam::Vec3::Z, glam::Vec3::Z));
        let [a, b, c, d] = hits;
        let weights = [0, 1, 2].map(|i| Vec4::new(a.b[i], b.b[i], c.b[i], d.b[i]));
        let (a, b) = (scene.corners(a), scene.corners(b));
        let (c, d) = (scene.corners(c), scene.corners(d));
        let corners = [0, 1, 2].map(|i| Vec3x4::new([a[i], b[i], c[i], d[i]]));
        let n = triangle_normals(corners)?;
        let wo = -Vec3x4::new(rays.map(|ray| &ray.d));
        let at = BoundedPointx4::on_triangles(corners, weights);
        Some(Self { paths, at, n, f, wo_n: wo.dot(n) })
    }

    /// Which hits reflect light from `wi`, and the cosines between these and the normals.
    #[inline(always)]
    pub fn reflect(&self, wi: Vec3x4) -> (BVec4A, Vec4) {
        let wi_n = wi.dot(self.n);
        let (above, wo_above) = (wi_n.cmpgt(Vec4::ZERO), self.wo_n.cmpgt(Vec4::ZERO));
        (!(above ^ wo_above) & self.wo_n.cmpne(Vec4::ZERO), wi_n)
    }

    /// Density of the lobe's directions, by their cosines with the normals.
    #[inline(always)]
    pub fn pdf(&self, wi_n: Vec4) -> Vec4 {
        let zero = Vec4::ZERO;
        let same =
            (self.wo_n.cmpgt(zero) & wi_n.cmpgt(zero)) | (self.wo_n.cmplt(zero) & wi_n.cmplt(zero));
        Vec4::select(same, wi_n.abs() * Vec4::splat(std::f32::consts::FRAC_1_PI), zero)
    }

    /// What the paths carry times the lobes.
    #[inline(always)]
    pub fn reflected(&self) -> [Spectrum; 4] {
        std::array::from_fn(|i| self.paths[i].beta * self.f[i])
    }

    /// The paths with one more reflection, and the directions in which they go on. Bit i of the mask is for the
    /// i-th.
    #[inline(always)]
    pub fn step(&self, u: [Vec2; 4]) -> (u32, [Path; 4], Vec3x4) {
        let mut local = cosine_hemisphere::sample_x4(u);
        local.z = Vec4::select(self.wo_n.cmplt(Vec4::ZERO), -local.z, local.z);
        let pdf = self.pdf(local.z);
        let wi = Framex4::from_normals(self.n).to_world(local);
        let (reflect, wi_n) = self.reflect(wi);
        let mut mask = (reflect & pdf.cmpgt(Vec4::ZERO)).bitmask();
        let factor = (wi_n.abs() / pdf).to_array();
        let reflected = self.reflected();
        let p = self.at.p.rows(pdf);
        let paths = std::array::from_fn(|i| {
            let beta = reflected[i] * factor[i];
            mask &= !(u32::from(beta.is_black()) << i);
            let path = self.paths[i];
            Path { beta, p: p[i].truncate(), pdf: p[i].w, ..*path }
        });
        (mask, paths, wi)
    }
}

/// Adds the values whose bits in the mask are set.
///
/// All are written, and the next one over those that do not count: a branch would be hard to foresee.
#[inline(always)]
pub fn push_x4<T: Copy>(to: &mut Vec<T>, mask: u32, values: &[T; 4]) {
    for (i, &value) in values.iter().enumerate() {
        to.push(value);
        to.truncate(to.len() - (!mask >> i & 1) as usize);
    }
}
