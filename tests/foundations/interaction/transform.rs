//! Meshes that are moved, stretched and mirrored.

use lobe::glam::{Affine3A, DMat3, Mat3, Quat, Vec3};

use crate::common::Rng;
use crate::common::meshes::lumpy;

/// Six times the volume inside of a closed mesh; negative when it is turned inside out.
fn volume(mesh: &lobe::TriangleMesh) -> f64 {
    let origin = mesh.positions[0].as_dvec3();
    let triples = (0..mesh.indices.len()).map(|t| mesh.corners(t).map(|p| p.as_dvec3() - origin));
    triples.map(|[a, b, c]| a.cross(b).dot(c)).sum()
}

/// Outside stays outside, and normals go with the inverse transpose, at any scale. Caught: mirroring
/// without turning triangles round; normals transformed like positions; normals lost where the product of
/// two small factors leaves the range of f32.
#[test]
fn outside_stays_outside() {
    for trial in 0..600 {
        let mut rng = Rng::new(930, trial);
        let mut mesh = lumpy(2, trial);
        mesh.normals = mesh.positions.iter().map(|p| p.normalize()).collect();
        let before = mesh.clone();
        let stretch = Vec3::new(rng.coordinate(0.7), rng.coordinate(0.7), rng.coordinate(0.7));
        let scale = 10.0_f32.powi(rng.below(33) as i32 - 16);
        let turn = |rng: &mut Rng| {
            Mat3::from_quat(Quat::from_axis_angle(rng.direction(), 6.0 * rng.f32()))
        };
        let matrix = turn(&mut rng) * Mat3::from_diagonal(stretch) * turn(&mut rng) * scale;
        mesh.transform(&Affine3A::from_mat3_translation(matrix, scale * rng.direction()));

        let what = format!("trial {trial}, scale {scale}, stretch {stretch}");
        let ratio = volume(&mesh) / volume(&before);
        let expected = f64::from(stretch.element_product()).abs() * f64::from(scale).powi(3);
        assert!(
            (ratio / expected - 1.0).abs() < 1e-3,
            "{what}: volume by {ratio}, expected {expected}"
        );

        let matrix = DMat3::from_cols(
            matrix.x_axis.as_dvec3(),
            matrix.y_axis.as_dvec3(),
            matrix.z_axis.as_dvec3(),
        );
        let inverse_transpose = matrix.inverse().transpose();
        for (n, old) in mesh.normals.iter().zip(&before.normals) {
            let truth = (inverse_transpose * old.as_dvec3()).normalize();
            let error = (n.as_dvec3() - truth).length();
            assert!(error < 1e-5, "{what}: {n}, expected {truth}");
            assert!((n.length() - 1.0).abs() < 1e-6, "{what}: {n}");
        }
    }
}

/// Zero normals, which mean none, stay zero, and a flattened mesh has no NaN. Caught: 0 / 0.
#[test]
fn degenerate_transformations() {
    let mut mesh = lumpy(1, 1);
    mesh.normals = mesh.positions.iter().map(|p| p.normalize()).collect();
    mesh.normals[3] = Vec3::ZERO;
    for stretch in [Vec3::ONE, Vec3::new(1.0, 1.0, 0.0), Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0)] {
        let mut mesh = mesh.clone();
        mesh.transform(&Affine3A::from_scale(stretch));
        assert_eq!(mesh.normals[3], Vec3::ZERO, "{stretch}");
        assert!(mesh.normals.iter().all(|n| n.is_finite()), "{stretch}");
    }
}
