//! [`PlainHits`]: the most common hits by far, four at a time.

use glam::{BVec4A, Vec2, Vec3, Vec4};

use super::paths::Path;
use crate::Spectrum;
use crate::accel::Hit;
use crate::bxdf::BxDF;
use crate::geometry::Ray;
use crate::geometry::four::{BoundedPointx4, Framex4, Vec3x4, four, three, triangle_normals};
use crate::sampling::cosine_hemisphere;
use crate::scene::Scene;

/// What has to be fetched for four hits on flat triangles with one constant Lambertian lobe.
pub struct Fetched<'a> {
    paths: [&'a Path; 4],
    corners: [Vec3x4; 3],
    weights: [Vec4; 3],
    /// Against the rays.
    wo: Vec3x4,
    /// The value of the lobe.
    f: [Spectrum; 4],
}

impl<'a> Fetched<'a> {
    /// # Panics
    /// If the hits are of another kind.
    #[inline(always)]
    pub fn new(scene: &Scene, paths: [&'a Path; 4], rays: [&Ray; 4], hits: [&Hit; 4]) -> Self {
        let lobe = |i: usize| scene.plain(hits[i]).expect("only plain hits are handed in");
        let [a, b, c, d] = four(|i| scene.corners(hits[i]));
        Self {
            paths,
            corners: three(|i| Vec3x4::new([a[i], b[i], c[i], d[i]])),
            weights: three(|i| Vec4::from_array(four(|hit| hits[hit].b[i]))),
            wo: -Vec3x4::new(four(|i| &rays[i].d)),
            // It looks at no directions.
            f: four(|i| lobe(i).f(Vec3::Z, Vec3::Z)),
        }
    }
}

/// Four such hits.
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
    /// Whether all normals could be found in f32. If not, nothing here is of use.
    pub sound: bool,
    f: [Spectrum; 4],
    wo_n: Vec4,
}

impl<'a> PlainHits<'a> {
    #[inline(always)]
    pub fn new(fetched: &Fetched<'a>) -> Self {
        let &Fetched { paths, corners, weights, wo, f } = fetched;
        let (n, sound) = triangle_normals(corners);
        let at = BoundedPointx4::on_triangles(corners, weights);
        Self { paths, at, n, sound, f, wo_n: wo.dot(n) }
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
        four(|i| self.paths[i].beta * self.f[i])
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
        let paths = four(|i| {
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
