//! [`Azimuths`]: rows of losses for directions around the normal.

use super::Ggx;
use super::row::{alpha_at, split};

/// Directions around the normal, of which each has another roughness α in its plane: α² = αx² cos² φ + αy² sin² φ. Rows are at equal steps of
/// ln α.
#[derive(Clone, Copy, Debug)]
pub struct Azimuths {
    alpha2: [f32; 2],
    /// ln of the smaller α², and the number of rows per unit from there.
    start: f32,
    scale: f32,
    rows: usize,
}

impl Azimuths {
    pub fn new(ggx: Ggx, rows: usize) -> Self {
        let alpha2 = [1.0, 0.0].map(|cos2_phi| alpha_at(ggx, cos2_phi).powi(2) as f32);
        let [start, end] = [alpha2[0].min(alpha2[1]).ln(), alpha2[0].max(alpha2[1]).ln()];
        Self { alpha2, start, scale: (rows - 1) as f32 / (end - start), rows }
    }

    /// The row before a direction with this cos² φ, and where it stands between that and the next.
    #[inline]
    pub fn row(&self, cos2_phi: f32) -> (usize, f32) {
        let [x, y] = self.alpha2;
        let at = ((x * cos2_phi + y * (1.0 - cos2_phi)).ln() - self.start) * self.scale;
        split(at.clamp(0.0, (self.rows - 1) as f32), self.rows)
    }

    /// cos² φ of a row.
    pub fn cos2_phi(&self, row: usize) -> f32 {
        let [x, y] = self.alpha2;
        let alpha2 = (self.start + row as f32 / self.scale).exp();
        ((alpha2 - y) / (x - y)).clamp(0.0, 1.0)
    }

    /// The mean over φ of what is known for each row.
    pub fn mean(&self, of_rows: &[f32]) -> f32 {
        const STEPS: u32 = 4096;
        let at = |i: u32| {
            let phi = std::f32::consts::FRAC_PI_2 * (i as f32 + 0.5) / STEPS as f32;
            let (row, share) = self.row(phi.cos().powi(2));
            f64::from(of_rows[row] + share * (of_rows[row + 1] - of_rows[row]))
        };
        ((0..STEPS).map(at).sum::<f64>() / f64::from(STEPS)) as f32
    }
}
