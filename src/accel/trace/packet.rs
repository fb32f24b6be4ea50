//! [`Packet`]: sixteen rays of similar direction, against one box or one triangle at a time.

use glam::Vec3A;

use super::hit::Hit;
use super::leaf_test::{LeafTest, intersect_triangle};
use super::watertight::{depth_error_bound, edge_function, sheared};
use crate::accel::tree::{Bvh, Leaf, Node};
use crate::geometry::Ray;
use crate::shape::{ShearedRay, TriangleHit};
use crate::simd::{LANES, Lanes, Mask, Vector, splat3};

/// Sixteen rays whose directions have the same largest axis, with the same sign, and the nearest hit of each so far. Each
/// lane computes what [`ShearedRay`] computes, to the bit.
pub struct Packet<'a, L> {
    rays: &'a [Ray; LANES],
    /// The axes that become x, y and z, the same for all rays.
    pub axes: [usize; 3],
    /// Whether the directions are negative along z.
    pub backwards: bool,
    pub o: [L; 3],
    pub d: [L; 3],
    pub shear: [L; 3],
    t_min: L,
    /// Where each ray ends, or hits the nearest triangle so far.
    pub t_max: L,
    /// The edge functions of that triangle, and their sum, by which they are divided in the end.
    edges: [L; 3],
    determinant: L,
    /// The id of that triangle, as the bits of an f32.
    ids: L,
}

/// Rays with an origin farther away than this are traced one by one.
const MAX_DISTANCE: f32 = 1e30;

/// The id of no triangle.
const NONE: u32 = u32::MAX;

