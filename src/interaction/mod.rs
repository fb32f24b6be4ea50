//! [`SurfaceInteraction`]: position, normals and derivatives at a hit.

mod block;
mod hit;
mod surfaces;

use glam::{Vec2, Vec3};

pub(crate) use block::Hits;
pub use block::{BLOCK, HitBlock};
pub use hit::Hit;
pub(crate) use surfaces::Surfaces;

use crate::geometry::{BoundedPoint, Frame, PixelCone, Ray, Xyz, unit, unit_cross};
use crate::shape::{PlacedMesh, TriangleMesh, shading_normal_wide, triangle_normal};
use crate::simd::Float;

/// Derivatives of position and normal with respect to the texture coordinates (u, v).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Partials {
    /// ∂p/∂u.
    pub dpdu: Vec3,
    /// ∂p/∂v.
    pub dpdv: Vec3,
    /// ∂n/∂u.
    pub dndu: Vec3,
    /// ∂n/∂v.
    pub dndv: Vec3,
}

/// Geometry for shading: the surface's own, or as changed by interpolated normals or bump mapping (PBRT 3rd
/// edition, section 2.10.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shading {
    /// Unit shading normal, in the hemisphere of the geometric one.
    pub n: Vec3,
    /// ∂p/∂u of the shading surface.
    pub dpdu: Vec3,
    /// ∂p/∂v of the shading surface.
    pub dpdv: Vec3,
    /// ∂n/∂u of the shading normal.
    pub dndu: Vec3,
    /// ∂n/∂v of the shading normal.
    pub dndv: Vec3,
}

/// A point where a ray hits a surface, in world space (PBRT 3rd edition, section 2.10.1).
///
/// It is lazy: the point and the normals are computed on construction, everything else on demand.
#[doc(alias = "hit")]
#[doc(alias = "intersection")]
#[derive(Clone)]
pub struct SurfaceInteraction<'a> {
    p: BoundedPoint,
    wo: Vec3,
    n: Vec3,
    shading_n: Vec3,
    source: Source<'a>,
    /// Of the camera, if there is one.
    cone: Option<&'a PixelCone>,
    /// Set by [`SurfaceInteraction::set_shading`].
    displaced: Option<Shading>,
}

/// Position of a hit on the scene's surfaces: shape, triangle and barycentric coordinates.
#[doc(alias = "barycentric")]
#[doc(alias = "primitive")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SurfacePlace {
    /// Index of the shape, in the order in which shapes were added to the scene; on an instance its index behind all shapes.
    /// [`Scene::shape_of`](crate::Scene::shape_of) tells both.
    pub shape: u32,
    /// Index of the triangle in the shape's mesh.
    pub triangle: u32,
    /// Barycentric coordinates, one per corner, each in `[0, 1]`; they add up to 1 except for rounding.
    pub b: [f32; 3],
}

/// What the remaining quantities are computed from.
#[derive(Clone)]
enum Source<'a> {
    Triangle { mesh: PlacedMesh<'a>, place: SurfacePlace },
    Given { uv: Vec2, partials: Partials, place: Option<SurfacePlace> },
}

impl<'a> SurfaceInteraction<'a> {
    /// The point of a triangle with the barycentric coordinates `b`, seen from the unit direction `wo`. The
    /// mesh is taken as the scene's shape 0.
    ///
    /// # Panics
    /// If `triangle` is out of range.
    #[inline]
    pub fn on_triangle(mesh: &'a TriangleMesh, triangle: usize, b: [f32; 3], wo: Vec3) -> Self {
        let place = SurfacePlace { shape: 0, triangle: triangle as u32, b };
        Self::on_shape(PlacedMesh::new(mesh, None), place, wo)
    }

