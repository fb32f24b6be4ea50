//! Products and mixtures, and images that textures share.

use std::path::PathBuf;
use std::sync::Arc;

use lobe::Spectrum;
use lobe::glam::{UVec2, Vec2};
use lobe::image::ReadError;
use lobe::image::{Picture, write_pfm};
use lobe::interaction::SurfaceInteraction;
use lobe::texture::{Curve, MixTexture, ProductTexture, Texture, TextureHandle, Textures};

use super::{RED, at, folders};

/// Of constants they are constants, stored in place; of others they are what the formula says. Seen to fail with one factor alone,
/// with the ends of a mixture exchanged, and with a constant that is not told or is that of one end.
#[test]
fn products_and_mixtures_of_constants_are_constants() {
    let u = |si: &SurfaceInteraction| si.uv().x;
    let grey = |si: &SurfaceInteraction| Spectrum::splat(si.uv().x);
    let si = at(Vec2::new(0.25, 0.5));
    let number: TextureHandle<f32> = ProductTexture::new(3.0, 0.5).into_handle();
    assert!(matches!(number, TextureHandle::Constant(1.5)));
    let number = MixTexture::new(1.0, 5.0, 0.25).into_handle();
    assert!(matches!(number, TextureHandle::Constant(2.0)));
    let nested = ProductTexture::new(MixTexture::new(RED, Spectrum::BLACK, 0.5), [2.0; 3]);
    assert_eq!(nested.clone().into_handle().constant(), Some(RED));

    for (texture, expected) in [
        (ProductTexture::new(u, 3.0).into_handle(), 0.75),
        (ProductTexture::new(3.0, u).into_handle(), 0.75),
        (MixTexture::new(u, 1.0, 0.5).into_handle(), 0.625),
        (MixTexture::new(1.0, u, 0.5).into_handle(), 0.625),
        (MixTexture::new(2.0, 4.0, u).into_handle(), 2.5),
    ] {
        assert_eq!((texture.constant(), texture.evaluate(&si)), (None, expected));
    }
    for texture in [ProductTexture::new(grey, RED), ProductTexture::new(RED, grey)] {
        assert_eq!((texture.constant(), texture.evaluate(&si)), (None, RED * 0.25));
    }
}

fn file(name: &str, values: &[f32]) -> PathBuf {
    let folder = folders::of_this_run();
    let pixels: Vec<_> = values.iter().map(|&value| Spectrum::new(0.5, value, 1.0)).collect();
    let picture = Picture::new(UVec2::new(2, values.len() as u32 / 2), pixels);
    write_pfm(folder.join(name), &picture).unwrap();
    folder.join(name)
}

/// An image is decoded once for each curve, by whatever path. Seen to fail with paths as they are written, and with the curve left
/// out of the key.
#[test]
fn images_are_shared() {
    let a = file("a.pfm", &[0.25, 0.5]);
    let folder = a.parent().unwrap();
    let roundabout = folder.join("..").join(folder.file_name().unwrap()).join("./a.pfm");
    let textures = Textures::default();
    let first = textures.image(&a, Curve::Srgb).unwrap();
    assert!(Arc::ptr_eq(&first, &textures.image(&a, Curve::Srgb).unwrap()));
    assert!(Arc::ptr_eq(&first, &textures.image(&roundabout, Curve::Srgb).unwrap()));
    assert!(Arc::ptr_eq(&first, &textures.clone().image(&a, Curve::Srgb).unwrap()));
    assert!(!Arc::ptr_eq(&first, &textures.image(&a, Curve::Linear).unwrap()));
    let images = textures.images();
    assert_eq!(
        images.iter().map(|(_, curve, _)| *curve).collect::<Vec<_>>(),
        [Curve::Srgb, Curve::Linear]
    );
    assert!(images.iter().all(|(_, _, texels)| texels.bytes() == 192));
    assert!(Textures::default().images().is_empty());
}

/// Values that no texture can have are an error with their place. Seen to fail without the check, with infinity taken, and with
/// rows and columns exchanged.
#[test]
fn values_that_are_no_texture_are_refused() {
    for (bad, shown) in
        [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (f32::NEG_INFINITY, "-inf"), (-1e-45, "-1e-45")]
    {
        let path = file("bad.pfm", &[0.0, -0.0, f32::MAX, 1.0, 1.0, bad]);
        let expected = format!(
            "cannot read `{}`: the pixel of column 1 and row 2, which count from 0 at the top left, is \
             [0.5, {shown}, 1.0], expected finite numbers of at least 0",
            path.display()
        );
        let textures = Textures::default();
        for curve in [Curve::Srgb, Curve::Linear] {
            assert_eq!(textures.image(&path, curve).err().unwrap().to_string(), expected);
        }
        assert!(textures.images().is_empty());
    }
    assert!(Textures::default().image(&file("good.pfm", &[-0.0, f32::MAX]), Curve::Srgb).is_ok());
}

/// An image that cannot be used is not decoded for each texture that names it: the first failure stays. Caught: only images that can be used kept.
#[test]
fn failures_are_shared() {
    let bad = file("bad.pfm", &[0.5, -1.0]);
    let textures = Textures::default();
    let first = textures.image(&bad, Curve::Linear).err().unwrap();
    assert_eq!(file("bad.pfm", &[0.5, 1.0]), bad);
    let again = textures.image(&bad, Curve::Linear).err().unwrap();
    assert!(Arc::ptr_eq(&first, &again), "{again}");
    assert!(textures.images().is_empty());
    assert!(Textures::default().image(&bad, Curve::Linear).is_ok());
}

/// What is made of an image counts beside the image. Caught: the image alone; half of the pixels' bytes.
#[test]
fn lookups_count_in_the_limit() {
    let large = file("large.pfm", &vec![0.5; 1 << 16]);
    // 16 bytes a pixel as it is decoded, 12 for lookups.
    let needed = 28 << 16;
    assert!(Textures::default().with_limit(needed).image(&large, Curve::Linear).is_ok());
    let refused = Textures::default().with_limit(needed - 1).image(&large, Curve::Linear);
    let error = refused.err().unwrap();
    assert!(matches!(*error, ReadError::AboveLimit { .. }), "{error:?}");
    let expected = "2 x 32768 pixels take 2 MiB of memory, above the limit of 1 MiB";
    assert_eq!(error.to_string(), format!("cannot read `{}`: {expected}", large.display()));
}
