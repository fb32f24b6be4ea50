//! [`Spectrum`]: linear RGB, for light and for reflectances.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

use glam::{Vec3, Vec3A};

use crate::simd::{Float, LaneMask};

/// A spectral quantity in three bands: linear RGB with the Rec. 709 primaries and the D65 white point.
///
/// The unit depends on the use: radiance in W / (m² sr), radiant intensity in W / sr, or a reflectance without
/// a unit. All operations are per band, since reflection models do not move energy between wavelengths
/// (no fluorescence).
///
/// ```
/// use lobe::Spectrum;
/// let red = Spectrum::new(0.8, 0.1, 0.2);
/// assert_eq!((red * 0.5).to_array(), [0.4, 0.05, 0.1]);
/// assert!((red * Spectrum::BLACK).is_black());
/// ```
#[doc(alias = "rgb")]
#[doc(alias = "color")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spectrum(Vec3A);

impl Spectrum {
    /// Zero in every band.
    pub const BLACK: Self = Self(Vec3A::ZERO);
    /// One in every band.
    pub const WHITE: Self = Self(Vec3A::ONE);

    /// A spectrum from its red, green and blue bands.
    #[inline]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Self(Vec3A::new(r, g, b))
    }

    /// The same value in every band.
    #[inline]
    pub const fn splat(value: f32) -> Self {
        Self(Vec3A::splat(value))
    }

    /// The bands, red first.
    #[inline]
    pub const fn to_array(self) -> [f32; 3] {
        self.0.to_array()
    }

    /// Whether every band is exactly zero, of either sign.
    #[inline]
    pub fn is_black(self) -> bool {
        self.0 == Vec3A::ZERO
    }

    /// Whether no band is infinite or NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    /// Whether every band is finite and at least zero, as radiances and reflectances have to be.
    #[inline]
    pub fn is_valid(self) -> bool {
        self.0.is_finite() && self.0.cmpge(Vec3A::ZERO).all()
    }

    /// Every band clamped to `[low, high]`. The result for NaN is unspecified.
    #[inline]
    pub fn clamp(self, low: f32, high: f32) -> Self {
        Self(self.0.clamp(Vec3A::splat(low), Vec3A::splat(high)))
    }

    /// Relative luminance Y of linear Rec. 709 (ITU-R BT.709).
    #[inline]
    pub fn luminance(&self) -> f32 {
        self.0.dot(Vec3A::new(0.2126, 0.7152, 0.0722))
    }

    /// The largest band.
    #[inline]
    pub fn max_component(self) -> f32 {
        self.0.max_element()
    }
}

impl From<[f32; 3]> for Spectrum {
    #[inline]
    fn from(rgb: [f32; 3]) -> Self {
        Self(Vec3A::from_array(rgb))
    }
}

impl From<Vec3> for Spectrum {
    #[inline]
    fn from(rgb: Vec3) -> Self {
        Self(Vec3A::from(rgb))
    }
}

impl Add for Spectrum {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl AddAssign for Spectrum {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Sub for Spectrum {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Mul<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f32) -> Self {
        Self(self.0 * factor)
    }
}

impl Div<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f32) -> Self {
        Self(self.0 / divisor)
    }
}

impl Sum for Spectrum {
    fn sum<I: Iterator<Item = Self>>(spectra: I) -> Self {
        spectra.fold(Self::BLACK, Add::add)
    }
}

/// The bands of a [`Spectrum`], or of one in each lane.
#[derive(Clone, Copy)]
pub(crate) struct Bands<F>(pub [F; 3]);

impl<F: Float> Bands<F> {
    /// The same spectrum in every lane.
    #[inline(always)]
    pub fn splat(spectrum: Spectrum) -> Self {
        let [r, g, b] = spectrum.to_array();
        Self([F::splat(r), F::splat(g), F::splat(b)])
    }

    /// Per lane: the spectrum where the mask is set, otherwise black.
    #[inline(always)]
    pub fn only(self, mask: F::Mask) -> Self {
        let [r, g, b] = self.0;
        let zero = F::splat(0.0);
        Self([F::select(mask, r, zero), F::select(mask, g, zero), F::select(mask, b, zero)])
    }

    /// As [`Spectrum::is_black`].
    #[inline(always)]
    pub fn is_black(self) -> F::Mask {
        let ([r, g, b], zero) = (self.0, F::splat(0.0));
        r.eq(zero) & g.eq(zero) & b.eq(zero)
    }

    /// As [`Spectrum::is_valid`].
    #[inline(always)]
    pub fn is_valid(self) -> F::Mask {
        let (zero, infinity) = (F::splat(0.0), F::splat(f32::INFINITY));
        let mut valid = F::Mask::splat(true);
        for band in self.0 {
            valid = valid & zero.le(band) & band.lt(infinity);
        }
        valid
    }

    /// As [`Spectrum::max_component`].
    #[inline(always)]
    pub fn max_component(self) -> F {
        let [r, g, b] = self.0;
        r.max(g).max(b)
    }
}

impl<F: Float> Add for Bands<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([r, g, b], [or, og, ob]) = (self.0, other.0);
        Self([r + or, g + og, b + ob])
    }
}

impl<F: Float> Mul for Bands<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let ([r, g, b], [or, og, ob]) = (self.0, other.0);
        Self([r * or, g * og, b * ob])
    }
}

impl<F: Float> Mul<F> for Bands<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: F) -> Self {
        let [r, g, b] = self.0;
        Self([r * factor, g * factor, b * factor])
    }
}

impl<F: Float> Div<F> for Bands<F> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: F) -> Self {
        let [r, g, b] = self.0;
        Self([r / divisor, g / divisor, b / divisor])
    }
}

impl From<Bands<f32>> for Spectrum {
    #[inline(always)]
    fn from(Bands(bands): Bands<f32>) -> Self {
        bands.into()
    }
}
