//! [`CameraError`]: why a camera cannot be built.

use glam::Vec3;

use crate::geometry::float::MAX_COORDINATE;

/// Why a camera cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A point, which the name tells, has a coordinate that is NaN or beyond [`MAX_COORDINATE`].
    #[error(
        "the camera's {0} is {1}: each coordinate has to be from -{most:e} to {most:e}",
        most = MAX_COORDINATE
    )]
    OutOfRange(&'static str, Vec3),
    /// The direction that is up is infinite or NaN.
    #[error("the camera's up is {0}: it has to be finite")]
    Up(Vec3),
    /// There is no direction of view.
    #[error("the camera's eye and look_at are the same point, so it looks nowhere")]
    NoDirection,
    /// The image could be turned any way round.
    #[error("the camera's up is zero or points along its view, so which side is up is open")]
    NoUp,
    /// No image plane has this field of view.
    #[error("the camera's fov is {0} degrees: it has to be above 0 and below 180")]
    Fov(f32),
    /// The shorter side of an orthographic image is not above 0 or beyond [`MAX_COORDINATE`].
    #[error(
        "the camera's extent is {0}: it has to be above 0 and at most {most:e}",
        most = MAX_COORDINATE
    )]
    Extent(f32),
    /// The longer side of an orthographic image is beyond [`MAX_COORDINATE`].
    #[error(
        "the camera's extent is {extent}, which makes the longer side of the image {longer_side:e}: \
         that can be at most {most:e}",
        most = MAX_COORDINATE
    )]
    LongerSide {
        /// The shorter side, in scene units.
        extent: f32,
        /// The longer side, in scene units.
        longer_side: f32,
    },
    /// The lens radius is negative, or beyond [`MAX_COORDINATE`].
    #[error(
        "the camera's lens_radius is {0}: it has to be from 0 to {most:e}",
        most = MAX_COORDINATE
    )]
    LensRadius(f32),
    /// The plane in focus is not in front of the camera.
    #[error("the camera's focal_distance is {0}: it has to be finite and above 0")]
    FocalDistance(f32),
    /// The image has no pixels.
    #[error("the film's resolution is {0} x {1}: both have to be at least 1")]
    Resolution(u32, u32),
}
