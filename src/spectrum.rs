//! [`Spectrum`]: linear RGB, for light and for reflectances.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

use glam::{Vec3, Vec3A};

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
