//! [`Film`]: sums of the samples of each pixel.

use std::io::{self, Write};

use glam::{UVec2, Vec3};

use super::Variance;
use super::first_hits::FirstHits;
use super::largest::{Fireflies, Largest, fireflies};
use super::pixel_sum::{PixelSum, zeroed};
use super::planes::Kind;
use super::pooled::pooled;
use super::stored::{read_all, write_all};
use super::variance::VarianceSums;
use crate::image::{Picture, Plane, Window};
use crate::spectrum::Spectrum;

/// Why a film cannot be created.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FilmError {
    /// The film, its picture and the files made from them do not fit into memory.
    #[error(
        "an image of {0} x {1} pixels needs about {2} MiB of memory, which is not available: \
         lower the film's resolution or set a crop"
    )]
    TooLarge(u32, u32, u64),
}

/// What a film keeps besides the radiance. None of it changes the radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FilmContents {
    /// How the variance of each pixel is estimated.
    pub variance: Variance,
    /// Whether first hits are recorded, which become the picture's [`Layers`](crate::image::Layers).
    pub first_hits: bool,
}

impl FilmContents {
    fn has_variance(self) -> bool {
        self.variance.bytes() > 0
    }

    /// Bytes of the sums behind the variance of a pixel.
    fn bytes_of_variance(self) -> u64 {
        let largest = if self.has_variance() { size_of::<Largest>() as u64 } else { 0 };
        self.variance.bytes() + largest
    }

    /// Bytes of the first hits of a pixel.
    fn bytes_of_first_hits(self) -> usize {
        if self.first_hits { size_of::<FirstHits>() } else { 0 }
    }
}

/// Sums of the samples of each pixel, in f64, so that a million samples lose no digits. All samples of a pixel have the
/// same weight: the filter is in their distribution. A pixel takes fewer than 2³² samples.
///
/// A sample with a value that is not finite is left out of its pixel and counted in [`non_finite`](Film::non_finite).
///
/// ```
/// use lobe::Spectrum;
/// use lobe::film::{Film, FilmContents, Variance};
/// use lobe::glam::UVec2;
/// use lobe::image::Window;
///
/// let size = UVec2::new(2, 1);
/// let contents = FilmContents { variance: Variance::OfSamples, first_hits: false };
/// let mut film = Film::new(size, Window::full(size), contents)?;
/// // Four independent samples of the left pixel, one of the right one.
/// for value in [1.0, 3.0, 1.0, 3.0] {
///     film.add_sample(UVec2::new(0, 0), 0, Spectrum::splat(value));
/// }
/// film.add_sample(UVec2::new(1, 0), 0, Spectrum::WHITE);
///
/// let picture = film.develop();
/// assert_eq!(picture.color, [Spectrum::splat(2.0), Spectrum::WHITE]);
/// // The variance of the mean is that of the samples, 4/3, over their number. One sample has no estimate.
/// let variance = picture.variance.unwrap();
/// assert_eq!(variance[0], Spectrum::splat(1.0 / 3.0));
/// assert_eq!(variance[1], Spectrum::splat(f32::INFINITY));
/// # Ok::<(), lobe::film::FilmError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Film {
    resolution: UVec2,
    window: Window,
    contents: FilmContents,
    pixels: Vec<PixelSum>,
    variance: VarianceSums,
    /// Kept with the variance.
    largest: Vec<Largest>,
    first_hits: Option<Vec<FirstHits>>,
    non_finite: u64,
}

impl Film {
    /// An empty film for the pixels of `window` in an image of `resolution`.
    ///
    /// # Errors
    /// [`FilmError::TooLarge`] if the film, its picture and the files made from them would not fit into memory.
    pub fn new(
        resolution: UVec2,
        window: Window,
        contents: FilmContents,
    ) -> Result<Self, FilmError> {
        let area = window.area();
        let first_hits = contents.bytes_of_first_hits();
        // Radiance and first hits three times: as sums, in the picture, and in the file that is written. The variance once
        // as sums, and twice as a spectrum: pooled, and either by pixel before that or in the file after it.
        let variance = contents.bytes_of_variance();
        let developed = if variance > 0 { 2 * size_of::<Spectrum>() as u64 } else { 0 };
        let per_pixel = 3 * (size_of::<PixelSum>() + first_hits) as u64 + variance + developed;
        let bytes = (area as u64).saturating_mul(per_pixel);
        let too_large = FilmError::TooLarge(window.size().x, window.size().y, bytes >> 20);
        let fits =
            usize::try_from(bytes).is_ok_and(|b| Vec::<u8>::new().try_reserve_exact(b).is_ok());
        if !fits {
            return Err(too_large);
        }
        let pixels = zeroed(area).ok_or(too_large)?;
        let variance = VarianceSums::new(contents.variance, area).ok_or(too_large)?;
        let first_hits =
            if contents.first_hits { Some(zeroed(area).ok_or(too_large)?) } else { None };
        let largest = zeroed(if contents.has_variance() { area } else { 0 }).ok_or(too_large)?;
        let non_finite = 0;
        Ok(Self { resolution, window, contents, pixels, variance, largest, first_hits, non_finite })
    }

