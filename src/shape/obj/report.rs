//! [`ObjMesh`]: the result of reading an OBJ file, and [`ObjReport`].

use crate::shape::mesh::TriangleMesh;

/// A mesh read from an OBJ file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ObjMesh {
    /// The mesh. It has at least one triangle, and passes [`TriangleMesh::check`].
    pub mesh: TriangleMesh,
    /// What is unusual about it.
    pub report: ObjReport,
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
