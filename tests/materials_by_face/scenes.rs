//! Scenes whose faces name their materials.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use lobe::bxdf::{Arena, BxdfFlags};
use lobe::geometry::Ray;
use lobe::glam::{Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::light::LightHit;
use lobe::scene::{FilmSettings, View};
use lobe::scene_file::{LoadedScene, read_scene};
use lobe::{PerspectiveSettings, RenderOptions, RenderSettings, Scene, render};

use crate::{folder, without_folder, write, write_image};

/// Five squares side by side in the plane z = 0, which face -z: square i is from x = i to i + 1.
fn squares(materials: [&str; 5]) -> String {
    let mut text = String::from("mtllib m.mtl\n");
    for i in 0..5 {
        text += &format!("v {i} 0 0\nv {i} 1 0\nv {} 1 0\nv {} 0 0\n", i + 1, i + 1);
    }
    for (i, material) in materials.iter().enumerate() {
        let v = 4 * i + 1;
        text += &format!("{material}\nf {v} {} {} {}\n", v + 1, v + 2, v + 3);
    }
    text
}

const MTL: &str =
    "newmtl red\nKd 0.75 0.25 0.125\nnewmtl mine\nKd 0.1\nnewmtl lamp\nKd 0.5\nKe 30 20 10\n";
const MATERIALS: [&str; 5] = ["", "usemtl red", "usemtl mine", "usemtl lost", "usemtl lamp"];

fn load(folder: &Path, text: &str) -> LoadedScene {
    write(folder, "s.toml", text);
    read_scene(&folder.join("s.toml"), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// π f in the middle of a square.
fn seen(scene: &Scene, square: usize) -> [f32; 3] {
    let ray = Ray::new(Vec3::new(square as f32 + 0.4, 0.3, -1.0), Vec3::Z);
    let hit = scene.accel().intersect1(&ray);
    assert!(hit.is_hit(), "square {square}");
    let (mut si, arena) = (scene.interaction(&ray, &hit), Arena::new());
    let bsdf = scene.bsdf(&hit, &mut si, &arena);
    let f = bsdf.f(-Vec3::Z, -Vec3::Z, BxdfFlags::all()).to_array();
    f.map(|f| (f64::from(f) * PI) as f32)
}

#[track_caller]
fn assert_seen(scene: &Scene, expected: [[f32; 3]; 5]) {
    for (square, expected) in expected.into_iter().enumerate() {
        let found = seen(scene, square);
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(is_near, "square {square}: {found:?}, expected {expected:?}");
    }
}

const RED: [f32; 3] = [0.75, 0.25, 0.125];

/// Of the scene file by name, else of the MTL file, else grey. Seen to fail with the scene's materials left out, with emission left
/// out, and with reports for shapes of the file alone.
#[test]
fn faces_have_the_materials_that_they_name() {
    let folder = folder("scenes-names");
    write(&folder, "m.obj", squares(MATERIALS));
    write(&folder, "m.mtl", MTL);
    let own = "[material.mine]\ntype = \"matte\"\nkd = [0, 1, 0]\n";
    let loaded = load(&folder, &format!("{own}[shape.s]\nobj = \"m.obj\"\n"));
    assert_seen(&loaded.scene, [[0.5; 3], RED, [0.0, 1.0, 0.0], [0.5; 3], [0.5; 3]]);
    assert_eq!(
        loaded.report.notes,
        [
            "shape \"s\": there is no material \"lost\"; its faces are grey",
            "shape \"s\": 2 triangles name no material and are grey",
        ]
    );
    let shapes: Vec<_> =
        loaded.scene.shapes().map(|(name, mesh)| (name, mesh.indices.len())).collect();
    assert_eq!(shapes, [("s", 8), ("s/lamp", 2)]);
    assert_eq!(loaded.report.meshes.len(), 2);

    // Without an MTL file all are grey but the scene's, and each name is noted once.
    fs::remove_file(folder.join("m.mtl")).unwrap();
    write(
        &folder,
        "m.obj",
        squares(["usemtl red", "usemtl mine", "usemtl red", "usemtl lost", "usemtl red"]),
    );
    let loaded = load(&folder, &format!("{own}[shape.s]\nobj = \"m.obj\"\n"));
    assert_seen(&loaded.scene, [[0.5; 3], [0.0, 1.0, 0.0], [0.5; 3], [0.5; 3], [0.5; 3]]);
    assert_eq!(
        without_folder(&loaded.report.notes, &folder),
        [
            "m.mtl: there is no such file",
            "shape \"s\": there is no material \"red\"; its faces are grey",
            "shape \"s\": there is no material \"lost\"; its faces are grey",
        ]
    );
    assert!(loaded.scene.lights().is_empty());
}

/// Notes of the MTL file have its name and the line of the key. Seen to fail with notes about images or keys left out.
/// Caught: the line of `newmtl`.
#[test]
fn notes_name_file_and_line() {
    let folder = folder("scenes-notes");
    write(
        &folder,
        "m.obj",
        squares(["usemtl red", "usemtl red", "usemtl lamp", "usemtl red", "usemtl red"]),
    );
    write(
        &folder,
        "m.mtl",
        format!("{MTL}shine 3\nmap_Kd no.png\nd 0.5\nnewmtl unused\nmap_Kd no.png\n"),
    );
    let loaded = load(&folder, "[shape.s]\nobj = \"m.obj\"\n");
    assert_eq!(
        without_folder(&loaded.report.notes, &folder),
        [
            "m.mtl:8: the key `shine` is not known",
            "m.mtl:9: material \"lamp\": map_Kd: cannot read `no.png`: there is no such file",
        ]
    );
}

/// A shape of the scene file may have the name that a lamp of an MTL file would get. Caught: both of one name, so that the instance was of
/// the wrong one.
#[test]
fn lamps_have_names_of_their_own() {
    let folder = folder("scenes-lamp-names");
    write(&folder, "m.obj", squares(MATERIALS));
    write(&folder, "m.mtl", MTL);
    let before = "[material.m]\ntype = \"matte\"\n[shape.\"s/lamp\"]\ntype = \"rectangle\"\nmaterial = \"m\"\ncorner = [0, 5, 0]\n\
                  edges = [[1, 0, 0], [0, 1, 0]]\n";
    let model = "[shape.s]\nobj = \"m.obj\"\n";
    for text in [format!("{before}{model}"), format!("{model}{before}")] {
        let loaded =
            load(&folder, &format!("{text}[instance.i]\nshape = \"s\"\ntranslate = [0, 0, 1]\n"));
        let mut names: Vec<_> = loaded.scene.shapes().map(|(name, _)| name).collect();
        names.sort();
        assert_eq!(names, ["i", "s", "s/lamp", "s/lamp'"]);
        assert_eq!(loaded.scene.lights().len(), 2);
        assert_eq!(loaded.scene.instances().collect::<Vec<_>>(), [("i", "s")]);
    }
}

/// Of several libraries the first with the name holds. Seen to fail with the last.
#[test]
fn the_first_library_holds() {
    let folder = folder("scenes-libraries");
    let obj =
        squares(["usemtl red"; 5]).replace("mtllib m.mtl", "mtllib no.mtl\nmtllib a/m.mtl m.mtl");
    write(&folder, "m.obj", obj);
    write(&folder, "m.mtl", MTL);
    write(&folder, "a/m.mtl", "newmtl red\nKd 1 0 0\nnewmtl red\nKd 0 0 1\n");
    let loaded = load(&folder, "[shape.s]\nobj = \"m.obj\"\n");
    assert_seen(&loaded.scene, [[1.0, 0.0, 0.0]; 5]);
    assert_eq!(
        without_folder(&loaded.report.notes, &folder),
        [
            "no.mtl: there is no such file",
            "a/m.mtl:3: material `red` stands there twice; the first one holds"
        ]
    );
}

/// A shape's own material or emission is that of all faces. Seen to fail with faces before the emission.
#[test]
fn a_shape_overrides_its_faces() {
    let folder = folder("scenes-shapes");
    write(&folder, "m.obj", squares(MATERIALS));
    write(&folder, "m.mtl", format!("{MTL}junk\n"));
    let own = "[material.own]\ntype = \"matte\"\nkd = [0, 0, 1]\n[shape.s]\nobj = \"m.obj\"\n";
    let loaded = load(&folder, &format!("{own}material = \"own\"\n"));
    assert_seen(&loaded.scene, [[0.0, 0.0, 1.0]; 5]);
    assert_eq!((loaded.report.notes.len(), loaded.scene.lights().len()), (0, 0));
    for (rest, color) in [("", 0.0), ("material = \"own\"\n", 1.0)] {
        let loaded = load(&folder, &format!("{own}{rest}emission = [1, 2, 3]\n"));
        assert_seen(&loaded.scene, [[0.0, 0.0, color]; 5]);
        assert_eq!((loaded.scene.lights().len(), loaded.scene.shapes().count()), (1, 1));
    }
}

/// Materials of the MTL file never take the place of others, whatever their names are. Seen to fail with names joined by a slash
/// alone.
#[test]
fn equal_names_are_told_apart() {
    let folder = folder("scenes-equal");
    for (name, material, kd) in
        [("a", "b/red", "1 0 0"), ("b", "red", "0 1 0"), ("c", "b", "0 0 1")]
    {
        let usemtl = format!("usemtl {material}");
        let obj = squares([&usemtl; 5]).replace("m.mtl", &format!("{name}.mtl"));
        write(&folder, &format!("{name}.obj"), obj);
        write(&folder, &format!("{name}.mtl"), format!("newmtl {material}\nKd {kd}\n"));
    }
    let shape = |name: &str, obj: &str, y: i32| {
        format!("[shape.{name:?}]\nobj = \"{obj}.obj\"\ntranslate = [0, {y}, 0]\n")
    };
    let text = format!(
        "[material.\"x/b/red\"]\ntype = \"matte\"\nkd = [1, 1, 1]\n{}{}{}[shape.w]\nobj = \"c.obj\"\nmaterial = \"x/b/red\"\ntranslate = [0, 3, 0]\n",
        shape("x", "a", 0),
        shape("x/b", "b", 1),
        shape("z", "c", 2)
    );
    let scene = load(&folder, &text).scene;
    for (row, expected) in
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]].into_iter().enumerate()
    {
        let ray = Ray::new(Vec3::new(0.4, row as f32 + 0.3, -1.0), Vec3::Z);
        let hit = scene.accel().intersect1(&ray);
        let (mut si, arena) = (scene.interaction(&ray, &hit), Arena::new());
        let f =
            scene.bsdf(&hit, &mut si, &arena).f(-Vec3::Z, -Vec3::Z, BxdfFlags::all()).to_array();
        let found = f.map(|f| (f64::from(f) * PI).round());
        assert_eq!(found, expected, "row {row}");
    }
}

/// A shape without any material lacks one.
#[test]
fn a_shape_without_materials_is_refused() {
    let folder = folder("scenes-none");
    write(&folder, "m.obj", squares([""; 5]));
    write(&folder, "s.toml", "[shape.s]\nobj = \"m.obj\"\n");
    let error = read_scene(&folder.join("s.toml"), &[]).err().unwrap().to_string();
    let expected = "s.toml:1:1: [shape.s] lacks `material`, expected the name of a material, or `emission`, or an OBJ file whose faces name materials";
    assert_eq!(without_folder(&[error], &folder), [expected]);
}

/// Faces with `Ke` are lamps on both sides, and scatter light as their material says: a ray sees Ke, and a point in front of a
/// small lamp has the irradiance Ke A cos θ cos θ' / d². Seen to fail with one side dark, and with the scene's material left out.
#[test]
fn faces_with_ke_are_lamps() {
    let folder = folder("scenes-lamps");
    write(&folder, "m.obj", squares(MATERIALS));
    write(&folder, "m.mtl", MTL);
    let scene = load(
        &folder,
        "[material.lamp]\ntype = \"matte\"\nkd = [0, 1, 0]\n[shape.s]\nobj = \"m.obj\"\n",
    )
    .scene;
    // The scene's own material of that name reflects; the emission stays.
    assert_seen(&scene, [[0.5; 3], RED, [0.1; 3], [0.5; 3], [0.0, 1.0, 0.0]]);
    let [lamp] = scene.lights() else { panic!("{} lights", scene.lights().len()) };
    for side in [-1.0, 1.0] {
        let p = Vec3::new(4.5, 0.5, 400.0 * side);
        let sample = lamp.sample_li(p, Vec2::new(0.3, 0.6)).unwrap();
        assert_eq!(sample.li.to_array(), [30.0, 20.0, 10.0]);
        let irradiance = sample.li.to_array()[0] * sample.wi.z.abs() / sample.pdf;
        assert!((irradiance / (30.0 / 160_000.0) - 1.0).abs() < 1e-4, "{irradiance}");
    }
    for (z, square, expected) in
        [(-3.0, 4.5, [30.0, 20.0, 10.0]), (3.0, 4.5, [30.0, 20.0, 10.0]), (-3.0, 1.5, [0.0; 3])]
    {
        let camera = PerspectiveSettings {
            eye: Vec3::new(square, 0.5, z),
            look_at: Vec3::new(square, 0.5, 0.0),
            fov: 5.0,
            ..PerspectiveSettings::default()
        };
        let view = View::perspective(&camera, FilmSettings::new(4, 4)).unwrap();
        let settings = RenderSettings::new(Default::default(), PathIntegrator::new(3));
        let picture = render(&scene, &view, &settings, &RenderOptions::default()).unwrap().picture;
        for pixel in picture.color {
            let is_near =
                pixel.to_array().iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-5 * b);
            assert!(is_near, "{z} {square}: {pixel:?}");
        }
    }
}

