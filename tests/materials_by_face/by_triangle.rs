//! One mesh whose triangles differ in material, without files.

use lobe::glam::Vec3;
use lobe::integrator::PathIntegrator;
use lobe::light::PointLight;
use lobe::scene::{FilmSettings, SceneBuilder, SceneError, View};
use lobe::{
    MatteMaterial, PerspectiveSettings, RenderOptions, RenderSettings, Scene, Spectrum,
    TriangleMesh, render,
};

const RED: [f32; 3] = [0.75, 0.25, 0.125];
const COLORS: [[f32; 3]; 3] = [RED, [0.1, 0.9, 0.3], [0.4; 3]];

fn strip() -> TriangleMesh {
    let positions = (0..20)
        .map(|i| Vec3::new(i as f32 * 0.1 - 1.0, (i % 2) as f32 - 0.5, (i % 3) as f32 * 0.1))
        .collect();
    let indices =
        (0..18).map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] }).collect();
    TriangleMesh { positions, indices, ..TriangleMesh::default() }
}

fn picture(builder: SceneBuilder) -> Vec<Spectrum> {
    let names = ["a", "b", "c"].into_iter().zip(COLORS);
    let builder =
        names.fold(builder, |builder, (name, kd)| builder.material(name, MatteMaterial::new(kd)));
    let scene = builder
        .light(PointLight::new(Vec3::new(0.5, 1.0, -2.0), Spectrum::splat(5.0)))
        .build()
        .unwrap();
    let camera = PerspectiveSettings {
        eye: Vec3::new(0.0, 0.1, -2.0),
        look_at: Vec3::ZERO,
        ..Default::default()
    };
    let view = View::perspective(&camera, FilmSettings::new(32, 24)).unwrap();
    let mut settings = RenderSettings::new(Default::default(), PathIntegrator::new(4));
    settings.sampler.spp = 8;
    render(&scene, &view, &settings, &RenderOptions::default()).unwrap().picture.color
}

/// One mesh whose triangles differ gives the picture of as many shapes, bit by bit. Seen to fail with the material of the triangle
/// before.
#[test]
fn materials_by_triangle_equal_separate_shapes() {
    let mesh = strip();
    let of_triangles: Vec<u32> = (0..18).map(|i| i * i % 3).collect();
    let names = ["a", "b", "c"].map(str::to_owned);
    let together = picture(Scene::builder().shape_with_materials(
        "s",
        mesh.clone(),
        names.to_vec(),
        of_triangles.clone(),
    ));
    let apart = (0..18).fold(Scene::builder(), |builder, i| {
        builder.shape(format!("s{i}"), mesh.part(&[i]), &names[of_triangles[i as usize] as usize])
    });
    let (apart, one) = (picture(apart), picture(Scene::builder().shape("s", mesh.clone(), "a")));
    assert!(together == apart);
    assert!(together != one);
    // Names may be given twice, and not at all.
    let twice = ["c", "a", "b", "c", "a"].map(str::to_owned).to_vec();
    let indices = of_triangles.iter().map(|index| [4, 2, 3][*index as usize]).collect();
    assert!(
        together
            == picture(Scene::builder().shape_with_materials("s", mesh.clone(), twice, indices))
    );
    assert!(
        one == picture(Scene::builder().shape_with_materials(
            "s",
            mesh,
            vec!["a".into()],
            vec![0; 18]
        ))
    );
}

/// Seen to fail with too many materials taken, and with an index of the count itself.
#[test]
fn materials_by_triangle_are_checked() {
    let refused = |names: &[&str], of_triangles: Vec<u32>| -> SceneError {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        let builder = Scene::builder().material("a", MatteMaterial::new(RED));
        builder
            .shape_with_materials("my shape", strip(), names, of_triangles)
            .build()
            .err()
            .unwrap()
    };
    for (names, of_triangles, message) in [
        (&["a"][..], vec![0; 17], "shape \"my shape\": 17 materials for 18 triangles"),
        (&["a"], vec![0; 19], "shape \"my shape\": 19 materials for 18 triangles"),
        (&["a"], Vec::new(), "shape \"my shape\": 0 materials for 18 triangles"),
        (&["a"], vec![1; 18], "shape \"my shape\": material 1 of 1, which count from 0"),
        (&[], vec![0; 18], "shape \"my shape\": material 0 of 0, which count from 0"),
        (
            &["a", "b"],
            vec![u32::MAX; 18],
            "shape \"my shape\": material 4294967295 of 2, which count from 0",
        ),
        (
            &["a", "b"],
            vec![0; 18],
            "shape \"my shape\" refers to material \"b\", which the scene does not have",
        ),
    ] {
        assert_eq!(refused(names, of_triangles).to_string(), message);
    }
}
