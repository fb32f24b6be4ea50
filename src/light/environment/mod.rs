//! [`EnvironmentLight`]: light from all around, by an image.

mod density;
mod error;
mod map;
mod orientation;

use std::f32::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{Quat, Vec2, Vec3};

pub use error::EnvironmentError;

use super::{BoundingSphere, Emitted, EscapedRays, Light, LightHit, LightSample, Read};
use crate::image::Image;
use crate::params::{Factor, Fault, Handedness, Key, Kind, Rotation, Shown, Table};
use crate::spectrum::Spectrum;
use crate::texture::Texels;
use density::Density;
use map::Map;
use orientation::Orientation;

/// How an environment map is laid around the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentSettings {
    /// Factor of its radiance, by band.
    pub scale: Spectrum,
    /// Turns the map with all that is seen in it.
    pub rotation: Quat,
    /// Which kind of space the world is: that of the camera.
    pub handedness: Handedness,
}

impl Default for EnvironmentSettings {
    fn default() -> Self {
        let (scale, rotation) = (Spectrum::WHITE, Quat::IDENTITY);
        Self { scale, rotation, handedness: Handedness::Left }
    }
}

/// Light from all around, by an equirectangular image (PBRT 3rd edition, section 12.6).
///
/// The image lies as the [equirectangular camera](crate::camera::EquirectangularCamera) sees the world: a picture that it takes
/// at its default place, along +z with +y up, shows the same sky again. With x from 0 at the left to 1 at the right and y from 0
/// at the top to 1 at the bottom, the direction is sin θ (cos φ forward + sin φ right) + cos θ up, where φ = 2π (x - 1/2) and
/// θ = π y; forward is +z, up is +y, and right is +x in a left-handed world and -x in a right-handed one, before rotation.
///
/// Radiance is bilinear between the centres of pixels, around the image from the last column to the first, and constant from the
/// centres of the first and last row to the poles. Directions are sampled by luminance times solid angle, with a density that is
/// above 0 wherever the radiance is.
///
/// A pixel takes 16 bytes, or 8 if it has codes of 8 bits: 512 MiB for 8192 × 4096 pixels of radiance, of which the sampling
/// takes 128 MiB.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::glam::{UVec2, Vec2, Vec3};
/// use lobe::image::{Encoding, Image};
/// use lobe::light::{EnvironmentLight, Light, LightHit};
///
/// // Dark above the horizon, 2 below.
/// let pixels = vec![Spectrum::BLACK, Spectrum::BLACK, Spectrum::splat(2.0), Spectrum::splat(2.0)];
/// let size = UVec2::new(1, 4);
/// let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding: Encoding::Linear };
/// let light = EnvironmentLight::new(&image, &Default::default())?;
/// let towards = |wi| light.le(&LightHit::outside(Vec3::ZERO, wi)).to_array()[0];
/// assert_eq!([towards(Vec3::Y), towards(Vec3::NEG_Y)], [0.0, 2.0]);
/// assert!((towards(Vec3::X) - 1.0).abs() < 1e-6);
/// assert!(light.sample_li(Vec3::ZERO, Vec2::new(0.5, 0.5)).unwrap().wi.y < 0.0);
/// # Ok::<(), lobe::light::EnvironmentError>(())
/// ```
#[doc(alias = "envmap")]
#[doc(alias = "infinite")]
#[doc(alias = "hdri")]
#[doc(alias = "image-based lighting")]
pub struct EnvironmentLight {
    map: Map,
    orientation: Orientation,
    /// `None` if the map is black.
    density: Option<Density>,
    mean: Spectrum,
}

impl EnvironmentLight {
    /// A light of an image: radiance in W / (m² sr), or codes of sRGB if its encoding says so.
    ///
    /// # Errors
    /// If a pixel is NaN, infinite or negative, or if a setting is; if the image has not one pixel for each place; or if memory is not available.
    pub fn new(image: &Image, settings: &EnvironmentSettings) -> Result<Self, EnvironmentError> {
        let orientation = orientation(settings)?;
        Self::of_map(Map::new(image, settings.scale)?, orientation)
    }

    /// The same without the image in memory when the density is made.
    fn of_image(image: Image, settings: &EnvironmentSettings) -> Result<Self, EnvironmentError> {
        let orientation = orientation(settings)?;
        let map = Map::new(&image, settings.scale)?;
        drop(image);
        Self::of_map(map, orientation)
    }

    fn of_map(map: Map, orientation: Orientation) -> Result<Self, EnvironmentError> {
        let (density, mean) = (Density::new(&map)?, map.mean());
        Ok(Self { map, orientation, density, mean })
    }

    /// Mean radiance over the sphere.
    pub fn mean(&self) -> Spectrum {
        self.mean
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.map.bytes() + self.density.as_ref().map_or(0, Density::bytes)
    }

    /// Radiance from a direction, and the density with which it is sampled.
    #[inline]
    fn radiance_and_pdf(&self, wi: Vec3) -> (Spectrum, f32) {
        let place = self.orientation.place(wi);
        let point = self.map.cell_point(&place);
        let corners = self.map.corners(point.cell);
        let pdf = |density: &Density| density.pdf(&self.map, &place, &point, &corners);
        (self.map.radiance(&point, &corners), self.density.as_ref().map_or(0.0, pdf))
    }
}

