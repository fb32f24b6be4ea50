//! [`Film`]: sums of samples.

use glam::{UVec2, Vec3};

use super::spread::Spread;
use super::{Layers, Picture, Variance, Window};
use crate::spectrum::Spectrum;

/// Why there is no film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FilmError {
    /// The picture does not fit into memory.
    #[error(
        "an image of {0} x {1} pixels needs about {2} MiB of memory, which is not to be had: \
         lower the film's resolution or set a crop"
    )]
    TooLarge(u32, u32, u64),
}

/// What a film keeps beside the radiance. None of it changes the radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FilmContents {
    /// From what it tells how far off the radiance is.
    pub variance: Variance,
    /// Whether it keeps the first hits: the picture's [`Layers`].
    pub first_hits: bool,
}

/// Sums of the samples of each pixel, all of which count the same, in f64: a million samples lose nothing.
/// A pixel holds fewer than 2³² samples.
///
/// A sample that is not finite is left out of its pixel and counted in
/// [`non_finite`](Film::non_finite).
#[derive(Clone, Debug)]
pub struct Film {
    resolution: UVec2,
    window: Window,
    contents: FilmContents,
    pixels: Vec<Sum>,
    spread: Spread,
    layers: Option<Vec<FirstHits>>,
    non_finite: u64,
}

/// Sum of some samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    pub values: [f64; 3],
    pub samples: u32,
}

impl Sum {
    #[inline]
    pub fn add(&mut self, values: [f32; 3]) {
        add(&mut self.values, values.map(f64::from));
        self.samples += 1;
    }

    pub fn merge(&mut self, other: &Self) {
        add(&mut self.values, other.values);
        self.samples += other.samples;
    }

    /// The mean; zero without samples.
    pub fn mean(&self) -> [f64; 3] {
        self.values.map(|sum| sum / f64::from(self.samples.max(1)))
    }
}

/// Sums over the samples that hit something.
#[derive(Clone, Copy, Debug, Default)]
struct FirstHits {
    normal: [f64; 3],
    depth: f64,
    albedo: [f64; 3],
    hits: u32,
}

impl FirstHits {
    fn merge(&mut self, other: &Self) {
        add(&mut self.normal, other.normal);
        add(&mut self.albedo, other.albedo);
        self.depth += other.depth;
        self.hits += other.hits;
    }
}

impl Film {
    /// An empty film for the pixels of `window` in an image of `resolution`. Fails if the film, its picture and
    /// the files made from them would not fit into memory.
    ///
    /// # Errors
    /// [`FilmError::TooLarge`] when the system refuses the memory.
    pub fn new(
        resolution: UVec2,
        window: Window,
        contents: FilmContents,
    ) -> Result<Self, FilmError> {
        let area = window.area();
        let first_hits = if contents.first_hits { size_of::<FirstHits>() } else { 0 };
        // Colour and layers once as sums, once developed, and once more while they are written; the last two
        // of the variance are a spectrum each.
        let spread = contents.variance.bytes();
        let developed = if spread > 0 { 2 * size_of::<Spectrum>() as u64 } else { 0 };
        let per_pixel = 3 * (size_of::<Sum>() + first_hits) as u64 + spread + developed;
        let bytes = (area as u64).saturating_mul(per_pixel);
        let too_large = FilmError::TooLarge(window.size().x, window.size().y, bytes >> 20);
        let fits =
            usize::try_from(bytes).is_ok_and(|b| Vec::<u8>::new().try_reserve_exact(b).is_ok());
        if !fits {
            return Err(too_large);
        }
        let pixels = zeroed(area).ok_or(too_large)?;
        let spread = Spread::new(contents.variance, area).ok_or(too_large)?;
        let layers = if contents.first_hits { Some(zeroed(area).ok_or(too_large)?) } else { None };
        Ok(Self { resolution, window, contents, pixels, spread, layers, non_finite: 0 })
    }

    /// Forgets all samples and stands for another window, no larger than the first one.
    pub fn reset(&mut self, window: Window) {
        self.window = window;
        self.non_finite = 0;
        self.pixels.clear();
        self.pixels.resize(window.area(), Sum::default());
        self.spread.reset(window.area());
        if let Some(layers) = &mut self.layers {
            layers.clear();
            layers.resize(window.area(), FirstHits::default());
        }
    }

    /// Whether it keeps the first hits.
    pub fn has_layers(&self) -> bool {
        self.layers.is_some()
    }

    /// How many samples were left out because they were not finite.
    pub fn non_finite(&self) -> u64 {
        self.non_finite
    }

