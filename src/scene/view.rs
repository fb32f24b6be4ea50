//! [`View`]: camera and film.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::FilmSettings;
use crate::camera::{Camera, CameraError, CameraSamples, PerspectiveCamera, PerspectiveSettings};
use crate::film::{Filter, FilterError, FilterSampler};
use crate::geometry::Ray;
use crate::image::Window;
use crate::sampling::SampleId;
use crate::simd::InstructionSet;

/// Why a view cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The camera cannot be built.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The camera was built for an image of another size.
    #[error(
        "the camera is for an image of {camera} pixels, but the film has {film}",
        camera = size(*.camera),
        film = size(*.film)
    )]
    Resolution {
        /// Columns and rows of the camera's image.
        camera: UVec2,
        /// Columns and rows of the film.
        film: UVec2,
    },
    /// The crop is empty or exceeds the image.
    #[error(
        "the film's crop {corners:?} is empty or reaches beyond its resolution of {1} x {2}",
        corners = [.0.min, .0.max].map(|corner| corner.to_array()).as_flattened()
    )]
    Crop(Window, u32, u32),
    /// The filter's radius or another parameter is out of range.
    #[error(transparent)]
    Filter(#[from] FilterError),
}

fn size(resolution: UVec2) -> String {
    format!("{} x {}", resolution.x, resolution.y)
}

/// A camera and a film of the same resolution. It is independent of the scene, so one scene can be rendered in any
/// number of views.
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::scene::{FilmSettings, View};
/// use lobe::{RenderSettings, PerspectiveSettings, RenderOptions, Scene, light::SkyLight, render};
///
/// let scene = Scene::builder().light(SkyLight::new([0.2, 0.4, 0.8].into())).build()?;
/// let film = FilmSettings::new(16, 9);
/// let front = PerspectiveSettings { eye: Vec3::NEG_Z, look_at: Vec3::ZERO, ..Default::default() };
/// let side = PerspectiveSettings { eye: Vec3::X, ..front };
/// for camera in [front, side] {
///     // All views share the scene's acceleration structure.
///     let view = View::perspective(&camera, film.clone())?;
///     let rendered =
///         render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
///     assert_eq!(rendered.picture.color.len(), 16 * 9);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct View {
    camera: Arc<dyn Camera>,
    film: FilmSettings,
    filter: FilterSampler,
}

impl View {
    /// A view of this camera on this film. `Arc<dyn Camera>` is a camera too.
    ///
    /// # Errors
    /// If the film has no pixels or another resolution than the camera, if the crop is empty or exceeds the image, or
    /// if the filter's settings are out of range.
    pub fn new(camera: impl Camera + 'static, film: FilmSettings) -> Result<Self, ViewError> {
        let resolution = film.resolution;
        if resolution.min_element() == 0 {
            return Err(CameraError::Resolution(resolution.x, resolution.y).into());
        }
        if camera.resolution() != resolution {
            return Err(ViewError::Resolution { camera: camera.resolution(), film: resolution });
        }
        let window = film.window();
        if window.min.cmpge(window.max).any() || window.max.cmpgt(resolution).any() {
            return Err(ViewError::Crop(window, resolution.x, resolution.y));
        }
        let filter = film.filter.prepare()?;
        Ok(Self { camera: Arc::new(camera), film, filter })
    }

    /// A view of a perspective camera on this film.
    ///
    /// # Errors
    /// Those of [`PerspectiveCamera::new`] and [`View::new`].
    pub fn perspective(
        camera: &PerspectiveSettings,
        film: FilmSettings,
    ) -> Result<Self, ViewError> {
        Self::new(PerspectiveCamera::new(camera, film.resolution)?, film)
    }

    /// The camera.
    pub fn camera(&self) -> &dyn Camera {
        &*self.camera
    }

    /// The film's settings.
    pub fn film(&self) -> &FilmSettings {
        &self.film
    }

    /// The film's filter, ready to be sampled.
    pub fn filter(&self) -> &FilterSampler {
        &self.filter
    }

    /// Generates the rays of samples, in their order. `film` holds uniform values in `[0, 1)²`, which are warped in
    /// place to offsets from the pixel by the filter; `lens` holds those for the lens, or zeros.
    #[inline(never)]
    pub(crate) fn generate_rays(
        &self,
        instruction_set: InstructionSet,
        ids: &[SampleId],
        film: &mut [Vec2],
        lens: &[Vec2],
        rays: &mut Vec<Ray>,
    ) {
        self.filter.sample_all_in_pixel(film);
        // The previous contents are overwritten.
        rays.resize(ids.len(), Ray::new(Vec3::ZERO, Vec3::Z));
        let samples = CameraSamples::new(instruction_set, ids, film, lens);
        self.camera.generate_rays(&samples, rays);
    }
}
