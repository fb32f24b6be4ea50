//! Lobes and their sum: sampling, contracts, and the checks of results.

mod bsdf;
mod contract;
mod events;
mod fresnel;
mod ggx;
mod glossy;
mod guard;
mod sampling;
mod specular;

use lobe::Spectrum;
use lobe::bxdf::fresnel::Fresnel;
use lobe::bxdf::{
    BoundaryLosses, BxDF, CoatedDiffuse, EnergyPreservingOrenNayar, FresnelMicrofacet,
    FresnelSpecular, LambertianReflection, LambertianTransmission, Losses, MicrofacetReflection,
    OrenNayar, RetroReflection, Roughnesses, ScaledBxDF, SpecularReflection, SpecularTransmission,
    ThinFresnelSpecular,
};
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

/// Losses that live as long as the test program.
fn kept<T>(losses: T) -> &'static T {
    Box::leak(Box::new(losses))
}

/// Reflection by facets that reflect all light, often.
fn white_facets(alpha: [f32; 2]) -> MicrofacetReflection<'static> {
    let losses = kept(Losses::of_mirrors(Roughnesses::Constant(alpha)));
    MicrofacetReflection::new(alpha, Fresnel::NoOp).and_multiple(losses, Spectrum::WHITE)
}

/// A rough boundary that absorbs nothing.
fn rough_glass(alpha: [f32; 2], eta: f32) -> FresnelMicrofacet<'static> {
    let losses = kept(BoundaryLosses::new(eta, Roughnesses::Constant(alpha)));
    FresnelMicrofacet::new(Spectrum::WHITE, Spectrum::WHITE, alpha, losses)
}

/// A coat over a base.
fn coat(r: Spectrum, alpha: [f32; 2], eta: f32) -> [Box<dyn BxDF>; 2] {
    let losses = kept(Losses::of_coat(eta, Roughnesses::Constant(alpha)));
    let reflection = MicrofacetReflection::new(alpha, Fresnel::Dielectric { eta });
    [Box::new(reflection), Box::new(CoatedDiffuse::new(r, alpha, losses))]
}

/// Roughness along x and y: isotropic, and not.
const ALPHAS: [[f32; 2]; 6] =
    [[0.01, 0.01], [0.03, 0.03], [0.3, 0.3], [1.0, 1.0], [0.1, 0.5], [1.0, 0.02]];

/// The crate's lobes, the glossy ones with these roughnesses.
fn all_lobes(alphas: &[[f32; 2]]) -> Vec<(String, Box<dyn BxDF>)> {
    let mut all: Vec<(String, Box<dyn BxDF>)> =
        lobes().into_iter().map(|(name, lobe)| (name.to_owned(), lobe)).collect();
    let gold = Fresnel::Conductor { eta: [0.2, 0.4, 1.3], k: [3.2, 2.5, 1.9] };
    let specular: [Box<dyn BxDF>; 5] = [
        Box::new(SpecularReflection::new(COLOR, gold)),
        Box::new(SpecularTransmission::new(COLOR, 1.5)),
        Box::new(FresnelSpecular::new(COLOR, Spectrum::WHITE, 0.75)),
        Box::new(ThinFresnelSpecular::new(COLOR, Spectrum::WHITE, 1.5)),
        Box::new(LambertianTransmission::new(COLOR)),
    ];
    all.extend(specular.into_iter().enumerate().map(|(i, lobe)| (format!("specular {i}"), lobe)));
    for &alpha in alphas {
        let white = white_facets(alpha);
        all.push((format!("facets {alpha:?}"), Box::new(white)));
        all.push((format!("retro {alpha:?}"), Box::new(RetroReflection::new(white))));
        let losses = kept(Losses::of_mirrors(Roughnesses::Any));
        let metal = MicrofacetReflection::new(alpha, gold).and_multiple(losses, gold.mean());
        all.push((format!("metal {alpha:?}"), Box::new(metal)));
        for eta in [1.5, 1.0 / 1.33, 1.05] {
            all.push((format!("rough glass {alpha:?} {eta}"), Box::new(rough_glass(alpha, eta))));
        }
        let [reflection, base] = coat(COLOR, alpha, 1.5);
        all.push((format!("coat {alpha:?}"), reflection));
        all.push((format!("coated {alpha:?}"), base));
    }
    all
}
