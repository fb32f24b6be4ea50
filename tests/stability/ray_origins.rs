//! The measurements of ray origins, with few rays.
//!
//! Truth: the definitions at the head of `measure.rs`, and the constants of Waechter and Binder 2019.

use lobe::geometry::BoundedPoint;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};

use crate::stability::ray_origins::measure::{Failure, measure};
use crate::stability::ray_origins::method::Method;
use crate::stability::ray_origins::placement::Placement;

const RAYS: u32 = 300;

/// The crate's rays never hit the surface they leave, at any scale and distance. The control does, so the trials can
/// detect failures. At the origin the control loses no contact, so the truth counts only contacts that can be found.
#[test]
fn error_bounds_have_no_self_hits() {
    let powers = |from: i32, to: i32| (from..=to).map(|power| 10.0_f64.powi(power));
    let mut measured = 0;
    for scale in powers(-6, 6) {
        for distance in std::iter::once(0.0).chain(powers(0, 6)) {
            let place = Placement { scale, distance };
            let at = format!("scale {scale}, distance {distance}");
            let Some([.., [bounded, _], [_, control]]) = measure(Failure::SelfHit, place, RAYS)
            else {
                continue;
            };
            assert_eq!(bounded, 0, "{at}");
            measured += 1;
            if distance == 0.0 {
                assert!(control > RAYS / 4, "{at}, {control} hits");
                let contacts = measure(Failure::LostContact, place, RAYS);
                let lost = contacts.map(|[.., [_, control]]| control);
                assert_eq!(lost, Some(0), "{at}");
            }
        }
    }
    assert!(measured > 80, "only {measured} places");
}

/// 256 floats further along each axis, or 2⁻¹⁶ near zero.
#[test]
fn waechter_binder_moves_by_its_constants() {
    let p = Vec3::new(1.0, -1.0, 0.01);
    let partials = |n: Vec3| {
        let [dpdu, dpdv] = if n.x != 0.0 {
            [Vec3::Y, Vec3::Z]
        } else if n.y != 0.0 {
            [Vec3::Z, Vec3::X]
        } else {
            [Vec3::X, Vec3::Y]
        };
        Partials { dpdu, dpdv, ..Partials::default() }
    };
    for (n, expected) in [
        (Vec3::X, Vec3::new(1.0 + 256.0 * f32::EPSILON, -1.0, 0.01)),
        (Vec3::Y, Vec3::new(1.0, -1.0 + 128.0 * f32::EPSILON, 0.01)),
        (Vec3::Z, Vec3::new(1.0, -1.0, 0.01 + 1.0 / 65536.0)),
    ] {
        let point = BoundedPoint { p, error: Vec3::ZERO };
        let si = SurfaceInteraction::new(point, Vec2::ZERO, n, partials(n));
        assert_eq!(Method::WaechterBinder.spawn(&si, n).o, expected);
        let below = 2.0 * p - Method::WaechterBinder.spawn(&si, -n).o;
        assert!((below - expected).abs().max_element() <= 128.0 * f32::EPSILON, "{below}");
    }
}
