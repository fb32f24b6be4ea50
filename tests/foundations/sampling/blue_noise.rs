//! The blue-noise sampler: nets for each pixel and for the whole image, and error that a blur removes.

use lobe::glam::{UVec2, Vec2};
use lobe::sampling::{BlueNoiseSampler, SampleId, Sampler, SobolSampler};

use super::sobol::assert_one_each;
use crate::common::stats::{assert_fits, assert_mean, mean};

const RESOLUTION: UVec2 = UVec2::new(107, 75);

fn id(x: u32, y: u32, index: u32) -> SampleId {
    SampleId { pixel: UVec2::new(x, y), set: 0, index }
}

/// All samples of an aligned square of pixels are a net, from a single pixel up to the image, and so is each
/// set beyond the first. Caught: the scramble with an odd constant in place of its last;
/// pixels in the order of rows.
#[test]
fn squares_of_pixels_are_nets() {
    let sampler = BlueNoiseSampler::new(UVec2::new(20, 30), 13, 5);
    for (dimension, side, set) in
        (0..6).flat_map(|d| [1, 2, 4, 8].map(|side| [0, 1, 6].map(|set| (d, side, set)))).flatten()
    {
        for corner in [UVec2::ZERO, UVec2::new(16, 8), UVec2::new(8, 24)] {
            let pixels = (0..side * side).map(|i| corner + UVec2::new(i % side, i / side));
            let points: Vec<Vec2> = pixels
                .flat_map(|p| (0..16).map(move |i| id(p.x, p.y, 16 * set + i)))
                .map(|id| sampler.get_2d(id, dimension))
                .collect();
            let bits = points.len().ilog2();
            for columns in 0..=bits {
                let cell = |x: f32, bits: u32| (f64::from(x) * f64::from(1 << bits)) as usize;
                let box_of =
                    |p: Vec2| cell(p.x, columns) << (bits - columns) | cell(p.y, bits - columns);
                let what = format!("dimension {dimension}, side {side} at {corner}, set {set}");
                assert_one_each(&points, box_of, &what);
            }
        }
    }
}

/// The means of 3 × 3 pixels.
fn blur(image: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let around =
        |rows: &[Vec<f64>], x: usize| rows.iter().flat_map(|row| &row[x..x + 3]).sum::<f64>() / 9.0;
    let row = |rows: &[Vec<f64>]| (0..rows[0].len() - 2).map(|x| around(rows, x)).collect();
    image.windows(3).map(row).collect()
}

/// The variance of an image of errors, as it is and after three blurs over 3 × 3 pixels.
fn variances(sampler: &dyn Sampler, spp: u32) -> [f64; 2] {
    let error = |x: u32, y: u32| {
        let f = |p: Vec2| f64::from(p.x * p.y) + f64::from(u8::from(p.x + 0.5 * p.y < 0.6));
        let truth = 0.25 + 0.35;
        (0..spp).map(|i| f(sampler.get_2d(id(x, y, i), 3))).sum::<f64>() / f64::from(spp) - truth
    };
    let image: Vec<Vec<f64>> =
        (0..RESOLUTION.y).map(|y| (0..RESOLUTION.x).map(|x| error(x, y)).collect()).collect();
    let blurred = blur(&blur(&blur(&image)));
    let square_mean = |values: &mut dyn Iterator<Item = f64>| mean(values.map(|v| v * v)).0;
    [
        square_mean(&mut image.iter().flatten().copied()),
        square_mean(&mut blurred.iter().flatten().copied()),
    ]
}

/// A blur takes more of the error away than where pixels are independent, while that of a pixel stays as it is.
/// Caught: pixels in the order of rows.
#[test]
fn error_is_blue() {
    for spp in [1, 4] {
        // One scramble for the whole image makes the error's size vary from seed to seed.
        let total = |sampler: &dyn Fn(u64) -> Box<dyn Sampler>| {
            let variances = (0..16).map(|seed| variances(&*sampler(seed), spp));
            variances.fold([0.0; 2], |sum, v| [sum[0] + v[0], sum[1] + v[1]])
        };
        let blue = total(&|seed| Box::new(BlueNoiseSampler::new(RESOLUTION, spp, seed)));
        let white = total(&|seed| Box::new(SobolSampler::new(seed)));
        assert!(blue[1] < 0.5 * white[1], "{spp} samples: {blue:?}, {white:?}");
        assert!(blue[0] < 1.15 * white[0], "{spp} samples: {blue:?}, {white:?}");
    }
}

/// Each pixel and sample is uniform over seeds, and its dimensions know nothing of each other. Caught: dimension 0 for
/// all dimensions, in scrambles and orders.
#[test]
fn pixels_are_uniform_over_seeds() {
    const COUNT: u64 = 1 << 16;
    let expected = [COUNT as f64 / 256.0; 256];
    for id in [id(0, 0, 0), id(106, 74, 3), id(31, 32, 1)] {
        let mut observed = [[0; 256]; 3];
        let mut products = Vec::new();
        for seed in 0..COUNT {
            let sampler = BlueNoiseSampler::new(RESOLUTION, 4, seed);
            let [p, q, r] = [0, 1, 2].map(|d| sampler.get_2d(id, d));
            for (observed, p) in
                observed.iter_mut().zip([p, Vec2::new(p.x, q.x), Vec2::new(p.y, r.x)])
            {
                observed[(p.x * 16.0) as usize * 16 + (p.y * 16.0) as usize] += 1;
            }
            products.push(f64::from(p.x * q.x * r.y));
        }
        for (kind, observed) in observed.iter().enumerate() {
            assert_fits(observed, &expected, 12, &format!("{id:?}, kind {kind}"));
        }
        let (mean, error) = mean(products.into_iter());
        assert_mean(mean, error, 0.125, 12, &format!("{id:?}"));
    }
}
