//! Rays that pass through holes of surfaces.

use super::Scene;
use crate::accel::Hit;
use crate::geometry::Ray;
use crate::sampling::{mix, unit_float};
use crate::texture::Texture;

impl Scene {
    /// The closest hit of each ray on what is not a hole.
    pub(crate) fn intersect(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.accel.intersect(rays, hits);
        if !self.has_holes {
            return;
        }
        for (ray, hit) in rays.iter().zip(hits) {
            self.pass(ray, hit);
        }
    }

    /// Whether each ray hits anything that is not a hole.
    pub(crate) fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        self.accel.occluded(rays, occluded);
        if !self.has_holes {
            return;
        }
        for (ray, occluded) in rays.iter().zip(occluded).filter(|(_, occluded)| **occluded) {
            let mut hit = self.accel.intersect1(ray);
            self.pass(ray, &mut hit);
            *occluded = hit.is_hit();
        }
    }

    /// Replaces a hit of a ray by the next one while it is in a hole.
    fn pass(&self, ray: &Ray, hit: &mut Hit) {
        while hit.is_hit() && self.is_hole(ray, hit) {
            *hit = self.accel.intersect1(&Ray { t_min: hit.t.next_up(), ..*ray });
        }
    }

    /// Whether the surface lets the ray pass. Of surfaces that let a part of rays pass, a hash of ray and surface decides: it is the same for any
    /// order of rays.
    fn is_hole(&self, ray: &Ray, hit: &Hit) -> bool {
        let material = &self.materials[self.material_at(hit) as usize];
        let Some(opacity) = material.opacity().filter(|_| self.light_at(hit).is_none()) else {
            return false;
        };
        let opacity = opacity.evaluate(&self.interaction(ray, hit));
        let word = |x: f32| u64::from(x.to_bits());
        let words = [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z].map(word);
        let place = u64::from(hit.shape) << 32 | u64::from(hit.triangle);
        let hash = words.into_iter().fold(mix(place), |hash, word| mix(hash ^ word));
        unit_float((hash >> 32) as u32) >= opacity
    }
}
