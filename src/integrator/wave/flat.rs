//! [`FlatHits`]: hits on flat-shaded triangles with one constant Lambertian lobe, four at a time.

use glam::{BVec4A, Vec2, Vec3, Vec4};

use super::paths::Path;
use crate::accel::Hit;
use crate::bxdf::BxDF;
use crate::geometry::Ray;
use crate::geometry::four::{BoundedPointx4, Framex4, Vec3x4, four, three};
use crate::sampling::cosine_hemisphere;
use crate::scene::Scene;
use crate::shape::triangle_normals;
use crate::spectrum::Spectrum;

/// Number of hits processed together, so that their data stay in the first-level cache.
pub const BLOCK: usize = 64;

/// Data of a block of hits, gathered from memory as a structure of arrays.
pub struct Fetched {
    /// Indexed by corner, then axis.
    corners: [[[f32; BLOCK]; 3]; 3],
    weights: [[f32; BLOCK]; 3],
    d: [[f32; BLOCK]; 3],
    /// Lobe value.
    f: [Spectrum; BLOCK],
}

impl Fetched {
    /// A block of zeros.
    pub fn new() -> Self {
        let rows = [[0.0; BLOCK]; 3];
        Self { corners: [rows; 3], weights: rows, d: rows, f: [Spectrum::BLACK; BLOCK] }
    }

    /// Gathers the data of a hit at index `i`.
    ///
    /// # Panics
    /// If the hit is not flat Lambertian.
    #[inline(always)]
    pub fn set(&mut self, i: usize, scene: &Scene, ray: &Ray, hit: &Hit) {
        let lobe = scene.flat_lambertian(hit).expect("the caller sorts hits by kind");
        // The value does not depend on directions.
        self.f[i] = lobe.f(Vec3::Z, Vec3::Z);
        for (rows, corner) in self.corners.iter_mut().zip(scene.corners(hit)) {
            set(rows, i, corner.to_array());
        }
        set(&mut self.weights, i, hit.b);
        set(&mut self.d, i, ray.d.to_array());
    }
}

#[inline(always)]
fn set(rows: &mut [[f32; BLOCK]; 3], i: usize, values: [f32; 3]) {
    for (row, value) in rows.iter_mut().zip(values) {
        row[i] = value;
    }
}

/// Four consecutive elements of each of three rows.
#[inline(always)]
fn get(rows: &[[f32; BLOCK]; 3], four: usize) -> Vec3x4 {
    let [x, y, z] = three(|i| Vec4::from_array(rows[i].as_chunks::<4>().0[four]));
    Vec3x4 { x, y, z }
}

/// Four hits on flat Lambertian surfaces.
///
/// All results come from the same operations in the same order as those of [`SurfaceInteraction`] and
/// [`Bsdf`], so both give the same bits.
///
/// [`SurfaceInteraction`]: crate::interaction::SurfaceInteraction
/// [`Bsdf`]: crate::bxdf::Bsdf
pub struct FlatHits<'a> {
    pub paths: [&'a Path; 4],
    pub at: BoundedPointx4,
    pub n: Vec3x4,
    /// Whether all normals could be computed in f32. If not, the hits must be processed one by one.
    pub sound: bool,
    f: [Spectrum; 4],
    wo_n: Vec4,
}

impl<'a> FlatHits<'a> {
    /// Hits 4 `four` to 4 `four` + 3 of a block, with the paths that they belong to.
    #[inline(always)]
    pub fn new(fetched: &Fetched, four: usize, paths: [&'a Path; 4]) -> Self {
        let corners = three(|corner| get(&fetched.corners[corner], four));
        let Vec3x4 { x, y, z } = get(&fetched.weights, four);
        let (n, sound) = triangle_normals(corners);
        let at = BoundedPointx4::on_triangles(corners, [x, y, z]);
        let wo_n = -get(&fetched.d, four).dot(n);
        Self { paths, at, n, sound, f: fetched.f.as_chunks::<4>().0[four], wo_n }
    }

    /// Which hits reflect light from `wi`, and the cosines of `wi` with the normals.
    #[inline(always)]
    pub fn reflect(&self, wi: Vec3x4) -> (BVec4A, Vec4) {
        let wi_n = wi.dot(self.n);
        let (above, wo_above) = (wi_n.cmpgt(Vec4::ZERO), self.wo_n.cmpgt(Vec4::ZERO));
        (!(above ^ wo_above) & self.wo_n.cmpne(Vec4::ZERO), wi_n)
    }

    /// Density over solid angle of directions sampled from the lobe, by their cosines with the normals: for hits that
    /// [`reflect`](Self::reflect) them.
    #[inline(always)]
    pub fn pdf(wi_n: Vec4) -> Vec4 {
        wi_n.abs() * Vec4::splat(std::f32::consts::FRAC_1_PI)
    }

    /// β f.
    #[inline(always)]
    pub fn reflected(&self) -> [Spectrum; 4] {
        four(|i| self.paths[i].beta * self.f[i])
    }

    /// Samples the next directions. Bit i of the mask is set if path i continues.
    #[inline(always)]
    pub fn sample_directions(&self, u: [Vec2; 4]) -> (u32, [Path; 4], Vec3x4) {
        let mut local = cosine_hemisphere::sample_x4(u);
        local.z = Vec4::select(self.wo_n.cmplt(Vec4::ZERO), -local.z, local.z);
        let pdf = Self::pdf(local.z);
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
