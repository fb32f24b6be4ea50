//! [`Losses`]: what single scattering loses on rough surfaces, integrated for the surface at hand.

use super::Ggx;
use super::azimuths::Azimuths;
use super::returned::{Interface, Lattice};
use super::row::{Row, position, split};
use crate::bxdf::fresnel::{Fresnel, boundary};
use crate::geometry::Xyz;
use crate::simd::Block;

/// For which roughness [`Losses`] are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roughnesses {
    /// One, along x and along y.
    Constant([f32; 2]),
    /// Any: 65 times the work. Where the two axes differ, the losses are those of their root mean square. If one is four times the other, white
    /// metal loses or gains up to 9 % for that, glass and a coat 20 %; beyond, metal 20 %, glass 26 %, a coat 53 %.
    Any,
}

/// The fraction of light from a direction that single scattering does not return: 1 - E(w), and its mean over directions.
///
/// Part of it is light that meets a second facet. [`MicrofacetReflection`](crate::bxdf::MicrofacetReflection) and
/// [`FresnelMicrofacet`](crate::bxdf::FresnelMicrofacet) return it by a smooth lobe in proportion to (1 - E(wo)) (1 - E(wi)), which
/// is reciprocal (Kelemen and Szirmay-Kalos 2001; Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks").
/// [`CoatedDiffuse`](crate::bxdf::CoatedDiffuse) sends it into the base.
///
/// It is integrated when it is made, so that it fits any index of refraction and any anisotropy: about 10 ms for a
/// [constant](Roughnesses::Constant) roughness, 0.2 s if it differs by axis, 1.1 s for such a boundary. A surface keeps it for all hits.
///
/// A white surface then returns all light within 1e-3 for indices between 1/2 and 2, and 1.2e-3 at an index of 4. If roughness differs by
/// axis, the error is 1.2e-3 up to a ratio of eight, and 2.5e-3 beyond.
#[derive(Clone, Debug)]
pub struct Losses {
    interface: Interface,
    roughnesses: Roughnesses,
    axis: Axis,
    /// For each roughness or azimuth of `axis`.
    rows: Vec<Row>,
    /// The mean over directions, cosine-weighted: one, or one for each roughness.
    means: Vec<f32>,
}

/// What the rows differ by.
#[derive(Clone, Copy, Debug)]
enum Axis {
    /// There is one.
    None,
    /// Roughness: see [`row_alpha`].
    Alpha,
    /// Direction around the normal.
    Azimuth(Azimuths),
    /// There is none: a smooth boundary.
    Smooth,
}

const ALPHA_ROWS: usize = 65;
impl Losses {
    /// Of facets that reflect all light: of a metal but for its colour.
    pub fn of_mirrors(roughnesses: Roughnesses) -> Self {
        Self::new(Interface { eta: None, transmits: false }, roughnesses)
    }

    /// Of a coat: what is not reflected. `eta` is the index of refraction below the surface, over that above it: at least 1. Below, total
    /// reflection has an edge that is not resolved.
    pub fn of_coat(eta: f32, roughnesses: Roughnesses) -> Self {
        let interface = Interface { eta: Some(eta), transmits: false };
        match roughnesses {
            Roughnesses::Constant(alpha) if Ggx::or_smooth(alpha).rough().is_none() => {
                let means = vec![mean_transmitted(eta)];
                Self { interface, roughnesses, axis: Axis::Smooth, rows: Vec::new(), means }
            }
            _ => Self::new(interface, roughnesses),
        }
    }

