//! [`Frustum`]: a beam of rays, against the boxes of a node and the triangles of a leaf.

use super::leaf_test::pick3;
use super::packet::{Packet, lane3};
use crate::accel::tree::{Bvh, Leaf, Node};
use crate::shape::ShearedRay;
use crate::simd::{Eight, Float, LANES, LaneMask, Lanes, Mask, splat3};

/// The frustum around a beam of one to [`MAX_PACKETS`] packets: the space between four side planes and two ends.
///
/// Relative to the origin of the first ray, each ray is a line x = a + s z with |s| at most 1, since z is the largest axis of
/// its direction; y likewise. The largest x of all rays is a convex function of z, so the line between its values at
/// both ends bounds it.
pub struct Frustum {
    /// The axes that become x, y and z.
    axes: [usize; 3],
    /// Origin of the first ray.
    base: [f32; 3],
    /// By how much boxes and triangles are enlarged, as a bound on rounding errors.
    pub padding: f32,
    /// Smallest and largest z.
    ends: [f32; 2],
    /// Whether the directions are negative along z.
    backwards: bool,
    /// Side planes around all packets.
    sides: Sides,
    /// Side planes around each.
    of_packets: [Sides; MAX_PACKETS],
}

/// Most packets of a beam.
pub const MAX_PACKETS: usize = 4;

/// Bounds of x and of y as functions of z.
#[derive(Clone, Copy)]
struct Sides {
    low: [Line; 2],
    high: [Line; 2],
}

/// x = a + s z.
#[derive(Clone, Copy)]
struct Line {
    a: f32,
    s: f32,
}

impl Line {
    #[inline(always)]
    fn at<F: Float>(&self, z: F) -> F {
        F::splat(self.a) + F::splat(self.s) * z
    }

    /// The smallest x between two z.
    #[inline(always)]
    fn min<F: Float>(&self, [low, high]: [F; 2]) -> F {
        self.at(if self.s < 0.0 { high } else { low })
    }

    /// The largest x between two z.
    #[inline(always)]
    fn max<F: Float>(&self, [low, high]: [F; 2]) -> F {
        self.at(if self.s < 0.0 { low } else { high })
    }
}

impl Sides {
    /// From the smallest and largest x at the first end, x at the second, y at the first, and y at the second.
    #[inline(always)]
    fn new([min, max]: [[f32; 4]; 2], first_end: f32, per_length: f32) -> Self {
        let line = |near: f32, far: f32| {
            let s = (far - near) * per_length;
            Line { a: near - s * first_end, s }
        };
        Self {
            low: [line(min[0], min[1]), line(min[2], min[3])],
            high: [line(max[0], max[1]), line(max[2], max[3])],
        }
    }
}

impl Frustum {
    /// The frustum of aligned packets; none if it is so wide that fewer than `min_per_leaf` rays come to a leaf of mean
    /// area.
    #[inline(always)]
    pub fn new<L: Lanes, const N: usize>(
        packets: &[Packet<L>; N],
        bvh: &Bvh,
        min_per_leaf: f32,
    ) -> Option<Self> {
        let first = &packets[0];
        let base = lane3(first.sheared.o, 0);
        let splat_base = splat3(base);
        let mut farthest = L::splat(0.0);
        let mut start = first.sheared.o[2];
        for packet in packets {
            let [x, y, z] = packet.sheared.o;
            farthest = farthest.max(x.abs().max(y.abs()).max(z.abs()));
            start = if first.backwards { start.max(z) } else { start.min(z) };
        }
        // Planes, boxes and the triangle test each take a few roundings of numbers no larger than the sum.
        let padding = 32.0 * f32::EPSILON * (bvh.largest_coordinate + farthest.reduce_max());
        let z = first.sheared.axes[2];
        let low = bvh.bounds.min[z] - base[2] - padding;
        let high = bvh.bounds.max[z] - base[2] + padding;
        let ends = if first.backwards {
            [low.max(end(packets, splat_base[2])), high.min(start.reduce_max() - base[2])]
        } else {
            [low.max(start.reduce_min() - base[2]), high.min(end(packets, splat_base[2]))]
        };
        let length = ends[1] - ends[0];
        let per_length = if length > f32::MIN_POSITIVE { 1.0 / length } else { 0.0 };
        let mut of_packets =
            [Sides { low: [Line { a: 0.0, s: 0.0 }; 2], high: [Line { a: 0.0, s: 0.0 }; 2] };
                MAX_PACKETS];
        let (mut min, mut max) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        for (packet, sides) in packets.iter().zip(&mut of_packets) {
            let (near_x, far_x) = at_ends(packet, 0, splat_base, ends);
            let (near_y, far_y) = at_ends(packet, 1, splat_base, ends);
            let extremes = L::reduce_min_max([near_x, far_x, near_y, far_y]);
            *sides = Sides::new(extremes, ends[0], per_length);
            for i in 0..4 {
                min[i] = if extremes[0][i] < min[i] { extremes[0][i] } else { min[i] };
                max[i] = if extremes[1][i] > max[i] { extremes[1][i] } else { max[i] };
            }
        }
        let span = |i: usize| max[i] - min[i];
        let area = span(0).max(span(1)) * span(2).max(span(3));
        let rays = (N * LANES) as f32;
        // Rays that all end before they reach the scene enter no box.
        let is_narrow = area * min_per_leaf <= rays * bvh.mean_leaf_area || ends[0] > ends[1];
        is_narrow.then(|| Self {
            axes: first.sheared.axes,
            base,
            padding,
            ends,
            backwards: first.backwards,
            sides: Sides::new([min, max], ends[0], per_length),
            of_packets,
        })
    }

