//! [`Instance`]: a mesh once more, at another place.

use glam::Affine3A;

use super::placement::Placement;

/// A mesh that is drawn once more, at another place, without a copy of it.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Index of the mesh.
    pub mesh: u32,
    pub(crate) placement: Placement,
}

impl Instance {
    /// Scales that can be undone in f32.
    const SCALES: [f64; 2] = [1e-15, 1e15];

    /// The mesh of this index, moved by `transform` from where it stands. `None` if that cannot be undone: if it flattens the mesh, scales it by
    /// less than 1e-15 or more than 1e15, or is not finite. Such a mesh has to be [transformed](super::TriangleMesh::transform) itself.
    pub fn new(mesh: u32, transform: &Affine3A) -> Option<Self> {
        let placement = Placement::new(transform);
        let inverse = placement.inverse()?.matrix3;
        let [least, most] = Self::SCALES;
        let is_within = |scale: f64| (least..=most).contains(&scale);
        let columns = [inverse.x_axis, inverse.y_axis, inverse.z_axis];
        columns.iter().all(|column| is_within(column.length())).then_some(Self { mesh, placement })
    }
}