/// Faces with `map_Ke` emit Ke times the image, seen by rays and by points that sample them; other faces of the file do not. Caught: texture
/// coordinates left out of the lamp's mesh, and `Ke` left out.
#[test]
fn faces_with_an_image_of_ke_are_lamps() {
    let folder = folder("scenes-map-ke");
    let corners = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 5\nv 0 1 5\nv 1 1 5\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\n";
    let faces = "usemtl red\nf 5 6 7\nusemtl lamp\nf 1/1 2/2 3/3 4/4\n";
    write(&folder, "m.obj", format!("mtllib m.mtl\n{corners}{faces}"));
    write(&folder, "m.mtl", MTL.replace("Ke 30 20 10", "Ke 30 20 10\nmap_Ke two.pfm"));
    write_image(folder.join("two.pfm"), &[0.25, 0.5]);
    let loaded = load(&folder, "[shape.s]\nobj = \"m.obj\"\ntwo_sided = true\n");
    assert_eq!(loaded.report.notes, Vec::<String>::new());
    let [image] = &loaded.report.images[..] else { panic!("{:?}", loaded.report.images) };
    assert!(image.file.ends_with("two.pfm"));
    let scene = loaded.scene;
    let [lamp] = scene.lights() else { panic!("{} lights", scene.lights().len()) };
    for (x, shade) in [(0.25, 0.25), (0.75, 0.5)] {
        let origin = Vec3::new(x, 0.4, -1.0);
        let ray = Ray::new(origin, Vec3::Z);
        let hit = scene.accel().intersect1(&ray);
        let si = scene.interaction(&ray, &hit);
        let le = lamp.le(&LightHit::on_surface(origin, &si)).to_array();
        for (found, ke) in le.into_iter().zip([30.0, 20.0, 10.0]) {
            assert!((found / (ke * shade) - 1.0).abs() < 1e-5, "{x}: {le:?}");
        }
    }
    for i in 0..100 {
        let u = Vec2::new((i % 10) as f32 + 0.5, (i / 10) as f32 + 0.5) / 10.0;
        let sample = lamp.sample_li(Vec3::new(0.5, 0.5, -2.0), u).unwrap();
        // Straight between the centres of pixels, and again beyond the edges.
        let x = sample.from.unwrap().x;
        let from_edge = (x - 0.5).abs().min(0.25) / 0.5;
        let shade = if x < 0.5 { 0.375 - 0.25 * from_edge } else { 0.375 + 0.25 * from_edge };
        if (0.25..0.75).contains(&x) {
            let red = sample.li.to_array()[0];
            assert!((red / (30.0 * shade) - 1.0).abs() < 1e-4, "{x}: {red}");
        }
    }
    // 0.375 is the mean.
    let power = lamp.power(&Default::default()).unwrap().to_array()[0];
    assert!((f64::from(power) / (2.0 * PI * 30.0 * 0.375) - 1.0).abs() < 1e-3, "{power}");
}

