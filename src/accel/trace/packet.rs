//! [`Packet`]: sixteen rays of similar direction, against one box or one triangle at a time.

use super::leaf_test::{candidates, intersect_triangle};
use super::space::World;
use crate::accel::tree::{Bvh, Leaf, Node};
use crate::geometry::Ray;
use crate::interaction::Hit;
use crate::shape::{Crossing, Edges, Reach, ShearedRay, TriangleHit, longest_axis};
use crate::simd::{ARITY, Block, LANES, LaneMask, Lanes, Mask, splat3};

/// Sixteen rays whose directions have the same largest axis, with the same sign, and the nearest hit of each so far.
pub struct Packet<'a, L> {
    rays: &'a [Ray; LANES],
    /// All of them, along the same axes.
    pub sheared: ShearedRay<L>,
    /// Whether the directions are negative along z.
    pub backwards: bool,
    /// z of the directions.
    d_z: L,
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
        let [ox, oy, oz, t_min, dx, dy, dz, t_max] = L::gather(|i| bytemuck::cast_ref(&rays[i]));
        let axes = ShearedRay::axes_of(&rays[0]);
        let (o, d) = ([ox, oy, oz], [dx, dy, dz]);
        let [x_longest, y_before_z] = longest_axis(d);
        let longest = match axes[2] {
            0 => x_longest,
            1 => !x_longest & y_before_z,
            _ => !x_longest & !y_before_z,
        };
        let [x, y, z] = axes;
        let (o, d) = ([o[x], o[y], o[z]], [d[x], d[y], d[z]]);
        let zero = L::splat(0.0);
        let forwards = d[2].gt(zero);
        // Then no sum, product or quotient that a frustum is made from is NaN.
        let distance = o[0].abs() + o[1].abs() + o[2].abs();
        let finite = distance.lt(L::splat(MAX_DISTANCE))
            & d[2].abs().gt(zero)
            & d[2].abs().lt(L::splat(f32::INFINITY))
            & d[0].abs().le(d[2].abs())
            & d[1].abs().le(d[2].abs())
            & t_max.eq(t_max);
        if !(longest & finite).all() || forwards.any() && !forwards.all() {
            return None;
        }
        Some(Self {
            rays,
            sheared: ShearedRay::permuted(axes, o, d),
            backwards: !forwards.any(),
            d_z: d[2],
            t_min,
            t_max,
            edges: [zero; 3],
            determinant: L::splat(1.0),
            ids: L::splat(f32::from_bits(NONE)),
        })
    }

    /// The rays that may enter the box of a slot before their nearest hit.
    #[inline(always)]
    pub fn enters(&self, node: &Node, slot: usize, padding: L) -> Mask {
        let shear = &self.sheared.shear;
        let [low_x, high_x] = self.extent(node, slot, 0, padding);
        let [low_y, high_y] = self.extent(node, slot, 1, padding);
        let [low_z, high_z] = self.extent(node, slot, 2, padding);
        let near_t = (if self.backwards { high_z } else { low_z }) * shear[2];
        // How far x and y of each ray move until it passes both ends of the box in z.
        let (x0, x1) = (shear[0] * low_z, shear[0] * high_z);
        let (y0, y1) = (shear[1] * low_z, shear[1] * high_z);
        let zero = L::splat(0.0);
        let met = (high_x + x0.max(x1)).ge(zero)
            & (low_x + x0.min(x1)).le(zero)
            & (high_y + y0.max(y1)).ge(zero)
            & (low_y + y0.min(y1)).le(zero)
            & !self.t_max.lt(near_t);
        met.bits()
    }

    /// The padded extent of a box along an axis, seen from the origin of each ray.
    #[inline(always)]
    fn extent(&self, node: &Node, slot: usize, i: usize, padding: L) -> [L; 2] {
        let (axis, o) = (self.sheared.axes[i] % 3, self.sheared.o[i]);
        let (low, high) = (node.planes[axis][slot % ARITY], node.planes[axis + 3][slot % ARITY]);
        [L::splat(low) - o - padding, L::splat(high) - o + padding]
    }

    /// The lanes of the triangles of a leaf that one ray may hit before its nearest hit.
    #[inline(always)]
    pub fn candidates_of(&self, leaf: Leaf, ray: u32) -> Mask {
        let ShearedRay { axes, o, shear } = self.sheared;
        let sheared = ShearedRay { axes, o: lane3(o, ray), shear: lane3(shear, ray) };
        let (t_min, t_max) = (self.t_min.lane(ray), self.t_max.lane(ray));
        let mut lanes = 0;
        for first in (0..leaf.triangles()).step_by(L::Narrow::LANES) {
            let candidates = candidates::<L, _>(World, &sheared, leaf, first, t_min, t_max);
            lanes |= candidates.map_or(0, |candidates| candidates.lanes) << first;
        }
        lanes
    }

    /// Tests all rays against one triangle of a leaf; returns those for which it is the nearest hit so far.
    #[inline(always)]
    pub fn intersect(&mut self, leaf: Leaf, lane: u32) -> Mask {
        let id = leaf.id(lane);
        let vertices = leaf.corners_of(lane);
        let corners = self.sheared.corners(|axis| leaf.coordinates(vertices, axis));
        let [x, y, z] = corners;
        let edges = Edges::new(x, y);
        let mut undecided = edges.any_zero();
        let inside = edges.inside() & !undecided;
        let mut all = 0;
        if inside.any() {
            let crossing = Crossing::new(edges, z, self.sheared.shear[2]);
            let reach = Reach::new(corners);
            let sure = crossing.is_sure(&reach);
            let mut hit = inside & (crossing.is_within(self.t_min, self.t_max) | !sure);
            if hit.any() {
                hit = hit & crossing.is_in_front(&reach, hit);
                undecided = undecided | (hit & !sure);
                hit = hit & sure;
                // Of two at the same distance the one with the lower id counts.
                let tied = hit & crossing.t.eq(self.t_max);
                hit = hit & crossing.t.lt(self.t_max) | self.with_larger_id(id, tied);
                self.set_hits(hit, crossing.t, edges.0, crossing.determinant, id);
                all = hit.bits();
            }
        }
        if undecided.any() {
            all |= self.intersect_scalar(leaf, lane, id, undecided.bits());
        }
        all
    }

    #[inline(always)]
    fn set_hits(&mut self, rays: L::Mask, t: L, e: [L; 3], determinant: L, id: u32) {
        self.t_max = L::select(rays, t, self.t_max);
        self.edges = [
            L::select(rays, e[0], self.edges[0]),
            L::select(rays, e[1], self.edges[1]),
            L::select(rays, e[2], self.edges[2]),
        ];
        self.determinant = L::select(rays, determinant, self.determinant);
        self.ids = L::select(rays, L::splat(f32::from_bits(id)), self.ids);
    }

    /// Those of some rays that have no hit yet, or one with a larger id.
    #[inline(always)]
    fn with_larger_id(&self, id: u32, rays: L::Mask) -> L::Mask {
        if !rays.any() {
            return rays;
        }
        let ids = self.ids.to_array();
        let is_larger = |i: usize| Mask::from(id < ids[i].to_bits()) << i;
        rays & L::Mask::from_bits((0..LANES).fold(0, |mask, i| mask | is_larger(i)))
    }

    /// Tests rays one by one that need the scalar test.
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
        self.sheared.axes == other.sheared.axes && self.backwards == other.backwards
    }

    /// Where each ray ends along z, relative to `base`.
    #[inline(always)]
    pub fn end(&self, base: L) -> L {
        self.sheared.o[2] - base + self.t_max * self.d_z
    }

    /// One ray, up to its nearest hit.
    #[inline(always)]
    pub fn ray(&self, i: u32) -> Ray {
        Ray { t_max: self.t_max.lane(i), ..self.rays[i as usize % LANES] }
    }

    /// Records a hit of one ray, if it is nearer than its nearest so far; returns whether it is.
    #[inline(always)]
    pub fn set_hit(&mut self, i: u32, t: f32, b: [f32; 3], id: u32) -> bool {
        let ray = L::Mask::from_bits(1 << i);
        let is_nearer = t < self.t_max.lane(i) || self.with_larger_id(id, ray).any();
        if is_nearer {
            // Barycentrics are edge functions that are divided already.
            self.set_hits(ray, L::splat(t), splat3(b), L::splat(1.0), id);
        }
        is_nearer
    }

    /// Ends rays, so that they hit nothing more.
    #[inline(always)]
    pub fn terminate(&mut self, rays: Mask) {
        self.t_max = L::select(L::Mask::from_bits(rays), L::splat(f32::NEG_INFINITY), self.t_max);
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
        let sum = self.determinant;
        let b = [(e0 / sum).to_array(), (e1 / sum).to_array(), (e2 / sum).to_array()];
        let (t, ids) = (self.t_max.to_array(), self.ids.to_array());
        let id = |i: usize| ids[i].to_bits();
        for (i, hit) in hits.iter_mut().enumerate() {
            // As if there was only one shape, which is the common case.
            let (t, shape) = if id(i) == NONE { (f32::INFINITY, u32::MAX) } else { (t[i], 0) };
            *hit = Hit { t, b: [b[0][i], b[1][i], b[2][i]], shape, triangle: id(i) };
        }
        if bvh.first_ids.len() > 1 {
            hits.iter_mut().for_each(|hit| bvh.tell_shape(hit));
        }
    }
}

/// The numbers in one lane of three vectors.
#[inline(always)]
pub fn lane3<L: Lanes>([x, y, z]: [L; 3], lane: u32) -> [f32; 3] {
    [x.lane(lane), y.lane(lane), z.lane(lane)]
}

/// The scalar test, out of line so that it does not spill the vectors of the caller.
#[cold]
#[inline(never)]
fn intersect_out_of_line(ray: &Ray, leaf: Leaf, lane: u32) -> Option<TriangleHit> {
    intersect_triangle(World, &ShearedRay::new(ray), leaf, lane, ray.t_min, ray.t_max)
}
