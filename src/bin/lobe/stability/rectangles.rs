//! Solid angles of rectangles and samples by solid angle, from 1e-10 sr to nearly 2π.

use lobe::glam::{DVec2, DVec3, Vec2, Vec3};
use lobe::light::{AreaLight, Light, LightHit};
use lobe::sampling::SphericalRectangle;
use lobe::{Spectrum, TriangleMesh};

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{half_decades, measured, relative_error, trials, worse};
use super::usual_rectangle::{UsualRectangle, UsualTriangle};

/// Perpendicular edges with integer coordinates, which are exact in f32, and their lengths.
const FRAMES: [([f32; 3], [f32; 3], f64); 4] = [
    ([1.0, 2.0, 2.0], [2.0, 1.0, -2.0], 3.0),
    ([2.0, 3.0, 6.0], [3.0, -6.0, 2.0], 7.0),
    ([1.0, 4.0, 8.0], [4.0, 7.0, -4.0], 9.0),
    ([4.0, 4.0, 7.0], [1.0, -8.0, 4.0], 9.0),
];

/// A rectangle and the point that it is seen from.
pub struct View {
    pub eye: Vec3,
    pub corner: Vec3,
    pub edges: [Vec3; 2],
}

impl View {
    /// A random rectangle and an eye `distance` edges away from one of its points: straight above it if that is less than 1,
    /// else in a random direction at a cosine of at least 0.2.
    fn draw(rng: &mut Rng, distance: f64) -> Self {
        let (x, y, length) = FRAMES[(rng.bits() >> 62) as usize];
        // Aspect ratios up to 4.
        let edges = [x, y].map(|edge| Vec3::from(edge) * (1 + (rng.bits() >> 62)) as f32);
        let corner = (8.0 * rng.in_cube()).round().as_vec3();
        let [ex, ey] = edges.map(Vec3::as_dvec3);
        let normal = ex.cross(ey).normalize();
        let to_eye = loop {
            let v = rng.direction();
            if v.dot(normal).abs() > 0.2 {
                break if distance < 1.0 { normal * v.dot(normal).signum() } else { v };
            }
        };
        let [u, v] = [(); 2].map(|()| 0.1 + 0.8 * rng.unit());
        let eye = corner.as_dvec3() + u * ex + v * ey + distance * length * to_eye;
        Self { eye: eye.as_vec3(), corner, edges }
    }

    /// The solid angle, in f64, of the part of the rectangle up to the fraction `share` of its first edge.
    ///
    /// Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle": tan Ω/2 from a triple product. Edges
    /// are used in place of differences of corners, so that small angles lose no digits.
    pub fn solid_angle(&self, share: f64) -> f64 {
        let [ex, ey] = self.edges.map(Vec3::as_dvec3);
        let a = self.corner.as_dvec3() - self.eye.as_dvec3();
        let (ex, b) = (share * ex, a + share * ex);
        solid_angle([a, b, b + ey], [ex, ey]) + solid_angle([a, b + ey, a + ey], [ex, ey])
    }
}

/// The solid angle of a triangle; `ex` and `ey` span the parallelogram that it is half of.
fn solid_angle([a, b, c]: [DVec3; 3], [ex, ey]: [DVec3; 2]) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let above = a.dot(ex.cross(ey)).abs();
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * above.atan2(below)
}

/// Stored bounds: twice the errors measured for ours.
const SAMPLES: [f64; 21] = [
    1.7e-2, 6.4e-3, 1.6e-3, 6.1e-4, 1.9e-4, 5.6e-5, 1.5e-5, 5.7e-6, 2.0e-6, 8.4e-7, 1.1e-6, 4.4e-7,
    4.4e-7, 3.8e-7, 3.9e-7, 4.4e-7, 3.5e-7, 4.0e-7, 3.8e-7, 3.6e-7, 4.6e-7,
];

const PARAMETER: &str = "distance of the eye (units of the rectangle, whose edges are 1 to 4)";
const ABOUT: &str = "Rectangles of many shapes and directions with exact edges, seen from close above a point of \
                     them, under nearly 2π, or farther than their unit from anywhere, down to 1e-10 sr.";

/// Solid angles by `SphericalRectangle`.
pub fn solid_angles(effort: f64) -> Sweep {
    let ours = |View { eye, corner, edges: [ex, ey] }: &View| {
        SphericalRectangle::new(*eye, *corner, *ex, *ey).map_or(f32::NAN, |one| one.solid_angle())
    };
    let parameters = half_decades(-5, 5);
    Sweep {
        name: "rectangles-angle",
        title: "Error of a rectangle's solid angle, by the eye's distance",
        bounds: vec![1e-7; parameters.len()],
        ..solid_angles_of("SphericalRectangle (ours)", ours, parameters, effort)
    }
}

/// Solid angles by `AreaLight`: the inverse of its density, in the range where it samples by solid angle.
pub fn solid_angles_of_lamps(effort: f64) -> Sweep {
    let ours = |View { eye, corner, edges: [ex, ey] }: &View| {
        let mesh = TriangleMesh::parallelogram(*corner, *ex, *ey);
        let to_light = *corner + 0.5 * *ex + 0.5 * *ey - *eye;
        let distance = to_light.length();
        let n = mesh.geometric_normal(0);
        let hit = LightHit::new(*eye, to_light / distance, distance, n);
        let light = AreaLight::new(&mesh, Spectrum::WHITE, true);
        light.map_or(f32::NAN, |light| 1.0 / light.pdf_li(&hit))
    };
    let mut parameters = half_decades(-5, 3);
    parameters.pop();
    let mut sweep = Sweep {
        name: "rectangles-lamp",
        title: "Error of the solid angle behind a lamp's density, by the eye's distance",
        // It uses f32 in the middle of the range. Twice the errors measured.
        bounds: parameters
            .iter()
            .map(|&distance| match distance {
                x if !(0.05..=20.0).contains(&x) => 2e-7,
                x if x < 0.5 => 1e-6,
                _ => 8e-6,
            })
            .collect(),
        ..solid_angles_of("AreaLight (ours)", ours, parameters, effort)
    };
    sweep.about += " `AreaLight` computes it in f32 from 0.05 sr on, and in f64 down to 1e-6 sr, where this chart \
                    ends.";
    sweep
}

