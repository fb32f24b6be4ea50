//! Writing the mesh as Wavefront OBJ.

use std::io::{self, Write};

use glam::DVec3;

use crate::mesh::Mesh;
use crate::uv::Uv;

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

/// Writes a title, positions, one normal per vertex, and faces `a//a b//b c//c`; with texture coordinates `a/t/a b/t/b c/t/c`.
pub fn write(
    out: &mut impl Write,
    title: &str,
    mesh: &Mesh,
    normals: &[DVec3],
    uv: Option<&Uv>,
) -> io::Result<()> {
    // The place where the sculptor first stood: changing it would change the bytes of the shipped file.
    writeln!(out, "# {title}, sculpted from signed distance functions by tools/sculpt_dragon.")?;
    writeln!(out, "# {} vertices, {} triangles", mesh.positions.len(), mesh.triangles.len())?;
    for p in &mesh.positions {
        writeln!(out, "v {:.6} {:.6} {:.6}", p.x, p.y, p.z)?;
    }
    for n in normals {
        writeln!(out, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z)?;
    }
    let Some(uv) = uv else {
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|v| v + 1);
            writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
        }
        return Ok(());
    };
    for [u, v] in &uv.coordinates {
        writeln!(out, "vt {u:.5} {v:.5}")?;
    }
    for (t, coordinates) in mesh.triangles.iter().zip(&uv.triangles) {
        let ([a, b, c], [x, y, z]) = (t.map(|v| v + 1), coordinates.map(|i| i + 1));
        writeln!(out, "f {a}/{x}/{a} {b}/{y}/{b} {c}/{z}/{c}")?;
    }
    Ok(())
}
