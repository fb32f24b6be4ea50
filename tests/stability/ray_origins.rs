//! The measurement of ray origins in `examples/ray_origins`, with few rays.
//!
//! Truth: the definitions at the head of the example, the constants of Waechter and Binder 2019, and what is
//! kept in `docs/`.

#[path = "../examples/ray_origins/chart.rs"]
mod chart;
#[path = "../examples/ray_origins/measure.rs"]
mod measure;
#[path = "../examples/ray_origins/method.rs"]
mod method;
#[path = "../examples/ray_origins/panel.rs"]
mod panel;
#[path = "../examples/ray_origins/rng.rs"]
mod rng;
#[path = "../examples/ray_origins/scene.rs"]
mod scene;
#[path = "../examples/ray_origins/table.rs"]
mod table;
#[path = "../examples/ray_origins/triangle_test.rs"]
mod triangle_test;

use lobe::geometry::BoundedPoint;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};

use measure::{Failure, Place, Row};
use method::Method;

const RAYS: u32 = 300;

fn rows() -> Vec<Row> {
    measure::places().into_iter().flat_map(|place| measure::measure(place, RAYS)).collect()
}

/// The crate's rays never hit what they left. The control does, so the trials catch failures; and at the
/// origin it loses no contact across the wide gap, so the truth asks for nothing that cannot be had.
#[test]
fn error_bounds_have_no_self_hits() {
    for row in rows() {
        let Place { scale, distance } = row.place;
        let [bounded, plain] = row.failures;
        let at = format!("scale {scale}, distance {distance}: {} trials", row.trials);
        match (row.failure, row.method) {
            (Failure::SelfHit, Method::ErrorBounds) => assert_eq!(bounded, 0, "{at}"),
            (Failure::SelfHit, Method::Unmoved) if distance == 0.0 => {
                assert!(plain > RAYS / 4, "{at}, {plain} hits");
            }
            (Failure::LostContact(1e-3), Method::Unmoved) if distance == 0.0 => {
                assert_eq!((row.trials, plain), (RAYS, 0), "{at}");
            }
            _ => {}
        }
    }
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

/// The table that is kept has the same places and methods, in the same order; the same rays give the same
/// bytes; and the charts have a line for each method in each of six panels, and four in the legend.
#[test]
fn files_are_what_the_example_writes() {
    let keys = |csv: &str| -> Vec<String> {
        csv.lines().map(|line| line.split(',').take(5).collect::<Vec<_>>().join(",")).collect()
    };
    let rows = rows();
    let csv = table::csv(&rows);
    assert_eq!(csv, table::csv(&self::rows()));
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/ray-origins.csv");
    let kept = std::fs::read_to_string(kept).expect("docs/ray-origins.csv is there");
    assert_eq!(keys(&csv), keys(&kept));
    for test in 0..2 {
        assert_eq!(chart::svg(&rows, RAYS, test).matches(r#"class="line "#).count(), 28);
    }
}
