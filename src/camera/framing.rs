//! [`PerspectiveSettings::framing`]: a camera from which all of a model is seen.

use glam::{DVec2, DVec3, UVec2, Vec3};

use super::error::CameraError;
use super::perspective::PerspectiveSettings;
use super::placement::{Axes, check_resolution};
use crate::geometry::float::MAX_COORDINATE;

/// Share of the image's width and height that the points fill at most.
const FILLED: f64 = 0.9;

/// Share of the points' bounding box, of its diagonal, that they are away from the camera along the view at least. Otherwise it would
/// stand at the tip of whatever is pointed and fits into the field of view from there.
const NEAREST: f64 = 0.1;

impl PerspectiveSettings {
    /// The camera that looks in the same direction and stands as near to `points` as it can with all of them in an image of
    /// this resolution, a twentieth of its width and height away from the edges, and none nearer than a tenth of the diagonal of their bounding box. `look_at` becomes the point in the middle of the image
    /// that is as far away as the middle of the points' bounding box.
    ///
    /// Points beyond [`MAX_COORDINATE`] are left out; without any other the camera stays where it is.
    ///
    /// ```
    /// use lobe::PerspectiveSettings;
    /// use lobe::camera::Handedness;
    /// use lobe::glam::{UVec2, Vec3};
    ///
    /// let from_above = PerspectiveSettings {
    ///     eye: Vec3::new(1.0, 1.0, 2.0),
    ///     look_at: Vec3::ZERO,
    ///     handedness: Handedness::Right,
    ///     fov: 40.0,
    ///     ..PerspectiveSettings::default()
    /// };
    /// let corners = [Vec3::ZERO, Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 5.0)];
    /// let camera = from_above.framing(corners.into_iter(), UVec2::new(800, 600))?;
    /// assert!(camera.eye.z > 5.0);
    /// # Ok::<(), lobe::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    /// If eye, `look_at` and up leave open where the camera looks, or the resolution is 0.
    pub fn framing(
        self,
        points: impl Iterator<Item = Vec3> + Clone,
        resolution: UVec2,
    ) -> Result<Self, CameraError> {
        let Axes { right, up, forward } =
            Axes::new(self.eye, self.look_at, self.up, self.handedness)?;
        check_resolution(resolution)?;
        let is_inside = |p: &Vec3| p.abs().max_element() <= MAX_COORDINATE;
        let points = points.filter(is_inside).map(DVec3::from);
        let bounds = points.clone().fold(None, |bounds: Option<[DVec3; 2]>, p| {
            Some(bounds.map_or([p, p], |[min, max]| [min.min(p), max.max(p)]))
        });
        let Some([min, max]) = bounds else { return Ok(self) };
        let center = (min + max) / 2.0;

        // Tangents of half the angles that the points may fill, from left to right and from bottom to top.
        let half = (f64::from(self.fov).to_radians() / 2.0).tan() * FILLED;
        let tangents = resolution.as_dvec2() / f64::from(resolution.min_element()) * half;
        // x - t z ≤ eye.x - t eye.z keeps a point left of the right edge, and -x - t z ≤ -eye.x - t eye.z right of the left one.
        let (mut most, mut nearest) = ([DVec2::NEG_INFINITY; 2], f64::INFINITY);
        for p in points {
            let p = p - center;
            let (across, depth) = (DVec2::new(p.dot(right), p.dot(up)), p.dot(forward));
            nearest = nearest.min(depth);
            most =
                [most[0].max(across - tangents * depth), most[1].max(-across - tangents * depth)];
        }
        let nearest = nearest - NEAREST * (max - min).length();
        let eye = |slack: f64| {
            let slack = slack * (1.0 + tangents * tangents).map(f64::sqrt);
            let [upper, lower] = most.map(|most| most + slack);
            let across = (upper - lower) / 2.0;
            let depth = (-(upper + lower) / (2.0 * tangents)).min_element().min(nearest);
            // A single point at the origin.
            let depth = if depth < -f64::from(f32::MIN_POSITIVE) { depth } else { -1.0 };
            center + right * across.x + up * across.y + forward * depth
        };
        // Rounding eye and look_at to f32 moves what is seen: as far as if the points were balls of this radius.
        let coordinate = min.abs().max(max.abs()).max(eye(0.0).abs()).max_element();
        let eye = eye(2.0 * f64::from(f32::EPSILON) * coordinate);
        let limit = Vec3::splat(MAX_COORDINATE);
        let look_at = eye + forward * (center - eye).dot(forward);
        Ok(Self {
            eye: eye.as_vec3().clamp(-limit, limit),
            look_at: look_at.as_vec3().clamp(-limit, limit),
            ..self
        })
    }
}
