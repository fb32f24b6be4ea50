//! [`LeafTriangle`]: what leaves hold.

use glam::Vec3;

/// A triangle in a leaf, with the numbers it has outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeafTriangle {
    pub(super) corners: [Vec3; 3],
    pub(super) shape: u32,
    pub(super) triangle: u32,
}
