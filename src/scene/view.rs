//! [`View`]: how a scene is seen.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::FilmSettings;
use crate::camera::{Camera, CameraError, PerspectiveCamera, PerspectiveSettings};
use crate::film::{Filter, FilterError, FilterSampler};
use crate::geometry::Ray;
use crate::image::Window;
use crate::sampling::SampleId;

/// Why there is no view.
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
    /// The part of the image to render is empty or sticks out.
    #[error(
        "the film's crop {corners:?} is empty or reaches beyond its resolution of {1} x {2}",
        corners = [.0.min, .0.max].map(|corner| corner.to_array()).as_flattened()
    )]
    Crop(Window, u32, u32),
    /// The filter covers nothing, or too much.
    #[error(transparent)]
    Filter(#[from] FilterError),
}

fn size(resolution: UVec2) -> String {
    format!("{} x {}", resolution.x, resolution.y)
}

/// How a scene is seen: a camera and a film of the same resolution. It knows nothing of the scene, so one scene can be
/// rendered in any number of views, and one view can show any number of scenes.
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
///     // The tree of the scene is built once, above.
///     let view = View::perspective(&camera, film)?;
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
    /// The view of this camera on this film. `Arc<dyn Camera>` is a camera too.
    ///
    /// # Errors
    /// If the film has no pixels, another resolution than the camera, a crop that is empty or reaches beyond it, or a
    /// filter out of range.
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
        let filter = FilterSampler::new(film.filter)?;
        Ok(Self { camera: Arc::new(camera), film, filter })
    }

    /// The view of a perspective camera on this film.
    ///
    /// # Errors
    /// If [`PerspectiveCamera::new`] or [`View::new`] refuses a setting.
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

    /// The rays of samples, in their order. `film` holds uniform samples in `[0, 1)²` of the filter, which become
    /// points of the pixels, and `lens` those of the lens, or zeros.
    #[inline(never)]
    pub(crate) fn generate_rays(
        &self,
        ids: &[SampleId],
        film: &mut [Vec2],
        lens: &[Vec2],
        rays: &mut Vec<Ray>,
    ) {
        if self.film.filter != Filter::Box {
            film.iter_mut().for_each(|u| *u = self.filter.place(*u));
        }
        // What is left of other rays is overwritten.
        rays.resize(ids.len(), Ray::new(Vec3::ZERO, Vec3::Z));
        let (mut rays, mut offsets, mut lens) = (&mut rays[..], &*film, lens);
        for of_set in SampleId::sets(ids) {
            let (rays_of_set, rays_left) = rays.split_at_mut(of_set.len());
            let (offsets_of_set, offsets_left) = offsets.split_at(of_set.len());
            let (lens_of_set, lens_left) = lens.split_at(of_set.len());
            self.camera.generate_rays(of_set[0].pixel, offsets_of_set, lens_of_set, rays_of_set);
            (rays, offsets, lens) = (rays_left, offsets_left, lens_left);
        }
    }
}
