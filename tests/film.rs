//! The film's sums: means, their variance, and films merged from tiles and passes. Truth is a second pass over the
//! samples in f64.

use lobe::Spectrum;
use lobe::film::{Film, FilmContents, Variance};
use lobe::glam::{UVec2, Vec3};
use lobe::image::{Picture, Window};

/// SplitMix64 (Steele et al. 2014), as numbers in `[0, 1)`.
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn spectrum(&mut self, offset: f64, scale: f64) -> Spectrum {
        Spectrum::from([0; 3].map(|_| (offset + scale * self.next()) as f32))
    }
}

const PIXEL: UVec2 = UVec2::ZERO;

fn film(side: u32, variance: Variance, first_hits: bool) -> Film {
    let resolution = UVec2::splat(side);
    let contents = FilmContents { variance, first_hits };
    Film::new(resolution, Window::full(resolution), contents).unwrap()
}

/// The picture of one pixel with these samples, each with its set.
fn one_pixel(variance: Variance, samples: &[(u32, Spectrum)]) -> Picture {
    let mut film = film(1, variance, false);
    for &(set, radiance) in samples {
        film.add_sample(PIXEL, set, radiance);
    }
    film.develop()
}

fn bands(samples: &[(u32, Spectrum)], band: usize) -> Vec<f64> {
    samples.iter().map(|(_, radiance)| f64::from(radiance.to_array()[band])).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn assert_near(found: f32, truth: f64, what: &str) {
    let error = (f64::from(found) - truth).abs();
    assert!(error <= 1e-6 * truth, "{what}: {found}, should be {truth}");
}

/// Samples around a large offset, so that a difference of large numbers loses their variance.
fn clouds() -> Vec<(String, Vec<(u32, Spectrum)>)> {
    let mut rng = Rng(1);
    let mut clouds = Vec::new();
    for (offset, scale) in
        [(0.0, 1.0), (1e6, 1.0), (1e6, 0.2), (3e7, 8.0), (0.0, 1e12), (1.0, 1e-5)]
    {
        for count in [2, 3, 17, 4096] {
            let samples: Vec<_> = (0..count)
                // Sets of different sizes: the first has every second sample, the last an eighth.
                .map(|i: u32| (i.trailing_ones().min(3), rng.spectrum(offset, scale)))
                .collect();
            clouds.push((format!("{count} samples in {offset:e} + {scale:e}"), samples));
        }
    }
    clouds
}

/// Caught: n for n - 1 below the squares; n² for n (n - 1) as divisor.
#[test]
fn variance_of_samples_is_that_of_two_passes() {
    for (what, samples) in clouds() {
        let picture = one_pixel(Variance::OfSamples, &samples);
        for band in 0..3 {
            let x = bands(&samples, band);
            let (n, m) = (x.len() as f64, mean(&x));
            let truth = x.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (n - 1.0) / n;
            assert_near(picture.variance.as_ref().unwrap()[0].to_array()[band], truth, &what);
        }
    }
}

/// Caught: sets that weigh the same whatever their size; the number of sets for one less.
#[test]
fn variance_of_sets_is_that_of_two_passes() {
    for (what, samples) in clouds() {
        // More sets than there are samples of, so that some are empty.
        let picture = one_pixel(Variance::OfSets(6), &samples);
        for band in 0..3 {
            let (x, mut sum, mut filled) = (bands(&samples, band), 0.0, 0.0);
            for set in 0..6 {
                let of_set: Vec<_> =
                    samples.iter().zip(&x).filter(|(s, _)| s.0 == set).map(|(_, x)| *x).collect();
                if !of_set.is_empty() {
                    let weight = of_set.len() as f64 / x.len() as f64;
                    sum += weight * (mean(&of_set) - mean(&x)).powi(2);
                    filled += 1.0;
                }
            }
            let truth = sum / (filled - 1.0);
            assert_near(picture.variance.as_ref().unwrap()[0].to_array()[band], truth, &what);
        }
    }
}

/// The mean of the estimates over 20,000 trials is the truth, within five standard errors.
fn assert_unbiased(truth: f64, mut trial: impl FnMut(&mut Rng) -> f32) {
    let mut rng = Rng(7);
    let estimates: Vec<_> = (0..20_000).map(|_| f64::from(trial(&mut rng))).collect();
    let (m, n) = (mean(&estimates), estimates.len() as f64);
    let error = (estimates.iter().map(|e| (e - m).powi(2)).sum::<f64>() / n / n).sqrt();
    assert!((m - truth).abs() < 5.0 * error, "{m} ± {error}, should be {truth}");
}

/// Four uniform numbers: the variance of their mean is 1/12/4. Caught: n for n - 1.
#[test]
fn variance_of_samples_is_unbiased() {
    assert_unbiased(1.0 / 48.0, |rng| {
        let samples: Vec<_> = (0..4).map(|_| (0, rng.spectrum(0.0, 1.0))).collect();
        one_pixel(Variance::OfSamples, &samples).variance.unwrap()[0].to_array()[1]
    });
}

/// Correlated samples: set r has r + 2 equal samples with the variance 1/12/(r + 2), so the mean of all 9 samples has
/// 1/12 / 9. An estimate for independent samples would give a quarter of it.
/// Caught: the number of sets for one less; sets that weigh the same.
#[test]
fn variance_of_sets_is_unbiased_for_correlated_samples() {
    assert_unbiased(1.0 / 108.0, |rng| {
        let samples: Vec<_> = (0..3)
            .flat_map(|set: u32| {
                let size = set + 2;
                let value = (rng.next() - 0.5) / f64::from(size).sqrt();
                vec![(set, Spectrum::from([value as f32; 3])); size as usize]
            })
            .collect();
        one_pixel(Variance::OfSets(3), &samples).variance.unwrap()[0].to_array()[1]
    });
}

/// The variance of equal samples is exactly zero.
#[test]
fn equal_samples_have_no_variance() {
    for value in [0.1, 1e-30, 123.456, 1.1e6, 3e30] {
        for count in [2, 3, 7, 1000, 4097] {
            let samples: Vec<_> = (0..count).map(|i| (i % 2, Spectrum::from([value; 3]))).collect();
            for variance in [Variance::OfSamples, Variance::OfSets(2)] {
                let picture = one_pixel(variance, &samples);
                assert_eq!(picture.color[0], Spectrum::from([value; 3]));
                assert_eq!(picture.variance, Some(vec![Spectrum::BLACK]), "{variance:?} {value}");
                assert_eq!(picture.standard_error(), Some(0.0));
            }
        }
    }
}

#[test]
fn what_is_unknown_is_not_made_up() {
    let lone = [(0, Spectrum::WHITE)];
    let one_set = [(1, Spectrum::WHITE), (1, Spectrum::BLACK)];
    for (variance, samples) in [
        (Variance::None, &one_set[..]),
        (Variance::OfSamples, &[]),
        (Variance::OfSamples, &lone),
        (Variance::OfSets(1), &lone),
        (Variance::OfSets(2), &one_set),
    ] {
        let picture = one_pixel(variance, samples);
        assert_eq!(
            (picture.variance.as_ref(), picture.standard_error()),
            (None, None),
            "{variance:?}"
        );
    }
    let mut film = film(2, Variance::OfSamples, true);
    for value in [1.0, 3.0] {
        film.add_sample(PIXEL, 0, Spectrum::from([value; 3]));
    }
    film.add_sample(UVec2::ONE, 0, Spectrum::WHITE);
    film.add_sample(UVec2::ONE, 0, Spectrum::from([f32::NAN; 3]));
    let picture = film.develop();
    let unknown = Spectrum::from([f32::INFINITY; 3]);
    assert_eq!(picture.variance, Some(vec![Spectrum::WHITE, unknown, unknown, unknown]));
    assert_eq!(picture.standard_error(), Some(1.0));
    assert_eq!(picture.layers.unwrap().samples, [2, 0, 0, 1]);
    assert_eq!(film.non_finite(), 1);
    assert_eq!(Variance::suiting(false, 1), Variance::OfSamples);
    assert_eq!(Variance::suiting(true, 1), Variance::None);
    assert_eq!(Variance::suiting(true, 4), Variance::OfSets(4));
}

/// A film of 3 × 3 pixels. Each has four samples in two sets, whose means differ by `apart` times two.
fn apart(of: impl Fn(UVec2) -> f32) -> Picture {
    let mut film = film(3, Variance::OfSets(2), false);
    for pixel in (0..9).map(|i| UVec2::new(i % 3, i / 3)) {
        for (set, sign) in [(0, 1.0), (1, -1.0)] {
            let value = Spectrum::new(10.0 + sign * of(pixel), 1.0, 1.0);
            film.add_samples(pixel, set, &[value; 2]);
        }
    }
    film.develop()
}

/// A pixel's variance is the mean of its own and of its neighbours' mean, at least an eighth of the largest neighbour's: in a
/// corner, on an edge, in the middle. Seen to fail with the pixel among its neighbours, with five by five neighbours, and with a
/// tenth for an eighth.
#[test]
fn variances_are_pooled_with_neighbours() {
    // Alone, the pixel in the middle has a variance of 1, the right ones 9, all others 0.
    let picture = apart(|pixel| if pixel == UVec2::ONE { 1.0 } else { 3.0 * (pixel.x / 2) as f32 });
    let red: Vec<_> = picture.variance.unwrap().iter().map(|v| v.to_array()).collect();
    let sixth = 0.5 * (1.0 + 9.0 + 9.0) / 5.0;
    let expected = [
        [0.5 / 3.0, sixth, 4.5 + 0.5 * 10.0 / 3.0],
        [1.0 / 8.0, 0.5 + 0.5 * 27.0 / 8.0, 4.5 + 0.5 * 19.0 / 5.0],
        [0.5 / 3.0, sixth, 4.5 + 0.5 * 10.0 / 3.0],
    ];
    for (index, expected) in expected.into_iter().flatten().enumerate() {
        let found = red[index];
        assert!((found[0] - expected).abs() < 1e-5, "{index}: {found:?}, expected {expected}");
        assert_eq!(found[1..], [0.0; 2], "equal samples among equal ones");
    }
    // One of eight neighbours varies: half of their mean would be a sixteenth of its variance.
    let picture = apart(|pixel| if pixel == UVec2::ZERO { 2.0 } else { 0.0 });
    assert!((picture.variance.unwrap()[4].to_array()[0] - 0.5).abs() < 1e-6);
}

/// Sets or samples less one, and as many again from the neighbours; those of the pixel that has the fewest, of those with an
/// estimate. Seen to fail with the most for the fewest.
#[test]
fn degrees_of_freedom_are_those_of_the_poorest_pixel() {
    let samples: Vec<_> = (0..7).map(|i| (i % 3, Spectrum::splat(i as f32))).collect();
    for (variance, degrees) in [
        (Variance::None, None),
        (Variance::OfSets(1), None),
        (Variance::OfSets(3), Some(2)),
        (Variance::OfSets(5), Some(2)),
        (Variance::OfSamples, Some(6)),
    ] {
        assert_eq!(one_pixel(variance, &samples).degrees_of_freedom, degrees, "{variance:?}");
        let mut film = film(2, variance, false);
        for &(set, radiance) in &samples {
            film.add_sample(PIXEL, set, radiance);
            film.add_sample(UVec2::X, set, radiance);
        }
        // One more sample of a set, of a pixel that keeps one sample, and of one that has none.
        film.add_sample(PIXEL, 0, Spectrum::WHITE);
        film.add_sample(UVec2::Y, 0, Spectrum::WHITE);
        let pooled = degrees.map(|degrees| 5 * degrees / 2);
        assert_eq!(film.develop().degrees_of_freedom, pooled, "{variance:?}");
    }
}

const VARIANCES: [Variance; 4] =
    [Variance::None, Variance::OfSamples, Variance::OfSets(1), Variance::OfSets(3)];

/// Adds one pass over the pixels of a window: colours, and first hits of some.
fn add_pass(film: &mut Film, window: Window, pass: u64) {
    for y in window.min.y..window.max.y {
        for x in window.min.x..window.max.x {
            let mut rng = Rng(pass << 32 | u64::from(y << 16 | x));
            for index in 0..3 + (x + y) % 2 {
                let pixel = UVec2::new(x, y);
                film.add_sample(pixel, index % 3, rng.spectrum(1e3, 1.0));
                if index > 0 {
                    let (n, a) = (rng.spectrum(-0.5, 1.0).to_array(), rng.spectrum(0.0, 1.0));
                    film.add_first_hit(pixel, Vec3::from(n), rng.next() as f32, a);
                }
            }
        }
    }
}

fn tiles(side: u32, size: u32) -> impl Iterator<Item = Window> {
    let at = move |i: u32| UVec2::new(i % 8, i / 8) * size;
    (0..64)
        .map(at)
        .filter(move |min| min.max_element() < side)
        .map(move |min| Window { min, max: (min + size).min(UVec2::splat(side)) })
}

/// Caught: n² for n (n - 1) as divisor.
#[test]
fn tiles_and_passes_add_up() {
    for variance in VARIANCES {
        let mut at_once = film(11, variance, true);
        let mut merged = film(11, variance, true);
        let mut tile = film(4, variance, true);
        for pass in 0..3 {
            add_pass(&mut at_once, Window::full(UVec2::splat(11)), pass);
            for window in tiles(11, 4) {
                tile.reset(window);
                add_pass(&mut tile, window, pass);
                merged.merge(&tile);
            }
            let (a, b) = (at_once.develop(), merged.develop());
            if pass == 0 {
                // Merging into an empty film is copying.
                assert_eq!(a, b, "{variance:?}");
            }
            let flat = |p: &Picture| {
                let layers = p.layers.clone().unwrap();
                let spectra =
                    p.color.iter().chain(p.variance.iter().flatten()).chain(&layers.albedo);
                let mut all: Vec<f32> = spectra.flat_map(|s| s.to_array()).collect();
                all.extend(layers.normal.iter().flat_map(|n| n.to_array()));
                all.extend(layers.depth);
                (all, layers.samples)
            };
            let ((a, samples_a), (b, samples_b)) = (flat(&a), flat(&b));
            assert_eq!(samples_a, samples_b);
            for (a, b) in a.into_iter().zip(b) {
                assert!((a - b).abs() <= 1e-6 * a.abs(), "{variance:?}, pass {pass}: {b}, not {a}");
            }
        }
    }
}

#[test]
fn radiance_does_not_know_what_else_is_kept() {
    let window = Window::full(UVec2::splat(16));
    let color = |variance, first_hits| {
        let (mut film, mut part) = (film(16, variance, first_hits), film(16, variance, first_hits));
        for pass in 0..40 {
            part.reset(window);
            add_pass(&mut part, window, pass);
            film.merge(&part);
        }
        film.develop().color
    };
    let plain = color(Variance::None, false);
    for variance in VARIANCES {
        assert_eq!(color(variance, true), plain, "{variance:?}");
    }
}

/// First hits are kept completely or not at all, and counted. Seen to fail without the film's test of first hits,
/// and without each of its three parts.
#[test]
fn first_hits_that_are_none_are_counted() {
    let mut film = film(1, Variance::None, true);
    let mut add = |n, depth, albedo| film.add_first_hit(PIXEL, n, depth, Spectrum::splat(albedo));
    for bad in [f32::NAN, f32::INFINITY] {
        add(Vec3::new(0.0, bad, 0.0), 2.0, 0.5);
        add(Vec3::Y, bad, 0.5);
        add(Vec3::Y, 2.0, bad);
    }
    add(Vec3::Y, 2.0, 0.5);
    assert_eq!(film.non_finite(), 6);
    let layers = film.develop().layers.unwrap();
    assert_eq!((layers.normal[0], layers.depth[0]), (Vec3::Y, 2.0));
    assert_eq!(layers.albedo[0], Spectrum::splat(0.5));
}

#[test]
#[should_panic = "a tile keeps what its film keeps"]
fn films_that_keep_other_things_do_not_merge() {
    film(1, Variance::OfSamples, false).merge(&film(1, Variance::None, false));
}

/// 65,536 sets for each of 2²⁸ pixels are 512 TiB, to which the rest adds 152 bytes a pixel.
#[test]
fn sets_count_towards_the_memory() {
    let contents = FilmContents { variance: Variance::OfSets(1 << 16), first_hits: false };
    let window = Window::full(UVec2::splat(1 << 14));
    let error = Film::new(window.max, window, contents).unwrap_err().to_string();
    assert!(error.contains("16384 x 16384 pixels needs about 536909824 MiB"), "{error}");
}

/// Pixels in which one sample holds more than half of all squared differences are told, with their share of those of the image.
/// Truth: of 31 samples of luminance 1 and one of 33, the mean is 2, and the large one holds 31² of 31² + 31 = 992. Caught: differences
/// from zero; merged films whose means are not compared; few samples that count; a sample that is not finite.
#[test]
fn fireflies_are_told() {
    let size = UVec2::new(4, 1);
    let film = |variance| {
        let contents = FilmContents { variance, first_hits: false };
        Film::new(size, Window::full(size), contents).unwrap()
    };
    assert_eq!(film(Variance::None).fireflies(), None);
    for variance in [Variance::OfSamples, Variance::OfSets(4)] {
        for parts in [1, 2, 7] {
            let mut films: Vec<Film> = (0..parts).map(|_| film(variance)).collect();
            let mut add = |x: u32, i: u32, y: f32| {
                films[(i % parts) as usize].add_sample(UVec2::new(x, 0), i % 4, Spectrum::splat(y));
            };
            for i in 0..32 {
                // One bright sample; two of them; none; and one among too few.
                add(0, i, if i == 20 { 33.0 } else { 1.0 });
                add(1, i, if i == 3 || i == 30 { 33.0 } else { 1.0 });
                add(2, i, (i % 5) as f32);
                add(2, i, f32::INFINITY);
                if i < 15 {
                    add(3, i, if i == 7 { 33.0 } else { 1.0 });
                }
            }
            let mut all = film(variance);
            films.iter().for_each(|film| all.merge(film));
            let part = all.develop_part();
            let read = Film::from_planes(size, Window::full(size), &part.planes, 99).unwrap();
            assert_eq!(read.unwrap().fireflies(), all.fireflies());
            let squares = |values: &[f64]| {
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                values.iter().map(|y| (y - mean).powi(2)).sum::<f64>()
            };
            let with = |count: usize, bright: usize| {
                (0..count).map(|i| if i < bright { 33.0 } else { 1.0 }).collect::<Vec<_>>()
            };
            let plain: Vec<f64> = (0..32).map(|i| f64::from(i % 5)).collect();
            let sum = 992.0 + squares(&with(32, 2)) + squares(&plain) + squares(&with(15, 1));
            let found = all.fireflies().unwrap();
            assert_eq!(found.pixels, 1, "{variance:?}, {parts} parts");
            let expected = 961.0 / sum;
            assert!((found.share - expected).abs() < 1e-9, "{}, expected {expected}", found.share);
        }
    }
}
