//! [`CameraError`]: why a camera cannot be built.

/// Why a camera cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A setting is infinite, NaN, or farther out than
    /// [`MAX_COORDINATE`](crate::geometry::float::MAX_COORDINATE).
    #[error("the camera's {0} is not finite, or is beyond 1e12")]
    OutOfRange(&'static str),
    /// There is no direction of view.
    #[error("the camera's eye and look_at are the same point, so it looks nowhere")]
    NoDirection,
    /// The image could be turned any way round.
    #[error("the camera's up is zero or points along its view, so which side is up is open")]
    NoUp,
    /// No image plane has this field of view.
    #[error("the camera's fov is {0} degrees: it has to be above 0 and below 180")]
    Fov(f32),
    /// An orthographic image has no size.
    #[error("the camera's extent is {0}: it has to be above 0")]
    Extent(f32),
    /// The lens radius is negative.
    #[error("the camera's lens_radius is {0}: it cannot be negative")]
    LensRadius(f32),
    /// The plane in focus is not in front of the camera.
    #[error("the camera's focal_distance is {0}: it has to be above 0")]
    FocalDistance(f32),
    /// The image has no pixels.
    #[error("the film's resolution is {0} x {1}: both have to be at least 1")]
    Resolution(u32, u32),
}
