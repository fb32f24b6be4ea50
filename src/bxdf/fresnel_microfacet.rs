//! [`FresnelMicrofacet`]: glossy reflection and refraction.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::fresnel::boundary;
use super::microfacet::{BoundaryLosses, Ggx, Spread, above, flipped};
use super::specular_transmission::relative;
use super::{BxDF, BxdfFlags, BxdfSample, FresnelSpecular};
use crate::spectrum::Spectrum;

/// Reflection and refraction by the facets of a rough boundary between media that do not absorb, which have the distribution [`Ggx`].
///
/// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equations 20 and 21, the second divided by η²: paths
/// start at the camera. What single scattering loses, up to 69 %, goes to both sides in proportion to their [`BoundaryLosses`]: with
/// η² taken out, a boundary that absorbs nothing is white from both sides, at every angle and roughness, within the error of those. Normals
/// are drawn by spherical caps without a bound, which would cut off refracted light.
///
/// Surfaces that f32 does not tell from smooth ones are specular: with a roughness, or a roughness times |η - 1|, below
/// [`Ggx::MIN_ALPHA`].
#[doc(alias = "rough glass")]
#[doc(alias = "dielectric")]
#[derive(Clone, Copy, Debug)]
pub struct FresnelMicrofacet<'a> {
    r: [f32; 3],
    t: [f32; 3],
    ggx: Ggx,
    /// Of light that is lost from above and from below: the mean over directions, and the fraction that leaves on the other side.
    means: [f32; 2],
    crossing: [f32; 2],
    losses: &'a BoundaryLosses,
}

/// A direction from which light is seen, mirrored so that it is above.
#[derive(Clone, Copy)]
struct View {
    wo: Vec3,
    /// Whether it was below.
    is_below: bool,
    /// The index on the far side of wo, over that on its own.
    eta: f32,
    /// What single scattering loses.
    lost: f32,
}

impl<'a> FresnelMicrofacet<'a> {
    /// Scales what is reflected by `r` and what is refracted by `t`, in `[0, 1]` per band. `alpha` is the roughness along x and
    /// along y, in `[0, 1]`; `losses` are those of this roughness and know the index of refraction.
    #[inline]
    pub fn new(r: Spectrum, t: Spectrum, alpha: [f32; 2], losses: &'a BoundaryLosses) -> Self {
        let [x, y] = alpha;
        let spread = (losses.eta() - 1.0).abs();
        let bends = Ggx::or_smooth([x * spread, y * spread]).rough().is_some();
        let ggx = Ggx::or_smooth(if bends { alpha } else { [0.0; 2] });
        let fits = ggx.rough().is_none_or(|ggx| losses.side(false).are_of(false, &ggx));
        debug_assert!(fits, "losses of another surface");
        let means = losses.means(&ggx);
        let (r, t, crossing) = (r.to_array(), t.to_array(), losses.crossing(means));
        Self { r, t, ggx, means, crossing, losses }
    }

    /// `None` if the surface is smooth.
    #[inline]
    fn view(&self, wo: Vec3) -> Option<View> {
        let (ggx, is_below) = (self.ggx.rough()?, wo.z < 0.0);
        let [up, _] = above([wo.into(), wo.into()]);
        let lost = self.losses.side(is_below).at(&ggx, up);
        Some(View { wo: up.into(), is_below, eta: relative(self.losses.eta(), wo), lost })
    }

    /// Value and density, where `wi` is mirrored with `wo`.
    #[inline(always)]
    fn value_and_density(&self, view: View, wi: Vec3) -> (Spectrum, f32) {
        let [single, multiple] = [self.single(view, wi), self.multiple(view, wi)];
        let color = Spectrum::from(if wi.z > 0.0 { self.r } else { self.t });
        (color * (single[0] + multiple[0]), (1.0 - view.lost) * single[1] + view.lost * multiple[1])
    }

