//! [`Picture`]: a developed film, ready to be shown or written.

use glam::{UVec2, Vec3};

use crate::spectrum::Spectrum;

/// A rectangle of pixels: `min` belongs to it, `max` does not. y grows downwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The first column and row.
    pub min: UVec2,
    /// One past the last column and row.
    pub max: UVec2,
}

impl Window {
    /// The window that covers an image of this size.
    pub const fn full(resolution: UVec2) -> Self {
        Self { min: UVec2::ZERO, max: resolution }
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.max - self.min
    }

    /// How many pixels it holds.
    pub fn area(&self) -> usize {
        self.size().x as usize * self.size().y as usize
    }
}

/// What a renderer knows about the first hit of each pixel, averaged over the samples that hit, and the
/// number of samples. A pixel that no sample hits has zero in all averages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Shading normals in world space, not normalised again after averaging.
    pub normal: Vec<Vec3>,
    /// Distance from the camera along the ray, in scene units.
    pub depth: Vec<f32>,
    /// Share of light that the surface reflects towards the camera under a uniform sky.
    pub albedo: Vec<Spectrum>,
    /// How many samples the radiance is the mean of, whether they hit or not.
    pub samples: Vec<u32>,
}

/// A developed film: linear radiance by pixel, row by row from the top left of the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns and rows of the whole image.
    pub resolution: UVec2,
    /// The part of it that was rendered.
    pub window: Window,
    /// Mean radiance of each pixel of the window.
    pub color: Vec<Spectrum>,
    /// Variance of each mean: the square of its standard error, by band. Infinite where there was too little to
    /// tell it from. `None` if nothing is known of it, or nobody asked.
    pub variance: Option<Vec<Spectrum>>,
    /// The first hits, when the render was asked for them.
    pub layers: Option<Layers>,
}

impl Picture {
    /// How far off the radiance is: the root of the mean variance over all bands of all pixels whose
    /// variance is finite. `None` if there are none.
    pub fn standard_error(&self) -> Option<f64> {
        let bands = self.variance.iter().flatten().flat_map(|v| v.to_array());
        let (sum, count) = bands
            .filter(|band| band.is_finite())
            .fold((0.0, 0_u64), |(sum, count), band| (sum + f64::from(band), count + 1));
        (count > 0).then(|| (sum / count as f64).sqrt())
    }

    /// Whether a file can hold it: the window lies in the image, and every list has one value for
    /// each of the window's pixels. If not, a clause that says what is wrong.
    pub(super) fn check(&self) -> Result<(), String> {
        // OpenEXR keeps windows as signed numbers of 32 bits, and uses half their range.
        const LARGEST: u32 = i32::MAX as u32 / 2 - 1;
        let Self { resolution, window, .. } = self;
        if resolution.max_element() > LARGEST {
            return Err(format!("a file's sides hold at most {LARGEST} pixels"));
        }
        if window.max.cmpgt(*resolution).any() {
            return Err("its window reaches beyond the image".to_owned());
        }
        if window.min.cmpge(window.max).any() {
            return Err("its window holds no pixel".to_owned());
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
        let area = window.area();
        match counts.into_iter().find(|&(_, count)| count != area) {
            Some((name, count)) => {
                Err(format!("its window has {area} pixels, but {count} values of {name}"))
            }
            None => Ok(()),
        }
    }
}

/// How a picture came about: written into the files as attributes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// The scene, as the user named it.
    pub scene: String,
    /// The sampler's seed.
    pub seed: u64,
    /// Samples taken in each pixel.
    pub samples_per_pixel: u32,
    /// Wall-clock time of the rendering alone.
    pub seconds: f64,
}
