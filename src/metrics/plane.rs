//! [`Plane`]: one band of an image, and separable filters.

use glam::UVec2;

/// One number for each pixel, row by row.
#[derive(Clone)]
pub struct Plane {
    pub size: UVec2,
    pub values: Vec<f32>,
}

impl Plane {
    /// The plane filtered along its rows by `across`, and along its columns by `down`, both of odd length. Pixels beyond
    /// the border repeat the border.
    pub fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        self.along_rows(across).transposed().along_rows(down).transposed()
    }

    fn along_rows(&self, weights: &[f32]) -> Self {
        let width = self.size.x as usize;
        let reach = weights.len() / 2;
        let mut values = Vec::with_capacity(self.values.len());
        let mut row = Vec::with_capacity(width + 2 * reach);
        for inner in self.values.chunks_exact(width) {
            row.clear();
            row.extend(std::iter::repeat_n(inner[0], reach));
            row.extend_from_slice(inner);
            row.extend(std::iter::repeat_n(inner[width - 1], reach));
            let sum = |around: &[f32]| around.iter().zip(weights).map(|(v, w)| v * w).sum::<f32>();
            values.extend(row.windows(weights.len()).map(sum));
        }
        Self { size: self.size, values }
    }

    /// Rows and columns exchanged.
    fn transposed(&self) -> Self {
        let (width, height) = (self.size.x as usize, self.size.y as usize);
        let column = |x: usize| (0..height).map(move |y| self.values[y * width + x]);
        Self {
            size: UVec2::new(self.size.y, self.size.x),
            values: (0..width).flat_map(column).collect(),
        }
    }

    /// Combines two planes pixel by pixel.
    pub fn zip(&self, other: &Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let both = self.values.iter().zip(&other.values);
        Self { size: self.size, values: both.map(|(&a, &b)| f(a, b)).collect() }
    }
}
