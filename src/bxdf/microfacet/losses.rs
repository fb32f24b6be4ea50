//! [`Losses`]: what single scattering loses on rough surfaces, integrated for the surface at hand.

use glam::Vec3;

use super::Ggx;
use crate::bxdf::fresnel::boundary;
use crate::geometry::Xyz;
use crate::simd::{Block, BlockKernel, Float, InstructionSet};

/// For which roughness [`Losses`] are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roughnesses {
    /// One, along x and along y.
    Constant([f32; 2]),
    /// Any: 65 times the work. Where the two axes differ, the losses are those of their root mean square: a white surface loses or gains up to 5 %
    /// where one is four times the other, 14 % at ten times, and 20 % beyond.
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
/// [constant](Roughnesses::Constant) roughness, 0.1 s if it differs by axis, 0.6 s for such a boundary. A surface keeps it for all hits. The largest error is 6e-4, for an
/// anisotropic boundary 2e-3, and 5e-3 if its roughnesses differ by more than a factor of ten.
#[derive(Clone, Debug)]
pub struct Losses {
    axis: Axis,
    /// At equal distances of [`position`], for each roughness or direction of `axis`.
    rows: Vec<[f32; NODES]>,
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
    Turn(Turns),
    /// There is none: a smooth boundary with this index.
    Smooth(f32),
}

/// What reflects: mirrors, or a boundary.
#[derive(Clone, Copy)]
struct Interface {
    /// Index of refraction on the far side over that on the near side; `None` if all light is reflected.
    eta: Option<f32>,
    /// Whether refracted light counts as returned.
    transmits: bool,
}

const NODES: usize = 128;
const ALPHA_ROWS: usize = 65;
const TURN_ROWS: usize = 17;
/// Total reflection has edges.
const TURN_ROWS_OF_BOUNDARY: usize = 33;
/// Visible normals of each integral.
const SAMPLES: usize = 8192;

impl Losses {
    /// Of facets that reflect all light: of a metal but for its colour.
    pub fn of_mirrors(roughnesses: Roughnesses) -> Self {
        Self::new(Interface { eta: None, transmits: false }, roughnesses)
    }

    /// Of a coat: what is not reflected. `eta` is the index of refraction below the surface, over that above it: above 0.
    pub fn of_coat(eta: f32, roughnesses: Roughnesses) -> Self {
        match roughnesses {
            Roughnesses::Constant(alpha) if Ggx::or_smooth(alpha).rough().is_none() => {
                Self::smooth(eta)
            }
            _ => Self::new(Interface { eta: Some(eta), transmits: false }, roughnesses),
        }
    }

    fn new(interface: Interface, roughnesses: Roughnesses) -> Self {
        let (axis, surfaces): (_, Vec<(Ggx, f32)>) = match roughnesses {
            Roughnesses::Constant(alpha) if Ggx::new(alpha).is_isotropic() => {
                (Axis::None, vec![(Ggx::new(alpha), 1.0)])
            }
            Roughnesses::Constant(alpha) => {
                let rows = if interface.transmits { TURN_ROWS_OF_BOUNDARY } else { TURN_ROWS };
                let (ggx, turns) = (Ggx::new(alpha), Turns::new(Ggx::new(alpha), rows));
                (Axis::Turn(turns), (0..rows).map(|row| (ggx, turns.of_row(row))).collect())
            }
            Roughnesses::Any => {
                let surface = |row| (Ggx::new([row_alpha(row); 2]), 1.0);
                (Axis::Alpha, (0..ALPHA_ROWS).map(surface).collect())
            }
        };
        let lattice = Lattice::new();
        let rows: Vec<_> =
            surfaces.iter().map(|&(ggx, turn)| row(&lattice, interface, ggx, turn)).collect();
        let means = rows.iter().zip(&surfaces).map(|(row, &(ggx, turn))| row_mean(row, ggx, turn));
        let means = match axis {
            Axis::Turn(turns) => vec![turns.mean(&means.collect::<Vec<_>>())],
            _ => means.collect(),
        };
        Self { axis, rows, means }
    }

