//! The scene of a model: framing, handedness, overrides, and whole error messages.

use std::path::{Path, PathBuf};

use lobe::PerspectiveSettings;
use lobe::camera::{Handedness, PerspectiveCamera};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::scene_file::{LoadedScene, parse_scene, read_scene, read_settings};

use crate::folders;
use crate::projection::project;
use crate::rng::Rng;

/// An arrow of three triangles that points to +x, thick at +y, with its front towards +z.
const ARROW: &str = "v -2 0 0\nv 1 0 0\nv 1 0.2 0\nv -2 0.2 0\nv 1 -0.5 0\nv 2 0 0\nv 1 1 0.1\n\
                     f 1 2 3 4\nf 5 6 7\n";

fn file(name: &str, text: &str) -> PathBuf {
    let path = folders::of_this_run().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// Numbers of the camera, from the scene's text.
fn camera(loaded: &LoadedScene) -> (PerspectiveSettings, UVec2) {
    let text = loaded.to_toml();
    let numbers = |key: &str| {
        let line = text.lines().find(|line| line.starts_with(&format!("{key} = "))).unwrap();
        let numbers = line.split_once('=').unwrap().1.trim().trim_matches(['[', ']']).to_owned();
        numbers.split(", ").map(|x| x.parse().unwrap()).collect::<Vec<f32>>()
    };
    let settings = PerspectiveSettings {
        eye: Vec3::from_slice(&numbers("eye")),
        look_at: Vec3::from_slice(&numbers("look_at")),
        handedness: Handedness::Right,
        fov: numbers("fov")[0],
        ..PerspectiveSettings::default()
    };
    (settings, loaded.view.film().resolution)
}

/// Where the vertices of the scene are in the image.
fn seen(loaded: &LoadedScene) -> Vec<[f64; 2]> {
    let (settings, resolution) = camera(loaded);
    let points = loaded.scene.shapes().flat_map(|(_, mesh)| &mesh.positions);
    points.map(|&p| project(&settings, resolution, p).unwrap().to_array()).collect()
}

fn assert_framed(loaded: &LoadedScene, what: &str) {
    let all = seen(loaded);
    let most = all.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!((0.89..0.901).contains(&most), "{what}: {most}, {all:?}");
}

/// The front is seen from the right and above, and right is right: in the picture of a left-handed camera the arrow would point to
/// the left: seen to fail with one.
#[test]
fn models_are_seen_from_the_front_and_not_mirrored() {
    let loaded = read_scene(&file("arrow.obj", ARROW), &[]).unwrap();
    assert_framed(&loaded, "the arrow");
    let (settings, resolution) = camera(&loaded);
    assert_eq!(resolution, UVec2::new(800, 600));
    let at = |p: Vec3| project(&settings, resolution, p).unwrap();
    // Tip against tail, top against bottom, and what is near is larger.
    assert!(at(Vec3::X * 2.0).x > at(Vec3::X * -2.0).x + 1.0);
    assert!(at(Vec3::new(1.0, 1.0, 0.1)).y > at(Vec3::new(1.0, -0.5, 0.0)).y + 0.3);
    assert!(settings.eye.x > 0.0 && settings.eye.y > 0.0 && settings.eye.z > 0.0);

    // The camera of the scene sees the tip there.
    let own = loaded.view.camera();
    let film = (at(Vec3::X * 2.0).as_vec2() * Vec2::new(0.5, -0.5) + 0.5) * resolution.as_vec2();
    let ray = own.generate_ray(film.as_uvec2(), film.fract(), Vec2::ZERO);
    assert!((Vec3::X * 2.0 - ray.o).normalize().dot(ray.d) > 1.0 - 1e-6);
    assert_eq!(
        own.describe(),
        PerspectiveCamera::new(&settings, resolution)
            .map(|c| lobe::camera::Camera::describe(&c))
            .unwrap()
    );
}

/// Flat things are seen from higher above. Seen to fail with one elevation for all.
#[test]
fn carpets_are_seen_from_above() {
    let elevation = |name: &str, text: &str| {
        let loaded = read_scene(&file(name, text), &[]).unwrap();
        assert_framed(&loaded, name);
        let (PerspectiveSettings { eye, look_at, .. }, _) = camera(&loaded);
        (eye - look_at).normalize().y.asin().to_degrees()
    };
    let carpet = "v -2 0 -1\nv 2 0 -1\nv 2 0.1 1\nv -2 0.1 1\nf 1 2 3 4\n";
    let wall = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nf 1 2 3 4\n";
    assert!((elevation("carpet.obj", carpet) - 50.0).abs() < 0.1);
    assert!((elevation("wall.obj", wall) - 20.0).abs() < 0.1);
}

/// The camera follows what overrides do to the shape and the film. Seen to fail with the mesh before its transform.
#[test]
fn all_is_seen_whatever_shape_and_film_are() {
    let path = file("followed.obj", ARROW);
    for trial in 0..50 {
        let rng = &mut Rng::new(74, trial);
        let scale = 10.0_f32.powf(rng.within(-6.0, 6.0));
        let [x, y, z] = rng.direction().to_array();
        let (move_by, degrees) = ((rng.direction() * scale).to_array(), rng.within(0.0, 360.0));
        let side = |rng: &mut Rng| 200 + rng.below(200);
        let set = [
            format!("shape.model.scale={scale}"),
            format!("shape.model.rotate=[{x},{y},{z},{degrees}]"),
            format!("shape.model.translate={move_by:?}"),
            format!("film.resolution=[{},{}]", side(rng), side(rng)),
        ];
        let set: Vec<&str> = set.iter().map(String::as_str).collect();
        assert_framed(&read_scene(&path, &set).unwrap(), &format!("trial {trial}: {set:?}"));
    }
}

/// What an override says holds, and the rest stays.
#[test]
fn overrides_hold() {
    let path = file("overridden.obj", ARROW);
    let plain = read_scene(&path, &[]).unwrap();
    let (own, _) = camera(&plain);
    let zoomed = read_scene(&path, &["camera.fov=20"]).unwrap();
    assert_eq!(camera(&zoomed).0, PerspectiveSettings { fov: 20.0, ..own });
    let moved = read_scene(&path, &["camera.eye=[0,0,9]"]).unwrap();
    assert_eq!(camera(&moved).0, PerspectiveSettings { eye: Vec3::Z * 9.0, ..own });
    // A table replaces the whole camera.
    let replaced = read_scene(&path, &["camera={eye=[0,0,9]}"]).unwrap();
    assert_eq!(replaced.view.camera().describe(), "[0, 0, 9] to [0, 0, 1], 90 degrees, pinhole");
    let other = read_scene(&path, &["camera={type=\"orthographic\",eye=[0,0,9]}"]).unwrap();
    assert!(other.view.camera().describe().contains("to [0, 0, 1]"));

    let settings =
        read_settings(&path, &["sampler.spp=7", "integrator={type=\"direct\"}"]).unwrap();
    assert_eq!(
        (settings.sampler.spp, settings.integrator.describe()),
        (
            7,
            read_scene(&path, &["integrator.type=\"direct\"", "integrator={type=\"direct\"}"])
                .unwrap()
                .settings
                .integrator
                .describe()
        )
    );

    // Another mesh in its place.
    let carpet = file("other.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n");
    let set = format!("shape.model.obj={:?}", carpet.to_str().unwrap());
    let loaded = read_scene(&path, &[&set]).unwrap();
    assert_eq!(loaded.scene.accel().triangle_count(), 1);
    assert_framed(&loaded, "another mesh");
    let rectangle =
        "shape.model={type=\"rectangle\",material=\"grey\",corner=[0,0,0],edges=[[4,0,0],[0,2,0]]}";
    let loaded = read_scene(&path, &[rectangle]).unwrap();
    assert_eq!(loaded.scene.accel().triangle_count(), 2);
    assert_framed(&loaded, "a rectangle");
    assert_eq!(read_scene(&path, &["shape={}"]).unwrap().scene.shapes().count(), 0);
}

/// The text of the scene is a scene file that gives the same scene.
#[test]
fn the_scene_as_text_is_the_same_scene() {
    let path = file("text.obj", ARROW);
    let set = ["camera.fov=50", "shape.model.rotate=[1,0,0,-90]"];
    let loaded = read_scene(&path, &set).unwrap();
    let text = loaded.to_toml();
    let again = parse_scene("text.toml".as_ref(), &text, &[]).unwrap();
    assert_eq!(again.identity(), loaded.identity());
    assert_eq!(again.to_toml(), text);
}

/// Materials that faces name are replaced by overrides, and the model gets one of a new name; no other material is added. The text of
/// the scene names those of the MTL file that are left. Caught: all materials of overrides dropped; any name taken; the grey material of a
/// model that has others.
#[test]
fn materials_of_mtl_files_are_replaced() {
    let faces = "mtllib faces.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nusemtl dark blue\nf 1 2 4\n";
    file("faces.mtl", "newmtl red\nKd 1 0 0\nnewmtl dark blue\nKd 0 0 1\n");
    let path = file("faces.obj", faces);
    let names = |loaded: &LoadedScene| {
        loaded.materials().map(|(name, _)| name.to_owned()).collect::<Vec<_>>()
    };
    let loaded = read_scene(&path, &[]).unwrap();
    assert_eq!(names(&loaded), ["model/red", "model/dark blue"]);
    let comments = "\n# Faces have these materials, of MTL files. To replace one, take away the # of its table:\n#\n";
    let blue = "# [material.\"dark blue\"]\n# type = \"matte\"\n";
    let red = "# [material.red]\n# type = \"matte\"\n#\n";
    let text = loaded.to_toml();
    assert!(text.ends_with(&format!("{comments}{red}{blue}")), "{text}");
    // As it is told.
    let replaced = text.replace("# [", "[").replace("# t", "t");
    let replaced = parse_scene("faces.toml".as_ref(), &replaced, &[]).unwrap();
    assert_eq!(names(&replaced), ["red", "dark blue"]);

    let loaded =
        read_scene(&path, &["material.red={type=\"mirror\"}", "material.red.kr=[0,1,0]"]).unwrap();
    assert_eq!(names(&loaded), ["red", "model/dark blue"]);
    let text = loaded.to_toml();
    assert!(text.contains("\n[material.red]\ntype = \"mirror\"\nkr = [0, 1, 0]\n"), "{text}");
    assert!(text.ends_with(&format!("{comments}{blue}")), "{text}");

    let gold = ["shape.model.material=\"gold\"", "material.gold={type=\"metal\"}"];
    assert_eq!(names(&read_scene(&path, &gold).unwrap()), ["grey", "gold"]);
    for (set, message) in [
        ("material.rde={type=\"mirror\"}", "the scene has no material `rde`; did you mean `red`?"),
        (
            "material.gold={type=\"metal\"}",
            "the scene has no material `gold`; expected `red` or `dark blue`; --set cannot add one: write it into the scene file",
        ),
        (
            "material.grey.kd=[1,1,1]",
            "the scene has no material `grey`; expected `red` or `dark blue`; --set cannot add one: write it into the scene file",
        ),
    ] {
        let found = read_scene(&path, &[set]).err().unwrap().to_string();
        assert_eq!(found, format!("--set {set}: {message}"));
    }
}

#[test]
fn models_that_cannot_be_read() {
    let refused = |path: &Path, set: &[&str]| read_scene(path, set).err().unwrap().to_string();
    assert_eq!(refused("no such.obj".as_ref(), &[]), "no such.obj: there is no such file");
    let folder = folders::of_this_run().join("folder.obj");
    std::fs::create_dir_all(&folder).unwrap();
    let name = folder.display();
    assert_eq!(refused(&folder, &[]), format!("{name}: is a directory, expected an OBJ file"));
    let empty = file("empty.OBJ", "v 1 2 3\n");
    let name = empty.display();
    assert_eq!(
        refused(&empty, &[]),
        format!(
            "{name}: has no faces: expected at least one line such as \"f 1 2 3\", found only 1 vertex"
        )
    );
    let glb = file("model.glb", "glTF");
    let name = glb.display();
    let expected = format!("{name}: expected a scene file, .toml, or a model, .obj");
    assert_eq!(refused(&glb, &[]), expected);
    assert_eq!(refused("no such.glb".as_ref(), &[]), "no such.glb: there is no such file");

    let arrow = file("refused.obj", ARROW);
    let name = arrow.display();
    let cases = [
        ("shape.arrow.scale=2", "--set shape.arrow.scale=2: the scene has no shape `arrow`; expected `model`; --set cannot add one: write it into the scene file".to_owned()),
        ("camera.fvo=2", "--set camera.fvo=2: unknown key `fvo` in [camera]; did you mean `fov`?".to_owned()),
        ("shape.model.material=\"clay\"", "--set shape.model.material=\"clay\": the scene has no material `clay`; expected `grey`".to_owned()),
        ("material.red={type=\"mirror\"}", "--set material.red={type=\"mirror\"}: the scene has no material `red`; expected `grey`; --set cannot add one: write it into the scene file".to_owned()),
        ("shape.model.obj=\"none.obj\"", "--set shape.model.obj=\"none.obj\": none.obj: there is no such file".to_owned()),
        ("shape.model.scale=1e30", format!("scene of {name}: shape \"model\": vertex 0 is at [-2000000000000000000000000000000, 0, 0], expected finite coordinates up to 1e12")),
        ("camera.type=\"orthographic\"", format!("scene of {name}: unknown key `fov` in [camera] of type \"orthographic\"; expected `type`, `eye`, `look_at`, `up`, `handedness`, `extent`, `lens_radius` or `focal_distance`")),
    ];
    for (set, message) in cases {
        assert_eq!(refused(&arrow, &[set]), message);
    }

    // A model with materials has no grey one that an override could set. Caught: the override left out with it.
    let painted = file("painted.obj", &format!("usemtl paint\n{ARROW}"));
    for set in ["material.grey.nonsense=1", "material.grey.kd=[1,0,0]", "material.grey={}"] {
        let message = refused(&painted, &[set]);
        let expected = format!("--set {set}: the scene has no material `grey`; expected `paint`");
        assert!(message.starts_with(&expected), "{message}");
    }
    assert!(read_scene(&painted, &["material={}", "camera.fov=30"]).is_ok());
    let key = refused(&arrow, &["material.grey.nonsense=1"]);
    assert!(key.contains("unknown key `nonsense` in [material.grey]"), "{key}");
}

/// A name that is no UTF-8 is a file all the same.
#[cfg(unix)]
#[test]
fn names_need_not_be_text() {
    use std::os::unix::ffi::OsStrExt;
    let path = folders::of_this_run().join(std::ffi::OsStr::from_bytes(b"m\xf6del.obj"));
    std::fs::write(&path, ARROW).unwrap();
    assert_framed(&read_scene(&path, &[]).unwrap(), "the arrow");
}