    /// Removes all samples and moves the film to another window, not larger than the first one.
    pub fn reset(&mut self, window: Window) {
        self.window = window;
        self.non_finite = 0;
        self.pixels.clear();
        self.pixels.resize(window.area(), PixelSum::default());
        self.variance.reset(window.area());
        if self.contents.has_variance() {
            self.largest.clear();
            self.largest.resize(window.area(), Largest::default());
        }
        if let Some(first_hits) = &mut self.first_hits {
            first_hits.clear();
            first_hits.resize(window.area(), FirstHits::default());
        }
    }

    /// Bytes of its sums.
    pub(crate) fn bytes(&self) -> u64 {
        let contents = self.contents;
        let sums = size_of::<PixelSum>() + contents.bytes_of_first_hits();
        let per_pixel = sums as u64 + contents.bytes_of_variance();
        self.window.area() as u64 * per_pixel
    }

    /// The pixels it is for.
    pub fn window(&self) -> Window {
        self.window
    }

    /// Whether first hits are recorded.
    pub fn has_layers(&self) -> bool {
        self.first_hits.is_some()
    }

    /// Number of samples and first hits that were left out because they were not finite.
    pub fn non_finite(&self) -> u64 {
        self.non_finite
    }

    /// The pixels whose variance is mostly that of one sample; `None` without an estimate of variances.
    pub fn fireflies(&self) -> Option<Fireflies> {
        let samples = self.pixels.iter().map(|sum| sum.samples);
        self.contents.has_variance().then(|| fireflies(&self.largest, samples))
    }

    /// Number of pixels without any sample.
    pub fn empty_pixels(&self) -> u64 {
        self.pixels.iter().filter(|sum| sum.samples == 0).count() as u64
    }

    /// Adds a sample of the radiance at `pixel`, which must lie in the window. `set` is the independent set that the
    /// sample belongs to: used by [`Variance::OfSets`] only, and less than its number of sets.
    #[inline]
    pub fn add_sample(&mut self, pixel: UVec2, set: u32, radiance: Spectrum) {
        self.add_samples(pixel, set, &[radiance]);
    }

    /// Adds samples of one pixel and set, in this order.
    #[inline]
    pub fn add_samples(&mut self, pixel: UVec2, set: u32, radiance: &[Spectrum]) {
        let index = self.index(pixel);
        let sum = &mut self.pixels[index];
        let before = sum.samples;
        let finite = radiance.iter().filter(|radiance| radiance.is_finite());
        self.variance.add(index, set, finite.clone().map(|radiance| radiance.to_array()), sum);
        if let Some(largest) = self.largest.get_mut(index) {
            largest.add(before, finite.copied());
        }
        self.non_finite += radiance.len() as u64 - u64::from(sum.samples - before);
    }

    /// Adds the first hit of a sample of `pixel`: the shading normal, the distance and the albedo. If any of it is not
    /// finite it is counted instead. Does nothing if the film records no first hits.
    #[inline]
    pub fn add_first_hit(&mut self, pixel: UVec2, normal: Vec3, depth: f32, albedo: Spectrum) {
        let index = self.index(pixel);
        let Some(first_hits) = &mut self.first_hits else { return };
        if !(normal.is_finite() && depth.is_finite() && albedo.is_finite()) {
            self.non_finite += 1;
            return;
        }
        first_hits[index].add(normal, depth, albedo);
    }

    /// Whether another film's samples can be added to this one: it keeps the same, and its window is part of this one's.
    pub fn fits(&self, tile: &Self) -> bool {
        self.contents == tile.contents
            && tile.window.min.cmpge(self.window.min).all()
            && tile.window.max.cmple(self.window.max).all()
    }

    /// Adds the samples of a film whose window is part of this one's. The result is that of adding them here one by one,
    /// up to rounding; merging into an empty film gives the same bits.
    ///
    /// # Panics
    /// If the contents of the films differ, or the tile's window reaches beyond this one's.
    pub fn merge(&mut self, tile: &Film) {
        assert!(self.fits(tile), "a tile keeps what its film keeps, within its window");
        self.non_finite += tile.non_finite;
        let width = tile.window.size().x as usize;
        for (row, y) in (tile.window.min.y..tile.window.max.y).enumerate() {
            let start = self.index(UVec2::new(tile.window.min.x, y));
            for (to, from) in (start..start + width).zip(row * width..) {
                let other = &tile.pixels[from];
                self.variance.merge(to, &self.pixels[to], &tile.variance, from, other);
                if let Some(largest) = self.largest.get_mut(to) {
                    largest.merge(self.pixels[to].samples, &tile.largest[from], other.samples);
                }
                self.pixels[to].merge(other);
                if let (Some(first_hits), Some(of_tile)) = (&mut self.first_hits, &tile.first_hits)
                {
                    first_hits[to].merge(&of_tile[from]);
                }
            }
        }
    }

