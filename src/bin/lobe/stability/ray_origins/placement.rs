//! [`Placement`]: size and position of a trial's scene.

/// Size and position of a trial's scene.
#[derive(Clone, Copy, PartialEq)]
pub struct Placement {
    /// Coordinates are within twice this of the scene's centre.
    pub scale: f64,
    /// Distance of the centre from the origin.
    pub distance: f64,
}
