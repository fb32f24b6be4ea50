//! Area lights with textures: samples, densities and radiance agree with each other, with integrals over the surface, and with
//! lights of one radiance.

use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::{DVec3, Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{AreaLight, Light, LightHit, TexturedAreaLight};
use lobe::{Spectrum, TriangleMesh};

use super::{L, rectangle};
use crate::common::Rng;
use crate::common::meshes::{grid, placed, soup};
use crate::common::stats::{assert_fits, assert_mean, mean};

/// A bowl of 4 × 4 squares that is open towards +z, with texture coordinates from 0 to 1, and triangles without area between the others.
fn bowl() -> TriangleMesh {
    let mut mesh = grid(4);
    mesh.uvs = mesh.positions.iter().map(|p| Vec2::new(p.x + 2.0, p.z + 2.0) / 4.0).collect();
    for p in &mut mesh.positions {
        *p = Vec3::new(p.x, -p.z, 0.1 * (p.x * p.x + p.z * p.z)) * 0.5;
    }
    mesh.indices = mesh.indices.iter().flat_map(|&t| [[t[0]; 3], [t[0], t[2], t[1]]]).collect();
    mesh
}

/// Black but for a corner, where it grows.
fn corner(uv: Vec2) -> Spectrum {
    L * (uv.x + uv.y - 1.6).max(0.0)
}

fn by_uv(radiance: fn(Vec2) -> Spectrum) -> impl Fn(&SurfaceInteraction) -> Spectrum {
    move |si| radiance(si.uv())
}

/// What is to be done with the hit of a ray from `origin` along `wi`.
fn with_hit<T>(
    accel: &Accel,
    mesh: &TriangleMesh,
    [origin, wi]: [Vec3; 2],
    use_hit: impl FnOnce(&LightHit) -> T,
) -> Option<T> {
    let hit = accel.intersect1(&Ray::new(origin, wi));
    hit.is_hit().then(|| {
        let si = SurfaceInteraction::on_triangle(mesh, hit.triangle as usize, hit.b, -wi);
        use_hit(&LightHit::on_surface(origin, &si))
    })
}

/// The sum of `value` over the centres of `cuts`² equal parts of each triangle: of the point, unit normal, texture coordinates and
/// area of a part.
fn integral(mesh: &TriangleMesh, cuts: u32, value: impl Fn(DVec3, DVec3, Vec2, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for t in 0..mesh.indices.len() {
        let corners = mesh.corners(t).map(Vec3::as_dvec3);
        let uvs = mesh.corner_uvs(t);
        let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let area = n.length() / 2.0 / f64::from(cuts * cuts);
        for (i, j) in (0..cuts).flat_map(|i| (0..cuts - i).map(move |j| (i, j))) {
            for third in [1.0, 2.0].into_iter().take(if i + j + 1 < cuts { 2 } else { 1 }) {
                let x = (f64::from(i) + third / 3.0) / f64::from(cuts);
                let y = (f64::from(j) + third / 3.0) / f64::from(cuts);
                let b = [1.0 - x - y, x, y];
                let p = (0..3).map(|k| corners[k] * b[k]).sum();
                let uv = (0..3).map(|k| uvs[k] * b[k] as f32).sum();
                sum += value(p, n.normalize_or_zero(), uv, area);
            }
        }
    }
    sum
}

/// The density of a sample is that of the ray that goes there, and so is the radiance: on bowls of any size, and on rectangles, of which
/// some are so small that points are sampled by area. Caught: the density of all triangles together, that of the next triangle, the
/// radiance of another point of the triangle, and on rectangles that of the triangle that the point is not on.
#[test]
fn samples_and_rays_of_a_texture_agree() {
    let (mut checked, mut on_rectangles) = (0, 0);
    for trial in 0..3000 {
        let mut rng = Rng::new(960, trial);
        let scale = rng.coordinate(4.0).abs();
        let mesh = match trial % 2 {
            0 => bowl(),
            _ => {
                let x = rng.direction();
                let y = x.any_orthonormal_vector() * rng.within(0.1, 3.0);
                TriangleMesh::parallelogram(rng.direction(), x, y)
            }
        };
        let mesh = placed(mesh, scale, Vec3::ZERO);
        let radiance = by_uv(|uv| Spectrum::new(0.1 + uv.x, 0.1 + uv.y, 2.0 - uv.x - uv.y));
        let light = TexturedAreaLight::new(&mesh, radiance, rng.below(2) == 0).unwrap();
        let accel = Accel::build(std::slice::from_ref(&mesh));
        let far = if trial % 8 == 1 { 3000.0 } else { rng.within(1.5, 20.0) };
        let p = scale * far * rng.direction();
        for _ in 0..10 {
            let Some(sample) = light.sample_li(p, rng.square()) else { continue };
            with_hit(&accel, &mesh, [p, sample.wi], |hit| {
                let (surface, cos) = (hit.surface.unwrap(), hit.n.dot(hit.wi).abs());
                // Rays to the border of a triangle may miss it, and others may hit another triangle first.
                let b = surface.place().unwrap().b;
                let off = (surface.p() - sample.from.unwrap()).length() / scale;
                if off > 3e-7 * far / cos || cos < 1e-2 || b.iter().any(|b| *b < 0.01) {
                    return;
                }
                let (pdf, le) = (light.pdf_li(hit), light.le(hit));
                assert!((pdf / sample.pdf - 1.0).abs() < 1e-3, "trial {trial}: {pdf}, {sample:?}");
                let off = le.to_array().into_iter().zip(sample.li.to_array());
                let off = off.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                // As many roundings of the point as of the distance.
                assert!(off < 1e-5 + 2e-6 * far / cos, "trial {trial}: {le:?}, {sample:?}");
                checked += 1;
                on_rectangles += trial % 2;
            });
        }
    }
    assert!(checked > 8000 && on_rectangles > 3000, "only {checked}, {on_rectangles}");
}

/// Irradiance from a bowl that is black but for a corner, and from a rectangle, seen from all sides: the mean over 200,000 samples
/// against a sum over the surface. Caught: light from a side that does not shine, the radiance of another point of the triangle, and on
/// rectangles that of the other triangle.
#[test]
fn a_texture_gives_the_irradiance_of_its_integral() {
    const TRIALS: u64 = 24;
    for trial in 0..TRIALS {
        let mut rng = Rng::new(961, trial);
        let mesh = match trial % 3 {
            0 => TriangleMesh::parallelogram(Vec3::new(-0.5, -0.5, 0.0), Vec3::X, Vec3::Y),
            _ => bowl(),
        };
        let two_sided = trial % 2 == 0;
        let light = TexturedAreaLight::new(&mesh, by_uv(corner), two_sided).unwrap();
        // In front of it or behind.
        let p = Vec3::new(rng.within(-1.0, 1.0), rng.within(-1.0, 1.0), 0.0)
            + Vec3::Z * if trial % 4 < 2 { 1.5 } else { -1.5 };
        let truth = integral(&mesh, 64, |q, n, uv, area| {
            let to_p = p.as_dvec3() - q;
            let cos = to_p.normalize().dot(n);
            let cos = if two_sided { cos.abs() } else { cos.max(0.0) };
            let cos_p = to_p.normalize().z.abs();
            f64::from(corner(uv).to_array()[0]) * cos * cos_p * area / to_p.length_squared()
        });
        let (found, error) = mean((0..200_000).map(|_| {
            light.sample_li(p, rng.square()).map_or(0.0, |sample| {
                let red = f64::from(sample.li.to_array()[0]);
                red * f64::from(sample.wi.z.abs()) / f64::from(sample.pdf)
            })
        }));
        if truth == 0.0 {
            assert_eq!(found, 0.0, "trial {trial}");
        } else {
            assert_mean(found, error, truth, TRIALS as usize, &format!("trial {trial}"));
        }
    }
}

/// Each triangle is drawn by its power nine times in ten, else by its area: 1e6 samples, chi-square. Its density follows. Caught:
/// a twentieth by area, all by area, powers that are means without areas, and the largest band for luminance.
#[test]
fn triangles_are_drawn_by_power() {
    let mut rng = Rng::new(962, 0);
    // Side by side along x, every seventh without area, every fourth dark.
    let triangles: Vec<[Vec3; 3]> = (0..50)
        .map(|i| {
            let at = Vec3::new(i as f32, 0.0, 0.0);
            let height = if i % 7 == 0 { 0.0 } else { rng.within(0.1, 3.0) };
            [at, at + 0.9 * Vec3::X, at + height * Vec3::Y]
        })
        .collect();
    let radiance = |triangle: u32| {
        // Black points give no samples.
        let shade = if triangle.is_multiple_of(4) { 1e-6 } else { (1 + triangle % 9) as f32 };
        Spectrum::new(shade, 0.5 * shade.min(1.0), 0.25 * shade)
    };
    let by_triangle = move |si: &SurfaceInteraction| radiance(si.place().unwrap().triangle);
    let mesh = soup(&triangles);
    let light = TexturedAreaLight::new(&mesh, by_triangle, false).unwrap();
    let area = |t: &[Vec3; 3]| f64::from((t[1] - t[0]).cross(t[2] - t[0]).length()) / 2.0;
    let areas: Vec<f64> = triangles.iter().map(area).collect();
    let powers: Vec<f64> =
        (0..).zip(&areas).map(|(t, area)| area * f64::from(radiance(t).luminance())).collect();
    let (total, sum) = (areas.iter().sum::<f64>(), powers.iter().sum::<f64>());
    let probabilities: Vec<f64> =
        areas.iter().zip(&powers).map(|(a, power)| 0.1 * a / total + 0.9 * power / sum).collect();
    let p = Vec3::new(25.0, 0.0, 40.0);
    let mut observed = vec![0; 50];
    for _ in 0..1_000_000 {
        let sample = light.sample_li(p, rng.square()).unwrap();
        let triangle = sample.from.unwrap().x as usize;
        observed[triangle] += 1;
        assert_eq!(sample.li, radiance(triangle as u32));
        let distance2 = f64::from((sample.from.unwrap() - p).length_squared());
        let cos = f64::from(sample.wi.z.abs());
        let pdf = distance2 * probabilities[triangle] / (cos * areas[triangle]);
        assert!((f64::from(sample.pdf) / pdf - 1.0).abs() < 1e-4, "triangle {triangle}");
    }
    let expected: Vec<f64> = probabilities.iter().map(|p| p * 1e6).collect();
    assert_fits(&observed, &expected, 1, "triangles");
}

/// π times the integral of the radiance over the area, twice that for both sides: within 1e-3 from the points that stand for a
/// triangle. Values that are negative or not finite count as black, and a light of no power is sampled by area. Caught: the sum of the triangles' means,
/// one side for both, points on a diagonal, negative and infinite values in the mean, no choice without power, and NaN that gives no sample.
#[test]
fn power_is_the_integral_of_the_texture() {
    for mesh in [bowl(), TriangleMesh::parallelogram(Vec3::ZERO, Vec3::X, 3.0 * Vec3::Y)] {
        let truth = integral(&mesh, 64, |_, _, uv, area| {
            f64::from(corner(uv).to_array()[0]) * area * std::f64::consts::PI
        });
        for (two_sided, sides) in [(false, 1.0), (true, 2.0)] {
            let light = TexturedAreaLight::new(&mesh, by_uv(corner), two_sided).unwrap();
            let power = light.power(&Default::default()).unwrap().to_array()[0];
            let ratio = f64::from(power) / (sides * truth);
            assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
        }
        let strange = |si: &SurfaceInteraction| match si.uv().x {
            x if x < 0.25 => Spectrum::splat(f32::NAN),
            x if x < 0.5 => Spectrum::splat(f32::INFINITY),
            x if x < 0.75 => Spectrum::splat(-1e9),
            _ => Spectrum::BLACK,
        };
        let light = TexturedAreaLight::new(&mesh, strange, false).unwrap();
        assert_eq!(light.power(&Default::default()), Some(Spectrum::BLACK));
        let mut rng = Rng::new(965, 0);
        let sample = || light.sample_li(Vec3::new(0.2, 0.3, 9.0), rng.square());
        // What is black gives none, what is no number does.
        let count = std::iter::repeat_with(sample).take(1000).flatten().count();
        assert!((300..700).contains(&count), "{count}");
    }
}

/// Bands below 0 emit nothing, and values that are no numbers stay, so that they are counted; so does light at a hit that does not tell
/// its place. Caught: negative bands as they are, NaN made 0, a density or radiance of 0 without a place, and radiance on the dark side.
#[test]
fn values_that_no_lamp_emits() {
    let mesh = bowl();
    let accel = Accel::build(std::slice::from_ref(&mesh));
    let ray = [Vec3::new(0.1, 0.2, 3.0), Vec3::NEG_Z];
    let emitted = |value: Spectrum| {
        let light = TexturedAreaLight::new(&mesh, move |_: &SurfaceInteraction| value, false);
        let light = light.unwrap();
        let le = with_hit(&accel, &mesh, ray, |hit| light.le(hit)).unwrap();
        let li = light.sample_li(ray[0], Vec2::splat(0.4)).unwrap().li;
        assert!(le == li || !(le.is_finite() || li.is_finite()), "{le:?}, {li:?}");
        le.to_array()
    };
    assert_eq!(emitted(Spectrum::new(-1.0, 2.0, 3.0)), [0.0, 2.0, 3.0]);
    assert!(emitted(Spectrum::new(f32::NAN, 2.0, 3.0))[0].is_nan());
    assert_eq!(emitted(Spectrum::splat(f32::INFINITY)), [f32::INFINITY; 3]);
    let light = TexturedAreaLight::new(&mesh, by_uv(corner), false).unwrap();
    let hit = LightHit::new(ray[0], ray[1], 3.0, Vec3::Z);
    assert!(light.pdf_li(&hit).is_nan() && !light.le(&hit).is_finite());
    let behind = LightHit::new(ray[0], ray[1], 3.0, Vec3::NEG_Z);
    assert_eq!(light.le(&behind), Spectrum::BLACK);
    // No area, no light.
    let flat = soup(&[[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]]);
    assert!(TexturedAreaLight::new(&flat, by_uv(corner), false).is_none());
    assert!(TexturedAreaLight::new(&TriangleMesh::default(), by_uv(corner), false).is_none());
}

/// A light whose texture has one value has the directions, densities and bounds of one with a radiance, on a rectangle to the bit.
/// Caught: a triangle without area that makes a rectangle none, or that widens the cone of normals.
#[test]
fn a_texture_of_one_value_is_like_a_constant() {
    let mut extra = rectangle(Vec3::ZERO, Vec3::X, Vec3::Y);
    // A rectangle in spite of a triangle without area.
    extra.indices.insert(1, [0, 1, 1]);
    for (mesh, is_rectangle) in [(extra, true), (bowl(), false)] {
        let textured = TexturedAreaLight::new(&mesh, |_: &SurfaceInteraction| L, true).unwrap();
        let constant = AreaLight::new(&mesh, L, true).unwrap();
        assert_eq!(format!("{:?}", textured.bounds()), format!("{:?}", constant.bounds()));
        let mut rng = Rng::new(963, 0);
        for trial in 0..1000 {
            let (p, u) = (rng.within(2.0, 9.0) * rng.direction(), rng.square());
            let [a, b] = [&textured as &dyn Light, &constant].map(|light| light.sample_li(p, u));
            if is_rectangle {
                assert_eq!(a, b, "trial {trial}");
            }
            let [Some(a), Some(b)] = [a, b] else {
                assert_eq!(a, b, "trial {trial}");
                continue;
            };
            let (off, density) = ((a.wi - b.wi).length(), (a.pdf / b.pdf - 1.0).abs());
            assert!(off < 1e-2 && density < 1e-2, "trial {trial}: {a:?}, {b:?}");
        }
    }
}

/// A ceiling of 16 × 16 squares of which one shines: with as many samples the variance of the irradiance is 100 times less than by area, at least.
/// It prints both. Caught: triangles by area.
#[test]
fn a_dark_texture_has_less_noise_by_power() {
    let mut mesh = grid(16);
    mesh.uvs = mesh.positions.iter().map(|p| Vec2::new(p.x + 8.0, p.z + 8.0)).collect();
    let bright =
        |uv: Vec2| Spectrum::splat(f32::from(u8::from(uv.floor() == Vec2::new(11.0, 4.0))));
    let textured = TexturedAreaLight::new(&mesh, by_uv(bright), true).unwrap();
    let constant = AreaLight::new(&mesh, Spectrum::WHITE, true).unwrap();
    let p = Vec3::new(0.0, -4.0, 0.0);
    let variance = |light: &dyn Light, is_lit: bool| {
        let mut rng = Rng::new(964, 0);
        let (mean, error) = mean((0..100_000).map(|_| {
            let Some(sample) = light.sample_li(p, rng.square()) else { return 0.0 };
            let from = sample.from.unwrap();
            let lit = if is_lit { sample.li } else { bright(Vec2::new(from.x, from.z) + 8.0) };
            f64::from(lit.to_array()[0]) * f64::from(sample.wi.y) / f64::from(sample.pdf)
        }));
        (mean, error * error * 1e5)
    };
    let [by_power, by_area] = [variance(&textured, true), variance(&constant, false)];
    println!("mean and variance: {by_power:?} by power, {by_area:?} by area");
    assert_mean(by_power.0, (by_area.1 / 1e5).sqrt(), by_area.0, 1, "the same light");
    assert!(by_area.1 > 100.0 * by_power.1, "{by_area:?}, {by_power:?}");
}

/// Few triangles take few lookups, whatever their area: each instance of a lamp makes them anew. Caught: all shared points on one triangle.
#[test]
fn few_triangles_take_few_lookups() {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};
    for (cut, most) in [(1, 2 * 4112), (40, 3200 * 16 + 65_536)] {
        let lookups = Arc::new(AtomicUsize::new(0));
        let counted = lookups.clone();
        let radiance = move |_: &SurfaceInteraction| {
            counted.fetch_add(1, Ordering::Relaxed);
            L
        };
        TexturedAreaLight::new(&grid(cut), radiance, false).unwrap();
        let found = lookups.load(Ordering::Relaxed);
        assert!(found <= most && 2 * found > most, "{cut}: {found}");
    }
}
