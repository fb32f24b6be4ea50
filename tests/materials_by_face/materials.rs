//! What a material of an MTL file becomes, compared with the crate's own.

use std::path::Path;
use std::sync::Arc;

use lobe::Spectrum;
use lobe::bxdf::{Arena, BxdfFlags};
use lobe::geometry::BoundedPoint;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};
use lobe::material::{
    DetailedMaterial, GlassMaterial, Material, MatteMaterial, MetalMaterial, MixMaterial,
    MtlMaterials, PlasticMaterial, Roughness,
};
use lobe::shape::{MtlNote, parse_mtl};
use lobe::texture::{Channel, Curve, ImageTexture, ProductTexture, Texture, Textures};

use crate::{folder, without_folder, write, write_image};

/// f for pairs of directions, and what is drawn, bit by bit.
fn answers(material: &dyn Material, uv: Vec2) -> String {
    let mut answers = String::new();
    let partials = Partials { dpdu: Vec3::X, dpdv: Vec3::Y, ..Partials::default() };
    for wo in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.64, -0.6)] {
        let point = BoundedPoint { p: Vec3::ZERO, error: Vec3::ZERO };
        let mut si = SurfaceInteraction::new(point, uv, wo, partials);
        let arena = Arena::new();
        let bsdf = material.compute_scattering(&mut si, &arena);
        for wi in [Vec3::Z, Vec3::new(0.0, 0.8, 0.6), Vec3::new(-0.6, 0.0, 0.8), -Vec3::Z] {
            answers += &format!("{:?} ", bsdf.f(wo, wi, BxdfFlags::all()).to_array());
        }
        for uc in [0.01, 0.5, 0.99] {
            answers +=
                &format!("{:?}\n", bsdf.sample_f(wo, uc, Vec2::new(0.3, 0.7), BxdfFlags::all()));
        }
    }
    answers
}

/// The material of some lines, and the notes about it.
fn made(folder: &Path, lines: &str) -> (std::sync::Arc<dyn Material>, Vec<String>) {
    let library = parse_mtl("m.mtl", format!("newmtl x\n{lines}").as_bytes()).unwrap();
    let is_clamped = |note: &MtlNote| note.what.ends_with("what is above 1 counts as 1");
    assert!(library.notes.iter().all(is_clamped), "{lines}: {:?}", library.notes);
    let materials = MtlMaterials { folder, textures: &Textures::default() };
    let (material, notes) = materials.make(&library.materials[0]);
    (material, notes.iter().map(MtlNote::to_string).collect())
}

#[track_caller]
fn assert_made(lines: &str, expected: impl Material, notes: &[&str]) {
    let (material, found) = made(Path::new(""), lines);
    let uv = Vec2::new(0.25, 0.5);
    assert_eq!(answers(&*material, uv), answers(&expected, uv), "{lines}");
    assert_eq!(found, notes, "{lines}");
}

const KD: [f32; 3] = [0.2, 0.4, 0.6];