/// Lamps alone, and lamps whose MTL names them last or first. Seen to fail with a shape of no triangles for what does not glow.
#[test]
fn all_faces_may_be_lamps() {
    let folder = folder("scenes-all-lamps");
    write(&folder, "m.obj", squares(["usemtl lamp"; 5]));
    write(&folder, "m.mtl", MTL.replace("Ke 30 20 10", "Ke 0 0 1\nfoo"));
    let loaded = load(&folder, "[shape.s]\nobj = \"m.obj\"\n");
    let shapes: Vec<_> =
        loaded.scene.shapes().map(|(name, mesh)| (name, mesh.indices.len())).collect();
    assert_eq!((&shapes[..], loaded.report.meshes.len()), (&[("s/lamp", 10)][..], 1));
    // Black is no emission.
    write(&folder, "m.mtl", MTL.replace("Ke 30 20 10", "Ke 0 0 0"));
    assert!(load(&folder, "[shape.s]\nobj = \"m.obj\"\n").scene.lights().is_empty());
}

/// Lamps of MTL files emit on both sides, or on one if the shape says so. Seen to fail with `two_sided` left out.
#[test]
fn lamps_of_faces_emit_where_they_are_asked_to() {
    let folder = folder("scenes-two-sided");
    write(&folder, "m.obj", squares(["usemtl lamp"; 5]));
    write(&folder, "m.mtl", MTL);
    let power = |more: &str| {
        let loaded = load(&folder, &format!("[shape.s]\nobj = \"m.obj\"\n{more}"));
        let power = loaded.scene.lights()[0].power(&Default::default());
        power.unwrap().to_array()[0]
    };
    assert_eq!(power(""), power("two_sided = true\n"));
    assert_eq!(power(""), 2.0 * power("two_sided = false\n"));
}
