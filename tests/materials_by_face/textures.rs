//! Textures of scene files: what they are, and whole messages of wrong ones.

use std::path::Path;

use lobe::Spectrum;
use lobe::bxdf::{Arena, BxdfFlags};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::scene_file::parse_scene;

use crate::{folder, write, write_image};

/// A wall of x and y from 0 to 1 with these textures, of which `kd` is seen.
fn scene(folder: &Path, textures: &str) -> Result<lobe::scene_file::LoadedScene, String> {
    let text = format!(
        "{textures}\n[material.m]\ntype = \"matte\"\nkd = \"kd\"\n[shape.wall]\ntype = \"rectangle\"\n\
         corner = [0, 0, 0]\nedges = [[1, 0, 0], [0, 1, 0]]\nmaterial = \"m\"\n"
    );
    parse_scene(&folder.join("s.toml"), &text, &[]).map_err(|error| {
        error.to_string().replace(&format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR), "")
    })
}

/// π f at a point of the wall.
fn seen(folder: &Path, textures: &str, x: f32, y: f32) -> Spectrum {
    let scene = scene(folder, textures).unwrap_or_else(|error| panic!("{error}\n{textures}")).scene;
    let ray = Ray::new(Vec3::new(x, y, -1.0), Vec3::Z);
    let hit = scene.accel().intersect1(&ray);
    assert!(hit.is_hit());
    let (mut si, arena) = (scene.interaction(&ray, &hit), Arena::new());
    let bsdf = scene.bsdf(&hit, &mut si, &arena);
    bsdf.f(-Vec3::Z, -Vec3::Z, BxdfFlags::all()) * std::f32::consts::PI
}

#[track_caller]
fn assert_seen(folder: &Path, textures: &str, at: [f32; 2], expected: [f32; 3]) {
    let found = seen(folder, textures, at[0], at[1]).to_array();
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 3e-3);
    assert!(is_near, "{textures}: {found:?}, expected {expected:?}");
}

/// Seen to fail with the curve 2.4, with scale or offset out of order, with the rotation or the turn reversed, and with another
/// mirror.
#[test]
fn image_textures_have_keys() {
    let folder = folder("textures-keys");
    write_image(folder.join("two.pfm"), &[0.25, 0.5]);
    write_image(folder.join("two.png"), &[0.25, 0.5]);
    // 188 of 255, which the sRGB curve makes of 0.5.
    let code = 188.0_f32 / 255.0;
    let with = |file: &str, rest: &str| {
        format!("[texture.kd]\ntype = \"image\"\nfile = \"{file}\"\n{rest}\n")
    };
    let planar = "projection = \"planar\"";
    for (file, rest, at, expected) in [
        ("two.png", "", [0.75, 0.5], 0.5),
        ("two.png", "curve = \"srgb\"", [0.75, 0.5], 0.5),
        ("two.png", "curve = \"linear\"", [0.75, 0.5], code),
        ("two.png", "curve = \"gamma-2.2\"", [0.75, 0.5], code.powf(2.2)),
        ("two.pfm", "curve = \"srgb\"", [0.75, 0.5], 0.5),
        ("two.pfm", "", [0.5, 0.5], 0.375),
        ("two.pfm", "magnification = \"nearest\"", [0.49, 0.5], 0.25),
        ("two.pfm", "", [0.01, 0.5], 0.37),
        ("two.pfm", "wrap = \"clamp\"", [0.01, 0.5], 0.25),
        ("two.pfm", "wrap = \"mirror\"\noffset = [1, 0]", [0.25, 0.5], 0.5),
        ("two.pfm", "offset = [0.5, 0]", [0.25, 0.5], 0.5),
        ("two.pfm", "scale = [3, 1]", [0.25, 0.5], 0.5),
        ("two.pfm", "rotate = 90", [0.5, 0.75], 0.25),
        // (0.25, 0.5) -> (0.5, 0.5) -> (-0.5, 0.5) -> (0.25, 0.5).
        ("two.pfm", "scale = [2, 1]\nrotate = 90\noffset = [0.75, 0]", [0.25, 0.5], 0.25),
        ("two.pfm", planar, [0.75, 0.5], 0.5),
        ("two.pfm", "projection = \"planar\"\ncenter = [0.5, 0, 0]", [0.75, 0.5], 0.25),
        ("two.pfm", "projection = \"planar\"\nturn = [0, 0, 1, 90]", [0.5, 0.75], 0.5),
        ("two.pfm", "projection = \"cylindrical\"\ncenter = [0.5, 0.5, 0]", [0.5, 0.75], 0.25),
        ("two.pfm", "projection = \"spherical\"\ncenter = [0.5, 0.5, 0]", [0.5, 0.25], 0.5),
        ("two.pfm", "projection = \"triplanar\"", [0.75, 0.5], 0.5),
    ] {
        assert_seen(&folder, &with(file, rest), at, [expected; 3]);
    }
    // Paths are relative to the scene.
    std::fs::create_dir(folder.join("deep")).unwrap();
    std::fs::copy(folder.join("two.pfm"), folder.join("deep/other.PFM")).unwrap();
    assert_seen(&folder, &with("deep/other.PFM", ""), [0.25, 0.5], [0.25; 3]);
}

