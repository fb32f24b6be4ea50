//! What implements `Texture`, and how materials store it.

use std::sync::Arc;

use lobe::bxdf::{Arena, BxdfFlags};
use lobe::geometry::BoundedPoint;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};
use lobe::material::Material;
use lobe::params::{AnyKey, Key, Value};
use lobe::texture::{ConstantTexture, Texture, TextureKey};
use lobe::{MatteMaterial, Spectrum};

const RED: Spectrum = Spectrum::new(0.75, 0.25, 0.125);

/// A point of the plane z = 0 with these texture coordinates.
fn at(uv: Vec2) -> SurfaceInteraction<'static> {
    let partials = Partials { dpdu: Vec3::X, dpdv: Vec3::Y, ..Partials::default() };
    let point = BoundedPoint { p: uv.extend(0.0), error: Vec3::ZERO };
    SurfaceInteraction::new(point, uv, Vec3::Z, partials)
}

/// The value of a matte surface with this reflectance, times π.
fn seen(kd: impl Texture<Spectrum> + 'static, uv: Vec2) -> Spectrum {
    let (material, arena) = (MatteMaterial::new(kd), Arena::new());
    let mut si = at(uv);
    let bsdf = material.compute_scattering(&mut si, &arena);
    bsdf.f(Vec3::Z, Vec3::Z, BxdfFlags::all()) * std::f32::consts::PI
}

fn close(a: Spectrum, b: Spectrum) -> bool {
    a.to_array().iter().zip(b.to_array()).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// Values, closures and shared textures of any type are textures.
/// Caught: a closure called with another point; the constant of a shared texture lost.
#[test]
fn everything_that_has_a_value_is_a_texture() {
    let stripes = |si: &SurfaceInteraction| RED * if si.uv().x < 0.5 { 1.0 } else { 0.5 };
    let shared = Arc::new(stripes);
    let dynamic: Arc<dyn Texture<Spectrum>> = shared.clone();
    let twice = Arc::new(dynamic.clone());
    for (uv, value) in [(Vec2::new(0.25, 0.0), RED), (Vec2::new(0.75, 0.0), RED * 0.5)] {
        assert!(close(seen(stripes, uv), value));
        assert!(close(seen(shared.clone(), uv), value));
        assert!(close(seen(dynamic.clone(), uv), value));
        assert!(close(seen(twice.clone(), uv), value));
        assert!(close(seen(dynamic.clone().into_handle(), uv), value));
        assert!(close(seen(RED, uv), RED) && close(seen(RED.to_array(), uv), RED));
    }
}

/// A constant is recognised in any wrapper, so that its surface takes the fast path: shared, behind a
/// pointer, in a shared material.
/// Caught: constants looked for by type; a constant lobe for an infinite value, which hits refuse and count.
#[test]
fn constants_are_recognised_everywhere() {
    let constant: Arc<dyn Texture<Spectrum>> = Arc::new(ConstantTexture::new(RED));
    let lobe = MatteMaterial::new(RED).constant_lambertian();
    assert!(lobe.is_some());
    let clothes = [
        MatteMaterial::new(constant.clone()),
        MatteMaterial::new(Arc::new(constant.clone())),
        MatteMaterial::new(ConstantTexture::new(RED))
            .with_sigma(Arc::new(ConstantTexture::new(0.0))),
        MatteMaterial::new(constant.into_handle()).with_sigma(0.0),
    ];
    for (i, material) in clothes.iter().enumerate() {
        assert_eq!(material.constant_lambertian(), lobe, "clothes {i}");
    }
    let material: Arc<dyn Material> = Arc::new(MatteMaterial::new(RED));
    assert_eq!(Arc::new(material).constant_lambertian(), lobe);
    for other in [
        MatteMaterial::new(RED).with_sigma(1.0),
        MatteMaterial::new(RED).with_bump(0.0),
        MatteMaterial::new(|_: &SurfaceInteraction| RED),
        MatteMaterial::new(Spectrum::splat(f32::NAN)),
        MatteMaterial::new(Spectrum::splat(f32::INFINITY)),
        MatteMaterial::new(Spectrum::BLACK),
    ] {
        assert_eq!(other.constant_lambertian(), None);
    }
}

/// The key of a texture accepts any name, and constants in its range.
/// Caught: names refused, as the key of a plain number does.
#[test]
fn texture_keys_accept_names_and_constants() {
    const SIGMA: Key<f32> = Key::new("sigma", "roughness").range(0.0..=90.0);
    let key = TextureKey::of(SIGMA);
    for (value, plain, textured) in [
        (Value::Text("rough".into()), false, true),
        (Value::Number("90".into()), true, true),
        (Value::Number("90.5".into()), false, false),
        (Value::Boolean(true), false, false),
    ] {
        assert_eq!((SIGMA.accepts(&value), key.accepts(&value)), (plain, textured), "{value}");
    }
}
