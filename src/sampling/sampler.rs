//! The contract of samplers.

use glam::{UVec2, Vec2};

/// Which sample of which pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleId {
    /// Column and row in the whole image.
    pub pixel: UVec2,
    /// Which of the pixel's independent sets of samples: sets have nothing to do with each other, so that
    /// their means tell how far off a mean is.
    pub set: u32,
    /// Running number within the set, from 0.
    pub index: u32,
}

impl SampleId {
    /// The runs of samples that are of the same set of the same pixel.
    pub(crate) fn sets(ids: &[Self]) -> impl Iterator<Item = &[Self]> {
        let mut ids = ids;
        std::iter::from_fn(move || {
            let (of_set, rest) = ids.split_at(Self::first_set(ids)?);
            ids = rest;
            Some(of_set)
        })
    }

    /// How many are in the first run.
    #[inline(always)]
    fn first_set(ids: &[Self]) -> Option<usize> {
        let first = ids.first()?;
        let differ = |id: &Self| {
            (id.pixel.x ^ first.pixel.x) | (id.pixel.y ^ first.pixel.y) | (id.set ^ first.set)
        };
        // Eight at once, as long as that goes.
        let (eights, _) = ids.as_chunks::<8>();
        let alike = |ids: &&[Self; 8]| ids.iter().fold(0, |all, id| all | differ(id)) == 0;
        let start = 8 * eights.iter().take_while(alike).count();
        Some(start + ids[start..].iter().take_while(|id| differ(id) == 0).count())
    }
}

/// A source of sample points in the unit square, one for each use that a light path makes of it.
///
/// A sample is a pure function of the sampler (with its seed), the pixel, the set, the index and the
/// dimension: nothing is carried from call to call. The same question has the same answer on any thread
/// and in any order, so one sample can be replayed alone. All values are in `[0, 1)`.
///
/// A dimension is one use: the place on the film, the place on the lens, the choice of a light. It is
/// asked for either by [`get_1d`](Sampler::get_1d) or by [`get_2d`](Sampler::get_2d), and different
/// dimensions are independent of each other, or spread more evenly than that.
pub trait Sampler: Send + Sync {
    /// Whether the samples of a set know of each other, so that only the means of whole sets tell how
    /// much an estimate varies.
    fn is_correlated(&self) -> bool;

    /// The number that this sample has in `dimension`.
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32;

    /// The point that this sample has in `dimension`.
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2;

    /// The numbers that these samples have in `dimension`, in place of what `values` holds.
    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut Vec<f32>) {
        values.clear();
        values.extend(ids.iter().map(|&id| self.get_1d(id, dimension)));
    }

    /// The points that these samples have in `dimension`, in place of what `points` holds.
    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut Vec<Vec2>) {
        points.clear();
        points.extend(ids.iter().map(|&id| self.get_2d(id, dimension)));
    }
}
