//! What can be sculpted.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::sculpture::Sculpture;
use crate::uv::{Uv, around_y};
use crate::{anatomy, object};

/// What is sculpted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subject {
    /// The dragon.
    Dragon,
    /// The object that materials are shown on.
    Object,
}

/// A sculpture, and how it becomes a mesh.
pub(crate) struct Model {
    pub sculpture: Sculpture,
    /// Corner of a box that holds all of it with room to spare.
    pub low: DVec3,
    /// The other corner.
    pub high: DVec3,
    /// Weight of errors about a place.
    pub interest: fn(DVec3) -> f64,
    /// Weight of a vertex's place against its planes: more makes triangles more alike in size.
    pub stay: f64,
    /// Extent of the finished mesh along x.
    pub width: f64,
}

impl Subject {
    /// The title in the OBJ file.
    pub fn title(self) -> &'static str {
        match self {
            Subject::Dragon => "Dragon",
            Subject::Object => "Object for materials",
        }
    }

    /// Texture coordinates of a mesh, if it has any.
    pub fn uv(self, mesh: &Mesh) -> Option<Uv> {
        match self {
            Subject::Dragon => None,
            Subject::Object => Some(around_y(mesh)),
        }
    }

    pub(crate) fn model(self) -> Model {
        match self {
            Subject::Dragon => Model {
                sculpture: anatomy::dragon(),
                low: anatomy::LOW,
                high: anatomy::HIGH,
                interest: anatomy::interest,
                stay: 1e-5,
                width: 4.2,
            },
            Subject::Object => Model {
                sculpture: object::object(),
                low: object::LOW,
                high: object::HIGH,
                interest: object::interest,
                stay: 2e-3,
                width: 2.0,
            },
        }
    }
}