impl<'a, L: Lanes> Packet<'a, L> {
    /// The packet; none if the rays do not have the same axis and sign, or are not finite.
    #[inline(always)]
    pub fn new(rays: &'a [Ray; LANES]) -> Option<Self> {
        let [ox, oy, oz, t_min, dx, dy, dz, t_max] = L::transpose(bytemuck::cast_ref(rays));
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
        // Then no sum, product or quotient that a frustum is made from is NaN.
        let distance = o[0].abs().add(o[1].abs()).add(o[2].abs());
        let finite = distance.lt(L::splat(MAX_DISTANCE))
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
        let ids = L::splat(f32::from_bits(NONE));
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
            ids,
        })
    }

    /// The rays that may enter the box of a slot before their nearest hit.
    #[inline(always)]
    pub fn enters(&self, node: &Node, slot: usize, padding: L) -> Mask {
        let [x, y, z] = self.axes;
        let low = |axis: usize| L::splat(node.planes[axis % 3][slot % LANES]);
        let high = |axis: usize| L::splat(node.planes[axis % 3 + 3][slot % LANES]);
        let (low_z, high_z) =
            (low(z).sub(self.o[2]).sub(padding), high(z).sub(self.o[2]).add(padding));
        let near_t = (if self.backwards { high_z } else { low_z }).mul(self.shear[2]);
        // How far x and y of each ray move until it passes both ends of the box in z.
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

    /// The lanes of the triangles of a leaf that one ray may hit before its nearest hit.
    #[inline(always)]
    pub fn candidates_of(&self, leaf: Leaf, ray: u32) -> Mask {
        if leaf.fits::<L::Narrow>() {
            return self.candidates(leaf, |x| x.broadcast_narrow(ray));
        }
        self.candidates(leaf, |x| x.broadcast(ray))
    }

    /// The same for the ray whose numbers `broadcast` puts into vectors.
    #[inline(always)]
    fn candidates<V: Vector>(&self, leaf: Leaf, broadcast: impl Fn(L) -> V) -> Mask {
        let three = |[x, y, z]: [L; 3]| [broadcast(x), broadcast(y), broadcast(z)];
        let (o, shear, t_min) = (three(self.o), three(self.shear), broadcast(self.t_min));
        let test = LeafTest { axes: self.axes, o, shear, t_min };
        test.candidates(leaf, broadcast(self.t_max)).map_or(0, |candidates| candidates.lanes)
    }

    /// Tests all rays against one triangle of a leaf; returns those for which it is the nearest hit so far.
    #[inline(always)]
    pub fn intersect(&mut self, leaf: Leaf, lane: u32) -> Mask {
        // The corners in the space of each ray, where it starts at the origin and runs along z.
        let id = leaf.id(lane);
        let corners = leaf.corners_of(lane);
        let z = self.translated(leaf, corners, 2);
        let x = sheared(self.translated(leaf, corners, 0), self.shear[0], z);
        let y = sheared(self.translated(leaf, corners, 1), self.shear[1], z);
        let (a, b, c) = ([x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]);
        let (e0, e1, e2) = (
            edge_function(x[1], y[1], x[2], y[2]),
            edge_function(x[2], y[2], x[0], y[0]),
            edge_function(x[0], y[0], x[1], y[1]),
        );
        let zero = L::splat(0.0);
        let on_edge = e0.eq(zero) | e1.eq(zero) | e2.eq(zero);
        let inside = (zero.le(e0.min(e1.min(e2))) | e0.max(e1.max(e2)).le(zero)) & !on_edge;
        let mut all = 0;
        if inside != 0 {
            let determinant = e0.add(e1).add(e2);
            let depth = e0.mul(a[2]).add(e1.mul(b[2])).add(e2.mul(c[2])).div(determinant);
            let t = depth.mul(self.shear[2]);
            let mut hit = inside & self.t_min.le(t) & t.le(self.t_max) & zero.lt(t);
            if hit != 0 {
                hit &= depth_error_bound([a, b, c], [e0, e1, e2], determinant).lt(depth.abs());
                // Of two at the same distance the one with the lower id counts.
                hit &= t.lt(self.t_max) | self.with_larger_id(id, hit & t.eq(self.t_max));
                self.set_hits(hit, t, [e0, e1, e2], determinant, id);
                all = hit;
            }
        }
        if on_edge != 0 {
            all |= self.intersect_scalar(leaf, lane, id, on_edge);
        }
        all
    }

    /// One coordinate of each corner of a triangle, seen from the origin of each ray.
    #[inline(always)]
    fn translated(&self, leaf: Leaf, corners: [usize; 3], i: usize) -> [L; 3] {
        let [a, b, c] = leaf.coordinates(corners, self.axes[i]);
        let o = self.o[i];
        [L::splat(a).sub(o), L::splat(b).sub(o), L::splat(c).sub(o)]
    }

    #[inline(always)]
    fn set_hits(&mut self, rays: Mask, t: L, e: [L; 3], determinant: L, id: u32) {
        self.t_max = self.t_max.blend(rays, t);
        self.edges = [
            self.edges[0].blend(rays, e[0]),
            self.edges[1].blend(rays, e[1]),
            self.edges[2].blend(rays, e[2]),
        ];
        self.determinant = self.determinant.blend(rays, determinant);
        self.ids = self.ids.blend(rays, L::splat(f32::from_bits(id)));
    }

    /// Those of some rays that have no hit yet, or one with a larger id.
    #[inline(always)]
    fn with_larger_id(&self, id: u32, rays: Mask) -> Mask {
        if rays == 0 {
            return 0;
        }
        let ids = self.ids.to_array();
        let is_larger = |i: usize| Mask::from(id < ids[i].to_bits()) << i;
        rays & (0..LANES).fold(0, |mask, i| mask | is_larger(i))
    }

    /// Tests rays with an edge function of zero one by one, which takes f64.
    #[inline(always)]
    fn intersect_scalar(&mut self, leaf: Leaf, lane: u32, id: u32, mut rays: Mask) -> Mask {
        let mut all = 0;
        while rays != 0 {
            let i = rays.trailing_zeros();
            rays &= rays - 1;
            if let Some(hit) = intersect_out_of_line(&self.ray(i), leaf, lane) {
                all |= Mask::from(self.set_hit(i, hit.t, hit.b, id)) << i;
            }
        }
        all
    }

    /// Whether another packet has the same axes and sign.
    #[inline(always)]
    pub fn is_aligned_with(&self, other: &Self) -> bool {
        self.axes == other.axes && self.backwards == other.backwards
    }

    /// The axes along which the first ray's direction is negative, x lowest.
    #[inline(always)]
    pub fn octant(&self) -> u32 {
        Vec3A::from(self.rays[0].d).is_negative_bitmask()
    }

    /// Where each ray ends along z, relative to `base`.
    #[inline(always)]
    pub fn end(&self, base: L) -> L {
        self.o[2].sub(base).add(self.t_max.mul(self.d[2]))
    }

    /// One ray, up to its nearest hit.
    #[inline(always)]
    pub fn ray(&self, i: u32) -> Ray {
        Ray { t_max: self.t_max.lane(i), ..self.rays[i as usize % LANES] }
    }

    /// Records a hit of one ray, if it is nearer than its nearest so far; returns whether it is.
    #[inline(always)]
    pub fn set_hit(&mut self, i: u32, t: f32, b: [f32; 3], id: u32) -> bool {
        let is_nearer = t < self.t_max.lane(i) || self.with_larger_id(id, 1 << i) != 0;
        if is_nearer {
            // Barycentrics are edge functions that are divided already.
            self.set_hits(1 << i, L::splat(t), splat3(b), L::splat(1.0), id);
        }
        is_nearer
    }

    /// Ends rays, so that they hit nothing more.
    #[inline(always)]
    pub fn terminate(&mut self, rays: Mask) {
        self.t_max = self.t_max.blend(rays, L::splat(f32::NEG_INFINITY));
    }

    /// The rays that have hit something.
    #[inline(always)]
    pub fn any_hit(&self) -> Mask {
        let ids = self.ids.to_array();
        (0..LANES).fold(0, |mask, i| mask | Mask::from(ids[i].to_bits() != NONE) << i)
    }

    /// The nearest hit of each ray.
    #[inline(always)]
    pub fn hits(&self, bvh: &Bvh, hits: &mut [Hit; LANES]) {
        let [e0, e1, e2] = self.edges;
        let (e0, e1) = (e0.div(self.determinant), e1.div(self.determinant));
        let b = [e0.to_array(), e1.to_array(), e2.div(self.determinant).to_array()];
        let (t, ids) = (self.t_max.to_array(), self.ids.to_array());
        let id = |i: usize| ids[i].to_bits();
        for (i, hit) in hits.iter_mut().enumerate() {
            // As if there was only one shape, which is the common case.
            let (t, shape) = if id(i) == NONE { (f32::INFINITY, u32::MAX) } else { (t[i], 0) };
            *hit = Hit { t, b: [b[0][i], b[1][i], b[2][i]], shape, triangle: id(i) };
        }
        if bvh.first_ids.len() > 1 {
            for hit in hits.iter_mut().filter(|hit| hit.is_hit()) {
                (hit.shape, hit.triangle) = bvh.shape_and_triangle(hit.triangle);
            }
        }
    }
}

/// The scalar test, out of line so that it does not spill the vectors of the caller.
#[cold]
#[inline(never)]
fn intersect_out_of_line(ray: &Ray, leaf: Leaf, lane: u32) -> Option<TriangleHit> {
    intersect_triangle(&ShearedRay::new(ray), leaf, lane, ray.t_min, ray.t_max)
}
