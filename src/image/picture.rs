//! [`Picture`]: the result of a render.

use glam::{UVec2, Vec3};

use super::{EncodeError, Window};
use crate::spectrum::Spectrum;

/// Properties of the surfaces that camera rays hit first, averaged over the samples of each pixel that hit anything, and
/// the number of samples. Averages are zero where no sample hit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Mean of the shading normals in world space; the mean is not normalised.
    pub normal: Vec<Vec3>,
    /// Distance from the camera along the ray, in scene units.
    pub depth: Vec<f32>,
    /// Reflectance towards the camera under a uniform sky (hemispherical-directional), by band.
    pub albedo: Vec<Spectrum>,
    /// Number of samples that the radiance is the mean of, whether they hit or not.
    pub samples: Vec<u32>,
}

/// The result of a render: linear radiance by pixel, row by row from the top left of the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns and rows of the whole image.
    pub resolution: UVec2,
    /// The part of the image that was rendered.
    pub window: Window,
    /// Mean radiance of each pixel of the window, in W / (m² sr).
    pub color: Vec<Spectrum>,
    /// Estimated variance of each mean, by band: the square of its standard error. A film pools each pixel's estimate with
    /// those of its neighbours. Infinite in pixels with too few samples for an estimate; `None` if there is no estimate for
    /// any pixel.
    pub variance: Option<Vec<Spectrum>>,
    /// Degrees of freedom of the variance in the pixel that has the fewest. A film's pixel has as many as it has
    /// independent samples, or sets of samples, less one, and as many again from its neighbours. A confidence interval
    /// follows by Student's t distribution. `None` without variance, or if they are not known.
    pub degrees_of_freedom: Option<u32>,
    /// The first hits, if the render recorded them.
    pub layers: Option<Layers>,
    /// What the film keeps, bit by bit, if the picture is of a [part](crate::render::Part) of a render:
    /// [`Film::from_planes`](crate::film::Film::from_planes) restores it. EXR files hold it.
    pub planes: Vec<Plane>,
}

/// A whole number for each pixel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plane {
    /// The name of its channel in files.
    pub name: String,
    /// One number for each pixel of the window.
    pub values: Vec<u32>,
}

impl Picture {
    /// A whole image with these colours, without variance or layers.
    pub fn new(resolution: UVec2, color: Vec<Spectrum>) -> Self {
        let window = Window::full(resolution);
        Self {
            resolution,
            window,
            color,
            variance: None,
            degrees_of_freedom: None,
            layers: None,
            planes: Vec::new(),
        }
    }

    /// Standard error of the radiance: the root of the mean variance over all bands of all pixels whose variance is
    /// finite. `None` if there are none.
    pub fn standard_error(&self) -> Option<f64> {
        let bands = self.variance.iter().flatten().flat_map(|v| v.to_array());
        let (sum, count) = bands
            .filter(|band| band.is_finite())
            .fold((0.0, 0_u64), |(sum, count), band| (sum + f64::from(band), count + 1));
        (count > 0).then(|| (sum / count as f64).sqrt())
    }

    /// Checks that files can hold an image of this size, before it is rendered.
    ///
    /// # Errors
    /// If a side is too long.
    pub fn check_resolution(resolution: UVec2) -> Result<(), EncodeError> {
        // OpenEXR stores windows as signed 32-bit integers and allows half their range.
        const LARGEST: u32 = i32::MAX as u32 / 2 - 1;
        if resolution.max_element() > LARGEST {
            return Err(EncodeError(format!("a file's sides hold at most {LARGEST} pixels")));
        }
        Ok(())
    }

    /// Checks what every writer relies on: the window is not empty and lies in the image, and every list has one value
    /// for each pixel of the window.
    pub(super) fn check(&self) -> Result<(), EncodeError> {
        let Self { resolution, window, .. } = self;
        Self::check_resolution(*resolution)?;
        if window.max.cmpgt(*resolution).any() {
            return Err(EncodeError("its window reaches beyond the image".to_owned()));
        }
        if window.min.cmpge(window.max).any() {
            return Err(EncodeError("its window holds no pixel".to_owned()));
        }
        let mut counts = vec![("colour", self.color.len())];
        if let Some(variance) = &self.variance {
            counts.push(("variance", variance.len()));
        }
        if let Some(Layers { normal, depth, albedo, samples }) = &self.layers {
            counts.push(("normal", normal.len()));
            counts.push(("depth", depth.len()));
            counts.push(("albedo", albedo.len()));
            counts.push(("samples", samples.len()));
        }
        counts.extend(self.planes.iter().map(|plane| (&*plane.name, plane.values.len())));
        let area = window.area();
        match counts.into_iter().find(|&(_, count)| count != area) {
            Some((name, count)) => Err(EncodeError(format!(
                "its window has {area} pixels, but {count} values of {name}"
            ))),
            None => Ok(()),
        }
    }
}
