//! Instances of shapes: pictures, scene files, and what is copied. Rays are in `foundations/rays/instances.rs`.

mod scenes;

use lobe::geometry::Ray;
use lobe::glam::{Affine3A, Quat, UVec2, Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::material::{DetailedMaterial, GlassMaterial, PlasticMaterial, Roughness};
use lobe::scene::{Emission, SceneBuilder, SceneError};
use lobe::scene_file::parse_scene;
use lobe::texture::{CheckerboardTexture, ConstantTexture};
use lobe::{MatteMaterial, RenderOptions, Scene, Spectrum, TriangleMesh, render};
use scenes::{ball, chapter_view, floor, independent, lumpy_ball};

/// Several materials, textures and bumps among them, on meshes with and without normals and texture coordinates.
fn shapes() -> Vec<(&'static str, TriangleMesh, &'static str)> {
    let small = |mut mesh: TriangleMesh| {
        mesh.transform(&Affine3A::from_scale(Vec3::splat(0.4)));
        mesh
    };
    let smooth = |mesh: TriangleMesh| {
        let normals = mesh.positions.iter().map(|p| p.normalize_or_zero()).collect();
        TriangleMesh { normals, ..small(mesh) }
    };
    let mapped = |mesh: TriangleMesh| {
        let uvs = mesh.positions.iter().map(|p| 7.0 * Vec2::new(p.x + p.z, p.y)).collect();
        TriangleMesh { uvs, ..mesh }
    };
    vec![
        ("lump", mapped(smooth(lumpy_ball(10))), "board"),
        ("glass", small(ball(8)), "glass"),
        ("coat", mapped(small(ball(6))), "coat"),
        ("bare", smooth(lumpy_ball(6)), "bumpy"),
    ]
}

fn places() -> Vec<Affine3A> {
    let at = |x, y, z| Affine3A::from_translation(Vec3::new(x, y, z));
    let turn = Affine3A::from_quat(Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), 1.1));
    vec![
        at(-1.5, -0.3, 0.5),
        at(0.9, 0.2, -0.4) * turn * Affine3A::from_scale(Vec3::new(1.0, 0.5, 1.6)),
        at(0.0, 1.0, 1.0) * Affine3A::from_scale(Vec3::new(-1.2, 1.0, 1.0)) * turn,
    ]
}

fn builder() -> SceneBuilder {
    let board = CheckerboardTexture::new(
        ConstantTexture::new(Spectrum::new(0.8, 0.2, 0.1)),
        ConstantTexture::new(Spectrum::splat(0.7)),
    );
    let bumps = CheckerboardTexture::new(ConstantTexture::new(0.0), ConstantTexture::new(0.05));
    let grey = || MatteMaterial::new([0.5; 3]);
    Scene::builder()
        .material("board", MatteMaterial::new(board))
        .material("glass", GlassMaterial::new(1.5))
        .material(
            "coat",
            PlasticMaterial::new(Spectrum::new(0.1, 0.4, 0.6), 1.5)
                .with_roughness(Roughness::alpha(0.2)),
        )
        .material("bumpy", DetailedMaterial::new(grey()).with_bump(bumps))
        .material("grey", grey())
        .shape("floor", floor(-1.0, 6.0), "grey")
        .light(SkyLight::new(Spectrum::splat(1.0)))
}

fn picture(builder: SceneBuilder) -> Vec<[u32; 3]> {
    let settings = independent(4, PathIntegrator::default());
    let options = RenderOptions { layers: true, ..RenderOptions::default() };
    let view = chapter_view(UVec2::splat(64));
    let picture = render(&builder.build().unwrap(), &view, &settings, &options).unwrap().picture;
    let layers = picture.layers.unwrap();
    let normals = layers.normal.iter().map(|n| n.to_array());
    let colors = picture.color.iter().map(|c| c.to_array());
    colors.chain(normals).map(|bands| bands.map(f32::to_bits)).collect()
}

