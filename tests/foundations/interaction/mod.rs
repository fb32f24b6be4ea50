//! Surface interactions, and what materials and textures compute from them.

mod bump;
mod matte;
mod partials;
mod shading;
mod transform;

use lobe::TriangleMesh;
use lobe::glam::{Vec2, Vec3};

use crate::common::Rng;

/// One triangle with texture coordinates.
fn textured(positions: [Vec3; 3], uvs: [Vec2; 3]) -> TriangleMesh {
    TriangleMesh {
        positions: positions.to_vec(),
        uvs: uvs.to_vec(),
        indices: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    }
}

/// A triangle that is far from degenerate in space and in texture coordinates. These have either
/// orientation; the size is 10^±8, and the position within ten times that.
fn random_triangle(rng: &mut Rng) -> TriangleMesh {
    loop {
        let (size, uv_size) = (rng.coordinate(8.0).abs(), rng.coordinate(3.0).abs());
        let at = rng.direction() * rng.f32() * 10.0;
        let corners = [(); 3].map(|()| size * (at + rng.direction()));
        let uvs = [(); 3].map(|()| uv_size * (rng.square() - Vec2::splat(0.5)));
        let (a, b) = ((corners[1] - corners[0]) / size, (corners[2] - corners[0]) / size);
        let (c, d) = ((uvs[1] - uvs[0]) / uv_size, (uvs[2] - uvs[0]) / uv_size);
        if a.cross(b).length() > 0.1 && c.perp_dot(d).abs() > 0.05 {
            return textured(corners, uvs);
        }
    }
}
