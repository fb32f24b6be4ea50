//! [`RunningMean`]: mean and variance of pictures that differ by noise alone.

use glam::DVec3;

use crate::image::Image;
use crate::spectrum::Spectrum;

/// Mean and variance of independent pictures, for each band of each pixel (Welford 1962, "Note on a method for calculating
/// corrected sums of squares and products").
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunningMean {
    count: u32,
    mean: Vec<DVec3>,
    /// Sums of squared differences from the mean.
    squares: Vec<DVec3>,
}

impl RunningMean {
    /// Number of pictures.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Adds a picture. All have to be of one size.
    ///
    /// # Panics
    /// If the number of pixels differs from that of the pictures before.
    pub fn add(&mut self, pixels: &[Spectrum]) {
        if self.count == 0 {
            self.mean = vec![DVec3::ZERO; pixels.len()];
            self.squares = self.mean.clone();
        }
        assert_eq!(pixels.len(), self.mean.len(), "pictures of one size");
        self.count += 1;
        let share = 1.0 / f64::from(self.count);
        for ((mean, squares), pixel) in self.mean.iter_mut().zip(&mut self.squares).zip(pixels) {
            let value = DVec3::from(pixel.to_array().map(f64::from));
            let before = value - *mean;
            *mean += share * before;
            *squares += before * (value - *mean);
        }
    }

    /// The mean, and the variance of the mean from two pictures on.
    pub fn pixels(&self) -> (Vec<Spectrum>, Option<Vec<Spectrum>>) {
        let narrow = |v: &DVec3| Spectrum::from(v.as_vec3().to_array());
        let mean = self.mean.iter().map(narrow).collect();
        let count = f64::from(self.count);
        let variance = |squares: &DVec3| narrow(&(*squares / (count * (count - 1.0))));
        (mean, (self.count > 1).then(|| self.squares.iter().map(variance).collect()))
    }

    /// Degrees of freedom of that variance: the pictures less one.
    pub fn degrees_of_freedom(&self) -> Option<u32> {
        self.count.checked_sub(1).filter(|&degrees| degrees > 0)
    }

    /// Restores the mean of `count` pictures from the result of [`pixels`](Self::pixels), stored in an image. It was
    /// rounded to f32. An image without variance counts as one picture.
    pub fn from_image(image: &Image, count: u32) -> Self {
        let wide = |pixel: &Spectrum| DVec3::from(pixel.to_array().map(f64::from));
        let mean: Vec<DVec3> = image.pixels.iter().map(wide).collect();
        match &image.variance {
            Some(variance) if count > 1 => {
                let of_mean = f64::from(count) * f64::from(count - 1);
                let squares = variance.iter().map(|v| of_mean * wide(v)).collect();
                Self { count, mean, squares }
            }
            _ => Self { count: 1, squares: vec![DVec3::ZERO; mean.len()], mean },
        }
    }

    /// Mean and variance of the mean of each pixel. The variance is NaN for fewer than two pictures.
    pub(super) fn moments(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let of_mean = f64::from(self.count) * (f64::from(self.count) - 1.0);
        self.mean.iter().zip(&self.squares).map(move |(&mean, &squares)| (mean, squares / of_mean))
    }
}
