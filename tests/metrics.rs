//! Errors between images: computed by hand, compared with other programs, and refused where they would be meaningless.
//! Each was seen to fail: by a constant of FLIP, infinite variances counted, encodings not compared, a scale from the largest pixel.

use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{Encoding, Image};
use lobe::metrics::{CompareError, ErrorMap, Errors, StudentT, Viewing, flip, half_widths, z_test};

fn image(size: UVec2, encoding: Encoding, pixel: impl Fn(u32, u32) -> [f32; 3]) -> Image {
    let at = |i: u32| Spectrum::from(pixel(i % size.x, i / size.x));
    let pixels = (0..size.x * size.y).map(at).collect();
    Image { size, pixels, variance: None, degrees_of_freedom: None, encoding }
}

const SIZE: UVec2 = UVec2::new(48, 40);

/// Values of flip-evaluator 1.7 for the pattern and its shift by 5: `evaluate(reference, test, "LDR")` and `"HDR"`.
const LDR: f64 = 0.42159;
const HDR: f64 = 0.32725;

/// A pattern that other programs can reproduce: (i · factor mod 256) / 255 for i = x + 48 y, a third of them shifted.
fn pattern(shift: u32) -> impl Fn(u32, u32) -> [f32; 3] {
    move |x, y| {
        let i = x + 48 * y;
        let moved = if i.is_multiple_of(3) { i + shift } else { i };
        [7, 11, 13].map(|factor| (moved * factor % 256) as f32 / 255.0)
    }
}

/// Seen to fail with the images exchanged in relMSE.
#[test]
fn errors_are_those_by_hand() {
    let a = image(UVec2::new(2, 1), Encoding::Linear, |x, _| {
        [[1.0, 2.0, 0.0], [0.5, 0.0, 4.0]][x as usize]
    });
    let b = image(UVec2::new(2, 1), Encoding::Linear, |x, _| {
        [[1.0, 1.0, 0.0], [0.0, 0.0, 2.0]][x as usize]
    });
    let errors = Errors::between(&a, &b).unwrap();
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-12 * y.abs(), "{x}, expected {y}");
    close(errors.mse, (1.0 + 0.25 + 4.0) / 6.0);
    close(errors.mae, 3.5 / 6.0);
    close(errors.mean, 3.5 / 6.0);
    close(errors.rel_mse, (1.0 / 1.01 + 0.25 / 0.01 + 4.0 / 4.01) / 6.0);
    close(errors.psnr(), 10.0 * (4.0 / errors.mse).log10());
}

/// Equal images have no noise, black ones neither, whose peak is 0. Seen to fail for black images with peak² / MSE alone.
#[test]
fn equal_images_have_infinite_psnr() {
    for value in [0.0, 0.5] {
        let image = image(SIZE, Encoding::Linear, |_, _| [value; 3]);
        assert_eq!(Errors::between(&image, &image).unwrap().psnr(), f64::INFINITY, "{value}");
    }
}

/// Images that cannot be compared give an error that says why, and where.
#[test]
fn what_cannot_be_compared_is_refused() {
    let good = image(SIZE, Encoding::Linear, pattern(0));
    let small = image(UVec2::new(48, 39), Encoding::Linear, pattern(0));
    let codes = image(SIZE, Encoding::Srgb, pattern(0));
    let mut odd = good.clone();
    odd.pixels[48 * 2 + 5] = Spectrum::new(1.0, f32::NAN, 1.0);
    odd.pixels[48 * 3] = Spectrum::splat(f32::INFINITY);
    let says = |a: &Image, b: &Image| Errors::between(a, b).unwrap_err().to_string();
    assert_eq!(
        says(&good, &small),
        "the images have 48 x 40 and 48 x 39 pixels: they have to be of one size"
    );
    assert_eq!(Errors::between(&good, &codes), Err(CompareError::Encoding));
    let expected = "2 pixels of the reference are not finite, at (5, 2), (0, 3): no mean over them would mean anything";
    assert_eq!(says(&good, &odd), expected);
    assert!(flip(&odd, &good, Viewing::default()).is_err());
}

