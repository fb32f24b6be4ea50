//! [`Sampler`]: the contract of samplers, and [`SampleId`], the name of a sample.

use glam::{UVec2, Vec2};

/// Identifies a sample of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleId {
    /// Column and row in the whole image.
    pub pixel: UVec2,
    /// Which set of the pixel's samples. Sets are independent of each other, so the variance of
    /// their means estimates the variance of the pixel.
    pub set: u32,
    /// Index within the set, from 0.
    pub index: u32,
}

/// A source of sample points in the unit square.
///
/// A *dimension* is one use of random numbers along a path: the position on the film, the position
/// on the lens, the choice of a light. It is asked for either by [`get_1d`](Sampler::get_1d) or by
/// [`get_2d`](Sampler::get_2d). Different dimensions of a sample are independent of each other, or
/// jointly more evenly distributed than that.
///
/// A sample is a pure function of the sampler (with its seed) and of pixel, set, index and
/// dimension: no state passes from call to call. The same arguments give the same value on any
/// thread and in any order, so a single sample can be replayed. All values are in `[0, 1)`.
///
/// # Examples
/// Sixteen points of a pixel in dimension 0, and one number for each in dimension 1:
/// ```
/// use lobe::glam::{UVec2, Vec2};
/// use lobe::sampling::{SampleId, Sampler, SobolSampler};
///
/// let sampler = SobolSampler::new(7);
/// let pixel = UVec2::new(3, 5);
/// let ids: Vec<_> = (0..16).map(|index| SampleId { pixel, set: 0, index }).collect();
/// let (mut film, mut choice) = ([Vec2::ZERO; 16], [0.0; 16]);
/// sampler.fill_2d(&ids, 0, &mut film);
/// sampler.fill_1d(&ids, 1, &mut choice);
///
/// // A pure function: one sample by itself is the same.
/// assert_eq!(film[9], sampler.get_2d(ids[9], 0));
/// // Sobol points: one in each cell of a 4 × 4 grid.
/// let mut cells: Vec<_> = film.iter().map(|p| (4.0 * *p).as_uvec2().to_array()).collect();
/// cells.sort();
/// cells.dedup();
/// assert_eq!(cells.len(), 16);
/// ```
/// A sampler of one's own:
/// ```
/// use std::hash::{DefaultHasher, Hash, Hasher};
///
/// use lobe::glam::{UVec2, Vec2, vec2};
/// use lobe::sampling::{SampleId, Sampler};
///
/// /// The R2 sequence (Roberts 2018), moved by an offset for each dimension, pixel and set.
/// struct R2;
///
/// impl Sampler for R2 {
///     fn is_correlated(&self) -> bool {
///         true
///     }
///
///     fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
///         self.get_2d(id, dimension).x
///     }
///
///     fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
///         let mut hasher = DefaultHasher::new();
///         (id.pixel.to_array(), id.set, dimension).hash(&mut hasher);
///         let hash = hasher.finish();
///         let at = |step: u32, start: u32| {
///             let bits = start.wrapping_add(id.index.wrapping_mul(step));
///             (bits >> 8) as f32 / (1 << 24) as f32
///         };
///         vec2(at(3_242_174_889, hash as u32), at(2_447_445_414, (hash >> 32) as u32))
///     }
/// }
///
/// let mut points = [Vec2::ZERO; 2];
/// let ids = [0, 1].map(|index| SampleId { pixel: UVec2::ZERO, set: 0, index });
/// R2.fill_2d(&ids, 0, &mut points);
/// assert_eq!(points[1], R2.get_2d(ids[1], 0));
/// ```
pub trait Sampler: Send + Sync {
    /// Whether the samples of a set are correlated. If so, the variance of an estimate can be
    /// estimated from the means of whole sets only, not from single samples.
    fn is_correlated(&self) -> bool;

    /// The value of the sample in `dimension`, in `[0, 1)`.
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32;

    /// The point of the sample in `dimension`, in `[0, 1)²`.
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2;

    /// [`get_1d`](Sampler::get_1d) of each id, of which there are any number in any order. All values have to be set.
    ///
    /// # Panics
    /// If there are not as many `values` as `ids`.
    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        assert_eq!(ids.len(), values.len(), "a value for each sample");
        for (&id, value) in ids.iter().zip(values) {
            *value = self.get_1d(id, dimension);
        }
    }

    /// [`get_2d`](Sampler::get_2d) of each id, of which there are any number in any order. All points have to be set.
    ///
    /// # Panics
    /// If there are not as many `points` as `ids`.
    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        assert_eq!(ids.len(), points.len(), "a point for each sample");
        for (&id, point) in ids.iter().zip(points) {
            *point = self.get_2d(id, dimension);
        }
    }
}