/// Seen to fail with `Pm` of 1/2 a metal, with models 3 and 5 matte, with black `Ks` plastic, with an index below 1 taken, and with
/// `Tf` left out.
#[test]
fn each_row_of_the_table_is_a_material() {
    let grey = Spectrum::splat(0.5);
    let kd = "Kd 0.2 0.4 0.6\n";
    let plastic = |eta| PlasticMaterial::new(KD, eta);
    let reflecting = |color: [f32; 3]| MetalMaterial::reflecting(color);
    assert_made("", MatteMaterial::new(grey), &[]);
    assert_made(kd, MatteMaterial::new(KD), &[]);
    for illum in [0, 1, 10] {
        assert_made(&format!("{kd}Ks 0.5\nNs 10\nillum {illum}"), MatteMaterial::new(KD), &[]);
    }
    assert_made(&format!("{kd}Ks 0 0 0\nillum 2"), MatteMaterial::new(KD), &[]);
    for (index, eta) in [
        ("", 1.5),
        ("Ni 1.8", 1.8),
        ("Ni 1", 1.5),
        ("Ni 0.5", 1.5),
        ("Ni -2", 1.5),
        ("Ni 10", 10.0),
        ("Ni 10.5", 1.5),
    ] {
        assert_made(&format!("{kd}Ks 0.5\n{index}"), plastic(eta), &[]);
        assert_made(&format!("{index}\nillum 2\nKs 0 0 0.01\n{kd}"), plastic(eta), &[]);
        for illum in [4, 6, 7, 9] {
            let glass = GlassMaterial::new(eta).with_kt([0.9, 0.5, 0.25]);
            assert_made(&format!("{kd}{index}\nTf 0.9 0.5 0.25\nd 0.1\nillum {illum}"), glass, &[]);
            assert_made(&format!("{index}\nillum {illum}"), GlassMaterial::new(eta), &[]);
        }
    }
    for illum in [3, 5] {
        assert_made(
            &format!("Kd 0 0 0\nKs 0.9 0.8 0.1\nillum {illum}"),
            reflecting([0.9, 0.8, 0.1]),
            &[],
        );
        assert_made(&format!("{kd}Ks 0.9\nillum {illum}"), plastic(1.5), &[]);
        assert_made(&format!("Kd 0\nKs 0\nillum {illum}"), MatteMaterial::new([0.0; 3]), &[]);
    }
    for others in ["", "illum 7", "illum 2\nKs 1", "illum 1", "illum 3\nKs 1"] {
        assert_made(&format!("{kd}Pm 0.51\n{others}"), reflecting(KD), &[]);
        assert_made(&format!("Pm 1\n{others}"), reflecting([1.0; 3]), &[]);
    }
    assert_made(&format!("{kd}Ks 0.9\nillum 8"), plastic(1.5), &[]);
    assert_made(&format!("{kd}Pm 0.5"), MatteMaterial::new(KD), &[]);
}

/// Seen to fail with `Ns` before `Pr`, and with α squared.
#[test]
fn roughness_is_pr_or_comes_from_ns() {
    let alpha = |ns: f32| Roughness::alpha((2.0 / (ns + 2.0)).sqrt());
    for (lines, roughness) in [
        ("", Roughness::smooth()),
        ("Ns 98", alpha(98.0)),
        ("Ns 0", alpha(0.0)),
        ("Ns -7", alpha(0.0)),
        ("Ns 1e30", alpha(1e30)),
        ("Pr 0.5", Roughness::perceptual(0.5)),
        ("Ns 98\nPr 0.5", Roughness::perceptual(0.5)),
        ("Pr 7", Roughness::perceptual(1.0)),
        ("Pr -1", Roughness::perceptual(0.0)),
    ] {
        assert_made(
            &format!("Kd 0.2 0.4 0.6\nKs 1\n{lines}"),
            PlasticMaterial::new(KD, 1.5).with_roughness(roughness.clone()),
            &[],
        );
        assert_made(
            &format!("illum 7\n{lines}"),
            GlassMaterial::new(1.5).with_roughness(roughness.clone()),
            &[],
        );
        assert_made(
            &format!("Kd 0.2 0.4 0.6\nPm 1\n{lines}"),
            MetalMaterial::reflecting(KD).with_roughness(roughness),
            &[],
        );
    }
}

/// Seen to fail with half of k = 2 √(r / (1 - r)), and without the clamp below 1.
#[test]
fn a_metal_reflects_its_colour_at_the_normal() {
    let colors = Spectrum::new(0.9, 0.04, 1.0);
    let (metal, arena) = (MetalMaterial::reflecting(colors), Arena::new());
    let partials = Partials { dpdu: Vec3::X, dpdv: Vec3::Y, ..Partials::default() };
    let point = BoundedPoint { p: Vec3::ZERO, error: Vec3::ZERO };
    let mut si = SurfaceInteraction::new(point, Vec2::ZERO, Vec3::Z, partials);
    let bsdf = metal.compute_scattering(&mut si, &arena);
    let sample = bsdf.sample_f(Vec3::Z, 0.5, Vec2::splat(0.5), BxdfFlags::all()).unwrap();
    let found = (sample.f * (sample.wi.z / sample.pdf)).to_array();
    for (found, expected) in found.into_iter().zip([0.9, 0.04, 0.9999]) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
}

