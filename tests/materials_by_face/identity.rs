//! What tells scenes with materials by face apart, so that no render goes on with other materials.

use std::fs;
use std::path::Path;

use lobe::scene_file::read_scene;

use crate::{folder, write, write_image};

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nf 1 2 4\n";
const MTL: &str = "newmtl a\nKd 0.5\nmap_Kd wood.png\nnewmtl b\nKd 0.25\n";
const SCENE: &str = "[texture.t]\ntype = \"image\"\nfile = \"t.pfm\"\n[shape.s]\nobj = \"m.obj\"\n";

fn scene(folder: &Path) {
    write(folder, "m.obj", OBJ);
    write(folder, "m.mtl", MTL);
    write(folder, "s.toml", SCENE);
    write_image(folder.join("wood.png"), &[0.25, 0.5]);
    write_image(folder.join("t.pfm"), &[0.25, 0.5]);
}

fn identity(folder: &Path) -> Vec<String> {
    read_scene(&folder.join("s.toml"), &[]).unwrap().identity()
}

/// Lines that are in one alone.
fn changed(before: &[String], after: &[String]) -> Vec<String> {
    let key = |line: &String| line.split_once(" = ").unwrap().0.to_owned();
    let new = after.iter().filter(|line| !before.contains(line)).map(key);
    let gone = before.iter().filter(|line| !after.contains(line)).map(key);
    let mut keys: Vec<_> = new.chain(gone).collect();
    keys.sort();
    keys.dedup();
    keys
}

/// Seen to fail with images left out, with codes or values left out of their checksums, with paths of images, and with the lines of
/// the MTL file counted.
#[test]
fn an_identity_has_materials_and_images() {
    let folder = folder("identity");
    scene(&folder);
    let whole = identity(&folder);
    assert_eq!(whole, identity(&folder));
    let check = |name: &str, contents: &str, keys: &[&str]| {
        let before = fs::read(folder.join(name)).unwrap();
        write(&folder, name, contents);
        assert_eq!(changed(&whole, &identity(&folder)), keys, "{name}: {contents}");
        write(&folder, name, before);
    };
    check("m.mtl", &MTL.replace("Kd 0.25", "Kd 0.26"), &["material \"b\" of \"s\""]);
    check("m.mtl", &MTL.replace("Kd 0.5", "Kd 0.5\nPr 0.1"), &["material \"a\" of \"s\""]);
    check("m.mtl", &MTL.replace("map_Kd", "map_Kd -s 2"), &["material \"a\" of \"s\""]);
    check("m.mtl", &MTL.replace("newmtl b", "newmtl c"), &["material \"b\" of \"s\""]);
    check(
        "m.mtl",
        &MTL.replace("wood", "no"),
        &["image \"wood.png\" as Srgb", "material \"a\" of \"s\""],
    );
    // Comments, unknown keys and materials of no face change nothing.
    check(
        "m.mtl",
        &format!("# more\n{}newmtl c\nKd 1\n", MTL.replace("newmtl a", "newmtl a\nKa 1")),
        &[],
    );
    let swapped = OBJ
        .replace("usemtl a", "usemtl x")
        .replace("usemtl b", "usemtl a")
        .replace("usemtl x", "usemtl b");
    // The same indices, of other names.
    check("m.obj", &swapped, &["materials of triangles of \"s\""]);
    let second_of_a = OBJ.replace("usemtl b\nf 1 3 4\n", "f 1 3 4\nusemtl b\n");
    check("m.obj", &second_of_a, &["materials of triangles of \"s\""]);
    let all_of_b = OBJ.replace("usemtl a\n", "").replace("f 1 2 3\n", "usemtl b\nf 1 2 3\n");
    check(
        "m.obj",
        &all_of_b,
        &[
            "image \"wood.png\" as Srgb",
            "material \"a\" of \"s\"",
            "materials of triangles of \"s\"",
        ],
    );

    for (name, values, key) in [
        ("wood.png", [0.25, 0.75], "image \"wood.png\" as Srgb"),
        ("t.pfm", [0.5, 0.25], "image \"t.pfm\" as Srgb"),
    ] {
        write_image(folder.join(name), &values);
        assert_eq!(changed(&whole, &identity(&folder)), [key]);
        write_image(folder.join(name), &[0.25, 0.5]);
    }
    assert_eq!(whole, identity(&folder));
    fs::remove_file(folder.join("wood.png")).unwrap();
    assert_eq!(changed(&whole, &identity(&folder)), ["image \"wood.png\" as Srgb"]);
}

/// The same in another folder, so that parts of a render can be merged. Seen to fail with paths of images.
#[test]
fn an_identity_holds_in_any_folder() {
    let folders = [folder("identity-here"), folder("identity-there").join("deep")];
    let [here, there] = folders.map(|folder| {
        fs::create_dir_all(&folder).unwrap();
        scene(&folder);
        identity(&folder)
    });
    assert_eq!(here, there);
}

/// What is read is told, so that no output replaces it. Seen to fail with images or MTL files left out.
#[test]
fn a_scene_tells_all_of_its_files() {
    let folder = folder("identity-files");
    scene(&folder);
    let files = read_scene(&folder.join("s.toml"), &[]).unwrap().files();
    let files: Vec<_> = files.iter().map(|file| fs::canonicalize(file).unwrap()).collect();
    for name in ["m.obj", "m.mtl", "wood.png", "t.pfm"] {
        assert!(files.contains(&fs::canonicalize(folder.join(name)).unwrap()), "{name}: {files:?}");
    }
}

/// Another image of the sky is another scene. Seen to fail with files of lights left out.
#[test]
fn an_identity_has_images_of_lights() {
    let folder = folder("identity-lights");
    scene(&folder);
    let file = folder.join("s.toml");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text + "[light.sky]\ntype = \"environment\"\nfile = \"sky.pfm\"\n").unwrap();
    write_image(folder.join("sky.pfm"), &[0.25, 0.5]);
    let before = identity(&folder);
    write_image(folder.join("sky.pfm"), &[0.25, 0.75]);
    assert_eq!(changed(&before, &identity(&folder)), ["file \"sky.pfm\""]);
}

/// Another image of a lamp is another scene, and so is a lamp of another texture. Caught: images of `map_Ke` that are read past the scene's textures.
#[test]
fn an_identity_has_images_of_lamps() {
    let folder = folder("identity-lamps");
    scene(&folder);
    write(&folder, "m.mtl", format!("{MTL}Ke 2\nmap_Ke glow.pfm\n"));
    let lamp = "[shape.lamp]\ntype = \"rectangle\"\ncorner = [0, 0, 3]\nedges = [[1, 0, 0], [0, 1, 0]]\nemission = \"t\"\n";
    write(&folder, "s.toml", format!("{SCENE}{lamp}"));
    write_image(folder.join("glow.pfm"), &[0.25, 0.5]);
    let before = identity(&folder);
    for name in ["glow.pfm", "t.pfm"] {
        write_image(folder.join(name), &[0.25, 0.75]);
        assert_eq!(changed(&before, &identity(&folder)), [format!("image \"{name}\" as Srgb")]);
        write_image(folder.join(name), &[0.25, 0.5]);
    }
    write(&folder, "s.toml", format!("{SCENE}{}", lamp.replace("\"t\"", "[1, 1, 1]")));
    assert_eq!(changed(&before, &identity(&folder)), ["shape.lamp.emission"]);
}
