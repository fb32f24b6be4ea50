//! The checks of `Bsdf`: calls that lobes must not get, and results that must not be returned.

use lobe::Spectrum;
use lobe::bxdf::{Bsdf, BxDF, BxdfFlags, Lobe, OrenNayar};
use lobe::geometry::Frame;
use lobe::glam::{Vec2, Vec3};

use super::view;
use crate::common::lobes::{Broken, Counting};

const BAD: [f32; 4] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-3];
const UC: f32 = 0.45;
const U: Vec2 = Vec2::new(0.3, 0.6);

fn flat(lobe: &dyn BxDF) -> Bsdf<'_> {
    let mut bsdf = Bsdf::new(Frame::from_normal(Vec3::Z), Vec3::Z);
    bsdf.add(Lobe::Custom(lobe));
    bsdf
}

/// Values that are not finite or negative become black, and are counted. Caught: the guard left out of
/// `f`, of `sample_f`, of `rho_hd` and of `rho_hh`; infinity let through.
#[test]
fn bad_values_become_black() {
    let all = BxdfFlags::all();
    for bad in BAD {
        let lobe = Broken::with_f(bad);
        let bsdf = flat(&lobe);
        assert!(bsdf.f(view(0.5), Vec3::Z, all).is_black(), "{bad}");
        assert_eq!(bsdf.rejected(), 1, "{bad}");
        assert!(bsdf.sample_f(view(0.5), UC, U, all).is_none_or(|s| s.f.is_black()), "{bad}");
        assert_eq!(bsdf.rejected(), 2, "{bad}");
        assert!(bsdf.rho_hd(view(0.5), &[UC], &[U], all).is_black(), "{bad}");
        assert!(bsdf.rho_hh(&[U], &[UC], &[U], all).is_black(), "{bad}");
        assert_eq!(bsdf.rejected(), 4, "{bad}");
        // The same from a delta lobe, whose own value is passed on.
        let specular = Broken { flags: BxdfFlags::REFLECTION | BxdfFlags::SPECULAR, ..lobe };
        let bsdf = flat(&specular);
        assert!(bsdf.sample_f(view(0.5), UC, U, all).is_none_or(|s| s.f.is_black()), "{bad}");
        assert_eq!(bsdf.rejected(), 1, "{bad}");
    }
}

/// Invalid densities give no sample, and are counted too. Caught: `pdf` without its guard, and
/// the guards of both without the count.
#[test]
fn bad_densities_give_no_sample() {
    let all = BxdfFlags::all();
    for bad in BAD {
        for specular in [false, true] {
            let mut lobe = Broken { pdf: bad, ..Broken::with_f(0.5) };
            if specular {
                lobe.flags = BxdfFlags::REFLECTION | BxdfFlags::SPECULAR;
            }
            let bsdf = flat(&lobe);
            assert!(bsdf.sample_f(view(0.5), UC, U, all).is_none(), "{bad}, specular {specular}");
            assert_eq!(bsdf.rejected(), 1, "{bad}, specular {specular}");
            assert_eq!(bsdf.pdf(view(0.5), Vec3::Z, all), 0.0, "{bad}");
            assert_eq!(bsdf.rejected(), 2, "{bad}, specular {specular}");
        }
    }
}

/// Invalid directions are not returned either. Caught: no look at `wi`.
#[test]
fn bad_directions_give_no_sample() {
    for wi in [Vec3::NAN, Vec3::new(0.0, f32::INFINITY, 0.0)] {
        for specular in [false, true] {
            let mut lobe = Broken { wi, ..Broken::with_f(0.5) };
            if specular {
                lobe.flags = BxdfFlags::REFLECTION | BxdfFlags::SPECULAR;
            }
            let bsdf = flat(&lobe);
            assert!(bsdf.sample_f(view(0.5), UC, U, BxdfFlags::all()).is_none(), "{wi}");
            assert_eq!(bsdf.rejected(), 1, "{wi}");
        }
    }
}

/// A lobe that samples a side which its flags do not name gives black there, and is counted, alone and beside
/// another lobe.
/// Caught: no count; the value of a single lobe kept.
#[test]
fn directions_on_the_wrong_side_are_counted() {
    let lobe = Broken { wi: Vec3::NEG_Z, ..Broken::with_f(0.5) };
    for lobes in [1, 2] {
        let mut bsdf = flat(&lobe);
        (1..lobes).for_each(|_| assert!(bsdf.add(Lobe::Custom(&lobe))));
        let sample = bsdf.sample_f(view(0.5), UC, U, BxdfFlags::all()).unwrap();
        assert!(sample.f.is_black(), "{lobes} lobes");
        // Once for the side, and once for a transmission without an index.
        assert_eq!(bsdf.rejected(), 2, "{lobes} lobes");
    }
}

/// Oren-Nayar between two directions that are almost along the surface leaves the range of f32.
/// Caught: the guard left out of `f`.
#[test]
fn overflow_of_a_real_model_is_caught() {
    let lobe = OrenNayar::new(Spectrum::WHITE, 90.0);
    let bsdf = flat(&lobe);
    let grazing = Vec3::new(1.0, 0.0, 1e-40);
    assert!(bsdf.f(grazing, grazing, BxdfFlags::all()).is_black());
    assert_eq!(bsdf.rejected(), 1);
}

/// No lobe is called with a `wo` exactly parallel to the surface, +0 or -0, in any frame.
/// Caught: the check left out of each of the five questions.
#[test]
fn directions_along_the_surface_reach_no_lobe() {
    let lobe = Counting::default();
    for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let mut bsdf = Bsdf::new(Frame::from_normal(n), n);
        bsdf.add(Lobe::Custom(&lobe));
        let along = Vec3::new(n.y, n.z, n.x);
        for wo in [along, -along] {
            let all = BxdfFlags::all();
            // The side of wi is undefined here, so both are tested.
            assert!(bsdf.f(wo, n, all).is_black() && bsdf.f(wo, -n, all).is_black(), "{n}, {wo}");
            assert_eq!(bsdf.pdf(wo, n, all), 0.0, "{n}, {wo}");
            assert_eq!(bsdf.f_and_pdf(wo, n, all), (Spectrum::BLACK, 0.0), "{n}, {wo}");
            assert!(bsdf.sample_f(wo, UC, U, all).is_none(), "{n}, {wo}");
            assert!(bsdf.rho_hd(wo, &[UC], &[U], all).is_black(), "{n}, {wo}");
            assert_eq!(lobe.calls(), 0, "{n}, {wo}");
        }
    }
}
