//! [`Azimuths`]: rows of losses for directions around the normal.

use super::Ggx;
use super::row::{alpha_at, split};

/// Directions around the normal, of which each has another roughness α in its plane: α² = αx² cos² φ + αy² sin² φ.
///
/// Rows are at equal steps of the mean of two coordinates: ln α², which places them where the roughness changes, and the squared cosine
/// of the angle to the rougher axis, which places them beside that axis.
#[derive(Clone, Copy, Debug)]
pub struct Azimuths {
    alpha2: [f32; 2],
    /// ln of the smaller α², and what it is multiplied by to be in `[0, 1]`.
    start: f32,
    scale: f32,
    rows: usize,
}

impl Azimuths {
    /// `None` if f32 does not tell the roughnesses apart.
    pub fn new(ggx: Ggx, rows: usize) -> Option<Self> {
        let alpha2 = [1.0, 0.0].map(|cos2_phi| alpha_at(ggx, cos2_phi).powi(2) as f32);
        let [start, end] = [alpha2[0].min(alpha2[1]).ln(), alpha2[0].max(alpha2[1]).ln()];
        let scale = 1.0 / (end - start);
        (end - start > 1e-4).then_some(Self { alpha2, start, scale, rows })
    }

    /// Where a direction with this cos² φ stands, in `[0, 1]` from the smoother axis to the rougher one.
    #[inline]
    fn position(&self, cos2_phi: f32) -> f32 {
        let [x, y] = self.alpha2;
        let sin2_phi = 1.0 - cos2_phi;
        let rougher = if x > y { cos2_phi } else { sin2_phi };
        let log = ((x * cos2_phi + y * sin2_phi).ln() - self.start) * self.scale;
        (0.5 * (rougher + log)).clamp(0.0, 1.0)
    }

    /// The row before a direction with this cos² φ, and where it stands between that and the next.
    #[inline]
    pub fn row(&self, cos2_phi: f32) -> (usize, f32) {
        split(self.position(cos2_phi) * (self.rows - 1) as f32, self.rows)
    }

    /// cos² φ of a row.
    pub fn cos2_phi(&self, row: usize) -> f32 {
        let at = row as f32 / (self.rows - 1) as f32;
        let is_x_rougher = self.alpha2[0] > self.alpha2[1];
        let [mut low, mut high] = [0.0_f32, 1.0];
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let is_before =
                if is_x_rougher { self.position(middle) < at } else { self.position(middle) > at };
            if is_before { low = middle } else { high = middle }
        }
        high
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