    /// The point at `place` of the shape with this mesh, seen from the unit direction `wo`.
    #[inline]
    pub(crate) fn on_shape(mesh: PlacedMesh<'a>, place: SurfacePlace, wo: Vec3) -> Self {
        let SurfacePlace { triangle, b, .. } = place;
        let triangle = triangle as usize;
        let corners = mesh.corners(triangle);
        let n = triangle_normal(corners);
        let (n, shading_n) = match mesh.corner_normals(triangle) {
            Some(normals) => {
                let [n, shading_n] = oriented(n.into(), normals.map(Xyz::from), b);
                (n.into(), shading_n.into())
            }
            None => (n, n),
        };
        Self {
            p: BoundedPoint::on_triangle(corners, b),
            wo,
            n,
            shading_n,
            source: Source::Triangle { mesh, place },
            cone: None,
            displaced: None,
        }
    }

    /// A hit on a surface of any kind, from the point with its error bounds, texture coordinates, the unit
    /// direction towards the viewer, and the derivatives. The normal is ∂p/∂u × ∂p/∂v, or `wo` where these
    /// are parallel or zero.
    pub fn new(p: BoundedPoint, uv: Vec2, wo: Vec3, partials: Partials) -> Self {
        let n = unit_cross(partials.dpdu, partials.dpdv).unwrap_or(wo);
        let source = Source::Given { uv, partials, place: None };
        Self { p, wo, n, shading_n: n, source, cone: None, displaced: None }
    }

    /// The point.
    #[inline]
    pub fn p(&self) -> Vec3 {
        self.p.p
    }

    /// Bounds on the absolute error of the point, per axis.
    #[inline]
    pub fn p_error(&self) -> Vec3 {
        self.p.error
    }

    /// Shape, triangle and barycentric coordinates; `None` for a point that was made without a mesh.
    #[inline]
    pub fn place(&self) -> Option<SurfacePlace> {
        match self.source {
            Source::Triangle { place, .. } => Some(place),
            Source::Given { place, .. } => place,
        }
    }

    /// Texture coordinates.
    #[inline]
    pub fn uv(&self) -> Vec2 {
        match &self.source {
            Source::Triangle { mesh, place: SurfacePlace { triangle, b, .. } } => {
                uv_at(*mesh, *triangle, *b)
            }
            Source::Given { uv, .. } => *uv,
        }
    }

    /// This point as a camera with this cone sees it.
    pub fn seen_by(self, cone: &'a PixelCone) -> Self {
        Self { cone: Some(cone), ..self }
    }

    /// From the point to those that the next pixels see, along the surface: see [`PixelCone`]. `None` if no camera is known.
    #[inline]
    pub fn footprint(&self) -> Option<[Vec3; 2]> {
        Some(self.cone?.footprint(self.p(), self.n))
    }

    /// Texture coordinates of a step along the surface: the least squares of ∂p/∂u du + ∂p/∂v dv.
    pub fn uv_step(&self, step: Vec3) -> Vec2 {
        let Partials { dpdu, dpdv, .. } = self.partials();
        let [uu, uv, vv] = [dpdu.dot(dpdu), dpdu.dot(dpdv), dpdv.dot(dpdv)];
        let [u, v] = [dpdu.dot(step), dpdv.dot(step)];
        let step = Vec2::new(vv * u - uv * v, uu * v - uv * u) / (uu * vv - uv * uv);
        if step.is_finite() { step } else { Vec2::ZERO }
    }

    /// Unit direction towards the origin of the ray.
    #[inline]
    pub fn wo(&self) -> Vec3 {
        self.wo
    }

    /// Unit geometric normal. It points to the outer side, whichever side `wo` is on.
    #[inline]
    pub fn n(&self) -> Vec3 {
        self.n
    }

    /// The unit shading normal.
    #[inline]
    pub fn shading_n(&self) -> Vec3 {
        self.shading_n
    }

    /// Derivatives of the surface itself. A triangle is flat: its normal does not change.
    pub fn partials(&self) -> Partials {
        match &self.source {
            Source::Triangle { mesh, place } => {
                let [dpdu, dpdv] = mesh.position_partials(place.triangle as usize);
                Partials { dpdu, dpdv, ..Partials::default() }
            }
            Source::Given { partials, .. } => *partials,
        }
    }

