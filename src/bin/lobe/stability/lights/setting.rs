//! [`Setting`]: a rectangular light and the point that it illuminates.

use lobe::glam::Vec3;

/// Edges of the light: integers at right angles, so that they are exact in f32 at any size. The outside is along
/// (-2, 2, -1).
pub const EDGES: [Vec3; 2] = [Vec3::new(1.0, 2.0, 2.0), Vec3::new(2.0, 1.0, -2.0)];
/// Corner of the light.
pub const CORNER: Vec3 = Vec3::new(2.0, -1.0, 3.0);

/// A light of radiance 1, and a point with its normal.
pub struct Setting {
    pub edges: [Vec3; 2],
    pub p: Vec3,
    pub n: Vec3,
}