    /// Adds a sample of the radiance at `pixel`, which lies in the window. It belongs to the independent set
    /// of this number, which is only looked at for [`Variance::OfSets`] and is below that number of sets.
    #[inline]
    pub fn add_sample(&mut self, pixel: UVec2, set: u32, radiance: Spectrum) {
        self.add_samples(pixel, set, &[radiance]);
    }

    /// Adds samples of one pixel and set, in their order.
    #[inline]
    pub fn add_samples(&mut self, pixel: UVec2, set: u32, radiance: &[Spectrum]) {
        let place = self.place(pixel);
        // A copy, which stays in registers.
        let mut sum = self.pixels[place];
        for radiance in radiance {
            if radiance.is_finite() {
                sum.add(radiance.to_array());
                self.spread.add(place, set, radiance.to_array(), &sum);
            } else {
                self.non_finite += 1;
            }
        }
        self.pixels[place] = sum;
    }

    /// Adds what a sample of `pixel` met first, if all of it is finite, and counts it otherwise. Nothing
    /// happens on a film without layers.
    #[inline]
    pub fn add_first_hit(&mut self, pixel: UVec2, normal: Vec3, depth: f32, albedo: Spectrum) {
        let place = self.place(pixel);
        let Some(layers) = &mut self.layers else { return };
        if !(normal.is_finite() && depth.is_finite() && albedo.is_finite()) {
            self.non_finite += 1;
            return;
        }
        let hits = &mut layers[place];
        add(&mut hits.normal, normal.to_array().map(f64::from));
        add(&mut hits.albedo, albedo.to_array().map(f64::from));
        hits.depth += f64::from(depth);
        hits.hits += 1;
    }

    /// Adds the samples of a film for a part of this one's window, as if they had been added here one by one
    /// (up to rounding; merged into an empty film they are the same bits).
    ///
    /// # Panics
    /// If the film's contents are others, or its window reaches beyond this one's.
    pub fn merge(&mut self, tile: &Film) {
        assert_eq!(self.contents, tile.contents, "a tile keeps what its film keeps");
        self.non_finite += tile.non_finite;
        let width = tile.window.size().x as usize;
        for (row, y) in (tile.window.min.y..tile.window.max.y).enumerate() {
            let start = self.place(UVec2::new(tile.window.min.x, y));
            for (to, from) in (start..start + width).zip(row * width..) {
                let other = &tile.pixels[from];
                self.spread.merge(to, &self.pixels[to], &tile.spread, from, other);
                self.pixels[to].merge(other);
                if let (Some(layers), Some(of_tile)) = (&mut self.layers, &tile.layers) {
                    layers[to].merge(&of_tile[from]);
                }
            }
        }
    }

    /// The mean of each pixel, and how far off it is.
    pub fn develop(&self) -> Picture {
        let mean = |sum: [f64; 3], count: u32| sum.map(|s| (s / f64::from(count.max(1))) as f32);
        let layers = self.layers.as_ref().map(|layers| Layers {
            normal: layers.iter().map(|l| mean(l.normal, l.hits).into()).collect(),
            depth: layers.iter().map(|l| (l.depth / f64::from(l.hits.max(1))) as f32).collect(),
            albedo: layers.iter().map(|l| mean(l.albedo, l.hits).into()).collect(),
            samples: self.pixels.iter().map(|p| p.samples).collect(),
        });
        let color = self.pixels.iter().map(|p| p.mean().map(|m| m as f32).into()).collect();
        let variance = self.variance();
        Picture { resolution: self.resolution, window: self.window, color, variance, layers }
    }

    /// The variance of each pixel's mean; `None` if no pixel has any.
    fn variance(&self) -> Option<Vec<Spectrum>> {
        let of = |(place, sum)| self.spread.variance(place, sum);
        let known = self.pixels.iter().enumerate().any(|pixel| of(pixel).is_some());
        known.then(|| {
            let variances = self.pixels.iter().enumerate().map(|pixel| {
                of(pixel).map_or([f32::INFINITY; 3], |v| v.map(|band| band as f32)).into()
            });
            variances.collect()
        })
    }

    #[inline]
    fn place(&self, pixel: UVec2) -> usize {
        let within = pixel - self.window.min;
        within.y as usize * self.window.size().x as usize + within.x as usize
    }
}

#[inline]
fn add(sum: &mut [f64; 3], values: [f64; 3]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// `count` default values, or `None` if there is no memory for them.
pub(super) fn zeroed<T: Clone + Default>(count: usize) -> Option<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(count).ok()?;
    values.resize(count, T::default());
    Some(values)
}
