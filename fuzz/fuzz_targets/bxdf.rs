//! Any parameters and directions: what leaves a Bsdf is finite and not negative, and no sample has a pdf
//! of 0.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::Spectrum;
use lobe::bxdf::{Bsdf, BxDF, BxdfFlags, LambertianReflection, OrenNayar, ScaledBxDF};
use lobe::geometry::Frame;
use lobe::glam::{Vec2, Vec3};

fuzz_target!(|input: ([[f32; 3]; 5], [u32; 3], f32)| {
    let ([r, n, ng, wo, wi], numbers, sigma) = input;
    let unit = |v: [f32; 3]| Vec3::from(v).try_normalize();
    let (Some(n), Some(ng), Some(wo), Some(wi)) = (unit(n), unit(ng), unit(wo), unit(wi)) else {
        return;
    };
    let [uc, x, y] = numbers.map(|bits| (bits >> 8) as f32 / (1 << 24) as f32);
    let u = Vec2::new(x, y);
    let all = BxdfFlags::all();
    let r = Spectrum::from(r);
    let mut bsdf = Bsdf::new(Frame::from_normal(n), ng);
    bsdf.add(LambertianReflection::new(r));
    bsdf.add(OrenNayar::new(r, sigma));
    assert!(bsdf.f(wo, wi, all).is_valid());
    let pdf = bsdf.pdf(wo, wi, all);
    assert!(pdf >= 0.0 && pdf.is_finite());
    if let Some(sample) = bsdf.sample_f(wo, uc, u, all) {
        assert!(sample.f.is_valid() && sample.pdf > 0.0 && sample.pdf.is_finite());
    }
    let scaled = ScaledBxDF::new(LambertianReflection::new(Spectrum::WHITE), Spectrum::splat(0.5));
    assert_eq!(scaled.rho_hd(wo, &[], &[]), Spectrum::splat(0.5));
});