/// A picture with instances is that with copies, to the bit. Caught: normals that are not transformed; texture coordinates in the
/// mesh's order on a mirrored instance; geometry of a block from where the mesh stands; a material of another shape.
#[test]
fn pictures_of_instances_are_those_of_copies() {
    let with_shapes = |copies: bool| {
        let mut builder = builder();
        for (name, mesh, material) in shapes() {
            builder = builder.shape(name, mesh, material);
        }
        for (name, mesh, material) in shapes() {
            for (i, place) in places().into_iter().enumerate() {
                let name_of_it = format!("{name} {i}");
                // Apart from each other.
                let place = Affine3A::from_translation(0.3 * name.len() as f32 * Vec3::X) * place;
                builder = if copies {
                    let mut copy = mesh.clone();
                    copy.transform(&place);
                    builder.shape(name_of_it, copy, material)
                } else {
                    builder.instance(name_of_it, name, place)
                };
            }
        }
        builder
    };
    let (instances, copies) = (picture(with_shapes(false)), picture(with_shapes(true)));
    let different = instances.iter().zip(&copies).filter(|(a, b)| a != b).count();
    assert_eq!(different, 0, "of {} values", copies.len());
}

/// Lamps and what is flattened become shapes of their own. Caught: a lamp's instance that does not shine.
#[test]
fn lamps_and_flat_instances_are_copied() {
    let lamp = TriangleMesh::parallelogram(Vec3::Y, Vec3::X, Vec3::Z);
    let emission = Emission { radiance: Spectrum::splat(2.0), two_sided: true };
    let scene = builder()
        .shape("ball", ball(6), "grey")
        .lamp("lamp", lamp, emission)
        .instance("lamp 2", "lamp", Affine3A::from_translation(Vec3::Y))
        .instance("ball 2", "ball", Affine3A::from_translation(Vec3::Y))
        .instance("shadow", "ball", Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)))
        .build()
        .unwrap();
    assert_eq!(scene.lights().len(), 3);
    let names: Vec<_> = scene.shapes().map(|(name, _)| name).collect();
    assert_eq!(names, ["floor", "ball", "lamp", "lamp 2", "shadow"]);
    assert_eq!(scene.instances().collect::<Vec<_>>(), [("ball 2", "ball")]);
    assert_eq!(scene.copies().collect::<Vec<_>>(), [("lamp 2", "lamp"), ("shadow", "ball")]);
}

/// A hit tells its shape, and the instance if it is on one. Caught: an instance that is taken for the shape of its own index.
#[test]
fn hits_tell_shape_and_instance() {
    let at = |x: f32| Affine3A::from_translation(Vec3::X * x);
    let scene = builder()
        .shape("ball", ball(6), "grey")
        .instance("ball 2", "ball", at(10.0))
        .instance("floor 2", "floor", at(100.0))
        .build()
        .unwrap();
    let shapes: Vec<_> = scene.shapes().map(|(name, _)| name).collect();
    let instances: Vec<_> = scene.instances().map(|(name, _)| name).collect();
    for (x, shape, instance) in
        [(0.0, "ball", None), (10.0, "ball", Some("ball 2")), (100.0, "floor", Some("floor 2"))]
    {
        let ray = Ray::new(Vec3::new(x, 9.0, 0.1), -Vec3::Y);
        let hit = scene.accel().intersect1(&ray);
        let place = scene.interaction(&ray, &hit).place().unwrap();
        let found = scene.shape_of(place.shape).unwrap();
        assert_eq!((shapes[found.shape], found.instance.map(|i| instances[i])), (shape, instance));
        assert_eq!(scene.shape_of(hit.shape), Some(found));
    }
    assert_eq!(scene.shape_of(lobe::accel::Hit::MISS.shape), None);
    assert_eq!(scene.shape_of(4), None);
}

