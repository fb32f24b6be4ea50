//! Writing the mesh as Wavefront OBJ.

use std::io::{self, Write};

use glam::DVec3;

use crate::mesh::Mesh;

/// Units of the last decimal of a position in the file.
const UNIT: f64 = 1e6;

/// `p` in units of the last decimal.
pub fn units(p: DVec3) -> [i64; 3] {
    (p * UNIT).round().to_array().map(|x| x as i64)
}

/// Moves every vertex to the nearest place that the file can hold.
pub fn round(mesh: &mut Mesh) {
    for p in &mut mesh.positions {
        *p = DVec3::from_array(units(*p).map(|x| x as f64 / UNIT));
    }
}

/// Writes a title, positions, one normal per vertex, and faces `a//a b//b c//c`.
pub fn write(out: &mut impl Write, title: &str, mesh: &Mesh, normals: &[DVec3]) -> io::Result<()> {
    // The place where the sculptor first stood: changing it would change the bytes of the shipped file.
    writeln!(out, "# {title}, sculpted from signed distance functions by tools/sculpt_dragon.")?;
    writeln!(out, "# {} vertices, {} triangles", mesh.positions.len(), mesh.triangles.len())?;
    for p in &mesh.positions {
        writeln!(out, "v {:.6} {:.6} {:.6}", p.x, p.y, p.z)?;
    }
    for n in normals {
        writeln!(out, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z)?;
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v + 1);
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}