/// π f of a matte material at a point of the texture.
fn seen(material: &dyn Material, uv: Vec2) -> [f32; 3] {
    let partials = Partials { dpdu: Vec3::X, dpdv: Vec3::Y, ..Partials::default() };
    let point = BoundedPoint { p: Vec3::ZERO, error: Vec3::ZERO };
    let (mut si, arena) = (SurfaceInteraction::new(point, uv, Vec3::Z, partials), Arena::new());
    let bsdf = material.compute_scattering(&mut si, &arena);
    (bsdf.f(Vec3::Z, Vec3::Z, BxdfFlags::all()) * std::f32::consts::PI).to_array()
}

/// Images are decoded by the sRGB curve, multiplied by Kd, placed by their options and found beside the MTL file. Seen to fail with
/// the linear curve, without `-s`, `-o` and `-clamp`, and with Kd left out.
#[test]
fn maps_are_images_by_their_options() {
    let folder = folder("materials-maps");
    // 8 bits hold these nearly: half is code 188.
    write_image(folder.join("two.png"), &[0.25, 0.5]);
    write_image(folder.join("two.pfm"), &[0.25, 0.5]);
    std::fs::create_dir(folder.join("sub dir")).unwrap();
    write_image(folder.join("sub dir/Deep.pfm"), &[0.125, 0.125]);
    let left = Vec2::new(0.25, 0.5);
    for (lines, uv, expected) in [
        ("map_Kd two.pfm", left, [0.25; 3]),
        ("map_Kd two.png", left, [0.25; 3]),
        ("map_Kd two.png", Vec2::new(0.75, 0.5), [0.5; 3]),
        ("map_Kd two.pfm", Vec2::new(1.25, 7.5), [0.25; 3]),
        ("Kd 1 0.5 0\nmap_Kd two.pfm", left, [0.25, 0.125, 0.0]),
        ("Kd 0 0 0\nmap_Kd two.pfm", left, [0.25; 3]),
        ("Kd 1 1 1\nmap_Kd two.pfm", left, [0.25; 3]),
        ("map_Kd -clamp on two.pfm", Vec2::new(1.25, 0.5), [0.5; 3]),
        ("map_Kd -s 3 two.pfm", left, [0.5; 3]),
        ("map_Kd -o 0.5 two.pfm", left, [0.5; 3]),
        ("map_Kd -s 2 1 -o 0.25 0 two.pfm", left, [0.5; 3]),
        ("map_Kd -mm 0.25 2 two.pfm", left, [0.75; 3]),
        ("Kd 0.5\nmap_Kd -mm 0.1 1 two.pfm", left, [0.175; 3]),
        ("map_Kd sub dir\\Deep.pfm", left, [0.125; 3]),
        ("map_Kd Sub Dir/deep.PFM", left, [0.125; 3]),
        ("map_Kd C:\\a\\b\\TWO.pfm", left, [0.25; 3]),
    ] {
        let (material, notes) = made(&folder, lines);
        let found = seen(&*material, uv);
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 3e-3);
        assert!(is_near, "{lines}: {found:?}, expected {expected:?}");
        assert_eq!(notes, Vec::<String>::new(), "{lines}");
    }
}

