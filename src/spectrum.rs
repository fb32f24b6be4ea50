//! [`Spectrum`]: the colour of light and of surfaces, as linear RGB.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

use glam::{Vec3, Vec3A};

/// A spectral quantity in three bands: linear RGB with the Rec. 709 primaries and the D65 white point.
///
/// It stands for radiance in W / (m² sr), for radiant intensity in W / sr, or for a reflectance
/// without a unit, as the place that uses it says. Products and sums are per band: the reflection
/// models assume that no energy moves from one wavelength to another (no fluorescence).
///
/// ```
/// use lobe::Spectrum;
/// let red = Spectrum::new(0.8, 0.1, 0.2);
/// assert_eq!((red * 0.5).to_array(), [0.4, 0.05, 0.1]);
/// assert!((red * Spectrum::BLACK).is_black());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spectrum(Vec3A);

impl Spectrum {
    /// No light, or a surface that reflects none.
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

    /// Whether every band is finite and at least zero: what radiance and reflectance have to be.
    #[inline]
    pub fn is_valid(self) -> bool {
        self.0.is_finite() && self.0.cmpge(Vec3A::ZERO).all()
    }

    /// Every band brought into `[low, high]`. What becomes of NaN is left open.
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