/// Equal images have no error; the pattern's values are those of flip-evaluator 1.x, to 1e-3.
#[test]
fn flip_is_that_of_its_authors() {
    for (encoding, expected) in [(Encoding::Srgb, LDR), (Encoding::Linear, HDR)] {
        let (a, b) = (image(SIZE, encoding, pattern(5)), image(SIZE, encoding, pattern(0)));
        let mean = |a: &Image, b: &Image| {
            let (seen, _) = flip(a, b, Viewing::default()).unwrap();
            seen.iter().map(|&x| f64::from(x)).sum::<f64>() / seen.len() as f64
        };
        assert_eq!(mean(&b, &b), 0.0);
        let found = mean(&a, &b);
        assert!((found - expected).abs() < 1e-3, "{encoding:?}: {found}, expected {expected}");
    }
}

/// A pixel beyond the saturation of the tone mapping curve is white, however bright. Seen to fail at 1e20 with the curve alone,
/// whose numerator and denominator are infinite there.
#[test]
fn flip_sees_the_brightest_pixel() {
    let dark = image(SIZE, Encoding::Linear, |_, _| [0.0; 3]);
    let firefly = |value: f32| {
        image(SIZE, Encoding::Linear, move |x, y| [if (x, y) == (20, 20) { value } else { 0.0 }; 3])
    };
    let at = |value: f32| {
        let (seen, _) = flip(&firefly(value), &dark, Viewing::default()).unwrap();
        seen[20 * 48 + 20]
    };
    let white = at(1.0);
    assert!(white > 0.5, "{white}");
    for value in [1e10, 1e20, 1e30, f32::MAX] {
        assert_eq!(at(value), white, "{value:e}");
    }
}

/// Differences of one standard error are noise, one of twenty is not, and pixels without variance do not count.
#[test]
fn noise_is_told_from_difference() {
    let mut a = image(SIZE, Encoding::Linear, pattern(0));
    let b = a.clone();
    assert_eq!(z_test(&a, &b), Ok(None));
    a.variance = Some(vec![Spectrum::splat(0.01); a.pixels.len()]);
    a.variance.as_mut().unwrap()[0] = Spectrum::splat(f32::INFINITY);
    for (i, pixel) in a.pixels.iter_mut().enumerate() {
        *pixel += Spectrum::splat(if i % 2 == 0 { 0.1 } else { -0.1 });
    }
    a.pixels[48 + 7] = b.pixels[48 + 7] + Spectrum::new(0.0, 2.0, 0.0);
    let found = z_test(&a, &b).unwrap().unwrap();
    assert_eq!((found.tested, found.failed), (3 * (48 * 40 - 1), 1));
    assert_eq!(found.largest.1, UVec2::new(7, 1));
    assert!((found.largest.0 - 20.0).abs() < 1e-3 && (4.0..5.5).contains(&found.limit));
}

/// Values that differ by rounding alone are equal, however small their variance. Seen to fail with the variance alone.
#[test]
fn rounding_is_no_difference() {
    let mut a = image(SIZE, Encoding::Linear, |_, _| [1.0, 100.0, 1e-4]);
    let mut b = image(SIZE, Encoding::Linear, |_, _| [1.0, 100.0, 1e-4].map(f32::next_up));
    for image in [&mut a, &mut b] {
        let variance = |pixel: &Spectrum| *pixel * *pixel * 1e-20;
        image.variance = Some(image.pixels.iter().map(variance).collect());
    }
    let found = z_test(&a, &b).unwrap().unwrap();
    assert_eq!((found.tested, found.failed), (3 * 48 * 40, 0), "{found:?}");
}

