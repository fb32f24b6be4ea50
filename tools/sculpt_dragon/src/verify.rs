//! What the mesh is promised to be, checked on the very numbers that are written.

use std::fmt;

use glam::DVec3;

use crate::halfedge::{Defect, HalfEdges};
use crate::mesh::Mesh;
use crate::obj;

/// A broken promise.
#[derive(Debug)]
pub enum Fault {
    /// Not closed or not consistently oriented.
    Surface(Defect),
    /// The triangles of a vertex are more than one fan.
    Fans { vertex: usize },
    /// More than one piece.
    Components(usize),
    /// The triangles look inwards.
    Inward(f64),
    /// A triangle without area, after rounding.
    Degenerate { triangle: usize },
    /// Two vertices that round to the same place.
    SamePlace { vertex: usize },
    /// A normal that isn't unit, or looks away from its triangles.
    Normal { vertex: usize },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Fault::Surface(defect) => write!(f, "not a closed, oriented surface: {defect}"),
            Fault::Fans { vertex } => {
                write!(f, "the triangles about vertex {vertex} are not one fan")
            }
            Fault::Components(n) => write!(f, "{n} separate pieces instead of 1"),
            Fault::Inward(volume) => write!(f, "the triangles look inwards: volume {volume}"),
            Fault::Degenerate { triangle } => write!(f, "triangle {triangle} has no area"),
            Fault::SamePlace { vertex } => write!(f, "vertex {vertex} lies on another"),
            Fault::Normal { vertex } => {
                write!(f, "the normal of vertex {vertex} is not unit or looks inwards")
            }
        }
    }
}

/// The promises, in words for the summary.
pub const PROMISES: &str =
    "closed, oriented, two-manifold, one component, outward, no degenerate triangle, unit normals";

/// Checks every promise. `mesh` has been rounded to what the file holds.
pub fn verify(mesh: &Mesh, normals: &[DVec3]) -> Result<(), Fault> {
    let edges = HalfEdges::pair(mesh).map_err(Fault::Surface)?;
    fans(mesh, &edges)?;
    match mesh.components() {
        1 => {}
        n => return Err(Fault::Components(n)),
    }
    let volume = mesh.volume();
    if volume.is_nan() || volume <= 0.0 {
        return Err(Fault::Inward(volume));
    }
    areas(mesh)?;
    places(mesh)?;
    agreement(mesh, normals)
}

/// Each vertex has as many triangles as one walk around it meets.
fn fans(mesh: &Mesh, edges: &HalfEdges) -> Result<(), Fault> {
    let (start, _) = mesh.fans();
    for v in 0..mesh.positions.len() {
        let triangles = (start[v + 1] - start[v]) as usize;
        // The walk is cut short so that a broken mesh can't keep it going.
        if edges.around(v as u32).take(triangles + 1).count() != triangles {
            return Err(Fault::Fans { vertex: v });
        }
    }
    Ok(())
}

/// Areas in whole units of the last decimal, so exactly.
fn areas(mesh: &Mesh) -> Result<(), Fault> {
    for (i, t) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = t.map(|v| obj::units(mesh.positions[v as usize]));
        let (u, v) = (difference(b, a), difference(c, a));
        let cross = [0, 1, 2].map(|k| {
            let (m, n) = ((k + 1) % 3, (k + 2) % 3);
            u[m] * v[n] - u[n] * v[m]
        });
        if cross == [0; 3] {
            return Err(Fault::Degenerate { triangle: i });
        }
    }
    Ok(())
}

fn difference(a: [i64; 3], b: [i64; 3]) -> [i128; 3] {
    [0, 1, 2].map(|k| i128::from(a[k] - b[k]))
}

fn places(mesh: &Mesh) -> Result<(), Fault> {
    let mut places: Vec<([i64; 3], usize)> =
        mesh.positions.iter().enumerate().map(|(v, &p)| (obj::units(p), v)).collect();
    places.sort_unstable();
    match places.windows(2).find(|w| w[0].0 == w[1].0) {
        Some(w) => Err(Fault::SamePlace { vertex: w[1].1 }),
        None => Ok(()),
    }
}

/// Normals are unit and on the outer side of the mean plane of their triangles.
fn agreement(mesh: &Mesh, normals: &[DVec3]) -> Result<(), Fault> {
    let means = mesh.vertex_normals();
    for (v, (n, mean)) in normals.iter().zip(means).enumerate() {
        let good = (n.length() - 1.0).abs() < 1e-9 && n.dot(mean) > 0.0;
        if !good {
            return Err(Fault::Normal { vertex: v });
        }
    }
    Ok(())
}
