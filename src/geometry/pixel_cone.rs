//! [`PixelCone`]: how wide a pixel is at a distance.

use glam::Vec3;

use super::{Frame, unit, unit_cross};

/// How far apart the rays through neighbouring pixels are, about: for textures that filter.
///
/// As in PBRT 4 (section 10.1.3), the footprint of a point follows from the camera alone, wherever the path that found it went: as if the camera
/// saw the point directly. So nothing travels with paths, through mirrors and glass neither.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelCone {
    /// Where rays begin; `None` if they are parallel.
    apex: Option<Vec3>,
    /// Their direction if they are parallel.
    direction: Vec3,
    /// Distance of neighbours at the distance 1, or at any if they are parallel.
    width: f32,
}

impl PixelCone {
    /// Rays from `apex`, which are `width` apart at a distance of 1.
    pub const fn from_point(apex: Vec3, width: f32) -> Self {
        Self { apex: Some(apex), direction: Vec3::ZERO, width }
    }

    /// Rays along the unit vector `direction`, which are `width` apart.
    pub const fn parallel(direction: Vec3, width: f32) -> Self {
        Self { apex: None, direction, width }
    }

    /// From the point `p` of a surface with the unit normal `n` to the points on the surface that the next pixels see: along the surface across the
    /// view and away from it. At grazing angles the second is longer by 1 / cos θ, at most a thousand times.
    pub fn footprint(&self, p: Vec3, n: Vec3) -> [Vec3; 2] {
        let to_point = self.apex.map_or(self.direction, |apex| p - apex);
        let width = self.width * self.apex.map_or(1.0, |_| to_point.length());
        let w = unit(to_point).unwrap_or(-n);
        let Some(across) = unit_cross(n, w) else {
            let Frame { s, t, .. } = Frame::from_normal(n);
            return [s * width, t * width];
        };
        let away = across.cross(n);
        [across * width, away * (width / w.dot(n).abs().max(1e-3))]
    }
}
