//! The contract of samplers.

use glam::{UVec2, Vec2};

/// Which sample of which pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleId {
    /// Column and row in the whole image.
    pub pixel: UVec2,
    /// Running number within the pixel, from 0.
    pub index: u32,
}

/// A source of sample points in the unit square, one for each use that a light path makes of it.
///
/// A sample is a pure function of the sampler (with its seed), the pixel, the index and the dimension:
/// nothing is carried from call to call. The same question has the same answer on any thread and in
/// any order, so one sample can be replayed alone. All values are in `[0, 1)`.
///
/// A dimension is one use: the place on the film, the place on the lens, the choice of a light. It is
/// asked for either by [`get_1d`](Sampler::get_1d) or by [`get_2d`](Sampler::get_2d), and different
/// dimensions are independent of each other.
pub trait Sampler: Send + Sync {
    /// How many samples of each pixel belong together. An index at or above it is allowed: it begins
    /// another, independent set.
    fn samples_per_pixel(&self) -> u32;

    /// The number that this sample has in `dimension`.
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32;

    /// The point that this sample has in `dimension`.
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2;
}
