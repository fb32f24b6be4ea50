//! What implements `Texture`, and how materials store it.

mod combined;
mod filtered;
#[path = "../../folders/mod.rs"]
mod folders;
mod lookups;
mod mappings;

use std::sync::Arc;

use lobe::bxdf::{Arena, BxdfFlags};
use lobe::geometry::BoundedPoint;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};
use lobe::material::Material;
use lobe::params::{AnyKey, Key, Value};
use lobe::texture::{ConstantTexture, Texture, TextureHandle, TextureKey};
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

/// A constant is recognised in any wrapper, so that no texture is asked for it: shared, or behind a pointer.
/// Caught: constants looked for by type; a closure taken for one.
#[test]
fn constants_are_recognised_everywhere() {
    let constant: Arc<dyn Texture<Spectrum>> = Arc::new(ConstantTexture::new(RED));
    for (i, handle) in [
        RED.into_handle(),
        constant.clone().into_handle(),
        Arc::new(constant.clone()).into_handle(),
        ConstantTexture::new(RED).into_handle(),
        Arc::new(ConstantTexture::new(RED)).into_handle(),
        constant.into_handle().into_handle(),
    ]
    .into_iter()
    .enumerate()
    {
        assert_eq!(handle.constant(), Some(RED), "wrapper {i}");
        assert!(matches!(handle, TextureHandle::Constant(_)), "wrapper {i}");
    }
    let closure = (|_: &SurfaceInteraction| RED).into_handle();
    assert_eq!(closure.constant(), None);
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