    fn smooth(eta: f32) -> Self {
        // In steps of cos² θ, the mean is cosine-weighted.
        const STEPS: u32 = 1 << 14;
        let entering = |i: u32| {
            let cos = ((f64::from(i) + 0.5) / f64::from(STEPS)).sqrt();
            1.0 - boundary(cos, f64::from(eta))[0]
        };
        let mean = (0..STEPS).map(entering).sum::<f64>() / f64::from(STEPS);
        Self { axis: Axis::Smooth(eta), rows: Vec::new(), means: vec![mean as f32] }
    }

    /// At a direction above the surface.
    #[inline]
    pub(in crate::bxdf) fn at(&self, ggx: &Ggx, w: Vec3) -> f32 {
        let (row, share) = match self.axis {
            Axis::None => (0, 0.0),
            Axis::Alpha => alpha_row(ggx.mean_alpha()),
            Axis::Turn(turns) => {
                let [x2, y2] = [w.x * w.x, w.y * w.y];
                turns.row(if x2 + y2 > 0.0 { x2 / (x2 + y2) } else { 0.0 })
            }
            Axis::Smooth(eta) => return 1.0 - boundary(w.z, eta)[0],
        };
        let (node, within) = split(position(w.z, ggx.stretch(w.into())) * LAST, NODES);
        let of_row = |row: &[f32; NODES]| row[node] + within * (row[node + 1] - row[node]);
        let lost = of_row(&self.rows[row]);
        if share > 0.0 { lost + share * (of_row(&self.rows[row + 1]) - lost) } else { lost }
    }

    /// The cosine-weighted mean over directions.
    #[inline]
    pub(in crate::bxdf) fn mean(&self, ggx: &Ggx) -> f32 {
        let Axis::Alpha = self.axis else { return self.means[0] };
        let (row, share) = alpha_row(ggx.mean_alpha());
        self.means[row] + share * (self.means[row + 1] - self.means[row])
    }
}

/// [`Losses`] of both sides of a boundary between media that do not absorb, and how what is lost is divided between them.
#[derive(Clone, Debug)]
pub struct BoundaryLosses {
    sides: [Losses; 2],
    eta: f32,
    /// The mean fraction of light that a smooth boundary transmits from above.
    transmitted: f32,
}

impl BoundaryLosses {
    /// `eta` is the index of refraction below the surface, over that above it: above 0.
    pub fn new(eta: f32, roughnesses: Roughnesses) -> Self {
        let of = |eta| Losses::new(Interface { eta: Some(eta), transmits: true }, roughnesses);
        Self { sides: [of(eta), of(1.0 / eta)], eta, transmitted: Losses::smooth(eta).means[0] }
    }

    /// Index of refraction below the surface, over that above it.
    #[inline]
    pub(in crate::bxdf) fn eta(&self) -> f32 {
        self.eta
    }

    /// What is lost of light from above the surface, or from below, for directions as if they were above.
    #[inline]
    pub(in crate::bxdf) fn side(&self, is_below: bool) -> &Losses {
        &self.sides[usize::from(is_below)]
    }

    /// The fraction of what is lost from a side that leaves on the other one.
    ///
    /// Reciprocity asks for n² L̄ times it to be the same for both sides, where L̄ is the mean loss. It would be the mean transmittance
    /// of each if that were so; the mean of both products is taken, and at most what keeps either fraction below 1.
    #[inline]
    pub(in crate::bxdf) fn crossing(&self, ggx: &Ggx, is_below: bool) -> f32 {
        let eta2 = self.eta * self.eta;
        let [above, below] = [self.sides[0].mean(ggx), eta2 * self.sides[1].mean(ggx)];
        // Of a smooth boundary, n² times the transmitted fraction is the same for both sides.
        let [from_above, from_below] = [self.transmitted, self.transmitted / eta2];
        let both = 0.5 * (from_above * above + from_below * below);
        let both = both.min(above).min(below);
        let own = if is_below { below } else { above };
        if own > 0.0 { both / own } else { 0.0 }
    }
}

const LAST: f32 = (NODES - 1) as f32;