    /// ∂p/∂u.
    pub fn dpdu(&self) -> Vec3 {
        self.partials().dpdu
    }

    /// ∂p/∂v.
    pub fn dpdv(&self) -> Vec3 {
        self.partials().dpdv
    }

    /// ∂n/∂u of the geometric normal.
    pub fn dndu(&self) -> Vec3 {
        self.partials().dndu
    }

    /// ∂n/∂v of the geometric normal.
    pub fn dndv(&self) -> Vec3 {
        self.partials().dndv
    }

    /// The complete shading geometry.
    ///
    /// Its tangents are those of the surface, projected onto the plane perpendicular to the shading normal. They
    /// are not normalized, because bump mapping needs their lengths.
    pub fn shading(&self) -> Shading {
        if let Some(displaced) = self.displaced {
            return displaced;
        }
        let n = self.shading_n;
        let Partials { dpdu, dpdv, dndu, dndv } = self.partials();
        let [dndu, dndv] = match &self.source {
            Source::Triangle { mesh, place } => mesh.normal_partials(place.triangle as usize),
            Source::Given { .. } => [dndu, dndv],
        };
        let [mut dpdu, mut dpdv] = [dpdu, dpdv].map(|v| v - n * n.dot(v));
        if unit_cross(dpdu, dpdv).is_none() {
            let frame = Frame::from_normal(n);
            (dpdu, dpdv) = (frame.s, frame.t);
        }
        Shading { n, dpdu, dpdv, dndu, dndv }
    }

    /// Replaces the shading geometry, as bump mapping does. The normal is normalized and flipped into the
    /// hemisphere of the geometric one. If it is zero or not finite, nothing changes.
    pub fn set_shading(&mut self, shading: Shading) {
        let Some(n) = unit(shading.n) else { return };
        let n = if n.dot(self.n) < 0.0 { -n } else { n };
        self.shading_n = n;
        self.displaced = Some(Shading { n, ..shading });
    }

    /// This hit at a point nearby with another normal: for finite differences of textures.
    pub fn moved_to(&self, p: Vec3, uv: Vec2, n: Vec3) -> Self {
        Self {
            p: BoundedPoint { p, error: self.p.error },
            n,
            shading_n: n,
            source: Source::Given { uv, partials: self.partials(), place: self.place() },
            cone: self.cone,
            displaced: Some(Shading { n, ..self.shading() }),
            wo: self.wo,
        }
    }

    /// The ray that leaves this point along `w`. Its origin is offset beyond the error bounds.
    #[inline]
    pub fn spawn_ray(&self, w: Vec3) -> Ray {
        Ray::new(self.ray_origin(w), w)
    }

    /// The ray from this point to `target`, which is at t = 1 and excluded.
    #[inline]
    pub fn spawn_ray_to(&self, target: Vec3) -> Ray {
        Ray::between(self.ray_origin(target - self.p.p), target)
    }

    #[inline]
    fn ray_origin(&self, w: Vec3) -> Vec3 {
        self.p.ray_origin(self.n, w)
    }
}

/// Texture coordinates of a point of a triangle.
#[inline]
fn uv_at(mesh: PlacedMesh, triangle: u32, b: [f32; 3]) -> Vec2 {
    let [uv0, uv1, uv2] = mesh.corner_uvs(triangle as usize);
    b[0] * uv0 + b[1] * uv1 + b[2] * uv2
}

/// The geometric normal on the outer side, and the shading normal. If there are vertex normals, they define both (PBRT 3rd
/// edition, section 3.6.2).
#[inline(always)]
fn oriented<F: Float>(n: Xyz<F>, normals: [Xyz<F>; 3], b: [F; 3]) -> [Xyz<F>; 2] {
    let (ns, exists) = shading_normal_wide(normals, b);
    let inward = exists & n.dot(ns).lt(F::splat(0.0));
    let n = Xyz::select(inward, -n, n);
    [n, Xyz::select(exists, ns, n)]
}
