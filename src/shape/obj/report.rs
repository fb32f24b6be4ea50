//! [`ObjMesh`]: the result of reading an OBJ file, and [`ObjReport`].

use std::path::PathBuf;

use crate::shape::mesh::TriangleMesh;

/// A mesh read from an OBJ file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ObjMesh {
    /// The mesh. It has at least one triangle, and passes [`TriangleMesh::check`].
    pub mesh: TriangleMesh,
    /// The materials that its triangles name.
    pub materials: ObjMaterials,
    /// What is unusual about it.
    pub report: ObjReport,
}

/// The materials of an OBJ file, by name: what its `usemtl` and `mtllib` lines say.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ObjMaterials {
    /// The names of `usemtl` lines that triangles follow, each once, in the order of the file. A name that is no UTF-8 is taken for Latin-1.
    pub names: Vec<String>,
    /// For each triangle, the index of its name, or [`ObjMaterials::NONE`] for faces above the first `usemtl`. Empty if no face follows one.
    pub of_triangles: Vec<u32>,
    /// The texts of `mtllib` lines, each once, in the order of the file. From [`read_obj`](super::read_obj), the files that they name.
    pub libraries: Vec<PathBuf>,
}

impl ObjMaterials {
    /// A triangle without material.
    pub const NONE: u32 = u32::MAX;
}

/// Counts of what is valid but unusual in an OBJ file, and often a sign of a mistake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ObjReport {
    /// Triangles without area: corners coincide or are collinear. They are part of the mesh.
    pub degenerate_triangles: usize,
    /// Vertices of the file that no face refers to. They are part of the mesh.
    pub unused_vertices: usize,
    /// Faces with fewer than three corners. They are not part of the mesh.
    pub short_faces: SkippedLines,
    /// Lines whose first word is not a keyword of the OBJ specification. They are skipped.
    pub unknown_lines: SkippedLines,
}

/// Lines of a file that were skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct SkippedLines {
    /// How many.
    pub count: usize,
    /// The first one, counted from 1; 0 if there is none.
    pub first: u64,
}

impl SkippedLines {
    pub(super) fn add(&mut self, line: u64) {
        if self.count == 0 {
            self.first = line;
        }
        self.count += 1;
    }
}