    pub(super) fn new(interface: Interface, roughnesses: Roughnesses) -> Self {
        let (axis, surfaces): (_, Vec<(Ggx, f32)>) = match roughnesses {
            Roughnesses::Constant(alpha) => {
                let (ggx, rows) = (Ggx::new(alpha), interface.azimuths());
                match Azimuths::new(ggx, rows) {
                    Some(azimuths) => {
                        let surface = |row| (ggx, azimuths.cos2_phi(row));
                        (Axis::Azimuth(azimuths), (0..rows).map(surface).collect())
                    }
                    None => (Axis::None, vec![(ggx, 1.0)]),
                }
            }
            Roughnesses::Any => {
                let surface = |row| (Ggx::new([row_alpha(row); 2]), 1.0);
                (Axis::Alpha, (0..ALPHA_ROWS).map(surface).collect())
            }
        };
        let lattice = Lattice::new();
        let rows: Vec<_> = surfaces
            .iter()
            .map(|&(ggx, cos2_phi)| Row::new(&lattice, interface, ggx, cos2_phi))
            .collect();
        let means =
            rows.iter().zip(&surfaces).map(|(row, &(ggx, cos2_phi))| row.mean(ggx, cos2_phi));
        let means = match axis {
            Axis::Azimuth(azimuths) => vec![azimuths.mean(&means.collect::<Vec<_>>())],
            _ => means.collect(),
        };
        Self { interface, roughnesses, axis, rows, means }
    }

    /// The index of refraction of a coat or a boundary; 1 of mirrors.
    #[inline]
    pub(in crate::bxdf) fn eta(&self) -> f32 {
        self.interface.eta.unwrap_or(1.0)
    }

    /// Whether they are those of mirrors, or else of a coat, with this roughness.
    pub(in crate::bxdf) fn are_of(&self, mirrors: bool, ggx: &Ggx) -> bool {
        let is_rough_so = match self.roughnesses {
            Roughnesses::Constant(alpha) => Ggx::new(alpha) == *ggx,
            Roughnesses::Any => true,
        };
        // A roughness that is not a number gives values that are counted.
        self.interface.eta.is_none() == mirrors && (is_rough_so || ggx.mean_alpha().is_nan())
    }

    /// At a direction above the surface.
    #[inline(always)]
    pub(in crate::bxdf) fn at<F: Block>(&self, ggx: &Ggx<F>, w: Xyz<F>) -> F {
        let zero = F::splat(0.0);
        if let Axis::Smooth = self.axis {
            return F::splat(1.0) - boundary(w.z, F::splat(self.eta()))[0];
        }
        let position = position(w.z, ggx.stretched_length(w));
        match self.axis {
            Axis::None | Axis::Smooth => position.each(|position| self.rows[0].at(position)),
            Axis::Alpha => position.zip_each(ggx.mean_alpha(), |position, alpha| {
                self.between(alpha_row(alpha), position)
            }),
            Axis::Azimuth(azimuths) => {
                let [x2, y2] = [w.x * w.x, w.y * w.y];
                let sum = x2 + y2;
                let cos2_phi = F::select(sum.gt(zero), x2 / sum, zero);
                position.zip_each(cos2_phi, |position, cos2_phi| {
                    self.between(azimuths.row(cos2_phi), position)
                })
            }
        }
    }

    /// Between a row and the next.
    #[inline(always)]
    fn between(&self, (row, share): (usize, f32), position: f32) -> f32 {
        let lost = self.rows[row].at(position);
        if share > 0.0 { lost + share * (self.rows[row + 1].at(position) - lost) } else { lost }
    }

    /// The cosine-weighted mean over directions.
    #[inline(always)]
    pub(in crate::bxdf) fn mean<F: Block>(&self, ggx: &Ggx<F>) -> F {
        let Axis::Alpha = self.axis else { return F::splat(self.means[0]) };
        ggx.mean_alpha().each(|alpha| {
            let (row, share) = alpha_row(alpha);
            self.means[row] + share * (self.means[row + 1] - self.means[row])
        })
    }
}

/// The roughness of a row.
fn row_alpha(row: usize) -> f32 {
    let root = row as f32 / (ALPHA_ROWS - 1) as f32;
    Ggx::MIN_ALPHA + (1.0 - Ggx::MIN_ALPHA) * root * root
}

/// The row before a roughness, and where it stands between that and the next.
#[inline]
fn alpha_row(alpha: f32) -> (usize, f32) {
    let square = (alpha - Ggx::MIN_ALPHA) / (1.0 - Ggx::MIN_ALPHA);
    split(square.max(0.0).sqrt() * (ALPHA_ROWS - 1) as f32, ALPHA_ROWS)
}

/// The fraction that a smooth boundary transmits of light from all directions above.
pub(super) fn mean_transmitted(eta: f32) -> f32 {
    1.0 - Fresnel::Dielectric { eta }.mean().max_component()
}