/// Where a direction stands among the nodes, in `[0, 1]`, from its cosine and s(w) of [`Ggx`].
///
/// Losses change with cos θ / s, along the surface over angles as small as the roughness, and with cos θ where indices differ little.
/// The roots are what makes them nearly straight lines along the surface.
#[inline]
fn position(cos: f32, stretch: f32) -> f32 {
    0.5 * ((cos / stretch).sqrt() + cos.sqrt().sqrt())
}

/// The cosine at a position, where `alpha` is the roughness in the plane of the direction and the normal.
fn cosine(at: f64, alpha: f64) -> f64 {
    let [mut low, mut high] = [0.0_f64, 1.0];
    for _ in 0..60 {
        let root = 0.5 * (low + high);
        let cos2 = root.powi(8);
        let stretch = (cos2 + alpha * alpha * (1.0 - cos2)).sqrt();
        let position = 0.5 * ((root.powi(4) / stretch).sqrt() + root);
        if position < at { low = root } else { high = root }
    }
    high.powi(4)
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

/// The index before a position among `count`, with another after it, and the fraction that remains.
#[inline]
fn split(at: f32, count: usize) -> (usize, f32) {
    let index = (at as usize).min(count - 2);
    (index, at - index as f32)
}

/// The roughness in the plane of directions with this cos² φ.
fn alpha_at(ggx: Ggx, turn: f32) -> f64 {
    let w = Vec3::new(turn.sqrt(), (1.0 - turn).sqrt(), 0.0);
    f64::from(ggx.stretch(w.into()))
}

fn row(lattice: &Lattice, interface: Interface, ggx: Ggx, turn: f32) -> [f32; NODES] {
    // At the horizon, all is returned.
    let mut row = [0.0; NODES];
    for (node, lost) in row.iter_mut().enumerate().skip(1) {
        let cos = cosine(node as f64 / f64::from(LAST), alpha_at(ggx, turn));
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt() as f32;
        let wo = Vec3::new(sin * turn.sqrt(), sin * (1.0 - turn).sqrt(), cos as f32);
        *lost = (1.0 - lattice.returned(interface, ggx, wo)).clamp(0.0, 1.0) as f32;
    }
    row
}

/// The mean of a row over cos² θ: the mean over directions, cosine-weighted. Between nodes, a row is linear in [`position`].
fn row_mean(row: &[f32; NODES], ggx: Ggx, turn: f32) -> f32 {
    const STEPS: usize = 8;
    let cos2_at = |step: usize| {
        cosine(step as f64 / (f64::from(LAST) * STEPS as f64), alpha_at(ggx, turn)).powi(2)
    };
    let (mut sum, mut from) = (0.0, 0.0);
    for step in 0..(NODES - 1) * STEPS {
        let to = cos2_at(step + 1);
        let [low, high] = [row[step / STEPS], row[step / STEPS + 1]].map(f64::from);
        let within = ((step % STEPS) as f64 + 0.5) / STEPS as f64;
        sum += (low + within * (high - low)) * (to - from);
        from = to;
    }
    sum as f32
}

/// Directions around the normal, of which each has another roughness α in its plane: α² = αx² cos² φ + αy² sin² φ. Rows are at equal steps of
/// ln α.
#[derive(Clone, Copy, Debug)]
struct Turns {
    alpha2: [f32; 2],
    /// ln of the smaller α², and the number of rows per unit from there.
    start: f32,
    scale: f32,
    rows: usize,
}

impl Turns {
    fn new(ggx: Ggx, rows: usize) -> Self {
        let alpha2 = [1.0, 0.0].map(|turn| alpha_at(ggx, turn).powi(2) as f32);
        let [start, end] = [alpha2[0].min(alpha2[1]).ln(), alpha2[0].max(alpha2[1]).ln()];
        Self { alpha2, start, scale: (rows - 1) as f32 / (end - start), rows }
    }

    /// The row before a direction with this cos² φ, and where it stands between that and the next.
    #[inline]
    fn row(&self, turn: f32) -> (usize, f32) {
        let [x, y] = self.alpha2;
        let at = ((x * turn + y * (1.0 - turn)).ln() - self.start) * self.scale;
        split(at.clamp(0.0, (self.rows - 1) as f32), self.rows)
    }

    /// cos² φ of a row.
    fn of_row(&self, row: usize) -> f32 {
        let [x, y] = self.alpha2;
        let alpha2 = (self.start + row as f32 / self.scale).exp();
        ((alpha2 - y) / (x - y)).clamp(0.0, 1.0)
    }

    /// The mean over φ of what is known for each row.
    fn mean(&self, of_rows: &[f32]) -> f32 {
        const STEPS: u32 = 4096;
        let at = |i: u32| {
            let phi = std::f32::consts::FRAC_PI_2 * (i as f32 + 0.5) / STEPS as f32;
            let (row, share) = self.row(phi.cos().powi(2));
            f64::from(of_rows[row] + share * (of_rows[row + 1] - of_rows[row]))
        };
        ((0..STEPS).map(at).sum::<f64>() / f64::from(STEPS)) as f32
    }
}

/// Points of the unit square: multiples of the golden ratio.
struct Lattice {
    u: [Vec<f32>; 2],
    set: InstructionSet,
}

impl Lattice {
    fn new() -> Self {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let even = |i| (i as f64 + 0.5) / SAMPLES as f64;
        let golden = |i| (0.5 + GOLDEN * i as f64).fract();
        let u = [
            (0..SAMPLES).map(|i| even(i) as f32).collect(),
            (0..SAMPLES).map(|i| golden(i) as f32).collect(),
        ];
        Self { u, set: InstructionSet::default() }
    }

    /// E(wo): the mean over visible normals of what each returns.
    fn returned(&self, interface: Interface, ggx: Ggx, wo: Vec3) -> f64 {
        let mut returned = vec![0.0; SAMPLES];
        let [u, v] = &self.u;
        self.set.run_block(Return { u, v, interface, ggx, wo, returned: &mut returned });
        // In the same order on all instruction sets.
        returned.iter().map(|&x| f64::from(x)).sum::<f64>() / SAMPLES as f64
    }
}

struct Return<'a> {
    u: &'a [f32],
    v: &'a [f32],
    interface: Interface,
    ggx: Ggx,
    wo: Vec3,
    returned: &'a mut [f32],
}

