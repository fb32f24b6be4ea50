//! Half-edges of a triangle mesh: which triangle lies across each side.
//!
//! Half-edge `3 t + k` runs from corner k of triangle t to its next corner. Pairing every
//! half-edge with exactly one that runs the other way is what it means for a mesh to be closed and
//! consistently oriented.

use std::fmt;

use crate::mesh::Mesh;

/// Twins of all half-edges.
pub struct HalfEdges {
    /// The half-edge that runs the other way along the same edge.
    pub twin: Vec<u32>,
    /// One half-edge that leaves each vertex.
    pub leaving: Vec<u32>,
}

/// Why a mesh has no pairing.
#[derive(Debug, PartialEq)]
pub enum Defect {
    /// A triangle names a vertex twice.
    RepeatedVertex { triangle: usize },
    /// Two triangles run along an edge in the same direction.
    RepeatedEdge { from: u32, to: u32 },
    /// An edge has a triangle on one side only.
    OpenEdge { from: u32, to: u32 },
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Defect::RepeatedVertex { triangle } => {
                write!(f, "triangle {triangle} names a vertex twice")
            }
            Defect::RepeatedEdge { from, to } => {
                write!(
                    f,
                    "the edge from vertex {from} to {to} has two triangles in the same direction"
                )
            }
            Defect::OpenEdge { from, to } => {
                write!(f, "the edge from vertex {from} to {to} has a triangle on one side only")
            }
        }
    }
}

impl HalfEdges {
    /// Pairs the half-edges of `mesh`, all of whose vertices must be used.
    pub fn pair(mesh: &Mesh) -> Result<HalfEdges, Defect> {
        let end = |e: u32| mesh.triangles[e as usize / 3][(e as usize % 3 + 1) % 3];
        let (start, runs) = mesh.fans();
        let fan = |v: u32| &runs[start[v as usize] as usize..start[v as usize + 1] as usize];
        let mut twin = vec![0; 3 * mesh.triangles.len()];
        for (t, &corners) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                return Err(Defect::RepeatedVertex { triangle: t });
            }
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                if fan(from).iter().filter(|&&e| end(e) == to).count() > 1 {
                    return Err(Defect::RepeatedEdge { from, to });
                }
                let back = fan(to).iter().find(|&&e| end(e) == from);
                twin[3 * t + k] = *back.ok_or(Defect::OpenEdge { from, to })?;
            }
        }
        let leaving = (0..mesh.positions.len() as u32).map(|v| fan(v)[0]).collect();
        Ok(HalfEdges { twin, leaving })
    }

    /// The half-edge after `e` in its triangle.
    pub fn next(e: u32) -> u32 {
        if e % 3 == 2 { e - 2 } else { e + 1 }
    }

    /// The half-edge before `e` in its triangle.
    pub fn previous(e: u32) -> u32 {
        if e.is_multiple_of(3) { e + 2 } else { e - 1 }
    }

    /// The half-edges that leave vertex `v`, once around.
    pub fn around(&self, v: u32) -> impl Iterator<Item = u32> {
        let first = self.leaving[v as usize];
        let mut at = Some(first);
        std::iter::from_fn(move || {
            let e = at?;
            let turned = self.twin[Self::previous(e) as usize];
            at = (turned != first).then_some(turned);
            Some(e)
        })
    }
}