/// Quantiles at probabilities of 0.5, 0.05, 1e-3, 1e-6 and 1e-12 on both sides, by mpmath 1.3 with 40 digits. Seen to fail
/// with a term of the continued fraction left out, and with the series of the factor cut off after its first term.
#[test]
fn quantiles_of_student_t_are_those_of_tables() {
    let table = [
        (1.0, [1.0, 12.706204736175, 636.61924876872, 636619.77236706, 636619772367.58]),
        (
            2.0,
            [0.81649658092773, 4.3026527297495, 31.599054576444, 999.99924999984, 999999.99999925],
        ),
        (
            3.0,
            [0.76489232840435, 3.1824463052837, 12.923978636687, 130.15458955836, 13016.38079988],
        ),
        (
            4.0,
            [0.74069708411268, 2.7764451051978, 8.6103015813793, 49.458636756935, 1565.0835151679],
        ),
        (
            5.5,
            [0.72168655636997, 2.5018586175892, 6.3508175000836, 23.470130979896, 290.5911194148],
        ),
        (
            10.0,
            [0.69981206131243, 2.2281388519863, 4.5868938587026, 10.516489956915, 43.456904513888],
        ),
        (
            30.0,
            [0.68275569332129, 2.0422724563012, 3.645958635042, 6.1190756203842, 11.722008426304],
        ),
        (
            127.3,
            [0.67642187134399, 1.9787746816674, 3.3685969380478, 5.1416567337308, 7.9236774898606],
        ),
        (
            1000.0,
            [0.67473516460701, 1.9623390808264, 3.3002826484239, 4.9222895234296, 7.2239545867942],
        ),
        (
            f64::INFINITY,
            [0.67448975019608, 1.9599639845401, 3.2905267314919, 4.8916384756986, 7.1305068481713],
        ),
    ];
    let (_, normal) = table[table.len() - 1];
    for (degrees_of_freedom, quantiles) in table {
        let student = StudentT { degrees_of_freedom };
        for (index, probability) in [0.5, 0.05, 1e-3, 1e-6, 1e-12].into_iter().enumerate() {
            let found = student.two_sided_quantile(probability);
            let expected = quantiles[index];
            let what = format!("{degrees_of_freedom} degrees of freedom, p = {probability:e}");
            assert!((found / expected - 1.0).abs() < 1e-9, "{what}: {found}, expected {expected}");
            let z = student.normal_deviate(expected);
            assert!(
                (z / normal[index] - 1.0).abs() < 1e-9,
                "{what}: z = {z}, not {}",
                normal[index]
            );
        }
    }
}

/// Where the approximation takes over from the exact way, and at the ends of the range. Seen to fail without
/// Newton's steps.
#[test]
fn normal_deviates_are_smooth_and_finite() {
    for t in [1e-3, 0.7, 2.0, 5.0, 9.0] {
        let z = |degrees_of_freedom| StudentT { degrees_of_freedom }.normal_deviate(t);
        assert!(
            (z(0.999_999e5) - z(1.000_001e5)).abs() < 1e-9 * t,
            "{t}: {} {}",
            z(0.999e5),
            z(1.001e5)
        );
        assert!(z(1.0) < z(2.0) && z(2.0) < z(50.0) && z(50.0) < t, "{t}");
    }
    for degrees_of_freedom in [1.0, 1.7, 6.0, 1e3, 1e6, f64::INFINITY] {
        let student = StudentT { degrees_of_freedom };
        assert_eq!(student.normal_deviate(0.0), 0.0);
        for t in [1e-12, 1.0, 1e6, 1e15, 1e30] {
            let z = student.normal_deviate(t);
            assert!(
                z.is_finite() && z > 0.0 && z <= t * (1.0 + 1e-9),
                "{degrees_of_freedom}, {t}: {z}"
            );
        }
    }
}

/// Two pictures of one scene, whose variances come from four sets, with normal noise of any size: none of 30,000 bands fails
/// at significance 0.01. With unknown degrees of freedom some sixty do.
#[test]
fn few_sets_are_no_difference() {
    let mut state = 1_u64;
    let mut uniform = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    };
    let mut normal = || (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
    let mut band = |size: f64| {
        let sets = [0; 4].map(|_| 1.0 + size * normal());
        let mean = sets.iter().sum::<f64>() / 4.0;
        (mean as f32, (sets.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 12.0) as f32)
    };
    let mut noisy = || {
        let bands: Vec<_> =
            (0..100 * 100).map(|i| [0; 3].map(|_| band(0.01 + (i % 7) as f64))).collect();
        Image {
            size: UVec2::splat(100),
            pixels: bands.iter().map(|pixel| pixel.map(|(mean, _)| mean).into()).collect(),
            variance: Some(
                bands.iter().map(|pixel| pixel.map(|(_, variance)| variance).into()).collect(),
            ),
            degrees_of_freedom: Some(3),
            encoding: Encoding::Linear,
        }
    };
    let (a, b) = (noisy(), noisy());
    let found = z_test(&a, &b).unwrap().unwrap();
    assert_eq!((found.tested, found.failed), (30_000, 0), "{found:?}");
    // Welch and Satterthwaite's degrees of freedom are an approximation, a little on the safe side.
    assert!((0.9..1.02).contains(&found.mean_square), "{found:?}");
    let unknown = |image: &Image| Image { degrees_of_freedom: None, ..image.clone() };
    assert!(z_test(&unknown(&a), &unknown(&b)).unwrap().unwrap().failed > 30);
    // Against known values, each value has its three degrees of freedom, and 95 % lie in their interval, within five
    // standard errors.
    let truth = Image { pixels: vec![Spectrum::WHITE; 10_000], variance: None, ..a.clone() };
    let found = z_test(&a, &truth).unwrap().unwrap();
    assert!((found.mean_square - 1.0).abs() < 5.0 * (2.0_f64 / 30_000.0).sqrt(), "{found:?}");
    assert_eq!(found.failed, 0);
    let widths = half_widths(&a).unwrap();
    let covered = widths.iter().zip(&a.pixels).flat_map(|(width, pixel)| {
        width.to_array().into_iter().zip(pixel.to_array()).map(|(w, x)| (x - 1.0).abs() <= w)
    });
    let share = covered.filter(|covered| *covered).count() as f64 / 30_000.0;
    assert!((share - 0.95).abs() < 5.0 * (0.95_f64 * 0.05 / 30_000.0).sqrt(), "{share}");
    assert_eq!(half_widths(&truth), None);
}

