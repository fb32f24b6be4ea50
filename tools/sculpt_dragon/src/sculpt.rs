//! From the field to a verified mesh of the size asked for.

use glam::DVec3;

use crate::decimate::decimate;
use crate::field::Field;
use crate::lattice;
use crate::mesh::{Mesh, quality};
use crate::obj;
use crate::parallel;
use crate::relax::relax;
use crate::subject::Subject;
use crate::verify::{Fault, verify};

/// Triangles of the lattice's mesh times the square of its step (measured).
const DENSITY: f64 = 320.0;
/// Fewest triangles to begin with: decimation then finds the small forms whatever was asked for.
const FEWEST: usize = 1_300_000;
/// How many more triangles to begin with than were asked for.
const SURPLUS: f64 = 1.25;

/// The finished sculpture.
pub struct Sculpted {
    /// Its surface, rounded to what the file holds.
    pub mesh: Mesh,
    /// Unit normals of the vertices.
    pub normals: Vec<DVec3>,
    /// Quality of its worst triangle.
    pub quality: f64,
}

/// Sculpts `subject` in about `triangles` triangles.
pub fn sculpt(subject: Subject, triangles: usize, threads: usize) -> Result<Sculpted, Fault> {
    let model = subject.model();
    let field = Field::new(&model.sculpture, model.low, model.high, threads);
    let wanted = FEWEST.max((triangles as f64 * SURPLUS) as usize);
    let h = (DENSITY / wanted as f64).sqrt();
    let mut mesh = lattice::extract(&field, h, threads);
    mesh.keep_largest_component();
    relax(&mut mesh, &field, h, 3, threads);
    decimate(&mut mesh, triangles, model.interest, model.stay, threads).map_err(Fault::Surface)?;

    let edge = (mesh.area() / mesh.triangles.len() as f64 * 2.3).sqrt();
    let normals = field_normals(&mesh, &field, 0.2 * edge, threads);
    stage(&mut mesh, model.width);
    obj::round(&mut mesh);
    let sculpted = Sculpted { quality: worst_quality(&mesh), mesh, normals };
    verify(&sculpted.mesh, &sculpted.normals)?;
    Ok(sculpted)
}

/// Scales the mesh to `width` along x, sets its lowest point on y = 0 and the middle of the box over
/// the origin.
fn stage(mesh: &mut Mesh, width: f64) {
    let (low, high) = mesh.bounds();
    let scale = width / (high.x - low.x);
    let origin = low.midpoint(high).with_y(low.y);
    for p in &mut mesh.positions {
        *p = scale * (*p - origin);
    }
}

/// Normals from the field's gradient. Where a detail is finer than the mesh, the gradient may look
/// away from the triangles; their own mean stands in there.
fn field_normals(mesh: &Mesh, field: &Field, step: f64, threads: usize) -> Vec<DVec3> {
    let means = mesh.vertex_normals();
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    parallel::fill(&mut normals, threads, |v| {
        let gradient = field.slope(mesh.positions[v], step).1.normalize_or_zero();
        let mean = means[v].normalize_or_zero();
        if gradient.dot(mean) > 0.5 { gradient } else { mean }
    });
    normals
}

fn worst_quality(mesh: &Mesh) -> f64 {
    let of = |t: &[u32; 3]| {
        let [p, q, r] = t.map(|v| mesh.positions[v as usize]);
        quality(p, q, r)
    };
    mesh.triangles.iter().map(of).fold(1.0, f64::min)
}