/// Numbers and colours in all pairs; numbers are greys beside colours and where a colour is expected. Seen to fail with pairs of colours
/// alone, with one factor, with ends exchanged, and with constants that are not folded.
/// Caught: greys of three times the number; greys refused.
#[test]
fn products_and_mixtures_are_of_numbers_or_colours() {
    let folder = folder("textures-pairs");
    write_image(folder.join("two.pfm"), &[0.25, 0.5]);
    let image = "[texture.i]\ntype = \"image\"\nfile = \"two.pfm\"\n[texture.n]\ntype = \"image\"\nfile = \"two.pfm\"\nvalues = \"red\"\n\
                 [texture.c]\ntype = \"constant\"\nvalue = [0.5, 1, 0]\n[texture.h]\ntype = \"constant\"\nvalue = 0.5\n";
    for (rest, expected) in [
        ("type = \"product\"\na = \"i\"\nb = 2", [0.5; 3]),
        ("type = \"product\"\na = 2\nb = \"i\"", [0.5; 3]),
        ("type = \"product\"\na = \"i\"\nb = [1, 2, 4]", [0.25, 0.5, 1.0]),
        ("type = \"product\"\na = \"n\"\nb = 3", [0.75; 3]),
        ("type = \"image\"\nfile = \"two.pfm\"\nvalues = \"red\"", [0.25; 3]),
        ("type = \"constant\"\nvalue = 0.75", [0.75; 3]),
        ("type = \"product\"\na = \"c\"\nb = \"n\"", [0.125, 0.25, 0.0]),
        ("type = \"product\"\na = \"c\"\nb = \"h\"", [0.25, 0.5, 0.0]),
        ("type = \"mix\"\nfirst = \"i\"\nsecond = \"c\"", [0.375, 0.625, 0.125]),
        ("type = \"mix\"\nfirst = \"c\"\nsecond = 1\namount = \"n\"", [0.625, 1.0, 0.25]),
        ("type = \"mix\"\nfirst = [1, 0, 0]\nsecond = [0, 1, 0]\namount = 0.25", [0.75, 0.25, 0.0]),
    ] {
        assert_seen(&folder, &format!("{image}[texture.kd]\n{rest}\n"), [0.25, 0.5], expected);
    }
    // Of constants alone they are constants, which ranges hold for.
    let out_of_range = format!("{image}[texture.kd]\ntype = \"product\"\na = \"c\"\nb = 3\n");
    assert_eq!(
        scene(&folder, &out_of_range).err().unwrap(),
        "s.toml:21:6: `material.m.kd` is the texture \"kd\", [1.5, 3, 0], expected [red, green, blue], each from 0 to 1"
    );
    // Ranges hold for greys, too.
    let out_of_range = format!("{image}[texture.kd]\ntype = \"product\"\na = \"h\"\nb = 3\n");
    assert_eq!(
        scene(&folder, &out_of_range).err().unwrap(),
        "s.toml:21:6: `material.m.kd` is the texture \"kd\", 1.5, expected [red, green, blue], each from 0 to 1"
    );
}