fn orientation(settings: &EnvironmentSettings) -> Result<Orientation, EnvironmentError> {
    let EnvironmentSettings { rotation, handedness, .. } = *settings;
    Orientation::new(rotation, handedness).ok_or(EnvironmentError::Rotation(rotation))
}

impl Light for EnvironmentLight {
    fn is_delta(&self) -> bool {
        false
    }

    fn is_infinite(&self) -> bool {
        true
    }

    /// Unless it is the same everywhere.
    fn is_worth_sampling(&self) -> bool {
        !self.map.is_constant()
    }

    /// Radiance and density are those of the rounded direction, so that they are those of a ray. `None` if the map is black.
    #[inline]
    fn sample_li(&self, _p: Vec3, u: Vec2) -> Option<LightSample> {
        let (x, z) = self.density.as_ref()?.sample(&self.map, u);
        let wi = self.orientation.direction(x, z);
        let (li, pdf) = self.radiance_and_pdf(wi);
        (pdf > 0.0 && pdf < f32::INFINITY).then(|| LightSample::distant(li, wi, pdf))
    }

    #[inline]
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        self.radiance_and_pdf(hit.wi).1
    }

    #[inline]
    fn le(&self, hit: &LightHit) -> Spectrum {
        let point = self.map.cell_point(&self.orientation.place(hit.wi));
        self.map.radiance(&point, &self.map.corners(point.cell))
    }

    /// 4π² r² times the mean radiance, as of a sky.
    fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.mean * (4.0 * PI * PI * scene.radius * scene.radius))
    }

    /// Finds the pixels of a ray once for both numbers.
    fn escaped_block(&self, rays: &EscapedRays, emitted: &mut Emitted) {
        for i in 0..rays.len() {
            let hit = rays.get(i);
            let both = || self.radiance_and_pdf(hit.wi);
            let (le, pdf) = if rays.needs_pdf() { both() } else { (self.le(&hit), 1.0) };
            emitted.set(i, le, pdf);
        }
    }
}

const FILE: Key<PathBuf> = Key::new(
    "file",
    "path of an equirectangular image: EXR or PFM of radiance, or PNG or JPEG of sRGB",
);
const SCALE: Key<Factor> =
    Key::new("scale", "factor of its radiance").at_least(0.0).default(Factor(Spectrum::WHITE));
const ROTATE: Key<Option<Rotation>> =
    Key::optional("rotate", "about an axis through the origin; about +y from z to x");

/// `type = "environment"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "environment",
    meaning: "From all around, by an equirectangular image",
    keys: &[&FILE, &SCALE, &ROTATE, &Handedness::KEY],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Light>, Fault> {
    let file = table.get(&FILE)?;
    let settings = EnvironmentSettings {
        scale: table.get(&SCALE)?.0,
        rotation: table.get(&ROTATE)?.map_or(Quat::IDENTITY, Quat::from),
        handedness: table.get(&Handedness::KEY)?,
    };
    let fault = |error| Fault::new(table.mark(&FILE), error);
    let image = Image::read(&file).map_err(fault)?;
    // The pixels are copied; of the copy, the density takes less than the image did.
    image.check_beside(&file, Texels::BYTES, Image::DEFAULT_LIMIT).map_err(fault)?;
    match EnvironmentLight::of_image(image, &settings) {
        Ok(light) => Ok(Arc::new(light)),
        Err(error) => Err(Fault::new(table.mark(&FILE), Unfit { file, error })),
    }
}

/// What is wrong in which file.
#[derive(Debug, thiserror::Error)]
#[error("cannot use `{}` as an environment map: {error}", Shown::path(.file))]
struct Unfit {
    file: PathBuf,
    error: EnvironmentError,
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;

    use bytemuck::Zeroable;
    use glam::UVec2;

    use super::*;
    use crate::image::Encoding;
    use crate::simd::{ROW, Rows};

    /// A block has the numbers of its rays, to the bit, with densities and without.
    #[test]
    fn a_block_of_rays_is_each_of_them() {
        let size = UVec2::new(5, 4);
        let pixels = (0..20).map(|i| Spectrum::new(i as f32, 1.0, (i % 3) as f32)).collect();
        let encoding = Encoding::Linear;
        let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding };
        let light = EnvironmentLight::new(&image, &EnvironmentSettings::default()).unwrap();
        let (origin, mut wi) = (Rows::splat(0.0), Rows::splat(0.0));
        for i in 0..ROW {
            let turn: [f32; 3] = from_fn(|axis| ((i + 1) as f32 * [0.71, 1.3, 2.9][axis]).sin());
            wi.set(i, Vec3::from(turn).normalize().to_array());
        }
        for (len, needs_pdf) in [(ROW, true), (ROW, false), (3, true), (0, true)] {
            let mut emitted = Emitted::zeroed();
            let rays = EscapedRays { len, origin: &origin, wi: &wi, needs_pdf };
            light.escaped_block(&rays, &mut emitted);
            for i in 0..ROW {
                let hit = LightHit::outside(Vec3::ZERO, wi.get(i).into());
                let (le, pdf) = emitted.get(i);
                if i < len {
                    assert_eq!(le, light.le(&hit), "ray {i} of {len}");
                    assert!(!needs_pdf || pdf == light.pdf_li(&hit), "ray {i} of {len}");
                } else {
                    assert!(le.is_black(), "ray {i} of {len}");
                }
            }
        }
    }
}
