//! Renders in parts, and what is refused of them.

use std::fs;

use lobe::Spectrum;
use lobe::image::Image;

use crate::folder::{Folder, value};

const SCENE: &str = "s.toml --spp 21 --set film.crop=[2,1,19,10] --quiet";

/// Values whose difference is rounding: of a sum of 64-bit numbers in another order, to 32 bits.
fn assert_close(a: &[Spectrum], b: &[Spectrum], what: &str) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b).flat_map(|(a, b)| a.to_array().into_iter().zip(b.to_array())) {
        assert!(a == b || (a - b).abs() <= 1.2e-7 * b.abs(), "{what}: {a} {b}");
    }
}

/// 1, 2, 5 and 8 parts, in any order: the same bytes, and the picture and the variance of the one render. Seen to fail with
/// parts that leave samples out, and with the sums of sets rounded to 32 bits.
#[test]
fn parts_add_up_to_the_whole() {
    for sampler in ["independent", "sobol", "stratified"] {
        let folder = Folder::new(&format!("parts-{sampler}"));
        let scene = format!("{SCENE} --set sampler.type=\"{sampler}\" --set sampler.replicates=4");
        folder.prints(&format!("render {scene} -o whole.exr"));
        let whole = Image::read(folder.0.join("whole.exr")).unwrap();
        for count in [1, 2, 5, 8] {
            let names: Vec<_> = (1..=count).map(|k| format!("s-{k}-of-{count}.exr")).collect();
            for k in 1..=count {
                folder.prints(&format!("render {scene} --shard {k}/{count} --threads {k}"));
            }
            let summary = folder.prints(&format!("merge {} -o m.exr -o m.png", names.join(" ")));
            assert_eq!(value(&summary, "parts"), count.to_string());
            assert_eq!(value(&summary, "samples"), "21");
            let merged = Image::read(folder.0.join("m.exr")).unwrap();
            assert_close(&merged.pixels, &whole.pixels, &format!("{sampler}, {count} parts"));
            let (a, b) = (merged.variance.unwrap(), whole.variance.as_ref().unwrap());
            assert_close(&a, b, &format!("variance, {sampler}, {count} parts"));
            let bytes = fs::read(folder.0.join("m.exr")).unwrap();
            let mut others = names.clone();
            for turn in 0..count {
                others.rotate_left(1);
                if turn % 2 == 0 {
                    others.reverse();
                }
                folder.prints(&format!("merge {} -o n.exr --quiet", others.join(" ")));
                assert!(fs::read(folder.0.join("n.exr")).unwrap() == bytes, "{others:?}");
            }
        }
    }
}

/// Seen to fail with each check left out: a picture of too few samples, of some twice, or of two scenes.
#[test]
fn parts_that_do_not_fit_are_refused() {
    let folder = Folder::new("parts-refused");
    for part in ["1/3", "2/3", "3/3", "1/2"] {
        let (k, n) = part.split_once('/').unwrap();
        folder.prints(&format!("render {SCENE} --shard {part} -o {k}{n}.exr"));
    }
    folder.prints(&format!("render {SCENE} --shard 2/2 --set camera.fov=50 -o fov.exr"));
    folder.prints(&format!("render {SCENE} -o whole.exr"));
    let tail = "are in none of the parts: name all files, or render what is missing";
    let refused = |arguments: &str, message: &str| {
        folder.fails(&format!("merge {arguments} -o m.exr"), message);
    };
    refused("13.exr 33.exr", &format!("samples 7 to 13 of 0 to 20 {tail}"));
    refused("33.exr 23.exr", &format!("samples 0 to 6 of 0 to 20 {tail}"));
    refused("12.exr", &format!("samples 10 to 20 of 0 to 20 {tail}"));
    refused("12.exr 23.exr 33.exr", "`12.exr` and `23.exr` both have sample 7: leave one out");
    refused("12.exr 12.exr", "`12.exr` and `12.exr` both have sample 0: leave one out");
    refused(
        "12.exr fov.exr",
        "the parts are of different renders: camera.fov is 50 in `fov.exr` and left out in `12.exr`",
    );
    refused(
        "12.exr whole.exr",
        "cannot read `whole.exr`: it is not a complete part of a render: `lobe render --shard K/N` writes those",
    );
    let whole = fs::read(folder.0.join("13.exr")).unwrap();
    fs::write(folder.0.join("half.exr"), &whole[..whole.len() / 2]).unwrap();
    let said = folder.run("merge half.exr 23.exr 33.exr -o m.exr");
    assert_eq!(said.status.code(), Some(1));
    let said = String::from_utf8(said.stderr).unwrap();
    assert!(said.starts_with("error: cannot read `half.exr`: it is incomplete: "), "{said}");
    folder.fails(
        "merge 13.exr 23.exr 33.exr -o 13.exr",
        "cannot write `13.exr`: it is read; give another name",
    );
    folder.fails(
        "render s.toml --shard 1/2 -o a.png",
        "parts are merged from EXR files: give an output whose name ends in .exr",
    );
    folder.fails(
        "render s.toml --spp 3 --shard 1/5",
        "part 1 of 5 has none of the 3 samples: use fewer parts",
    );
}

/// Samples that were left out are those of all parts. Seen to fail with those of the last part alone.
#[test]
fn samples_left_out_are_added_up() {
    let folder = Folder::new("parts-non-finite");
    // A light so close that its radiance leaves the range of numbers.
    let scene = "s.toml --spp 8 --set integrator.type=\"path\" --set light.key.intensity=[3e38,3e38,3e38] \
                 --set light.key.position=[0,0,-0.0001]";
    let left_out = |summary: &str| value(summary, "non-finite").parse::<u64>().unwrap();
    let parts = ["1/2", "2/2"]
        .map(|part| left_out(&folder.prints(&format!("render {scene} --shard {part}"))));
    let merged = folder.prints("merge s-1-of-2.exr s-2-of-2.exr -o m.exr");
    assert!(parts.iter().all(|count| *count > 0), "{parts:?}");
    assert_eq!(left_out(&merged), parts[0] + parts[1]);
}