    /// The picture: the mean of each pixel, its estimated variance, and the layers. The variance of a pixel is pooled with
    /// those of its neighbours in the window, so that it differs at the border of a crop from that in the whole image.
    pub fn develop(&self) -> Picture {
        let samples = || self.pixels.iter().map(|sum| sum.samples);
        let layers = self.first_hits.as_ref().map(|pixels| FirstHits::develop(pixels, samples()));
        let color = self.pixels.iter().map(|p| p.mean().map(|m| m as f32).into()).collect();
        let variance = self.raw_variance().map(|raw| pooled(self.window.size(), &raw));
        let degrees_of_freedom = self.degrees_of_freedom();
        let (resolution, window, planes) = (self.resolution, self.window, Vec::new());
        Picture { resolution, window, color, variance, degrees_of_freedom, layers, planes }
    }

    /// The picture, with all that the film keeps as [`planes`](Picture::planes).
    pub fn develop_part(&self) -> Picture {
        let (pixels, mut planes) = (self.pixels.len(), Vec::new());
        Kind::Sum.push(&self.pixels, pixels, &mut planes);
        self.variance.push_planes(pixels, &mut planes);
        Kind::Largest.push(&self.largest, pixels, &mut planes);
        if let Some(first_hits) = &self.first_hits {
            Kind::FirstHits.push(first_hits, pixels, &mut planes);
        }
        Picture { planes, ..self.develop() }
    }

    /// The film that a [part's picture](Self::develop_part) was developed from, but for
    /// [`non_finite`](Self::non_finite); `None` if the picture has no such planes, or a pixel has more than `most_samples`
    /// samples.
    ///
    /// # Errors
    /// Those of [`Film::new`].
    pub fn from_planes(
        resolution: UVec2,
        window: Window,
        planes: &[Plane],
        most_samples: u32,
    ) -> Result<Option<Self>, FilmError> {
        let variance = VarianceSums::kind(planes);
        let contents = FilmContents { variance, first_hits: Kind::FirstHits.words(planes) > 0 };
        let mut film = Self::new(resolution, window, contents)?;
        let pixels = window.area();
        let first_hits = film.first_hits.as_mut().map_or(&mut [][..], |first_hits| first_hits);
        let is_whole = Kind::Sum.words(planes) > 0
            && Kind::Sum.restore(&mut film.pixels, pixels, planes).is_some()
            && film.variance.restore_planes(pixels, planes).is_some()
            && Kind::Largest.restore(&mut film.largest, pixels, planes).is_some()
            && Kind::FirstHits.restore(first_hits, pixels, planes).is_some()
            && film.pixels.iter().all(|sum| sum.samples <= most_samples)
            && film.variance.counts().all(|samples| samples <= most_samples)
            && film.first_hits.iter().flatten().all(|sum| sum.hits <= most_samples);
        Ok(is_whole.then_some(film))
    }

    /// The degrees of freedom of the pooled variance in the pixel that has the fewest: five halves of its own, if there
    /// are neighbours (see [`pooled`]). `None` if no pixel has any.
    fn degrees_of_freedom(&self) -> Option<u32> {
        let of = |(index, sum)| self.variance.degrees_of_freedom(index, sum);
        let own = self.pixels.iter().enumerate().map(of).filter(|&degrees| degrees > 0).min()?;
        Some(if self.pixels.len() > 1 { own.saturating_mul(5) / 2 } else { own })
    }

    /// The variance of each pixel's mean from its own samples, infinite where there is no estimate; `None` if no pixel has one.
    fn raw_variance(&self) -> Option<Vec<Spectrum>> {
        let of = |(index, sum)| self.variance.of_mean(index, sum);
        let known = self.pixels.iter().enumerate().any(|pixel| of(pixel).is_some());
        known.then(|| {
            let variances = self.pixels.iter().enumerate().map(|pixel| {
                of(pixel).map_or([f32::INFINITY; 3], |v| v.map(|band| band as f32)).into()
            });
            variances.collect()
        })
    }

    /// Writes all sums, for [`read_sums`](Self::read_sums).
    pub(crate) fn write_sums(&self, to: &mut dyn Write) -> io::Result<()> {
        to.write_all(&self.non_finite.to_le_bytes())?;
        write_all(&self.pixels, to)?;
        self.variance.write(to)?;
        write_all(&self.largest, to)?;
        self.first_hits.as_deref().map_or(Ok(()), |first_hits| write_all(first_hits, to))
    }

    /// Reads what a film of the same window and contents wrote; `None` if there are too few bytes.
    pub(crate) fn read_sums(&mut self, from: &mut &[u8]) -> Option<()> {
        let (non_finite, rest) = from.split_first_chunk()?;
        (self.non_finite, *from) = (u64::from_le_bytes(*non_finite), rest);
        read_all(&mut self.pixels, from)?;
        self.variance.read(from)?;
        read_all(&mut self.largest, from)?;
        self.first_hits.as_mut().map_or(Some(()), |first_hits| read_all(first_hits, from))
    }

    #[inline]
    fn index(&self, pixel: UVec2) -> usize {
        let within = pixel - self.window.min;
        within.y as usize * self.window.size().x as usize + within.x as usize
    }
}
