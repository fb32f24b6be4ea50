//! Where points are in an image, in closed form.

use lobe::PerspectiveSettings;
use lobe::camera::Handedness;
use lobe::glam::{DVec2, DVec3, UVec2, Vec3};

/// Where the camera sees a point: x to the right and y up, each in [-1, 1] within the image. `None` behind it.
///
/// The right of the image is view × up in a right-handed world, and x = p·right / (p·view · tan(fov/2)), of the shorter side.
pub fn project(settings: &PerspectiveSettings, resolution: UVec2, p: Vec3) -> Option<DVec2> {
    let [eye, look_at, up, p] = [settings.eye, settings.look_at, settings.up, p].map(DVec3::from);
    let view = (look_at - eye).normalize();
    let right = match settings.handedness {
        Handedness::Right => view.cross(up).normalize(),
        Handedness::Left => up.cross(view).normalize(),
    };
    let top = (up - view * view.dot(up)).normalize();
    let p = p - eye;
    let half = (f64::from(settings.fov).to_radians() / 2.0).tan();
    let half = resolution.as_dvec2() / f64::from(resolution.min_element()) * half;
    let depth = p.dot(view);
    (depth > 0.0).then(|| DVec2::new(p.dot(right), p.dot(top)) / depth / half)
}