impl BlockKernel for Return<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let (ggx, wo) = (Ggx::splat(self.ggx), Xyz::splat(self.wo));
        for at in (0..SAMPLES).step_by(F::LANES) {
            let u = [F::load(&self.u[at..]), F::load(&self.v[at..])];
            let m = ggx.sample_visible(wo, u);
            returned(self.interface, ggx, wo, m).store(&mut self.returned[at..]);
        }
    }
}

/// What a facet that is seen from `wo` returns.
#[inline(always)]
fn returned<F: Float>(interface: Interface, ggx: Ggx<F>, wo: Xyz<F>, m: Xyz<F>) -> F {
    let zero = F::splat(0.0);
    let cos = wo.dot(m).max(zero).min(F::splat(1.0));
    let reflected = unmasked(ggx, wo, m * (cos + cos) - wo);
    let Some(eta) = interface.eta else { return reflected };
    let eta = F::splat(eta);
    let [fresnel, cos_t] = boundary(cos, eta);
    let mut sum = fresnel * reflected;
    if interface.transmits {
        let refracted = m * (cos / eta - cos_t) - wo / eta;
        let mirrored = Xyz { z: -refracted.z, ..refracted };
        sum = sum + (F::splat(1.0) - fresnel) * unmasked(ggx, wo, mirrored);
    }
    sum
}

/// The fraction of light from a facet that is seen from `wo` that leaves towards `wi`: G(wo, wi) / G1(wo), 0 below the surface.
#[inline(always)]
fn unmasked<F: Float>(ggx: Ggx<F>, wo: Xyz<F>, wi: Xyz<F>) -> F {
    let leaves = (wo.z + ggx.stretch(wo)) * wi.z * ggx.seen_by_both(wo, wi);
    F::select(wi.z.gt(F::splat(0.0)), leaves, F::splat(0.0))
}
