//! Settings of film and emission, as plain values.

use std::sync::Arc;

use glam::UVec2;

use crate::film::{BoxFilter, Filter};
use crate::image::{Display, Window};
use crate::spectrum::Spectrum;

/// Resolution, crop, display curve and reconstruction filter of the image.
#[derive(Clone, Debug)]
pub struct FilmSettings {
    /// Columns and rows of the image.
    pub resolution: UVec2,
    /// Part of the image to render: within the image and not empty; `None` for all of it.
    pub crop: Option<Window>,
    /// Tone curve from radiance to the codes of a PNG.
    pub display: Display,
    /// The reconstruction filter.
    pub filter: Arc<dyn Filter>,
}

impl FilmSettings {
    /// The resolution of [`FilmSettings::default`].
    pub const DEFAULT_RESOLUTION: UVec2 = UVec2::splat(500);

    /// The display curve of [`FilmSettings::default`].
    pub const DEFAULT_DISPLAY: Display = Display::Srgb;

    /// An image of `width` × `height` pixels, with default settings.
    pub fn new(width: u32, height: u32) -> Self {
        Self { resolution: UVec2::new(width, height), ..Self::default() }
    }

    /// The same with this filter, of the crate or of the caller's own.
    pub fn with_filter(self, filter: impl Filter + 'static) -> Self {
        Self { filter: filter.into_arc(), ..self }
    }

    /// The pixels to render.
    pub fn window(&self) -> Window {
        self.crop.unwrap_or(Window::full(self.resolution))
    }
}

impl Default for FilmSettings {
    /// 500 × 500 pixels with a box filter and the sRGB curve.
    fn default() -> Self {
        Self {
            resolution: Self::DEFAULT_RESOLUTION,
            crop: None,
            display: Self::DEFAULT_DISPLAY,
            filter: Arc::new(BoxFilter),
        }
    }
}

/// Emission of a surface, the same in all directions: a constant or a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission<R = Spectrum> {
    /// Radiance in W / (m² sr), at least 0 in each band: a [`Spectrum`], or a texture of them, which is not filtered (see
    /// [`TexturedAreaLight`](crate::light::TexturedAreaLight)).
    pub radiance: R,
    /// Whether both sides emit, or only the outer one: see [`AreaLight`](crate::light::AreaLight).
    pub two_sided: bool,
}
