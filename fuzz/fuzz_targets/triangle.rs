//! Any floats as a ray and a triangle: a miss, or a hit within the ray and the triangle.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

fuzz_target!(|input: ([[f32; 3]; 5], f32, f32)| {
    let ([o, d, corners @ ..], t_min, t_max) = input;
    let ray = Ray { o: o.into(), t_min, d: d.into(), t_max };
    if let Some(hit) = ShearedRay::new(&ray).intersect(&corners.map(Vec3::from), t_min, t_max) {
        assert!(hit.t >= t_min && hit.t <= t_max && hit.t > 0.0);
        assert!(hit.b.iter().all(|b| (0.0..=1.0).contains(b)), "{hit:?}");
    }
});
