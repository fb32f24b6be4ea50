//! The two triangle tests of these sweeps.

use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

use super::super::usual_triangle::moeller_trumbore;

/// Whether a ray hits a triangle.
pub type TriangleTest = fn(&Ray, &[Vec3; 3]) -> bool;

/// Both tests, in the order of the counts.
pub const TESTS: [TriangleTest; 2] = [bounded, plain];

/// The crate's test, which rejects hits whose t is within its error bound.
fn bounded(ray: &Ray, corners: &[Vec3; 3]) -> bool {
    ShearedRay::new(ray).intersect(corners, ray.t_min, ray.t_max).is_some()
}

/// The common test, which accepts every hit at t > 0.
fn plain(ray: &Ray, corners: &[Vec3; 3]) -> bool {
    moeller_trumbore(ray, corners, 0.0).is_some()
}
