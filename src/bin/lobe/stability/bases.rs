//! Orthonormal frames around normals close to -z.

use std::f64::consts::TAU;

use lobe::geometry::Frame;
use lobe::glam::{DVec3, Vec3};

use super::sweep::Sweep;
use super::tally::{measured, trials, worse};

/// Normals close to -z.
pub fn near_minus_z(effort: f64) -> Sweep {
    let parameters: Vec<f64> = (-27..=0).map(|k| 2.0 * 10.0_f64.powf(0.5 * f64::from(k))).collect();
    let around = trials(20_000, effort, 200);
    let named = [
        ("Frisvad 2012", false),
        ("Hughes-Möller 1999", false),
        ("Frame::from_normal (ours)", true),
    ];
    let methods = measured(&parameters, named, |_, above| {
        let mut worst = [0.0; 3];
        for i in 0..around {
            let n = normal(above, f64::from(i) / f64::from(around));
            let Frame { s, t, .. } = Frame::from_normal(n);
            for (worst, [s, t]) in worst.iter_mut().zip([frisvad(n), hughes_moeller(n), [s, t]]) {
                *worst = worse(*worst, skew([s, t, n].map(Vec3::as_dvec3)));
            }
        }
        worst
    });
    Sweep {
        name: "bases",
        title: "Frames that are not orthonormal, by how close the normal is to -z",
        about: format!(
            "Tangents for {around} normals around the z axis, rounded to f32. The error is the largest of all dot \
             products between the three axes and of the deviations of their lengths from 1, in f64 from the f32 axes. \
             Common methods: Frisvad 2012, \"Building an Orthonormal Basis from a 3D Unit Vector Without Normalization\", as \
             printed, which has a special case only below n.z = -0.9999999; and Hughes and Möller 1999, which normalises \
             and does not fail either. Ours is that of Duff et al. 2017."
        ),
        parameter: "1 + n.z",
        log_parameter: true,
        measure: "largest error of a dot product or length",
        methods,
        fails_from: 1e-4,
        bounds: vec![2e-7; parameters.len()],
        parameters,
    }
}

/// The unit vector with 1 + n.z = `above`, at the azimuth of `turns` full turns.
fn normal(above: f64, turns: f64) -> Vec3 {
    let (sin, cos) = (TAU * turns).sin_cos();
    let across = (above * (2.0 - above)).max(0.0).sqrt();
    DVec3::new(across * cos, across * sin, above - 1.0).as_vec3()
}

/// Largest deviation from an orthonormal frame.
fn skew([s, t, n]: [DVec3; 3]) -> f64 {
    let dots = [s.dot(t), t.dot(n), n.dot(s)].map(f64::abs);
    let lengths = [s, t, n].map(|v| (v.length() - 1.0).abs());
    dots.into_iter().chain(lengths).fold(0.0, worse)
}

/// Frisvad's listing 3.
fn frisvad(n: Vec3) -> [Vec3; 2] {
    if n.z < -0.999_999_9 {
        return [Vec3::new(0.0, -1.0, 0.0), Vec3::new(-1.0, 0.0, 0.0)];
    }
    let a = 1.0 / (1.0 + n.z);
    let b = -n.x * n.y * a;
    [Vec3::new(1.0 - n.x * n.x * a, b, -n.x), Vec3::new(b, 1.0 - n.y * n.y * a, -n.y)]
}

/// Hughes and Möller 1999, "Building an Orthonormal Basis from a Unit Vector".
fn hughes_moeller(n: Vec3) -> [Vec3; 2] {
    let across =
        if n.x.abs() > n.z.abs() { Vec3::new(-n.y, n.x, 0.0) } else { Vec3::new(0.0, -n.z, n.y) };
    let t = across / across.length();
    [t.cross(n), t]
}