    /// Moves the far end to the farthest of the rays' nearest hits.
    #[inline(always)]
    pub fn shorten<L: Lanes, const N: usize>(&mut self, packets: &[Packet<L>; N]) {
        let end = end(packets, L::splat(self.base[2]));
        if self.backwards {
            self.ends[0] = self.ends[0].max(end);
        } else {
            self.ends[1] = self.ends[1].min(end);
        }
    }

    /// Where the beam ends, to be compared with the distances of [`Frustum::met`].
    #[inline(always)]
    pub fn end(&self) -> f32 {
        if self.backwards { -self.ends[0] } else { self.ends[1] }
    }

    /// The children whose boxes the beam may enter, and how far along z they begin.
    #[inline(always)]
    pub fn met<B: Eight>(&self, node: &Node) -> (B::Mask, B) {
        let ends = self.extent::<B>(node, 2);
        let in_ends = ends[0].le(B::splat(self.ends[1])) & B::splat(self.ends[0]).le(ends[1]);
        let met = in_ends & self.overlaps(node, 0, ends) & self.overlaps(node, 1, ends);
        let near = if self.backwards { -ends[1] } else { ends[0] };
        (met, near)
    }

    /// The lanes of the triangles of a leaf that the rays of one packet may hit.
    #[inline(always)]
    pub fn candidates<L: Lanes>(&self, leaf: Leaf, packet: usize) -> Mask {
        let sides = &self.of_packets[packet % MAX_PACKETS];
        let z = leaf.vertices::<L>(self.axes[2]) - L::splat(self.base[2]);
        let corners = leaf.corners(0);
        let x_between = self.between_sides(leaf, 0, z, sides, corners);
        let y_between = self.between_sides(leaf, 1, z, sides, corners);
        leaf.lanes() & (x_between & y_between).bits()
    }

    /// The lanes of triangles that are not beyond a side plane in x (`i` = 0) or y.
    #[inline(always)]
    fn between_sides<L: Lanes>(
        &self,
        leaf: Leaf,
        i: usize,
        z: L,
        sides: &Sides,
        corners: [L::Indices; 3],
    ) -> L::Mask {
        let x = leaf.vertices::<L>(self.axes[i]) - L::splat(self.base[i]);
        // How far inside either plane each vertex is, and the largest of each triangle.
        let above = max_of_corners(x - sides.low[i].at(z), corners);
        let below = max_of_corners(sides.high[i].at(z) - x, corners);
        let limit = L::splat(-self.padding);
        limit.le(above) & limit.le(below)
    }

    /// The padded extents of the children along an axis.
    #[inline(always)]
    fn extent<B: Eight>(&self, node: &Node, i: usize) -> [B; 2] {
        let (axis, base, padding) = (self.axes[i], B::splat(self.base[i]), B::splat(self.padding));
        let low = B::load(&node.planes[axis % 3]);
        let high = B::load(&node.planes[axis % 3 + 3]);
        [low - base - padding, high - base + padding]
    }

    /// The lanes of children that are not beyond a side plane in x (`i` = 0) or y.
    #[inline(always)]
    fn overlaps<B: Eight>(&self, node: &Node, i: usize, ends: [B; 2]) -> B::Mask {
        let [low, high] = self.extent::<B>(node, i);
        self.sides.low[i].min(ends).le(high) & low.le(self.sides.high[i].max(ends))
    }
}

/// x (`i` = 0) or y of all rays at two z, all relative to `base`.
#[inline(always)]
fn at_ends<L: Lanes>(packet: &Packet<L>, i: usize, base: [L; 3], ends: [f32; 2]) -> (L, L) {
    let ShearedRay { o, shear, .. } = &packet.sheared;
    let (o, z) = (o[i] - base[i], o[2] - base[2]);
    (o - shear[i] * (L::splat(ends[0]) - z), o - shear[i] * (L::splat(ends[1]) - z))
}

/// Where the last of all rays ends along z, relative to `base`: the largest, or the smallest if they run backwards.
#[inline(always)]
fn end<L: Lanes, const N: usize>(packets: &[Packet<L>; N], base: L) -> f32 {
    let mut end = packets[0].end(base);
    for packet in &packets[1..] {
        end = if packet.backwards { end.min(packet.end(base)) } else { end.max(packet.end(base)) };
    }
    if packets[0].backwards { end.reduce_min() } else { end.reduce_max() }
}

/// The largest value of each triangle's vertices.
#[inline(always)]
fn max_of_corners<L: Lanes>(vertices: L, corners: [L::Indices; 3]) -> L {
    let [a, b, c]: [L; 3] = pick3(vertices, corners);
    a.max(b.max(c))
}
