//! [`Packet`]: sixteen rays that go much the same way, against triangles one by one.

use glam::Vec3A;

use super::edges::{edge, least_depth, sheared};
use super::lanes::{LANES, Lanes, Mask, Vector, splat3};
use super::needle::{Needle, hit};
use super::node::Node;
use super::triangles::Leaf;
use super::{Accel, Hit};
use crate::geometry::Ray;
use crate::shape::{ShearedRay, TriangleHit};

/// Sixteen rays that are longest in the same axis and run along it in the same sense, with the nearest hit
/// of each so far. Each lane computes what [`ShearedRay`] computes, to the bit.
pub struct Packet<'a, L> {
    rays: &'a [Ray; LANES],
    /// The axes that become x, y and z, as of each ray.
    pub axes: [usize; 3],
    /// Whether the rays run along z backwards.
    pub backwards: bool,
    pub o: [L; 3],
    pub d: [L; 3],
    pub shear: [L; 3],
    t_min: L,
    /// Where the ray ends, or meets the nearest triangle so far.
    pub t_max: L,
    /// The edge functions of that triangle, and their sum.
    edges: [L; 3],
    determinant: L,
    /// Its number, as the bits of an f32.
    number: L,
}

/// Rays from farther away walk alone.
const FARTHEST: f32 = 1e30;

/// The number of no triangle.
const NONE: u32 = u32::MAX;

impl<'a, L: Lanes> Packet<'a, L> {
    /// The packet, if the rays make one.
    #[inline(always)]
    pub fn new(rays: &'a [Ray; LANES]) -> Option<Self> {
        let [ox, oy, oz, t_min, dx, dy, dz, t_max] = L::transposed(rays);
        let axes = ShearedRay::axes_of(&rays[0]);
        let (o, d) = ([ox, oy, oz], [dx, dy, dz]);
        // The rule of `ShearedRay::axes_of` for all rays at once.
        let size = [dx.abs(), dy.abs(), dz.abs()];
        let longest = match axes[2] {
            0 => size[1].lt(size[0]) & size[2].lt(size[0]),
            1 => !(size[1].lt(size[0]) & size[2].lt(size[0])) & size[2].lt(size[1]),
            _ => !(size[1].lt(size[0]) & size[2].lt(size[0])) & !size[2].lt(size[1]),
        };
        let [x, y, z] = axes;
        let (o, d) = ([o[x], o[y], o[z]], [d[x], d[y], d[z]]);
        let zero = L::splat(0.0);
        let forwards = zero.lt(d[2]);
        // Numbers that a frustum can be made from: no sum, product or quotient of theirs is NaN.
        let distance = o[0].abs().add(o[1].abs()).add(o[2].abs());
        let finite = distance.lt(L::splat(FARTHEST))
            & zero.lt(d[2].abs())
            & d[2].abs().lt(L::splat(f32::INFINITY))
            & d[0].abs().le(d[2].abs())
            & d[1].abs().le(d[2].abs())
            & t_max.eq(t_max);
        if longest & finite != Mask::MAX || forwards != 0 && forwards != Mask::MAX {
            return None;
        }
        let shear = [
            L::splat(-0.0).sub(d[0]).div(d[2]),
            L::splat(-0.0).sub(d[1]).div(d[2]),
            L::splat(1.0).div(d[2]),
        ];
        let number = L::splat(f32::from_bits(NONE));
        let backwards = forwards == 0;
        Some(Self {
            rays,
            axes,
            backwards,
            o,
            d,
            shear,
            t_min,
            t_max,
            edges: [zero; 3],
            determinant: L::splat(1.0),
            number,
        })
    }

    /// Which rays may meet the box of a slot, before the nearest hit of each.
    #[inline(always)]
    pub fn enters(&self, node: &Node, slot: usize, padding: L) -> Mask {
        let [x, y, z] = self.axes;
        let low = |axis: usize| L::splat(node.planes[axis % 3][slot % LANES]);
        let high = |axis: usize| L::splat(node.planes[axis % 3 + 3][slot % LANES]);
        let (low_z, high_z) =
            (low(z).sub(self.o[2]).sub(padding), high(z).sub(self.o[2]).add(padding));
        let near_t = (if self.backwards { high_z } else { low_z }).mul(self.shear[2]);
        // Where each ray is when it passes both ends of the box in z.
        let (low_x, high_x) = (self.shear[0].mul(low_z), self.shear[0].mul(high_z));
        let (low_y, high_y) = (self.shear[1].mul(low_z), self.shear[1].mul(high_z));
        let (from_x, to_x) =
            (low(x).sub(self.o[0]).sub(padding), high(x).sub(self.o[0]).add(padding));
        let (from_y, to_y) =
            (low(y).sub(self.o[1]).sub(padding), high(y).sub(self.o[1]).add(padding));
        let zero = L::splat(0.0);
        zero.le(to_x.add(low_x.max(high_x)))
            & from_x.add(low_x.min(high_x)).le(zero)
            & zero.le(to_y.add(low_y.max(high_y)))
            & from_y.add(low_y.min(high_y)).le(zero)
            & !self.t_max.lt(near_t)
    }

