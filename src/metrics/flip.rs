//! [`flip`]: the perceived difference of two images.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference Evaluator for
//! Alternating Images"; for radiance Andersson, Nilsson, Shirley and Akenine-Möller 2021, "Visualizing Errors in
//! Rendered High Dynamic Range Images". Names and constants are theirs.

use std::f32::consts::PI;

use glam::{Mat3, UVec2, Vec3};

use super::CompareError;
use super::errors::check;
use super::plane::Plane;
use crate::image::{Display, Encoding, Image};

/// Viewing conditions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// Pixels per degree of the field of view.
    pub pixels_per_degree: f32,
}

impl Default for Viewing {
    /// 0.7 m in front of a screen that is 0.7 m wide and has 3840 columns: 67.02 pixels per degree.
    fn default() -> Self {
        Self { pixels_per_degree: 0.7 * (3840.0 / 0.7) * (PI / 180.0) }
    }
}

/// The exposures at which linear images were compared, in stops: evenly spaced, as many as there are stops between
/// the first and the last one, rounded up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposures {
    /// The first one, at which the tone mapper takes the brightest pixel of the reference to 0.85.
    pub start: f32,
    /// The last one, likewise for the pixel of median luminance.
    pub stop: f32,
    /// Number of exposures, at least two.
    pub count: usize,
}

/// The difference that a viewer sees at each pixel who flips between both images, from 0 to 1.
///
/// Encoded images are compared as they are (LDR-FLIP). Linear images are tone mapped at several exposures, which follow
/// from the reference and are returned, and the result is the maximum over them (HDR-FLIP).
///
/// # Errors
/// As [`Errors::between`](super::Errors::between).
pub fn flip(
    image: &Image,
    reference: &Image,
    viewing: Viewing,
) -> Result<(Vec<f32>, Option<Exposures>), CompareError> {
    check(image, reference)?;
    let filters = Filters::new(viewing);
    let vectors = |image: &Image| -> Vec<Vec3> {
        image.pixels.iter().map(|pixel| Vec3::from(pixel.to_array())).collect()
    };
    let (test, truth, size) = (vectors(image), vectors(reference), image.size);
    if image.encoding == Encoding::Srgb {
        let linear = |pixels: Vec<Vec3>| -> Vec<Vec3> {
            pixels
                .into_iter()
                .map(|p| {
                    p.to_array().map(|code| Display::Srgb.decode(f64::from(code)) as f32).into()
                })
                .collect()
        };
        return Ok((difference(size, &linear(test), &linear(truth), &filters), None));
    }
    let exposures = Exposures::of(&truth);
    let mut worst = vec![0.0_f32; truth.len()];
    for exposure in exposures.each() {
        let shown = |pixels: &[Vec3]| -> Vec<Vec3> {
            pixels.iter().map(|&p| tone_map(exposure.exp2() * p)).collect()
        };
        let seen = difference(size, &shown(&test), &shown(&truth), &filters);
        worst.iter_mut().zip(seen).for_each(|(worst, seen)| *worst = worst.max(seen));
    }
    Ok((worst, Some(exposures)))
}

impl Exposures {
    fn of(reference: &[Vec3]) -> Self {
        // Solves the tone mapping curve for the value 0.85.
        const T: f32 = 0.85;
        let [k0, k1, k2, k3, k4, k5] = ACES;
        let (a, b, c) = (k0 - T * k3, k1 - T * k4, k2 - T * k5);
        let half = -0.5 * (b / a);
        let bright = half + (half * half - c / a).sqrt();
        let mut luminances: Vec<f32> =
            reference.iter().map(|p| p.dot(Vec3::new(0.2126, 0.7152, 0.0722))).collect();
        luminances.sort_unstable_by(f32::total_cmp);
        let largest = luminances[luminances.len() - 1].max(f32::EPSILON);
        let median = luminances[luminances.len() / 2].max(f32::EPSILON);
        let (start, stop) = ((bright / largest).log2(), (bright / median).log2());
        Self { start, stop, count: ((stop - start).ceil() as usize).max(2) }
    }

