//! Cameras: from the samples of a pixel to rays.
//!
//! A [`Camera`] is built for images of one resolution; a [`View`](crate::scene::View) joins it to a film of the same
//! resolution. Camera space is PBRT's: x to the right of the image, y up, z along the view (PBRT 3rd edition,
//! section 6.1). [`Handedness`] says how it lies in the world.
//!
//! ```
//! use lobe::camera::{Camera, PerspectiveCamera, PerspectiveSettings};
//! use lobe::glam::{UVec2, Vec2, Vec3};
//!
//! // From the origin along +z, 90 degrees wide.
//! let camera = PerspectiveCamera::new(&PerspectiveSettings::default(), UVec2::new(2, 2))?;
//! // The upper left corner of the lower right pixel is the middle of the image.
//! let ray = camera.generate_ray(UVec2::ONE, Vec2::ZERO, Vec2::ZERO);
//! assert_eq!(ray.d, Vec3::Z);
//! # Ok::<(), lobe::camera::CameraError>(())
//! ```
//!
//! A camera of another crate is one function; it need not normalize its directions:
//!
//! ```
//! use lobe::camera::Camera;
//! use lobe::geometry::Ray;
//! use lobe::glam::{UVec2, Vec2, Vec3};
//! use lobe::scene::{FilmSettings, View};
//! use lobe::{RenderSettings, RenderOptions, Scene, Spectrum, light::SkyLight, render};
//!
//! /// Equidistant fisheye: the angle from +z grows with the distance from the middle of the image.
//! struct Fisheye(UVec2);
//!
//! impl Camera for Fisheye {
//!     fn resolution(&self) -> UVec2 {
//!         self.0
//!     }
//!     fn has_lens(&self) -> bool {
//!         false
//!     }
//!     fn generate_ray(&self, pixel: UVec2, offset: Vec2, _lens: Vec2) -> Ray {
//!         let p = (pixel.as_vec2() + offset) / self.0.as_vec2() * 2.0 - 1.0;
//!         let angle = p.length() * std::f32::consts::FRAC_PI_2;
//!         let across = p.normalize_or_zero() * angle.sin();
//!         Ray::new(Vec3::ZERO, Vec3::new(across.x, -across.y, angle.cos()))
//!     }
//! }
//!
//! let scene = Scene::builder().light(SkyLight::new(Spectrum::WHITE)).build()?;
//! let view = View::new(Fisheye(UVec2::new(8, 8)), FilmSettings::new(8, 8))?;
//! let rendered = render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
//! assert_eq!(rendered.picture.color, vec![Spectrum::WHITE; 64]);
//! assert_eq!(rendered.counters.refused_camera_rays, 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod equirectangular;
mod error;
mod framing;
mod orthographic;
mod perspective;
mod placement;
mod traits;

pub use block::CameraSamples;
pub use equirectangular::{EquirectangularCamera, EquirectangularSettings};
pub use error::CameraError;
pub use orthographic::{OrthographicCamera, OrthographicSettings};
pub use perspective::{PerspectiveCamera, PerspectiveSettings};
pub(crate) use traits::prepare;
pub use traits::{Camera, Read};

pub use crate::params::Handedness;
use crate::params::Kind;

/// All kinds of cameras.
pub static CAMERAS: &[Kind<Read>] = &[perspective::KIND, orthographic::KIND, equirectangular::KIND];