    /// Which triangles of a leaf one ray may meet before what it met so far.
    #[inline(always)]
    pub fn meets(&self, leaf: Leaf, ray: u32) -> Mask {
        if leaf.fits::<L::Narrow>() {
            let spread = |x: L| x.spread_narrow(ray);
            return self.needle(spread).meets(leaf, spread(self.t_max)).map_or(0, |met| met.lanes);
        }
        let spread = |x: L| x.spread(ray);
        self.needle(spread).meets(leaf, spread(self.t_max)).map_or(0, |met| met.lanes)
    }

    /// One ray, of whose numbers `spread` makes vectors.
    #[inline(always)]
    fn needle<V: Vector>(&self, spread: impl Fn(L) -> V) -> Needle<V> {
        let three = |[x, y, z]: [L; 3]| [spread(x), spread(y), spread(z)];
        let (o, shear) = (three(self.o), three(self.shear));
        Needle { axes: self.axes, o, shear, t_min: spread(self.t_min) }
    }

    /// Tests one triangle of a leaf; which rays meet it before what they met so far.
    #[inline(always)]
    pub fn meet(&mut self, leaf: Leaf, lane: u32, number: u32) -> Mask {
        // The corners in the space of each ray, where it starts at the origin and runs along z.
        let corners = leaf.corners_of(lane);
        let z = self.moved(leaf, corners, 2);
        let x = sheared(self.moved(leaf, corners, 0), self.shear[0], z);
        let y = sheared(self.moved(leaf, corners, 1), self.shear[1], z);
        let (a, b, c) = ([x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]);
        let (e0, e1, e2) = (
            edge(x[1], y[1], x[2], y[2]),
            edge(x[2], y[2], x[0], y[0]),
            edge(x[0], y[0], x[1], y[1]),
        );
        let zero = L::splat(0.0);
        let unsure = e0.eq(zero) | e1.eq(zero) | e2.eq(zero);
        let inside = (zero.le(e0.min(e1.min(e2))) | e0.max(e1.max(e2)).le(zero)) & !unsure;
        let mut all = 0;
        if inside != 0 {
            let determinant = e0.add(e1).add(e2);
            let depth = e0.mul(a[2]).add(e1.mul(b[2])).add(e2.mul(c[2])).div(determinant);
            let t = depth.mul(self.shear[2]);
            let mut met = inside & self.t_min.le(t) & t.le(self.t_max) & zero.lt(t);
            if met != 0 {
                met &= least_depth([a, b, c], [e0, e1, e2], determinant).lt(depth.abs());
                // Of two at the same distance the first triangle counts.
                met &= t.lt(self.t_max) | self.numbered_above(number, met & t.eq(self.t_max));
                self.keep(met, t, [e0, e1, e2], determinant, number);
                all = met;
            }
        }
        if unsure != 0 {
            all |= self.meet_singly(leaf, lane, number, unsure);
        }
        all
    }

    /// One coordinate of each corner of a triangle, seen from the origin of each ray.
    #[inline(always)]
    fn moved(&self, leaf: Leaf, corners: [usize; 3], i: usize) -> [L; 3] {
        let [a, b, c] = leaf.coordinates(corners, self.axes[i]);
        let o = self.o[i];
        [L::splat(a).sub(o), L::splat(b).sub(o), L::splat(c).sub(o)]
    }

    #[inline(always)]
    fn keep(&mut self, met: Mask, t: L, e: [L; 3], determinant: L, number: u32) {
        self.t_max = self.t_max.or(met, t);
        self.edges =
            [self.edges[0].or(met, e[0]), self.edges[1].or(met, e[1]), self.edges[2].or(met, e[2])];
        self.determinant = self.determinant.or(met, determinant);
        self.number = self.number.or(met, L::splat(f32::from_bits(number)));
    }