/// What is copied is counted before it is: no memory is taken for more triangles than a scene can have, nor for vertices that no triangle has.
///
/// Caught: triangles of copies that are not counted; copies with all vertices of their mesh. Copies made before they are counted take all memory.
#[test]
fn copies_are_counted_before_they_are_made() {
    let mut lamp = lumpy_ball(150);
    let (triangles, emission) =
        (lamp.indices.len(), Emission { radiance: Spectrum::WHITE, two_sided: false });
    let count = lobe::accel::Accel::MAX_TRIANGLES / triangles + 1;
    let scene = Scene::builder().lamp("lamp", lamp.clone(), emission);
    let scene = (0..count)
        .fold(scene, |scene, i| scene.instance(i.to_string(), "lamp", Affine3A::IDENTITY));
    match scene.build().err() {
        Some(SceneError::TooManyTriangles(found)) => assert_eq!(found, (count + 1) * triangles),
        other => panic!("{other:?}"),
    }

    lamp.indices.truncate(1);
    let scene = Scene::builder().lamp("lamp", lamp, emission);
    let scene = scene.instance("copy", "lamp", Affine3A::IDENTITY).build().unwrap();
    let (_, copy) = scene.shapes().nth(1).unwrap();
    assert_eq!(
        (copy.positions.len(), copy.corners(0)),
        (3, scene.shapes().next().unwrap().1.corners(0))
    );
}

/// What cannot be an instance.
#[test]
fn bad_instances_are_refused() {
    let refused = |shape: &str, transform: Affine3A| match builder()
        .instance("i", shape, transform)
        .build()
    {
        Err(error @ SceneError::Instance { .. }) => error.to_string(),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("accepted"),
    };
    let no_shape = refused("flor", Affine3A::IDENTITY);
    assert_eq!(no_shape, "instance \"i\": the scene has no shape \"flor\"");
    for far in [f32::NAN, f32::INFINITY, 1e13] {
        let error = refused("floor", Affine3A::from_translation(Vec3::splat(far)));
        assert_eq!(error, "instance \"i\": coordinates have to be finite and up to 1e12");
    }
}

/// Instances of a scene file: scaled, rotated, then translated, on top of where the shape stands.
#[test]
fn scene_files_have_instances() {
    let text = "[material.m]\ntype = \"matte\"\n[shape.s]\ntype = \"rectangle\"\nmaterial = \"m\"\ncorner = [1, 0, 0]\n\
        edges = [[1, 0, 0], [0, 1, 0]]\ntranslate = [0, 0, 5]\n\
        [instance.i]\nshape = \"s\"\nscale = 2\nrotate = [0, 0, 1, 90]\ntranslate = [10, 0, 0]\n";
    let path = "s.toml".as_ref();
    let scene = parse_scene(path, text, &[] as &[&str]).unwrap().scene;
    assert_eq!(scene.instances().collect::<Vec<_>>(), [("i", "s")]);
    let bounds = scene.accel().bounds();
    // The rectangle is from (1, 0, 5) to (2, 1, 5), the instance from (8, 2, 10) to (10, 4, 10).
    let is_near = |a: Vec3, b: Vec3| a.distance(b) < 1e-4;
    assert!(is_near(bounds.min, Vec3::new(1.0, 0.0, 5.0)), "{bounds:?}");
    assert!(is_near(bounds.max, Vec3::new(10.0, 4.0, 10.0)), "{bounds:?}");

    let refused = |from: &str, to: &str| {
        let text = text.replace(from, to);
        parse_scene(path, &text, &[] as &[&str]).err().expect("refused").to_string()
    };
    let cases = [
        (
            "shape = \"s\"",
            "shape = \"t\"",
            "s.toml:10:9: the scene has no shape `t`; did you mean `s`?",
        ),
        (
            "shape = \"s\"\n",
            "",
            "s.toml:9:1: [instance.i] lacks `shape`, expected a text in quotes",
        ),
        (
            "scale = 2",
            "size = 2",
            "s.toml:11:1: unknown key `size` in [instance.i]; expected `type`, `shape`, `scale`, `rotate` or `translate`",
        ),
        (
            "scale = 2",
            "scale = 1e30",
            "s.toml:9:1: instance \"i\": coordinates have to be finite and up to 1e12",
        ),
    ];
    for (from, to, message) in cases {
        let found = refused(from, to);
        assert_eq!(found, message);
    }
}