    /// Value of single scattering and its density, without the colour.
    #[inline(always)]
    fn single(&self, View { wo, is_below, eta, .. }: View, wi: Vec3) -> [f32; 2] {
        // Visible normals, but for their area and the cosine.
        let visible = 2.0 / (wo.z + self.ggx.stretched_length(wo.into()));
        if wi.z > 0.0 {
            let sum = wo + wi;
            let [reflected, _] = boundary((0.5 * sum.length()).min(1.0), eta);
            let facets = reflected * self.ggx.distribution(sum.into());
            let seen = self.ggx.twice_the_visibility(wo.into(), wi.into());
            return [0.5 * facets * seen, 0.25 * facets * visible];
        }
        // As seen from above, so that exchanging the directions changes no bit but the factor η².
        let [a, b] = if is_below { [-wi, -wo] } else { [wo, wi] };
        let index = self.losses.eta();
        let sum = a + index * b;
        let sum = if sum.z < 0.0 { -sum } else { sum };
        let length2 = sum.length_squared();
        let m = sum / length2.sqrt();
        let [cos_a, cos_b] = [a.dot(m), -b.dot(m)];
        // Each side sees the facet from its own side.
        if !(length2 > 0.0 && cos_a > 0.0 && cos_b > 0.0) {
            return [0.0; 2];
        }
        // 1 - F, from both cosines.
        let [across, along] = [cos_a + index * cos_b, index * cos_a + cos_b];
        let both = 1.0 / (across * across) + 1.0 / (along * along);
        let transmitted = 2.0 * index * cos_a * cos_b * both;
        // dm/dwi is η² |wi · m| / (wo · m + η wi · m)², and the last is the length of the sum.
        let facets = transmitted * self.ggx.distribution(sum.into()) * cos_a * cos_b / length2;
        let seen = self.ggx.twice_the_visibility(a.into(), (-b).into());
        let f = 2.0 * facets * seen;
        if is_below {
            [f * index * index, facets * visible]
        } else {
            [f, facets * index * index * visible]
        }
    }

    /// Value of multiple scattering and its density, without the colour.
    #[inline(always)]
    fn multiple(&self, View { is_below, eta, lost, .. }: View, wi: Vec3) -> [f32; 2] {
        let (crossing, reflects) = (self.crossing[usize::from(is_below)], wi.z > 0.0);
        let far = if reflects { is_below } else { !is_below };
        let wi = Vec3::new(wi.x, wi.y, wi.z.abs());
        let (share, scale) = if reflects { (1.0 - crossing, 1.0) } else { (crossing, eta * eta) };
        let (mean, of_far) =
            (self.means[usize::from(far)], self.losses.side(far).at(&self.ggx, wi.into()));
        let f = if mean > 0.0 { share * lost * of_far / mean * FRAC_1_PI / scale } else { 0.0 };
        [f, share * Spread::new(self.ggx.mean_alpha()).pdf(wi.z)]
    }

    /// The surface as a specular one.
    #[inline]
    fn smooth(&self) -> FresnelSpecular {
        FresnelSpecular::new(self.r.into(), self.t.into(), self.losses.eta())
    }

    /// A direction as if wo were above, with wo above.
    #[inline]
    fn direction(&self, view: View, uc: f32, u: Vec2) -> Option<Vec3> {
        let View { wo, is_below, eta, lost } = view;
        if uc < lost {
            let (uc, crossing) = (uc / lost, self.crossing[usize::from(is_below)]);
            let wi = Spread::new(self.ggx.mean_alpha()).sample(u.to_array());
            return (wi.z > 0.0).then(|| flipped(uc < crossing, wi).into());
        }
        let uc = (uc - lost) / (1.0 - lost);
        let m: Vec3 = self.ggx.sample_visible(wo.into(), u.to_array()).into();
        let cos = wo.dot(m).min(1.0);
        let [reflected, cos_t] = boundary(cos, eta);
        let (wi, side) = if uc < reflected {
            (2.0 * cos * m - wo, 1.0)
        } else {
            ((cos / eta - cos_t) * m - wo / eta, -1.0)
        };
        (wi.z * side > 0.0).then(|| wi.normalize())
    }
}

impl BxDF for FresnelMicrofacet<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        let spread = match self.ggx.rough() {
            Some(_) => BxdfFlags::GLOSSY,
            None => BxdfFlags::SPECULAR,
        };
        BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION | spread
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.f_and_pdf(wo, wi).0
    }

    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        let Some(view) = self.view(wo) else { return self.smooth().sample_f(wo, uc, u) };
        let up = self.direction(view, uc, u)?;
        let (f, pdf) = self.value_and_density(view, up);
        let wi = flipped(view.is_below, up.into()).into();
        let event = BxdfSample::glossy(f, wi, pdf);
        (pdf > 0.0).then_some(if up.z > 0.0 { event } else { event.transmitted(view.eta) })
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.f_and_pdf(wo, wi).1
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        match self.view(wo) {
            Some(view) if wi.z != 0.0 => {
                let [_, wi] = above([wo.into(), wi.into()]);
                self.value_and_density(view, wi.into())
            }
            _ => (Spectrum::BLACK, 0.0),
        }
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.smooth().albedo_estimate(wo)
    }
}
