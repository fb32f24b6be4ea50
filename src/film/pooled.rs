//! [`pooled`]: the variance of each pixel, estimated from the pixel and its neighbours.

use glam::UVec2;

use crate::spectrum::Spectrum;

/// Pools the variance of each pixel with those of its up to eight neighbours in the window, band by band: the mean of its
/// own and of their mean, but at least an eighth of their largest.
///
/// Few sets may agree by chance: all samples of a pixel in a penumbra may be in shadow, and at a silhouette each set may
/// hit as often. Alone, such a pixel would claim no error. If neighbours tell as much as the pixel does, the pooled
/// variance has 3.6 times the degrees of freedom of a pixel (Satterthwaite 1946); five halves are counted, by which the
/// stated intervals hold the truth as often as they say. Measurements of this and other ways are in docs/measurements.md.
///
/// What it costs: a pixel that is noisier than all its neighbours claims down to half of its variance.
///
/// Infinite variances are unknown: they stay, and do not count as neighbours.
pub(super) fn pooled(size: UVec2, raw: &[Spectrum]) -> Vec<Spectrum> {
    let (width, height) = (size.x as usize, size.y as usize);
    let mut pooled = Vec::with_capacity(raw.len());
    for (index, own) in raw.iter().enumerate() {
        let (x, y) = (index % width, index / width);
        let (mut sum, mut largest, mut known) = ([0.0_f64; 3], [0.0_f32; 3], 0.0);
        for row in y.saturating_sub(1)..(y + 2).min(height) {
            for column in x.saturating_sub(1)..(x + 2).min(width) {
                let neighbour = row * width + column;
                if neighbour == index || !raw[neighbour].is_finite() {
                    continue;
                }
                known += 1.0;
                for (band, value) in raw[neighbour].to_array().into_iter().enumerate() {
                    sum[band] += f64::from(value);
                    largest[band] = largest[band].max(value);
                }
            }
        }
        let own = own.to_array();
        pooled.push(if known == 0.0 {
            own.into()
        } else {
            [0, 1, 2]
                .map(|band| {
                    let mean = 0.5 * (f64::from(own[band]) + sum[band] / known);
                    (mean as f32).max(0.125 * largest[band])
                })
                .into()
        });
    }
    pooled
}