    fn each(&self) -> impl Iterator<Item = f32> {
        let step = (self.stop - self.start) / (self.count - 1) as f32;
        let start = self.start;
        (0..self.count).map(move |i| start + i as f32 * step)
    }
}

/// Coefficients of the tone mapping curve (k₀x² + k₁x + k₂) / (k₃x² + k₄x + k₅), Narkowicz's fit to ACES.
const ACES: [f32; 6] = [0.36 * 2.51, 0.6 * 0.03, 0.0, 0.36 * 2.43, 0.6 * 0.59, 0.14];

fn tone_map(p: Vec3) -> Vec3 {
    // The curve exceeds 1 from 12.1 on; squares of much larger values would leave the range of f32.
    const WHITE: f32 = 100.0;
    let [k0, k1, k2, k3, k4, k5] = ACES;
    let curve = |x: f32| (x * (k0 * x + k1) + k2) / (x * (k3 * x + k4) + k5);
    let p = p.clamp(Vec3::ZERO, Vec3::splat(WHITE));
    Vec3::from(p.to_array().map(curve)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Weights of all filters, each separable.
struct Filters {
    /// Contrast sensitivity to luminance, red-green and blue-yellow, each a sum of two Gaussians.
    color: [[(f32, Vec<f32>); 2]; 3],
    /// Feature detectors: the first and second derivatives of a Gaussian, and the Gaussian for the other axis.
    edge: Vec<f32>,
    point: Vec<f32>,
    smooth: Vec<f32>,
}

impl Filters {
    fn new(Viewing { pixels_per_degree: ppd }: Viewing) -> Self {
        // a₁, b₁, a₂, b₂ of the contrast sensitivity functions.
        const SENSITIVITY: [[f32; 4]; 3] =
            [[1.0, 0.0047, 0.0, 1e-5], [1.0, 0.0053, 0.0, 1e-5], [34.1, 0.04, 13.5, 0.025]];
        let reach = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * ppd).ceil() as i32;
        let gaussian = |b: f32| -> Vec<f32> {
            (-reach..=reach).map(|x| (-PI * PI * (x as f32 / ppd).powi(2) / b).exp()).collect()
        };
        let color = SENSITIVITY.map(|[a1, b1, a2, b2]| {
            let parts = [(a1, b1), (a2, b2)].map(|(a, b)| (a * (PI / b).sqrt(), gaussian(b)));
            let total: f32 =
                parts.iter().map(|(weight, g)| weight * g.iter().sum::<f32>().powi(2)).sum();
            parts.map(|(weight, g)| (weight / total, g))
        });
        let deviation = 0.5 * 0.082 * ppd;
        let reach = (3.0 * deviation).ceil() as i32;
        let row = |of: fn(f32) -> f32| -> Vec<f32> {
            let at = |x: i32| x as f32 / deviation;
            (-reach..=reach).map(|x| of(at(x)) * (-0.5 * at(x).powi(2)).exp()).collect()
        };
        Self {
            color,
            edge: balanced(row(|x| -x)),
            point: balanced(row(|x| x * x - 1.0)),
            smooth: {
                let row = row(|_| 1.0);
                let sum: f32 = row.iter().sum();
                row.into_iter().map(|w| w / sum).collect()
            },
        }
    }
}

/// Scales the weights so that the positive ones sum to 1 and the negative ones to -1.
fn balanced(weights: Vec<f32>) -> Vec<f32> {
    let above: f32 = weights.iter().map(|w| w.max(0.0)).sum();
    let below: f32 = weights.iter().map(|w| -w.min(0.0)).sum();
    weights.into_iter().map(|w| if w < 0.0 { w / below } else { w / above }).collect()
}

/// LDR-FLIP of two images with linear colours in `[0, 1]`.
fn difference(size: UVec2, test: &[Vec3], truth: &[Vec3], filters: &Filters) -> Vec<f32> {
    let (test, truth) = (Seen::new(size, test, filters), Seen::new(size, truth, filters));
    // The largest possible colour difference is that of green and blue.
    const POWER: f32 = 0.7;
    let largest = hyab(hunt_lab(Vec3::Y), hunt_lab(Vec3::Z)).powf(POWER);
    let color = test.lab.iter().zip(&truth.lab);
    let color = color.map(|(&a, &b)| redistribute(hyab(a, b).powf(POWER), largest));
    let edges = test.edges.zip(&truth.edges, |a, b| (a - b).abs());
    let points = test.points.zip(&truth.points, |a, b| (a - b).abs());
    let features = edges.zip(&points, f32::max);
    color
        .zip(&features.values)
        .map(|(color, feature)| {
            let feature = (std::f32::consts::FRAC_1_SQRT_2 * feature).sqrt().min(1.0);
            color.powf(1.0 - feature)
        })
        .collect()
}

/// Maps a difference to `[0, 1]` relative to the largest one; small differences get most of the range.
fn redistribute(difference: f32, largest: f32) -> f32 {
    const C: f32 = 0.4;
    const T: f32 = 0.95;
    let bend = C * largest;
    if difference < bend {
        T / bend * difference
    } else {
        T + (difference - bend) / (largest - bend) * (1.0 - T)
    }
}

/// An image as it is perceived.
struct Seen {
    /// Colours after the contrast sensitivity filter, in L*a*b* with Hunt's adjustment.
    lab: Vec<Vec3>,
    edges: Plane,
    points: Plane,
}

impl Seen {
    fn new(size: UVec2, linear: &[Vec3], filters: &Filters) -> Self {
        let opponent: Vec<Vec3> = linear.iter().map(|&rgb| opponent_of(rgb)).collect();
        let plane =
            |band: usize| Plane { size, values: opponent.iter().map(|p| p[band]).collect() };
        let blurred = [0, 1, 2].map(|band| {
            let plane = plane(band);
            let [(w0, g0), (w1, g1)] = &filters.color[band];
            let first = plane.filtered(g0, g0);
            if *w1 == 0.0 {
                return first.zip(&first, |a, _| w0 * a);
            }
            first.zip(&plane.filtered(g1, g1), |a, b| w0 * a + w1 * b)
        });
        let lab = (0..linear.len()).map(|i| {
            let seen = linear_of(Vec3::from(blurred.each_ref().map(|band| band.values[i])));
            hunt_lab(seen.clamp(Vec3::ZERO, Vec3::ONE))
        });
        let mut luminance = plane(0);
        luminance.values.iter_mut().for_each(|y| *y = (*y + 16.0) / 116.0);
        let feature = |filter: &[f32]| {
            let across = luminance.filtered(filter, &filters.smooth);
            across.zip(&luminance.filtered(&filters.smooth, filter), f32::hypot)
        };
        Self { lab: lab.collect(), edges: feature(&filters.edge), points: feature(&filters.point) }
    }
}

/// Linear Rec. 709 to XYZ.
const TO_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(0.412_386_56, 0.212_636_82, 0.019_330_62),
    Vec3::new(0.357_591_49, 0.715_182_98, 0.119_197_16),
    Vec3::new(0.180_450_49, 0.072_180_2, 0.950_372_6),
);

/// XYZ relative to white.
fn xyz_of(rgb: Vec3) -> Vec3 {
    (TO_XYZ * rgb) / (TO_XYZ * Vec3::ONE)
}

/// Linear opponent colours Y, Cx and Cz.
fn opponent_of(rgb: Vec3) -> Vec3 {
    let Vec3 { x, y, z } = xyz_of(rgb);
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// Inverse of [`opponent_of`].
fn linear_of(opponent: Vec3) -> Vec3 {
    let y = (opponent.x + 16.0) / 116.0;
    let xyz = Vec3::new(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
    TO_XYZ.inverse() * (xyz * (TO_XYZ * Vec3::ONE))
}

/// L*a*b* with Hunt's adjustment: chroma is scaled by luminance.
fn hunt_lab(rgb: Vec3) -> Vec3 {
    const DELTA: f32 = 6.0 / 29.0;
    let f = |t: f32| {
        if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    };
    let [x, y, z] = xyz_of(rgb).to_array().map(f);
    let l = 116.0 * y - 16.0;
    Vec3::new(l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z))
}

/// HyAB, a distance for large colour differences: |ΔL| + √(Δa² + Δb²).
fn hyab(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}
