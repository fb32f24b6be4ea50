//! [`Ggx`]: facets whose slopes have the distribution of Trowbridge and Reitz.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::geometry::Xyz;
use crate::simd::Float;

/// A surface of mirrors or boundaries that are too small to be seen, the GGX distribution: how many of them have a normal, which of these
/// are seen from a direction, and how to draw one of those.
///
/// Trowbridge and Reitz 1975; Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", named it GGX. Masking and
/// shadowing are Smith's, correlated by height (Heitz 2014, "Understanding the Masking-Shadowing Function").
///
/// With s(w) = √((αx x)² + (αy y)² + z²), Smith's Λ is (s / |z| - 1) / 2, so that all factors are written without a division by a
/// cosine. All directions are unit vectors above the surface: callers mirror those from below.
///
/// The lobe of facets that reflect is F D(m) [`visibility`](Self::visibility), where m is between wo and wi; nothing in it is 0/0 along the
/// surface, unlike G / (4 cos θo cos θi). A reflected direction has the density [`pdf`](Self::pdf) / (4 wo · m).
///
/// ```
/// use lobe::bxdf::Ggx;
/// use lobe::glam::{Vec2, Vec3};
///
/// let ggx = Ggx::new([0.1, 0.3]);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let m = ggx.sample(wo, Vec2::new(0.2, 0.7));
/// let seen = ggx.g1(wo) * ggx.d(m) * wo.dot(m) / wo.z;
/// assert!((ggx.pdf(wo, m) - seen).abs() < 1e-5 * seen);
/// ```
#[doc(alias = "trowbridge-reitz")]
#[doc(alias = "microfacet")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<F = f32> {
    alpha: [F; 2],
}

impl Ggx {
    /// The least roughness that f32 resolves: below it, half vectors are less exact than the lobe is wide, and lobes that use the
    /// distribution are specular.
    pub const MIN_ALPHA: f32 = 1e-4;

    /// `alpha` is the roughness along x and along y, clamped to [[`MIN_ALPHA`](Self::MIN_ALPHA), 1].
    #[inline]
    pub fn new(alpha: [f32; 2]) -> Self {
        let [x, y] = alpha;
        Self { alpha: [x.clamp(Self::MIN_ALPHA, 1.0), y.clamp(Self::MIN_ALPHA, 1.0)] }
    }

    /// The distribution, or what [`rough`](Self::rough) tells from one: a surface is smooth to f32 if its roughness is below
    /// [`MIN_ALPHA`](Self::MIN_ALPHA) along both axes.
    #[inline]
    pub(in crate::bxdf) fn or_smooth(alpha: [f32; 2]) -> Self {
        let [x, y] = alpha;
        if x < Self::MIN_ALPHA && y < Self::MIN_ALPHA {
            Self { alpha: [0.0; 2] }
        } else {
            Self::new(alpha)
        }
    }

    /// The distribution, if the surface is not smooth.
    #[inline]
    pub(in crate::bxdf) fn rough(&self) -> Option<Self> {
        // A roughness that is not a number gives values that are none, which the Bsdf counts.
        (self.alpha[0] != 0.0).then_some(*self)
    }

    /// Area of the facets with the normal `m`, per area of the surface and solid angle, in 1/sr.
    #[inline]
    pub fn d(&self, m: Vec3) -> f32 {
        self.distribution(m.into())
    }

    /// The fraction of facets that is seen from `w`.
    #[inline]
    pub fn g1(&self, w: Vec3) -> f32 {
        2.0 * w.z / (w.z + self.stretched_length(w.into()))
    }

    /// The fraction of facets that is seen from both.
    #[inline]
    pub fn g(&self, wo: Vec3, wi: Vec3) -> f32 {
        4.0 * wo.z * wi.z * self.visibility(wo, wi)
    }

    /// G(wo, wi) / (4 cos θo cos θi).
    #[inline]
    pub fn visibility(&self, wo: Vec3, wi: Vec3) -> f32 {
        0.5 * self.twice_the_visibility(wo.into(), wi.into())
    }

    /// The normal of a facet that is seen from `wo`: by spherical caps (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
    /// Caps").
    #[inline]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        self.sample_visible(wo.into(), u.to_array()).into()
    }

    /// Density over solid angle with which [`sample`](Self::sample) returns `m`.
    #[inline]
    pub fn pdf(&self, wo: Vec3, m: Vec3) -> f32 {
        self.visible(wo.into(), m.into(), wo.dot(m))
    }

    /// The u for which [`sample`](Self::sample) returns `m`.
    pub fn inverse(&self, wo: Vec3, m: Vec3) -> Vec2 {
        let [ax, ay] = self.alpha;
        let h: Vec3 = self.hemisphere(wo.into()).into();
        let n = Vec3::new(m.x / ax, m.y / ay, m.z).normalize();
        let c = 2.0 * n.dot(h) * n - h;
        let turn = c.y.atan2(c.x) / TAU;
        Vec2::new(if turn < 0.0 { turn + 1.0 } else { turn }, (1.0 - c.z) / (1.0 + h.z))
    }

    /// The roughness along x and along y.
    #[inline]
    pub(in crate::bxdf) fn alpha(&self) -> [f32; 2] {
        self.alpha
    }
}

