//! The scene of a trial: a flat patch of four triangles, a hit on it, and a plate above it.

use lobe::TriangleMesh;
use lobe::geometry::Ray;
use lobe::glam::{DVec3, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::shape::ShearedRay;

use super::super::rng::Rng;
use super::placement::Placement;
use super::triangle_test::TriangleTest;

/// Smallest sine between two edges of a triangle.
const THINNEST: f64 = 1e-3;
/// Smallest barycentric coordinate of a hit on the plate that counts.
const MARGIN: f64 = 0.01;

/// A large triangle, split into four at the midpoints of its edges.
pub struct Patch {
    mesh: TriangleMesh,
    /// All coordinates are multiples of this, the spacing of floats at the farthest corner.
    unit: f64,
    /// The corners of the large triangle.
    large: [DVec3; 3],
    /// Its exact normal, rounded to f64.
    pub n: DVec3,
}

impl Patch {
    /// A random patch; `None` if its area is close to 0.
    ///
    /// All coordinates are multiples of one power of two with at most 24 bits. So they are exact floats, and the four
    /// triangles are exactly coplanar.
    pub fn draw(rng: &mut Rng, Placement { scale, distance }: Placement) -> Option<Self> {
        let unit = spacing(distance + 2.0 * scale);
        let round = |v: DVec3| (v / unit).round() * unit;
        let c = round(distance * rng.direction() + 0.5 * scale * rng.in_cube());
        let [a, b] = [(); 2].map(|()| round(0.5 * scale * rng.in_cube()));
        let cross = (a / unit).cross(b / unit);
        if cross.length() * unit * unit <= THINNEST * a.length() * b.length() {
            return None;
        }
        let large = [c + a - b, c + b - a, c + a + b];
        let positions = [c, c + a, c + b, large[0], large[1], large[2]].map(DVec3::as_vec3);
        let indices = [[0, 1, 2], [0, 3, 1], [0, 2, 4], [1, 5, 2]];
        let mesh = TriangleMesh {
            positions: positions.to_vec(),
            indices: indices.to_vec(),
            ..TriangleMesh::default()
        };
        Some(Self { mesh, unit, large, n: cross.normalize() })
    }

    /// The hit of a ray aimed at the middle triangle, computed as in a renderer.
    pub fn draw_hit(&self, rng: &mut Rng, scale: f64) -> Option<SurfaceInteraction<'_>> {
        let [b1, b2] = rng.in_triangle();
        let [p0, p1, p2] = self.mesh.corners(0).map(Vec3::as_dvec3);
        let target = p0 + b1 * (p1 - p0) + b2 * (p2 - p0);
        let eye = (target + 2.0 * scale * rng.direction()).as_vec3();
        let d = (target.as_vec3() - eye).try_normalize()?;
        let ray = ShearedRay::new(&Ray::new(eye, d));
        let hits = self.triangles().enumerate().filter_map(|(triangle, corners)| {
            Some((triangle, ray.intersect(&corners, 0.0, f32::INFINITY)?))
        });
        let (triangle, hit) = hits.min_by(|(_, a), (_, b)| a.t.total_cmp(&b.t))?;
        Some(SurfaceInteraction::on_triangle(&self.mesh, triangle, hit.b, -d))
    }

    /// Whether a ray hits one of the four triangles by this test.
    pub fn is_hit(&self, test: TriangleTest, ray: &Ray) -> bool {
        self.triangles().any(|corners| test(ray, &corners))
    }

    fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> {
        (0..self.mesh.indices.len()).map(|triangle| self.mesh.corners(triangle))
    }

    /// The point of the exact plane that is nearest to a computed hit point.
    ///
    /// The exact ray starts there: the truth needs an origin in the plane, but not a particular one.
    pub fn exact(&self, p: Vec3) -> DVec3 {
        let p = p.as_dvec3();
        p - (p - self.large[0]).dot(self.n) * self.n
    }

    /// The large triangle, moved by `gap` along `n`, with its corners rounded to f32; `None` if the gap is below the
    /// spacing of floats, or if rounding has changed it by more than half.
    pub fn plate(&self, n: DVec3, gap: f64) -> Option<Plate> {
        if gap < self.unit {
            return None;
        }
        let corners = self.large.map(|p| (p + gap * n).as_vec3());
        let kept = corners.iter().all(|&p| {
            let height = (p.as_dvec3() - self.large[0]).dot(n);
            height >= 0.5 * gap && height <= 1.5 * gap
        });
        kept.then_some(Plate { corners })
    }
}

/// A triangle parallel to a patch.
pub struct Plate {
    corners: [Vec3; 3],
}

impl Plate {
    /// Whether a ray hits it by this test.
    pub fn is_hit(&self, test: TriangleTest, ray: &Ray) -> bool {
        test(ray, &self.corners)
    }

    /// Whether the exact ray from `o` along `w` hits it, not too close to its edges.
    pub fn is_truly_hit(&self, o: DVec3, w: DVec3) -> bool {
        // Cramer's rule for o + t w = p0 + b1 e1 + b2 e2.
        let [p0, p1, p2] = self.corners.map(Vec3::as_dvec3);
        let (e1, e2, from) = (p1 - p0, p2 - p0, o - p0);
        let determinant = e1.cross(e2).dot(w);
        let t = -e1.cross(e2).dot(from) / determinant;
        let b1 = w.cross(e2).dot(from) / e1.dot(w.cross(e2));
        let b2 = e1.cross(w).dot(from) / e1.cross(w).dot(e2);
        determinant != 0.0 && t > 0.0 && b1 > MARGIN && b2 > MARGIN && b1 + b2 < 1.0 - MARGIN
    }
}

/// The spacing of floats at `extent`. Its multiples up to there are exact floats.
fn spacing(extent: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let below = f64::from_bits(extent.to_bits() & EXPONENT);
    below * 2.0 / f64::from(1 << 24)
}