fn solid_angles_of(
    name: &'static str,
    ours: impl Fn(&View) -> f32 + Sync,
    parameters: Vec<f64>,
    effort: f64,
) -> Sweep {
    let views = trials(20_000, effort, 300);
    let named =
        [("Ureña et al., f32", false), ("triangles by angle excess, f32", false), (name, true)];
    let methods = measured(&parameters, named, |seed, distance| {
        let mut rng = Rng::new(seed as u64);
        let mut worst = [0.0; 3];
        for _ in 0..views {
            let view = View::draw(&mut rng, distance);
            let View { eye, corner, edges: [ex, ey] } = view;
            let usual = UsualRectangle::new(eye, corner, ex, ey).s;
            let far = corner + ex + ey;
            let triangles = [[corner, corner + ex, far], [corner, far, corner + ey]]
                .map(|corners| UsualTriangle::new(eye, corners).area);
            let truth = view.solid_angle(1.0);
            let found = [usual, triangles[0] + triangles[1], ours(&view)];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worse(*worst, relative_error(f64::from(found), truth));
            }
        }
        worst
    });
    Sweep {
        name: "",
        title: "",
        about: format!(
            "{ABOUT} The largest error of {views} for each point; NaN counts as infinite. Truth is the formula of \
             Van Oosterom and Strackee 1983 in f64, with edges in its triple product. Common methods: Ureña, Fajardo and \
             King 2013 as printed, and two triangles by Girard's angle excess, both in f32."
        ),
        parameter: PARAMETER,
        log_parameter: true,
        measure: "largest relative error of the solid angle",
        methods,
        fails_from: 1e-3,
        bounds: Vec::new(),
        parameters,
    }
}

/// Samples by solid angle.
pub fn samples(effort: f64) -> Sweep {
    let parameters = half_decades(-5, 5);
    let views = trials(20_000, effort, 300);
    let named = [("Ureña et al., f32", false), ("SphericalRectangle (ours)", true)];
    let methods = measured(&parameters, named, |seed, distance| {
        let mut rng = Rng::new(seed as u64);
        let mut worst = [0.0; 2];
        for _ in 0..views {
            let view = View::draw(&mut rng, distance);
            let View { eye, corner, edges: [ex, ey] } = view;
            let u = Vec2::new(rng.unit() as f32, rng.unit() as f32).min(Vec2::splat(0.999_999_9));
            let usual = UsualRectangle::new(eye, corner, ex, ey).sample(u);
            let ours = SphericalRectangle::new(eye, corner, ex, ey);
            let ours = ours.map_or(Vec3::NAN, |rectangle| rectangle.sample(u));
            for (worst, point) in worst.iter_mut().zip([usual, ours]) {
                *worst = worse(*worst, misplaced(&view, point, u));
            }
        }
        worst
    });
    Sweep {
        name: "rectangles-samples",
        title: "Error of samples on a rectangle, by the eye's distance",
        about: format!(
            "{ABOUT} A sample for u should have the share u.x of the solid angle to its left, and on its line the \
             share u.y below it; the error is the largest difference of {views} samples for each point, where NaN \
             counts as infinite. Truth is the formula of Van Oosterom and Strackee 1983 in f64, for the f32 point. \
             Common method: Ureña, Fajardo and King 2013 as printed, in f32. The rest of our error close to the rectangle \
             is the rounding of the point to f32."
        ),
        parameter: PARAMETER,
        log_parameter: true,
        measure: "largest error of the share of the solid angle",
        methods,
        fails_from: 1e-2,
        bounds: SAMPLES.to_vec(),
        parameters,
    }
}

/// Difference between the position of a sample and u, as fractions of the solid angle and of the line across.
fn misplaced(view: &View, point: Vec3, u: Vec2) -> f64 {
    let [ex, ey] = view.edges.map(Vec3::as_dvec3);
    let moved = point.as_dvec3() - view.corner.as_dvec3();
    let share = moved.dot(ex) / ex.length_squared();
    let left = view.solid_angle(share.clamp(0.0, 1.0)) / view.solid_angle(1.0);
    // Along the line through the point, the sine of the angle from the eye's foot point is uniform.
    let foot = view.eye.as_dvec3() - view.corner.as_dvec3();
    let on_line = foot - share * ex;
    let along = on_line.dot(ey) / ey.length();
    let depth2 = (on_line.length_squared() - along * along).max(0.0);
    let sine = |y: f64| (y - along) / DVec2::new(y - along, depth2.sqrt()).length();
    let y = moved.dot(ey) / ey.length();
    let (h0, h1) = (sine(0.0), sine(ey.length()));
    let below = (sine(y) - h0) / (h1 - h0);
    // Points outside the rectangle are wrong by their distance.
    let beyond = (share - share.clamp(0.0, 1.0)).abs();
    worse(worse((left - f64::from(u.x)).abs(), (below - f64::from(u.y)).abs()), beyond)
}