/// What cannot be used is noted, and the colour holds. Seen to fail with notes left out.
#[test]
fn images_that_cannot_be_read_are_noted() {
    let folder = folder("materials-notes");
    write(&folder, "broken.png", "no image");
    write(&folder, "broken.pfm", "P6\n2 2\n255\n");
    write(&folder, "notes.txt", "no image");
    std::fs::create_dir(folder.join("folder.png")).unwrap();
    write_image(folder.join("nan.exr"), &[0.5, f32::NAN]);
    let nan = "cannot read `nan.exr`: the pixel of column 1 and row 0, which count from 0 at the top left, \
               is [NaN, NaN, NaN], expected finite numbers of at least 0";
    let name = "cannot read `notes.txt`: its name has to end in .exr, .jpg, .jpeg, .pfm or .png";
    for (file, note) in [
        ("no such.png", "cannot read `no such.png`: there is no such file"),
        ("folder.png", "cannot read `folder.png`: it is a folder; give the name of a file in it"),
        ("notes.txt", name),
        (
            "broken.pfm",
            "cannot read `broken.pfm`: it is not a PFM file: it begins with `P6`, not PF or Pf",
        ),
        ("nan.exr", nan),
    ] {
        for (kd, color) in [("Kd 0.2 0.4 0.6", KD), ("", [0.5; 3])] {
            let (material, notes) = made(&folder, &format!("{kd}\nmap_Kd {file}"));
            assert_eq!(without_folder(&notes, &folder), [format!("line 3: map_Kd: {note}")]);
            let uv = Vec2::splat(0.3);
            assert_eq!(answers(&*material, uv), answers(&MatteMaterial::new(color), uv), "{file}");
        }
    }
    assert_eq!(made(&folder, "map_Kd broken.png").1.len(), 1);
}

/// What glass has no place for is noted. Seen to fail with the note left out.
#[test]
fn what_is_not_used_is_noted() {
    assert_made("Kd 0.2 0.4 0.6\nd 1\nTr 0", MatteMaterial::new(KD), &[]);
    let lines = "illum 7\nmap_Kd no.png\nTr 0.9";
    assert_made(lines, GlassMaterial::new(1.5), &["line 3: map_Kd of glass is not used"]);
    for key in ["map_d", "map_Pr", "map_Pm", "map_Bump", "norm"] {
        let note = format!("line 3: {key}: cannot read `no.png`: there is no such file");
        let lines = format!("Kd 0.2 0.4 0.6\n{key} no.png");
        assert_made(&lines, MatteMaterial::new(KD), &[&note]);
    }
}

/// Maps of numbers, of heights and of normals, on either half of an image. Seen to fail with the sRGB curve, with `Pr` and `-bm` left
/// out, with the ends of the mixture exchanged, and with green for blue.
#[test]
fn maps_drive_every_parameter() {
    let folder = folder("materials-numbers");
    write_image(folder.join("two.pfm"), &[0.25, 0.75]);
    let textures = Textures::default();
    let image = || {
        let texels = textures.image(&folder.join("two.pfm"), Curve::Linear).unwrap();
        ImageTexture::new(texels)
    };
    let numbers = || image().channel(Channel::Green);
    let kd = "Kd 0.2 0.4 0.6\n";
    let plastic = |roughness| PlasticMaterial::new(KD, 1.5).with_roughness(roughness);
    let metal = MetalMaterial::reflecting(KD);
    let half = ProductTexture::new(numbers(), 0.5);
    let cases: Vec<(&str, Arc<dyn Material>)> = vec![
        ("Ks 1\nmap_Pr -imfchan g two.pfm", Arc::new(plastic(Roughness::perceptual(numbers())))),
        ("Ks 1\nPr 1\nmap_Pr two.pfm", Arc::new(plastic(Roughness::perceptual(numbers())))),
        ("Ks 1\nPr 0.5\nmap_Pr two.pfm", Arc::new(plastic(Roughness::perceptual(half)))),
        (
            "Ks 1\nmap_Pm -imfchan g two.pfm",
            Arc::new(MixMaterial::new(PlasticMaterial::new(KD, 1.5), metal.clone(), numbers())),
        ),
        (
            "Pm 1\nmap_Kd two.pfm",
            Arc::new(MetalMaterial::reflecting(ProductTexture::new(image(), Spectrum::from(KD)))),
        ),
        (
            "bump -bm 2 two.pfm",
            Arc::new(
                DetailedMaterial::new(MatteMaterial::new(KD))
                    .with_bump(ProductTexture::new(numbers(), 2.0)),
            ),
        ),
        (
            "norm two.pfm",
            Arc::new(DetailedMaterial::new(MatteMaterial::new(KD)).with_normals(image())),
        ),
    ];
    for (lines, expected) in cases {
        let (material, notes) = made(&folder, &format!("{kd}{lines}"));
        assert_eq!(notes, Vec::<String>::new(), "{lines}");
        for uv in [Vec2::new(0.25, 0.5), Vec2::new(0.45, 0.5), Vec2::new(0.75, 0.5)] {
            assert_eq!(answers(&*material, uv), answers(&*expected, uv), "{lines}, {uv}");
        }
    }
    let opacity = |lines: &str, uv| {
        let (material, _) = made(&folder, lines);
        let partials = Partials { dpdu: Vec3::X, dpdv: Vec3::Y, ..Partials::default() };
        let point = BoundedPoint { p: Vec3::ZERO, error: Vec3::ZERO };
        let si = SurfaceInteraction::new(point, uv, Vec3::Z, partials);
        material.opacity().map(|opacity| opacity.evaluate(&si))
    };
    assert_eq!(opacity("map_d two.pfm", Vec2::new(0.25, 0.5)), Some(0.25));
    assert_eq!(opacity("map_d -mm 1 -1 two.pfm", Vec2::new(0.75, 0.5)), Some(0.25));
    assert_eq!(opacity("d 0.5", Vec2::ZERO), None);
}

