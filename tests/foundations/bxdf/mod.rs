//! Lobes and their sum: sampling, contracts, and the checks of results.

mod bsdf;
mod contract;
mod events;
mod fresnel;
mod guard;
mod sampling;
mod specular;

use lobe::Spectrum;
use lobe::bxdf::{BxDF, EnergyPreservingOrenNayar, LambertianReflection, OrenNayar, ScaledBxDF};
use lobe::glam::Vec3;

use crate::common::lobes::{Stretched, Through};

/// cos θ of the directions of view: from the normal to grazing, and from below.
const VIEWS: [f32; 6] = [1.0, 0.7, 0.3, 0.05, 1e-4, -0.6];

/// The unit vector with this cosine, askew to all axes.
fn view(cos: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).sqrt();
    Vec3::new(sin * 0.8, sin * 0.6, cos)
}

const COLOR: Spectrum = Spectrum::new(0.9, 0.5, 0.0);

/// All lobes without a delta; the first are the crate's own, in full and dimmed.
fn lobes() -> Vec<(&'static str, Box<dyn BxDF>)> {
    let rough = OrenNayar::new(COLOR, 20.0);
    vec![
        ("Lambertian", Box::new(LambertianReflection::new(COLOR))),
        ("Oren-Nayar, almost smooth", Box::new(OrenNayar::new(COLOR, 0.01))),
        ("Oren-Nayar", Box::new(rough)),
        ("Oren-Nayar, roughest", Box::new(OrenNayar::new(COLOR, 90.0))),
        ("EON, smooth", Box::new(EnergyPreservingOrenNayar::new(COLOR, 0.0))),
        ("EON", Box::new(EnergyPreservingOrenNayar::new(COLOR, 0.3))),
        ("EON, roughest", Box::new(EnergyPreservingOrenNayar::new(COLOR, 1.0))),
        ("scaled Lambertian", Box::new(ScaledBxDF::new(LambertianReflection::new(COLOR), COLOR))),
        ("scaled Oren-Nayar", Box::new(ScaledBxDF::new(rough, COLOR))),
        ("stretched", Box::new(Stretched { r: 0.7, m: Vec3::new(0.2, 0.6, 1.0) })),
        ("through", Box::new(Through(0.4))),
    ]
}
