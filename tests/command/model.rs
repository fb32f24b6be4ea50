//! OBJ files in place of scene files.

use std::fs;

use lobe::image::Image;

use crate::folder::{Folder, value};
use crate::interrupted::{end, signal, start, wait_for};

/// A red square on the left, a blue one on the right, and one of a texture above them, all facing +z.
const MODEL: &str = "\
mtllib model.mtl
v -2 0 0\nv 0 0 0\nv 0 2 0\nv -2 2 0\nv 2 0 0\nv 2 2 0\nv 0 4 0\nv -2 4 0
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
usemtl red\nf 1 2 3 4
usemtl blue\nf 2 5 6 3
usemtl wood\nf 4/1 3/2 7/3 8/4
";

const MTL: &str = "\
newmtl red\nKd 0.8 0.1 0.1
newmtl blue\nKd 0.1 0.1 0.8\nshine 3
newmtl wood\nmap_Kd wood.png\nmap_Bump wood.png
";

/// With a model, its MTL file and the image that it names.
fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.prints("render s.toml -o wood.png --quiet");
    folder.write("model.obj", MODEL);
    folder.write("model.mtl", MTL);
    folder
}

const SMALL: &str = "--set film.resolution=[40,30] --spp 4";

/// Red is on the left: not mirrored, and the MTL file was found. Seen to fail with a left-handed camera.
#[test]
fn a_model_alone_is_rendered() {
    let folder = folder("model");
    let summary = folder.prints(&format!("render model.obj {SMALL}"));
    let files =
        ["model.exr", "model.mtl", "model.obj", "model.png", "s.toml", "wall.obj", "wood.png"];
    assert_eq!(folder.files(), files);
    assert_eq!(value(&summary, "scene"), "model.obj");
    let warnings: Vec<_> = summary.lines().filter(|line| line.starts_with("warning")).collect();
    assert_eq!(warnings, ["warning     model.mtl:5: the key `shine` is not known"],);
    let image = Image::read(folder.0.join("model.exr")).unwrap();
    let pixel = |x: usize, y: usize| image.pixels[40 * y + x].to_array();
    let ([left, _, left_blue], [right_red, _, right]) = (pixel(13, 21), pixel(27, 21));
    assert!(left > 2.0 * left_blue && right > 2.0 * right_red, "{left} {right}");
}

/// The whole of what info says.
#[test]
fn info_lists_materials_and_textures() {
    let folder = folder("model-info");
    let summary = folder.prints("info model.obj");
    let (settings, rest) = summary.split_once("nodes").unwrap();
    let (scene, settings) = settings.split_once('\n').unwrap();
    let (camera, settings) = settings.split_once('\n').unwrap();
    assert_eq!(scene, "scene           model.obj");
    assert!(camera.ends_with(", 40 degrees, pinhole, right-handed"), "{camera}");
    assert_eq!(
        settings,
        "image           800x600 pixels
display         srgb
filter          box
sampler         sobol, 64 samples per pixel in 4 sets, seed 0
integrator      path, up to 16 reflections, roulette, strategy auto
lights          2
shape           model: 6 triangles
material        model/red: 2 triangles
material        model/blue: 2 triangles
material        model/wood: 2 triangles
texture         wood.png: 20x10 pixels, srgb, 0.00 MiB
texture         wood.png: 20x10 pixels, linear, 0.00 MiB
warning         model.mtl:5: the key `shine` is not known
triangles       6
bounds          [-2, 0, 0] to [2, 4, 0]
"
    );
    assert_eq!(value(rest, "texture-memory"), "0.00");
    folder.write("lamp.mtl", "newmtl red\nKe 1 2 3\nmap_Ke wood.png\n");
    folder.write("lamp.obj", &MODEL.replace("model.mtl", "lamp.mtl"));
    let summary = folder.prints("info lamp.obj");
    assert!(summary.contains("\nmaterial        model/red: 2 triangles, emitting\n"), "{summary}");
    let texture = "\ntexture         wood.png: 20x10 pixels, srgb, 0.00 MiB\n";
    assert!(summary.contains(texture), "{summary}");
}

/// The scene of a model as text: whole, and rendered it gives the same picture.
#[test]
fn the_scene_of_a_model_is_a_start() {
    let folder = folder("model-scene");
    let scene = folder.prints("info model.obj --scene --set camera.fov=50");
    // Where the camera stands depends on the platform's sine.
    let is_place = |line: &&str| line.starts_with("eye = [") || line.starts_with("look_at = [");
    assert_eq!(scene.lines().filter(is_place).count(), 2, "{scene}");
    let rest: Vec<_> = scene.lines().filter(|line| !is_place(line)).collect();
    assert_eq!(
        rest.join("\n"),
        r#"[camera]
handedness = "right"
fov = 50

[film]
resolution = [800, 600]

[sampler]
spp = 64

[integrator]
type = "path"
max_depth = 16

[light.sky]
type = "sky"
radiance = [0.6, 0.6, 0.6]

[light.key]
type = "distant"
direction = [0.55, -0.75, -0.65]
irradiance = [1.5, 1.5, 1.5]

[shape.model]
obj = "model.obj"

# Faces have these materials, of MTL files. To replace one, take away the # of its table:
#
# [material.red]
# type = "matte"
#
# [material.blue]
# type = "matte"
#
# [material.wood]
# type = "matte""#
    );
    folder.write("own.toml", &scene);
    folder.prints(&format!("render own.toml -o own.exr {SMALL}"));
    folder.prints(&format!("render model.obj -o model.exr {SMALL} --set camera.fov=50"));
    let pixels = |name: &str| Image::read(folder.0.join(name)).unwrap().pixels;
    assert_eq!(pixels("own.exr"), pixels("model.exr"));
    folder.fails("info s.toml --scene", "`s.toml` is a scene file already: --scene is for models");
}