/// `Ke` times `map_Ke`, 1 without it; black is a constant. Caught: `Ke` left out, `-mm` left out, a black `Ke` that is taken for none, and an
/// image of black pixels that is a lamp.
#[test]
fn lamps_have_their_image() {
    let folder = folder("materials-lamps");
    write_image(folder.join("two.pfm"), &[0.25, 0.75]);
    write_image(folder.join("dark.pfm"), &[0.0, 0.0]);
    let textures = Textures::default();
    let materials = MtlMaterials { folder: &folder, textures: &textures };
    let none = |line| format!("line {line}: map_Ke: cannot read `no.pfm`: there is no such file");
    let times_black = "line 3: map_Ke times a black Ke emits nothing";
    // At the centres of both pixels; `None` for the second if the emission is constant.
    for (lines, first, second, note) in [
        ("Ke 1 2 3", [1.0, 2.0, 3.0], None, None),
        ("", [0.0; 3], None, None),
        ("map_Ke two.pfm", [0.25; 3], Some([0.75; 3]), None),
        ("Ke 2 4 8\nmap_Ke two.pfm", [0.5, 1.0, 2.0], Some([1.5, 3.0, 6.0]), None),
        ("Ke 2\nmap_Ke -mm 1 2 two.pfm", [3.0; 3], Some([5.0; 3]), None),
        ("Ke 2\nmap_Ke -s 1 1 -o 0.5 0 two.pfm", [1.5; 3], Some([0.5; 3]), None),
        ("map_Ke dark.pfm", [0.0; 3], None, None),
        ("map_Ke -mm 1 1 dark.pfm", [1.0; 3], Some([1.0; 3]), None),
        ("Ke 0\nmap_Ke two.pfm", [0.0; 3], None, Some(times_black.to_owned())),
        ("Ke 2\nmap_Ke no.pfm", [2.0; 3], None, Some(none(3))),
        ("map_Ke no.pfm", [0.0; 3], None, Some(none(2))),
    ] {
        let library = parse_mtl("m.mtl", format!("newmtl x\n{lines}").as_bytes()).unwrap();
        let (found, notes) = materials.emission(&library.materials[0]);
        let point = BoundedPoint { p: Vec3::ZERO, error: Vec3::ZERO };
        let at = |u| {
            let uv = Vec2::new(u, 0.5);
            let si = SurfaceInteraction::new(point, uv, Vec3::Z, Partials::default());
            found.evaluate(&si).to_array()
        };
        assert_eq!(at(0.25), first, "{lines}");
        assert_eq!(found.constant().is_none().then(|| at(0.75)), second, "{lines}");
        let notes: Vec<_> = notes.iter().map(MtlNote::to_string).collect();
        assert_eq!(without_folder(&notes, &folder), Vec::from_iter(note), "{lines}");
    }
}
