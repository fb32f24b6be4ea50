//! [`Frustum`]: all that a beam of rays can meet, against boxes and triangles.

use super::Aabb;
use super::lanes::{LANES, Lanes, Mask, splat3};
use super::node::Node;
use super::packet::Packet;
use super::triangles::Leaf;

/// The space between four planes and two ends around a beam: one packet of rays or a few.
///
/// Seen from the origin of the first ray, each ray is a line x = a + s z with |s| at most 1, as z is the axis
/// in which it is longest; y likewise. The largest x of all rays is convex in z, so the line between its
/// values at both ends bounds it.
pub struct Frustum<L> {
    axes: [usize; 3],
    /// Where the first ray begins.
    base: [L; 3],
    /// By how much all is taken to be larger.
    pub padding: L,
    /// Least and largest z.
    ends: [L; 2],
    backwards: bool,
    /// Turns slots into the order in which the rays meet them, the last one first.
    pub flip: u32,
    /// Around all packets.
    sides: Sides,
    /// Around each.
    of_packets: [Sides; PACKETS],
}

/// How many packets a beam has at most.
pub const PACKETS: usize = 4;

/// The bounds of x and of y.
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
    fn at<L: Lanes>(&self, z: L) -> L {
        L::splat(self.a).add(L::splat(self.s).mul(z))
    }

    /// The least x between two z.
    #[inline(always)]
    fn least<L: Lanes>(&self, [low, high]: [L; 2]) -> L {
        self.at(if self.s < 0.0 { high } else { low })
    }

    /// The largest x between two z.
    #[inline(always)]
    fn greatest<L: Lanes>(&self, [low, high]: [L; 2]) -> L {
        self.at(if self.s < 0.0 { low } else { high })
    }
}

impl Sides {
    /// From the least and largest x and y at both ends: x at the first, x at the second, y, y.
    #[inline(always)]
    fn new([least, most]: [[f32; 4]; 2], first_end: f32, per_length: f32) -> Self {
        let line = |near: f32, far: f32| {
            let s = (far - near) * per_length;
            Line { a: near - s * first_end, s }
        };
        Self {
            low: [line(least[0], least[1]), line(least[2], least[3])],
            high: [line(most[0], most[1]), line(most[2], most[3])],
        }
    }
}

impl<L: Lanes> Frustum<L> {
    /// The frustum of packets in a scene, if it is narrow: if `per_leaf` rays come to a leaf with faces as large
    /// as `grain`. All packets have the same axes and run the same way.
    #[inline(always)]
    pub fn new<const N: usize>(
        packets: &[Packet<L>; N],
        bounds: &Aabb,
        largest_coordinate: f32,
        grain: f32,
        per_leaf: f32,
    ) -> Option<Self> {
        let first = &packets[0];
        let [x, y, z] = first.o;
        let base = [x.lane(0), y.lane(0), z.lane(0)];
        let splat_base = splat3(base);
        let mut farthest = L::splat(0.0);
        let mut start = first.o[2];
        for packet in packets {
            let [x, y, z] = packet.o;
            farthest = farthest.max(x.abs().max(y.abs()).max(z.abs()));
            start = if first.backwards { start.max(z) } else { start.min(z) };
        }
        // Planes, boxes and the triangle test each make a few roundings of numbers no larger than this.
        let padding = 32.0 * f32::EPSILON * (largest_coordinate + farthest.greatest());
        let z = first.axes[2];
        let (low, high) = (bounds.min[z] - base[2] - padding, bounds.max[z] - base[2] + padding);
        let ends = if first.backwards {
            [low.max(end(packets, splat_base[2])), high.min(start.greatest() - base[2])]
        } else {
            [low.max(start.least() - base[2]), high.min(end(packets, splat_base[2]))]
        };
        let length = ends[1] - ends[0];
        let per_length = if length > f32::MIN_POSITIVE { 1.0 / length } else { 0.0 };
        let mut of_packets =
            [Sides { low: [Line { a: 0.0, s: 0.0 }; 2], high: [Line { a: 0.0, s: 0.0 }; 2] };
                PACKETS];
        let (mut least, mut most) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        for (packet, sides) in packets.iter().zip(&mut of_packets) {
            let (near_x, far_x) = at_ends(packet, 0, splat_base, ends);
            let (near_y, far_y) = at_ends(packet, 1, splat_base, ends);
            let extremes = L::extremes([near_x, far_x, near_y, far_y]);
            *sides = Sides::new(extremes, ends[0], per_length);
            for i in 0..4 {
                least[i] = if extremes[0][i] < least[i] { extremes[0][i] } else { least[i] };
                most[i] = if extremes[1][i] > most[i] { extremes[1][i] } else { most[i] };
            }
        }
        let span = |i: usize| most[i] - least[i];
        let area = span(0).max(span(1)) * span(2).max(span(3));
        let rays = (N * LANES) as f32;
        // Rays that all end before they reach the scene meet no box.
        let is_narrow = area * per_leaf <= rays * grain || ends[0] > ends[1];
        is_narrow.then(|| Self {
            axes: first.axes,
            base: splat_base,
            padding: L::splat(padding),
            ends: [L::splat(ends[0]), L::splat(ends[1])],
            backwards: first.backwards,
            flip: first.octant() << 1 ^ (LANES as u32 - 1),
            sides: Sides::new([least, most], ends[0], per_length),
            of_packets,
        })
    }