impl<F: Float> Ggx<F> {
    /// The same roughness in all lanes.
    #[inline(always)]
    pub(in crate::bxdf) fn splat(ggx: Ggx) -> Self {
        let [x, y] = ggx.alpha;
        Self { alpha: [F::splat(x), F::splat(y)] }
    }

    /// With the roughness along x and along y as it is: of a lobe.
    #[inline(always)]
    pub(in crate::bxdf) fn of(alpha: [F; 2]) -> Self {
        Self { alpha }
    }

    /// The roughness that a surface has on the average over its directions.
    #[inline(always)]
    pub(in crate::bxdf) fn mean_alpha(&self) -> F {
        let [x, y] = self.alpha;
        F::select(x.eq(y), x, (F::splat(0.5) * (x * x + y * y)).sqrt())
    }

    /// s(w).
    #[inline(always)]
    pub(in crate::bxdf) fn stretched_length(&self, w: Xyz<F>) -> F {
        let [x, y] = [self.alpha[0] * w.x, self.alpha[1] * w.y];
        (x * x + y * y + w.z * w.z).sqrt()
    }

    /// D(m) for a vector of any length.
    #[inline(always)]
    pub(in crate::bxdf) fn distribution(&self, m: Xyz<F>) -> F {
        let [ax, ay] = self.alpha;
        let [x, y] = [m.x / ax, m.y / ay];
        // The square of a length that is no float is 0: no facets.
        let stretched2 = (x * x + y * y + m.z * m.z).max(F::splat(f32::MIN_POSITIVE));
        let ratio = m.length_squared() / stretched2;
        ratio * ratio * F::splat(FRAC_1_PI) / (ax * ay)
    }

    /// G(wo, wi) / (2 cos θo cos θi).
    #[inline(always)]
    pub(in crate::bxdf) fn twice_the_visibility(&self, wo: Xyz<F>, wi: Xyz<F>) -> F {
        F::splat(1.0) / (self.stretched_length(wo) * wi.z + self.stretched_length(wi) * wo.z)
    }

    /// Density of visible normals, where `cos` is wo · m: G1 D cos / cos θo.
    #[inline(always)]
    pub(in crate::bxdf) fn visible(&self, wo: Xyz<F>, m: Xyz<F>, cos: F) -> F {
        let cos = cos.max(F::splat(0.0));
        F::splat(2.0) * self.distribution(m) * cos / (wo.z + self.stretched_length(wo))
    }

    #[inline(always)]
    pub(in crate::bxdf) fn sample_visible(&self, wo: Xyz<F>, u: [F; 2]) -> Xyz<F> {
        let h = self.hemisphere(wo);
        self.cap(h, h.z, u)
    }

    /// Density of `wi` as the reflection of `wo` by a normal of [`sample_bounded`](Self::sample_bounded), where `sum` is wo + wi.
    #[inline(always)]
    pub(in crate::bxdf) fn reflected_bounded(&self, wo: Xyz<F>, sum: Xyz<F>) -> F {
        let below = self.bound(wo) * wo.z + self.stretched_length(wo);
        self.distribution(sum) / (F::splat(2.0) * below)
    }

    /// The normal of a facet that is seen from `wo` and, most often, reflects it upwards: the spherical cap is cut where no such facet is
    /// (Tokuyoshi and Eto 2024, "Bounded VNDF Sampling for the Smith-GGX BRDF", equations 5 and 6).
    #[inline(always)]
    pub(in crate::bxdf) fn sample_bounded(&self, wo: Xyz<F>, u: [F; 2]) -> Xyz<F> {
        let h = self.hemisphere(wo);
        self.cap(h, self.bound(wo) * h.z, u)
    }

    /// By how much the cap is cut, as a factor of the height at which it ends.
    #[inline(always)]
    fn bound(&self, wo: Xyz<F>) -> F {
        let one = F::splat(1.0);
        let a = self.alpha[0].min(self.alpha[1]);
        let s = one + (wo.x * wo.x + wo.y * wo.y).sqrt();
        let (s2, az) = (s * s, a * wo.z);
        (one - a) * (one + a) * s2 / (s2 + az * az)
    }

    /// The direction in the space in which the facets are a hemisphere.
    #[inline(always)]
    fn hemisphere(&self, wo: Xyz<F>) -> Xyz<F> {
        let [ax, ay] = self.alpha;
        Xyz { x: ax * wo.x, y: ay * wo.y, z: wo.z } / self.stretched_length(wo)
    }

    /// The normal of the facet that reflects `h` to a point of the sphere that is higher than -`end`, by a uniform choice.
    #[inline(always)]
    fn cap(&self, h: Xyz<F>, end: F, [u, v]: [F; 2]) -> Xyz<F> {
        let (one, two) = (F::splat(1.0), F::splat(2.0));
        let from_top = v * (one + end);
        let sin = (from_top * (two - from_top)).max(F::splat(0.0)).sqrt();
        let [cos_phi, sin_phi] = u.unit_circle();
        let [ax, ay] = self.alpha;
        let n = Xyz {
            x: ax * (sin * cos_phi + h.x),
            y: ay * (sin * sin_phi + h.y),
            z: ((one - from_top) + h.z).max(F::splat(0.0)),
        };
        n.normalized()
    }
}
