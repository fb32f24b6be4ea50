//! What holds for rays through a tree of any triangles: the tree gives what a loop over the triangles gives.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

/// Any bytes as triangles and rays. The first byte is the number of triangles. Where the second one is even, whole
/// numbers from -128 to 127 follow, and closest hits are those of the loop, bit by bit. Where it is odd, floats of any
/// value follow: hits are those of their triangles, and where the loop has none the tree has none.
pub fn accel(bytes: &[u8]) {
    let [count, kind, rest @ ..] = bytes else { return };
    let is_whole = kind % 2 == 0;
    let numbers: Vec<f32> = if is_whole {
        rest.iter().map(|&byte| f32::from(byte as i8)).collect()
    } else {
        rest.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()
    };
    let (corners, rays) = numbers.split_at(numbers.len().min(9 * usize::from(*count)));
    let mesh = mesh(corners);
    // Meshes that do not pass are refused before a tree is built.
    if mesh.check().is_err() {
        return;
    }
    let rays: Vec<Ray> = rays.as_chunks().0.iter().map(ray).collect();
    let tree = Accel::build(std::slice::from_ref(&mesh));
    let (mut hits, mut occluded) = (vec![Hit::MISS; rays.len()], vec![false; rays.len()]);
    tree.intersect(&rays, &mut hits);
    tree.occluded(&rays, &mut occluded);
    for ((ray, hit), occluded) in rays.iter().zip(&hits).zip(&occluded) {
        let alone = tree.intersect1(ray);
        let truth = closest(&mesh, ray, 0..mesh.indices.len());
        if is_whole {
            assert_eq!(bits(hit), bits(&truth), "{ray:?}: {hit:?}, expected {truth:?}");
            assert_eq!(bits(&alone), bits(&truth), "{ray:?}: {alone:?}, expected {truth:?}");
            assert_eq!(*occluded, truth.is_hit(), "{ray:?}: {truth:?}");
            assert_eq!(tree.occluded1(ray), truth.is_hit(), "{ray:?}: {truth:?}");
            continue;
        }
        for hit in [hit, &alone].into_iter().filter(|hit| hit.is_hit()) {
            let number = hit.triangle as usize;
            let again = closest(&mesh, ray, number..number + 1);
            assert_eq!(bits(hit), bits(&again), "{ray:?}: {hit:?}, by itself {again:?}");
        }
        let any = *occluded || tree.occluded1(ray);
        assert!(truth.is_hit() || !any, "{ray:?}: occluded, but the loop finds nothing");
    }
}

/// A mesh whose triangles share no vertices.
fn mesh(numbers: &[f32]) -> TriangleMesh {
    let positions: Vec<Vec3> =
        numbers.as_chunks().0.iter().map(|&at| Vec3::from_array(at)).collect();
    let indices = (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { positions, indices, ..TriangleMesh::default() }
}

fn ray(&[ox, oy, oz, dx, dy, dz, t_min, t_max]: &[f32; 8]) -> Ray {
    let (o, d) = (Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
    // A whole range, where none is given.
    Ray { o, d, t_min: t_min.max(0.0), t_max: if t_max > 0.0 { t_max } else { f32::INFINITY } }
}

/// The closest hit among some triangles; of equally close ones the first. Triangles without area are no surface.
fn closest(mesh: &TriangleMesh, ray: &Ray, triangles: std::ops::Range<usize>) -> Hit {
    let sheared = ShearedRay::new(ray);
    let mut closest = Hit::MISS;
    for number in triangles.filter(|&number| mesh.geometric_normal(number) != Vec3::ZERO) {
        let found = sheared.intersect(&mesh.corners(number), ray.t_min, ray.t_max);
        if let Some(found) = found
            && (found.t < closest.t || !closest.is_hit())
        {
            closest = Hit { t: found.t, b: found.b, shape: 0, triangle: number as u32 };
        }
    }
    closest
}

/// A hit as integers, to compare bits.
fn bits(hit: &Hit) -> (u32, [u32; 3], u32, u32) {
    (hit.t.to_bits(), hit.b.map(f32::to_bits), hit.shape, hit.triangle)
}
