//! [`AreaLight`]: emission from the triangles of a mesh.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::block::{WideLight, sample_wide};
use super::emissive_mesh::{Areas, EmissiveMesh, triangle_area, with_area};
use super::{BoundingSphere, Light, LightBounds, LightHit, LightSample, LightSamples, Receivers};
use crate::sampling::Discrete;
use crate::shape::TriangleMesh;
use crate::spectrum::Spectrum;

/// A mesh that emits the same radiance everywhere and in all directions, from its outer side or from both sides (PBRT 3rd
/// edition, sections 12.5 and 14.2.2). [`TexturedAreaLight`](super::TexturedAreaLight) is one whose radiance varies.
///
/// The outer side is that of [`SurfaceInteraction`](crate::interaction::SurfaceInteraction): where the
/// corners run counter-clockwise, unless vertex normals point to the other side.
///
/// Points are sampled uniformly by area. If the mesh is one flat rectangle, they are sampled uniformly by
/// solid angle instead, down to 1e-6 sr.
#[doc(alias = "diffuse area light")]
#[doc(alias = "emission")]
#[doc(alias = "emitter")]
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// Triangles of non-zero area, each selected in proportion to it.
    mesh: EmissiveMesh,
    radiance: Spectrum,
}

impl AreaLight {
    /// A light with the shape of `mesh`, in world space, that emits `radiance`, in W / (m² sr). The mesh must
    /// have passed [`TriangleMesh::check`]. `None` if it has no area. Triangles without area are ignored.
    pub fn new(mesh: &TriangleMesh, radiance: Spectrum, two_sided: bool) -> Option<Self> {
        // Emission needs neither texture coordinates nor triangles without area.
        let mesh = TriangleMesh {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            uvs: Vec::new(),
            indices: with_area(mesh).map(|t| mesh.indices[t]).collect(),
        };
        let areas = || (0..mesh.indices.len()).map(|t| triangle_area(mesh.corners(t)));
        let triangles = Discrete::new(areas())?;
        let areas = Areas { all: areas().sum(), ..Areas::default() };
        Some(Self { mesh: EmissiveMesh::new(mesh, triangles, areas, two_sided), radiance })
    }

    /// [`sample_li`](Light::sample_li) where f32 is not precise enough, or if the light is no rectangle: in f64 by solid
    /// angle, or else by area.
    fn sample_precisely(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.mesh.sample(p, u, self.radiance).map(|(sample, _)| sample)
    }
}

impl Light for AreaLight {
    fn is_delta(&self) -> bool {
        false
    }

    #[inline]
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        if let Some(rectangle) = self.mesh.on_rectangle(self.radiance) {
            let (incident, imprecise) = rectangle.incident(p.into(), u.to_array());
            if !imprecise {
                return incident.into_sample();
            }
        }
        self.sample_precisely(p, u)
    }

    #[inline]
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        self.mesh.pdf(hit, self.mesh.areas().all)
    }

    /// The light's radiance, if the ray arrives on a side that emits.
    #[inline]
    fn le(&self, hit: &LightHit) -> Spectrum {
        if self.mesh.shines(-hit.n.dot(hit.wi)) { self.radiance } else { Spectrum::BLACK }
    }

    /// π A L, twice that for both sides.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.radiance * (self.mesh.sides() * PI * self.mesh.areas().all as f32))
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(self.mesh.bounds())
    }

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        let precisely = |i: usize, samples: &mut LightSamples| {
            samples.set(i, self.sample_precisely(receivers.p(i), receivers.u(i)));
        };
        match self.mesh.on_rectangle(self.radiance) {
            Some(rectangle) => {
                sample_wide(&rectangle, receivers, samples).for_each(|i| precisely(i, samples))
            }
            None => (0..receivers.len()).for_each(|i| precisely(i, samples)),
        }
    }
}