/// Zero is dark, the ends of the scale differ from the middle, and one pixel in a thousand does not set the scale.
#[test]
fn maps_show_where_images_differ() {
    let size = UVec2::new(100, 100);
    let b = image(size, Encoding::Linear, |_, _| [0.5; 3]);
    let mut a = b.clone();
    a.pixels[..5000].fill(Spectrum::splat(0.7));
    a.pixels[5000..6000].fill(Spectrum::splat(0.3));
    a.pixels[9999] = Spectrum::splat(1000.0);
    let map = ErrorMap::signed(&a, &b).unwrap();
    assert!((map.limit - 0.2).abs() < 1e-6, "{}", map.limit);
    let codes = map.codes();
    let pixel = |place: usize| [codes[3 * place], codes[3 * place + 1], codes[3 * place + 2]];
    let [red, blue, same] = [pixel(0), pixel(5500), pixel(7000)];
    assert!(red[0] > 2 * red[2] && blue[2] > 2 * blue[0] && same.iter().all(|&c| c > 230));
    assert_eq!(pixel(9999), red, "beyond the scale's end");
    let absolute = ErrorMap::absolute(&a, &b).unwrap();
    assert!(absolute.values.iter().all(|&value| value >= 0.0));
    assert!(absolute.codes()[..3].iter().all(|&c| c > absolute.codes()[3 * 7000]));
    // Equal images have a scale too, and a file is as wide as its bar needs.
    let small = image(UVec2::ONE, Encoding::Linear, |_, _| [0.5; 3]);
    let map = ErrorMap::signed(&small, &small).unwrap();
    assert_eq!((map.limit, map.mean()), (1.0, 0.0));
    assert_eq!(map.png()[..4], *b"\x89PNG");
}

/// The scale of a map ends at the 99.9th percentile: of 1000 values the last but one. Seen to fail with the 99th.
#[test]
fn the_scale_of_a_map_leaves_out_a_thousandth() {
    let size = UVec2::new(40, 25);
    let image = image(size, Encoding::Linear, |x, y| [(40 * y + x) as f32; 3]);
    let black = Image { pixels: vec![Spectrum::BLACK; 1000], ..image.clone() };
    assert_eq!(ErrorMap::absolute(&image, &black).unwrap().limit, 998.0);
}

/// The last exposure is that of the median: of the brightest pixel, where half of the pixels are as bright. Seen to fail with
/// the lower quartile.
#[test]
fn exposures_end_at_the_median() {
    let size = UVec2::new(8, 8);
    let half = image(size, Encoding::Linear, |x, _| [if x < 4 { 0.25 } else { 1.0 }; 3]);
    let (_, exposures) = flip(&half, &half, Viewing::default()).unwrap();
    let exposures = exposures.unwrap();
    assert_eq!(exposures.start, exposures.stop);
    let less = image(size, Encoding::Linear, |x, _| [if x < 5 { 0.25 } else { 1.0 }; 3]);
    let (_, exposures) = flip(&less, &less, Viewing::default()).unwrap();
    let exposures = exposures.unwrap();
    assert!((exposures.stop - exposures.start - 2.0).abs() < 1e-5, "{exposures:?}");
}