    /// The lanes of `of` that have met nothing, or a triangle with a larger number.
    #[inline(always)]
    fn numbered_above(&self, number: u32, of: Mask) -> Mask {
        if of == 0 {
            return 0;
        }
        let numbers = self.number.to_array();
        let is_above = |i: usize| Mask::from(number < numbers[i].to_bits()) << i;
        of & (0..LANES).fold(0, |mask, i| mask | is_above(i))
    }

    /// Tests rays for which an edge function is zero, which takes f64.
    #[inline(always)]
    fn meet_singly(&mut self, leaf: Leaf, lane: u32, number: u32, mut rays: Mask) -> Mask {
        let mut all = 0;
        while rays != 0 {
            let i = rays.trailing_zeros();
            rays &= rays - 1;
            if let Some(hit) = hit_apart(&self.ray(i), leaf, lane) {
                all |= Mask::from(self.keep_one(i, hit.t, hit.b, number)) << i;
            }
        }
        all
    }

    /// Whether another packet has the same axes and runs along z the same way.
    #[inline(always)]
    pub fn runs_like(&self, other: &Self) -> bool {
        self.axes == other.axes && self.backwards == other.backwards
    }

    /// Which axes the first ray runs along backwards, x lowest.
    #[inline(always)]
    pub fn octant(&self) -> u32 {
        Vec3A::from(self.rays[0].d).is_negative_bitmask()
    }

    /// Where z ends for each ray, seen from `base`.
    #[inline(always)]
    pub fn end(&self, base: L) -> L {
        self.o[2].sub(base).add(self.t_max.mul(self.d[2]))
    }

    /// One ray, as far as it has met nothing.
    #[inline(always)]
    pub fn ray(&self, i: u32) -> Ray {
        Ray { t_max: self.t_max.lane(i), ..self.rays[i as usize % LANES] }
    }

    /// Keeps what one ray met, if it is before what it met so far; whether it is.
    #[inline(always)]
    pub fn keep_one(&mut self, i: u32, t: f32, b: [f32; 3], number: u32) -> bool {
        let is_before = t < self.t_max.lane(i) || self.numbered_above(number, 1 << i) != 0;
        if is_before {
            // The weights are edge functions divided already.
            self.keep(1 << i, L::splat(t), splat3(b), L::splat(1.0), number);
        }
        is_before
    }

    /// Lets rays end that have met anything, so that they meet nothing more.
    #[inline(always)]
    pub fn end_met(&mut self, rays: Mask) {
        self.t_max = self.t_max.or(rays, L::splat(f32::NEG_INFINITY));
    }

    /// Which rays have met something.
    #[inline(always)]
    pub fn met(&self) -> Mask {
        let numbers = self.number.to_array();
        (0..LANES).fold(0, |mask, i| mask | Mask::from(numbers[i].to_bits() != NONE) << i)
    }

    /// What the rays hit.
    #[inline(always)]
    pub fn hits(&self, accel: &Accel, hits: &mut [Hit; LANES]) {
        let [e0, e1, e2] = self.edges;
        let (e0, e1) = (e0.div(self.determinant), e1.div(self.determinant));
        let b = [e0.to_array(), e1.to_array(), e2.div(self.determinant).to_array()];
        let (t, numbers) = (self.t_max.to_array(), self.number.to_array());
        let number = |i: usize| numbers[i].to_bits();
        for (i, hit) in hits.iter_mut().enumerate() {
            // As if all triangles were of the first shape, which they mostly are.
            let (t, shape) = if number(i) == NONE { (f32::INFINITY, u32::MAX) } else { (t[i], 0) };
            *hit = Hit { t, b: [b[0][i], b[1][i], b[2][i]], shape, triangle: number(i) };
        }
        if accel.shapes.len() > 1 {
            for hit in hits.iter_mut().filter(|hit| hit.is_hit()) {
                (hit.shape, hit.triangle) = accel.triangle_of(hit.triangle);
            }
        }
    }
}

/// The test of one triangle, out of the way of the vectors.
#[cold]
#[inline(never)]
fn hit_apart(ray: &Ray, leaf: Leaf, lane: u32) -> Option<TriangleHit> {
    hit(&ShearedRay::new(ray), leaf, lane, ray.t_min, ray.t_max)
}