/// Of many notes render prints the first, and info all. Seen to fail without a limit.
#[test]
fn many_notes_are_cut_short() {
    let folder = folder("model-notes");
    let keys: String = (0..23).map(|i| format!("key{i} 1\n")).collect();
    folder.write("model.mtl", &format!("newmtl red\n{keys}newmtl blue\nnewmtl wood\n"));
    let of = |summary: &str| {
        let lines = summary.lines().filter(|line| line.starts_with("warning"));
        lines.map(|line| line["warning".len()..].trim().to_owned()).collect::<Vec<_>>()
    };
    let note = |i: usize| format!("model.mtl:{}: the key `key{i}` is not known", i + 2);
    let mut expected: Vec<_> = (0..20).map(note).collect();
    expected.push("and 3 more, which lobe info shows".to_owned());
    assert_eq!(of(&folder.prints(&format!("render model.obj -o a.png {SMALL}"))), expected);
    expected.pop();
    expected.extend((20..23).map(note));
    assert_eq!(of(&folder.prints("info model.obj")), expected);
}

/// What the model refers to is not written over. Seen to fail with the files of the scene file alone.
#[test]
fn files_of_a_model_are_kept() {
    let folder = folder("model-files");
    folder.fails(
        "render model.obj -o wood.png",
        "cannot write `wood.png`: it is read; give another name",
    );
    folder.write("wood.obj", MODEL);
    folder.fails("render wood.obj", "cannot write `wood.png`: it is read; give another name");
}

/// Caught: scene files of any ending.
#[test]
fn models_that_cannot_be_rendered() {
    let folder = folder("model-refused");
    folder.fails("render no.obj", "no.obj: there is no such file");
    fs::create_dir(folder.0.join("folder.obj")).unwrap();
    folder.fails("info folder.obj", "folder.obj: is a directory, expected an OBJ file");
    folder.write("points.obj", "v 1 2 3\n");
    folder.fails(
        "render points.obj",
        "points.obj: has no faces: expected at least one line such as \"f 1 2 3\", found only 1 vertex",
    );
    folder.write("model.glb", "glTF");
    folder.fails("render model.glb", "model.glb: expected a scene file, .toml, or a model, .obj");
    folder.fails("check model.glb", "model.glb: expected a scene file, .toml, or a model, .obj");
    folder.fails("render no.glb", "no.glb: there is no such file");
    for arguments in ["render wood.png", "info wood.png --scene"] {
        folder.fails(arguments, "wood.png: expected a scene file, .toml, or a model, .obj");
    }
    folder.fails(
        "render model.obj --set shape.wall.scale=2",
        "--set shape.wall.scale=2: the scene has no shape `wall`; expected `model`; --set cannot add one: write it into the scene file",
    );
    // Without its MTL file it is grey.
    fs::remove_file(folder.0.join("model.mtl")).unwrap();
    let summary = folder.prints(&format!("render model.obj -o a.png {SMALL}"));
    let warnings: Vec<_> = summary.lines().filter(|line| line.starts_with("warning")).collect();
    assert_eq!(
        warnings,
        [
            "warning     model.mtl: there is no such file",
            "warning     shape \"model\": there is no material \"red\"; its faces are grey",
            "warning     shape \"model\": there is no material \"blue\"; its faces are grey",
            "warning     shape \"model\": there is no material \"wood\"; its faces are grey",
        ],
    );
}

/// A render of a model goes on, unless its materials are others.
#[test]
fn a_render_of_a_model_goes_on() {
    let folder = folder("model-resumed");
    let endless = "render model.obj --set film.resolution=[20,10] --spp 100000000 --resume --save-every 0.001";
    let child = start(&folder, endless);
    wait_for(&folder, "model.state");
    signal(&child, "-INT");
    assert_eq!(end(child).0.code(), Some(130));

    folder.write("model.mtl", &MTL.replace("0.8", "0.7"));
    let said = String::from_utf8(folder.run(endless).stderr).unwrap();
    let before = "error: `model.state` is of another render: material \"red\" of \"model\" is ";
    assert!(said.starts_with(before), "{said}");

    folder.write("model.mtl", MTL);
    let stored = fs::read(folder.0.join("model.state")).unwrap();
    let child = start(&folder, endless);
    while fs::read(folder.0.join("model.state")).unwrap() == stored {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    signal(&child, "-INT");
    assert_eq!(end(child).0.code(), Some(130));
}

/// The materials of MTL files are checked too, and charts are made of models.
#[test]
fn models_are_checked_and_charted() {
    let folder = folder("model-checked");
    let text = folder.prints("check model.obj --samples 8192");
    let names = text.lines().filter_map(|line| line.strip_prefix("ok")).map(str::trim);
    assert_eq!(names.collect::<Vec<_>>(), ["model/red", "model/blue", "model/wood"]);
    folder.write(
        "two.toml",
        "[methods]\none = ['sampler.type=\"sobol\"']\ntwo = ['sampler.type=\"independent\"']\n",
    );
    folder.prints(
        "chart model.obj --methods two.toml --budgets 1,2 --seeds 2 --set film.resolution=[20,10]",
    );
    assert!(folder.0.join("model-chart").join("runs.csv").exists());
}