/// Seen to fail with a key of textures that expects no names.
#[test]
fn wrong_textures_are_refused() {
    let folder = folder("textures-refused");
    write_image(folder.join("good.pfm"), &[0.25, 0.5]);
    write_image(folder.join("minus.exr"), &[0.25, -0.5]);
    write(&folder, "broken.pfm", "P6\n2 2\n255\n");
    write(&folder, "notes.txt", "no image");
    std::fs::create_dir(folder.join("folder.png")).unwrap();
    let numbers = "expected an array of 2, each a finite number";
    let mut wrong: Vec<(String, String)> = Vec::new();
    for (rest, message) in [
        ("type = \"image\"", "1:1: [texture.kd] lacks `file`, expected a text in quotes"),
        (
            "type = \"picture\"",
            "2:8: `texture.kd.type` is \"picture\", expected \"constant\", \"image\", \"checkerboard\", \"product\" or \"mix\"",
        ),
        ("type = \"image\"\nfile = 3", "3:8: `texture.kd.file` is 3, expected a text in quotes"),
        ("type = \"image\"\nfile = \"no.png\"", "3:8: cannot read `no.png`: there is no such file"),
        (
            "type = \"image\"\nfile = \"folder.png\"",
            "3:8: cannot read `folder.png`: it is a folder; give the name of a file in it",
        ),
        (
            "type = \"image\"\nfile = \"notes.txt\"",
            "3:8: cannot read `notes.txt`: its name has to end in .exr, .jpg, .jpeg, .pfm or .png",
        ),
        (
            "type = \"image\"\nfile = \"broken.pfm\"",
            "3:8: cannot read `broken.pfm`: it is not a PFM file: it begins with `P6`, not PF or Pf",
        ),
        (
            "type = \"image\"\nfile = \"minus.exr\"",
            "3:8: cannot read `minus.exr`: the pixel of column 1 and row 0, which count from 0 at the top left, is [-0.5, -0.5, -0.5], expected finite numbers of at least 0",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nwarp = 1",
            "4:1: unknown key `warp` in [texture.kd] of type \"image\"; did you mean `wrap`?",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nwrap = \"tile\"",
            "4:8: `texture.kd.wrap` is \"tile\", expected \"repeat\", \"mirror\" or \"clamp\"",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nvalues = \"alpha\"",
            "4:10: `texture.kd.values` is \"alpha\", expected \"rgb\", \"red\", \"green\", \"blue\" or \"luminance\"",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\ncurve = 2.2",
            "4:9: `texture.kd.curve` is 2.2, expected \"srgb\", \"gamma-2.2\" or \"linear\"",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nmagnification = true",
            "4:17: `texture.kd.magnification` is true, expected \"bilinear\" or \"nearest\"",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nprojection = \"cube\"",
            "4:14: `texture.kd.projection` is \"cube\", expected \"uv\", \"planar\", \"cylindrical\", \"spherical\" or \"triplanar\"",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\ncenter = [0, 0]",
            "4:10: `texture.kd.center` is [0, 0], expected [x, y, z], all finite",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nturn = [0, 0, 0, 9]",
            "4:8: `texture.kd.turn` is [0, 0, 0, 9], expected [x, y, z, degrees], an axis that is not 0 and an angle, all finite",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nscale = 2",
            &format!("4:9: `texture.kd.scale` is 2, {numbers}"),
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\nrotate = inf",
            "4:10: `texture.kd.rotate` is inf, expected degrees, finite",
        ),
        (
            "type = \"image\"\nfile = \"good.pfm\"\noffset = [0, nan]",
            &format!("4:10: `texture.kd.offset` is [0, nan], {numbers}"),
        ),
        (
            "type = \"product\"\na = 1",
            "1:1: [texture.kd] lacks `b`, expected a number or [red, green, blue], all finite",
        ),
        ("type = \"product\"\na = 1\nb = \"t\"", "4:5: the scene has no texture `t`"),
        (
            "type = \"product\"\na = true\nb = 1",
            "3:5: `texture.kd.a` is true, expected a texture's name or a number or [red, green, blue], all finite",
        ),
        (
            "type = \"product\"\na = [1, 2]\nb = 1",
            "3:5: `texture.kd.a` is [1, 2], expected a number or [red, green, blue], all finite",
        ),
        (
            "type = \"mix\"\nfirst = 1\nsecond = 0\namount = 1.5",
            "5:10: `texture.kd.amount` is 1.5, expected a number from 0 to 1",
        ),
        (
            "type = \"mix\"\nfirst = 1\nsecond = 0\namount = [0, 0, 0]",
            "5:10: `texture.kd.amount` is [0, 0, 0], expected a number from 0 to 1",
        ),
    ] {
        let found = scene(&folder, &format!("[texture.kd]\n{rest}")).err();
        let found = found.unwrap_or_else(|| format!("accepted: {rest}"));
        let expected = format!("s.toml:{message}");
        if found != expected {
            wrong.push((found, expected));
        }
    }
    assert_eq!(wrong, []);
    // A colour where a number is needed, and a texture below the one that names it.
    let colors = "[texture.i]\ntype = \"image\"\nfile = \"good.pfm\"\n[texture.kd]\ntype = \"mix\"\nfirst = 1\nsecond = 0\namount = ";
    assert_eq!(
        scene(&folder, &format!("{colors}\"i\"")).err().unwrap(),
        "s.toml:8:10: `texture.kd.amount` is the texture \"i\", of colours, expected a number from 0 to 1; an image has numbers with `values = \"luminance\"` in its table"
    );
    let later = "[texture.kd]\ntype = \"product\"\na = \"z\"\nb = 1\n[texture.z]\ntype = \"constant\"\nvalue = 1\n";
    assert_eq!(scene(&folder, later).err().unwrap(), "s.toml:3:5: the scene has no texture `z`");
    let of_itself = later.replace("\"z\"", "\"kd\"");
    assert_eq!(
        scene(&folder, &of_itself).err().unwrap(),
        "s.toml:3:5: the scene has no texture `kd`"
    );
}
