//! [`SceneError`]: why a scene cannot be built.

use crate::accel::Accel;
use crate::params::quoted;
use crate::shape::MeshError;

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A shape refers to a material that the scene does not have.
    #[error(
        "shape {} refers to material {}, which the scene does not have",
        quoted(shape),
        quoted(material)
    )]
    UnknownMaterial {
        /// The shape's name.
        shape: String,
        /// The name of the missing material.
        material: String,
    },
    /// More triangles than [`Accel::MAX_TRIANGLES`].
    #[error("the scene has {0} triangles, more than {max}", max = Accel::MAX_TRIANGLES)]
    TooManyTriangles(usize),
    /// An [`Emission`](super::Emission) that is the same everywhere is negative or not finite.
    #[error(
        "shape {} emits {radiance:?}: each band has to be finite and at least 0",
        quoted(shape)
    )]
    Emission {
        /// The shape.
        shape: String,
        /// What it emits.
        radiance: [f32; 3],
    },
    /// The materials of a shape's triangles are not one for each.
    #[error("shape {}: {reason}", quoted(shape))]
    Materials {
        /// The shape.
        shape: String,
        /// What is wrong.
        reason: String,
    },
    /// An instance cannot be.
    #[error("instance {}: {reason}", quoted(instance))]
    Instance {
        /// The instance.
        instance: String,
        /// What is wrong.
        reason: String,
    },
    /// A mesh failed [`TriangleMesh::check`](crate::TriangleMesh::check).
    #[error("shape {}: {}", quoted(.0), .1)]
    Mesh(String, MeshError),
}
