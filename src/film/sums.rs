//! [`Film`]: sums of samples.

use glam::{UVec2, Vec3};

use super::{Layers, Picture, Window};
use crate::Spectrum;

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

/// Sums of the samples of each pixel under a box filter, in f64: a million samples lose nothing.
///
/// A sample that is not finite is left out of its pixel and counted in
/// [`non_finite`](Film::non_finite).
#[derive(Clone, Debug)]
pub struct Film {
    resolution: UVec2,
    window: Window,
    pixels: Vec<Pixel>,
    layers: Option<Vec<FirstHits>>,
    non_finite: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Pixel {
    sum: [f64; 3],
    samples: u32,
}

/// Sums over the samples that hit something.
#[derive(Clone, Copy, Debug, Default)]
struct FirstHits {
    normal: [f64; 3],
    depth: f64,
    albedo: [f64; 3],
    hits: u32,
}

/// stub
#[derive(Clone, Copy)]
pub enum Variance {
    /// stub
    None,
    /// stub
    OfSamples,
    /// stub
    OfSets,
}
/// stub
#[derive(Clone, Copy)]
pub struct FilmContents {
    /// stub
    pub sets: u32,
    /// stub
    pub variance: Variance,
    /// stub
    pub first_hits: bool,
}
impl Film {
    /// An empty film for the pixels of `window` in an image of `resolution`, with room for the first
    /// hits if `layers` says so. Fails if the film, its picture and the files made from them would not
    /// fit into memory.
    ///
    /// # Errors
    /// [`FilmError::TooLarge`] when the system refuses the memory.
    pub fn new(resolution: UVec2, window: Window, c: FilmContents) -> Result<Self, FilmError> {
        let layers = c.first_hits;
        // Colour and layers once as sums, once developed, and once more while they are written.
        let per_pixel = size_of::<Pixel>() + if layers { size_of::<FirstHits>() } else { 0 };
        let bytes = (window.area() as u64).saturating_mul(3 * per_pixel as u64);
        let too_large = FilmError::TooLarge(window.size().x, window.size().y, bytes >> 20);
        let fits =
            usize::try_from(bytes).is_ok_and(|b| Vec::<u8>::new().try_reserve_exact(b).is_ok());
        if !fits {
            return Err(too_large);
        }
        let pixels = zeroed(window.area()).ok_or(too_large)?;
        let layers = if layers { Some(zeroed(window.area()).ok_or(too_large)?) } else { None };
        Ok(Self { resolution, window, pixels, layers, non_finite: 0 })
    }

    /// Forgets all samples and stands for another window, no larger than the first one.
    pub fn reset(&mut self, window: Window) {
        self.window = window;
        self.non_finite = 0;
        self.pixels.clear();
        self.pixels.resize(window.area(), Pixel::default());
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

    /// Adds a sample of the radiance at `pixel`, which lies in the window.
    #[inline]
    pub fn add_sample(&mut self, pixel: UVec2, set: u32, radiance: Spectrum) {
        self.add_samples(pixel, set, &[radiance]);
    }

    /// Adds samples of one pixel, in their order.
    #[inline]
    pub fn add_samples(&mut self, pixel: UVec2, _set: u32, radiance: &[Spectrum]) {
        let place = self.place(pixel);
        // A copy, which stays in registers.
        let mut sums = self.pixels[place];
        for radiance in radiance {
            if radiance.is_finite() {
                add(&mut sums.sum, radiance.to_array());
                sums.samples += 1;
            } else {
                self.non_finite += 1;
            }
        }
        self.pixels[place] = sums;
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
        add(&mut hits.normal, normal.to_array());
        add(&mut hits.albedo, albedo.to_array());
        hits.depth += f64::from(depth);
        hits.hits += 1;
    }

    /// Takes over the pixels of a film for a part of this one's window.
    pub fn merge(&mut self, tile: &Film) {
        self.non_finite += tile.non_finite;
        let width = tile.window.size().x as usize;
        for (row, y) in (tile.window.min.y..tile.window.max.y).enumerate() {
            let from = row * width..(row + 1) * width;
            let to = self.place(UVec2::new(tile.window.min.x, y));
            self.pixels[to..to + width].copy_from_slice(&tile.pixels[from.clone()]);
            if let (Some(layers), Some(of_tile)) = (&mut self.layers, &tile.layers) {
                layers[to..to + width].copy_from_slice(&of_tile[from]);
            }
        }
    }

    /// The mean of each pixel.
    pub fn develop(&self) -> Picture {
        let mean = |sum: [f64; 3], count: u32| sum.map(|s| (s / f64::from(count.max(1))) as f32);
        let layers = self.layers.as_ref().map(|layers| Layers {
            normal: layers.iter().map(|l| mean(l.normal, l.hits).into()).collect(),
            depth: layers.iter().map(|l| (l.depth / f64::from(l.hits.max(1))) as f32).collect(),
            albedo: layers.iter().map(|l| mean(l.albedo, l.hits).into()).collect(),
        });
        let color = self.pixels.iter().map(|p| mean(p.sum, p.samples).into()).collect();
        Picture { resolution: self.resolution, window: self.window, color, layers }
    }

    #[inline]
    fn place(&self, pixel: UVec2) -> usize {
        let within = pixel - self.window.min;
        within.y as usize * self.window.size().x as usize + within.x as usize
    }
}

#[inline]
fn add(sum: &mut [f64; 3], values: [f32; 3]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += f64::from(value);
    }
}

/// `count` default values, or `None` if there is no memory for them.
fn zeroed<T: Clone + Default>(count: usize) -> Option<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(count).ok()?;
    values.resize(count, T::default());
    Some(values)
}