    /// Leaves out what lies behind the nearest hits of all rays.
    #[inline(always)]
    pub fn shorten<const N: usize>(&mut self, packets: &[Packet<L>; N]) {
        let end = L::splat(end(packets, self.base[2]));
        if self.backwards {
            self.ends[0] = self.ends[0].max(end);
        } else {
            self.ends[1] = self.ends[1].min(end);
        }
    }

    /// Where the beam ends, as [`Frustum::enters`] says where boxes begin.
    #[inline(always)]
    pub fn end(&self) -> f32 {
        if self.backwards { -self.ends[0].lane(0) } else { self.ends[1].lane(0) }
    }

    /// Which children the beam may meet, in lanes flipped by `flip`, far ones first; and how far along z they
    /// begin, as [`Lanes::push_slots`] takes it.
    #[inline(always)]
    pub fn enters(&self, node: &Node) -> (Mask, L) {
        let ends = self.extent(node, 2);
        let in_ends = ends[0].le(self.ends[1]) & self.ends[0].le(ends[1]);
        let met = in_ends & self.overlaps(node, 0, ends) & self.overlaps(node, 1, ends);
        let near = if self.backwards { L::splat(-0.0).sub(ends[1]) } else { ends[0] };
        (L::turned_mask(met, self.flip), near)
    }

    /// Which triangles of a leaf a packet may meet.
    #[inline(always)]
    pub fn meets(&self, leaf: Leaf, packet: usize) -> Mask {
        let sides = &self.of_packets[packet % PACKETS];
        let z = leaf.vertices::<L>(self.axes[2]).sub(self.base[2]);
        let corners = leaf.corners::<L::Places>();
        leaf.lanes()
            & self.within(leaf, 0, z, sides, corners)
            & self.within(leaf, 1, z, sides, corners)
    }

    /// Which triangles are not beside the sides in x or y.
    #[inline(always)]
    fn within(&self, leaf: Leaf, i: usize, z: L, sides: &Sides, corners: [L::Places; 3]) -> Mask {
        let x = leaf.vertices::<L>(self.axes[i]).sub(self.base[i]);
        // How far within either line each vertex is, and of each triangle the one that is farthest within.
        let above = farthest(x.sub(sides.low[i].at(z)), corners);
        let below = farthest(sides.high[i].at(z).sub(x), corners);
        let out = L::splat(0.0).sub(self.padding);
        out.le(above) & out.le(below)
    }

    /// From where to where the children reach along an axis.
    #[inline(always)]
    fn extent(&self, node: &Node, i: usize) -> [L; 2] {
        let axis = self.axes[i];
        let low = L::load(&node.planes[axis % 3]).turned(self.flip);
        let high = L::load(&node.planes[axis % 3 + 3]).turned(self.flip);
        [low.sub(self.base[i]).sub(self.padding), high.sub(self.base[i]).add(self.padding)]
    }

    /// Which children are not beside the frustum in x or y.
    #[inline(always)]
    fn overlaps(&self, node: &Node, i: usize, ends: [L; 2]) -> Mask {
        let [low, high] = self.extent(node, i);
        self.sides.low[i].least(ends).le(high) & low.le(self.sides.high[i].greatest(ends))
    }
}

/// x (`i` = 0) or y (`i` = 1) of all rays at two z, all seen from `base`.
#[inline(always)]
fn at_ends<L: Lanes>(packet: &Packet<L>, i: usize, base: [L; 3], ends: [f32; 2]) -> (L, L) {
    let (o, z) = (packet.o[i].sub(base[i]), packet.o[2].sub(base[2]));
    let slope = L::splat(0.0).sub(packet.shear[i]);
    let near = o.add(slope.mul(L::splat(ends[0]).sub(z)));
    let far = o.add(slope.mul(L::splat(ends[1]).sub(z)));
    (near, far)
}

/// Where z ends for all rays, seen from `base`: the largest, or the least if they run backwards.
#[inline(always)]
fn end<L: Lanes, const N: usize>(packets: &[Packet<L>; N], base: L) -> f32 {
    let mut end = packets[0].end(base);
    for packet in &packets[1..] {
        end = if packet.backwards { end.min(packet.end(base)) } else { end.max(packet.end(base)) };
    }
    if packets[0].backwards { end.least() } else { end.greatest() }
}

/// The largest number of each triangle's vertices.
#[inline(always)]
fn farthest<L: Lanes>(vertices: L, [a, b, c]: [L::Places; 3]) -> L {
    vertices.at(a).max(vertices.at(b).max(vertices.at(c)))
}
