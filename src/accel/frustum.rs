//! [`Frustum`]: all that a packet of rays can meet, against boxes and triangles.

use super::Aabb;
use super::lanes::{LANES, Lanes, Mask};
use super::node::Node;
use super::packet::Packet;
use super::triangles::Leaf;

/// The space between four planes and two ends around a packet of rays.
///
/// Seen from the origin of the first ray, each ray is a line x = a + s z with |s| at most 1, as z is the axis
/// in which it is longest; y likewise. The largest x of all rays is convex in z, so the line between its
/// values at both ends of the packet bounds it.
pub struct Frustum<L> {
    axes: [usize; 3],
    /// Where the first ray begins.
    base: [L; 3],
    /// By how much all is taken to be larger.
    pub padding: L,
    /// The bounds of x, and of y.
    low: [Line<L>; 2],
    high: [Line<L>; 2],
    /// Least and largest z.
    ends: [L; 2],
    backwards: bool,
    /// Turns slots into the order in which the rays meet them, the last one first.
    pub flip: u32,
}

/// x = a + s z.
struct Line<L> {
    a: L,
    s: L,
    falls: bool,
}

impl<L: Lanes> Line<L> {
    #[inline(always)]
    fn at(&self, z: L) -> L {
        self.a.add(self.s.mul(z))
    }

    /// The least x between two z.
    #[inline(always)]
    fn least(&self, [low, high]: [L; 2]) -> L {
        self.at(if self.falls { high } else { low })
    }

    /// The largest x between two z.
    #[inline(always)]
    fn greatest(&self, [low, high]: [L; 2]) -> L {
        self.at(if self.falls { low } else { high })
    }
}

/// Packets that are wider than this part of the scene have little in common.
const WIDEST: f32 = 1.0 / 16.0;

impl<L: Lanes> Frustum<L> {
    /// The frustum of a packet in a scene, if it is narrow.
    #[inline(always)]
    pub fn new(packet: &Packet<L>, bounds: &Aabb, largest_coordinate: f32) -> Option<Self> {
        let [x, y, z] = packet.o;
        let base = [L::splat(x.lane(0)), L::splat(y.lane(0)), L::splat(z.lane(0))];
        let o = [packet.o[0].sub(base[0]), packet.o[1].sub(base[1]), packet.o[2].sub(base[2])];
        let farthest = packet.o[0].abs().max(packet.o[1].abs()).max(packet.o[2].abs());
        // Planes, boxes and the triangle test each make a few roundings of numbers no larger than this.
        let padding = 32.0 * f32::EPSILON * (largest_coordinate + farthest.greatest());
        let z = packet.axes[2];
        let first = packet.o[2].lane(0);
        let (low, high) = (bounds.min[z] - first - padding, bounds.max[z] - first + padding);
        let ends = if packet.backwards {
            [low.max(packet.end(base[2])), high.min(o[2].greatest())]
        } else {
            [low.max(o[2].least()), high.min(packet.end(base[2]))]
        };
        let (near_x, far_x) = at_ends(packet, 0, o, ends);
        let (near_y, far_y) = at_ends(packet, 1, o, ends);
        let [least, most] = L::extremes([near_x, far_x, near_y, far_y]);
        let span = |i: usize| most[i] - least[i];
        let width = span(0).max(span(1)).max(span(2).max(span(3)));
        let per_length = if ends[0] < ends[1] { 1.0 / (ends[1] - ends[0]) } else { 0.0 };
        let line = |near: f32, far: f32| {
            let s = (far - near) * per_length;
            Line { a: L::splat(near - s * ends[0]), s: L::splat(s), falls: s < 0.0 }
        };
        let widest = WIDEST * (bounds.max - bounds.min).max_element();
        // Rays that all end before they reach the scene meet no box.
        let is_narrow = width <= widest || ends[0] > ends[1];
        is_narrow.then(|| Self {
            axes: packet.axes,
            base,
            padding: L::splat(padding),
            low: [line(least[0], least[1]), line(least[2], least[3])],
            high: [line(most[0], most[1]), line(most[2], most[3])],
            ends: [L::splat(ends[0]), L::splat(ends[1])],
            backwards: packet.backwards,
            flip: packet.octant() << 1 ^ (LANES as u32 - 1),
        })
    }

    /// Leaves out what lies behind the nearest hits of all rays.
    #[inline(always)]
    pub fn shorten(&mut self, packet: &Packet<L>) {
        let end = L::splat(packet.end(self.base[2]));
        if self.backwards {
            self.ends[0] = self.ends[0].max(end);
        } else {
            self.ends[1] = self.ends[1].min(end);
        }
    }

    /// Where the packet ends, as [`Frustum::enters`] says where boxes begin.
    #[inline(always)]
    pub fn end(&self) -> f32 {
        if self.backwards { -self.ends[0].lane(0) } else { self.ends[1].lane(0) }
    }

    /// Which children the packet may meet, and how far along z they begin, in lanes flipped by `flip`: far
    /// ones first.
    #[inline(always)]
    pub fn enters(&self, node: &Node) -> (Mask, L) {
        let ends = self.extent(node, 2);
        let in_ends = ends[0].le(self.ends[1]) & self.ends[0].le(ends[1]);
        let met = in_ends & self.overlaps(node, 0, ends) & self.overlaps(node, 1, ends);
        let near = if self.backwards { L::splat(-0.0).sub(ends[1]) } else { ends[0] };
        (met, near)
    }

    /// Which triangles of a leaf the packet may meet.
    #[inline(always)]
    pub fn meets(&self, leaf: Leaf) -> Mask {
        let z = self.moved(leaf, 2);
        let is_before = z[0].max(z[1].max(z[2])).add(self.padding).lt(self.ends[0]);
        let is_behind = self.ends[1].lt(z[0].min(z[1].min(z[2])).sub(self.padding));
        !(is_before | is_behind)
            & self.is_around(leaf, 0, z)
            & self.is_around(leaf, 1, z)
            & leaf.lanes()
    }

    /// From where to where the children reach along an axis.
    #[inline(always)]
    fn extent(&self, node: &Node, i: usize) -> [L; 2] {
        let axis = self.axes[i];
        let low = L::load(&node.planes[axis % 3]).flipped(self.flip);
        let high = L::load(&node.planes[axis % 3 + 3]).flipped(self.flip);
        [low.sub(self.base[i]).sub(self.padding), high.sub(self.base[i]).add(self.padding)]
    }

    /// Which children are not beside the frustum in x or y.
    #[inline(always)]
    fn overlaps(&self, node: &Node, i: usize, ends: [L; 2]) -> Mask {
        let [low, high] = self.extent(node, i);
        self.low[i].least(ends).le(high) & low.le(self.high[i].greatest(ends))
    }

    /// One coordinate of all corners, seen from the base.
    #[inline(always)]
    fn moved(&self, leaf: Leaf, i: usize) -> [L; 3] {
        let [a, b, c] = leaf.columns::<L>(self.axes[i]);
        [a.sub(self.base[i]), b.sub(self.base[i]), c.sub(self.base[i])]
    }

    /// Which triangles are not beside the frustum in x or y.
    #[inline(always)]
    fn is_around(&self, leaf: Leaf, i: usize, z: [L; 3]) -> Mask {
        let [a, b, c] = self.moved(leaf, i);
        let (low, high) = (&self.low[i], &self.high[i]);
        // How far each corner is on the inner side of either line.
        let above = a.sub(low.at(z[0])).max(b.sub(low.at(z[1])).max(c.sub(low.at(z[2]))));
        let below = high.at(z[0]).sub(a).max(high.at(z[1]).sub(b).max(high.at(z[2]).sub(c)));
        let out = L::splat(0.0).sub(self.padding);
        out.le(above) & out.le(below)
    }
}

/// x (`i` = 0) or y (`i` = 1) of all rays at two z.
#[inline(always)]
fn at_ends<L: Lanes>(packet: &Packet<L>, i: usize, o: [L; 3], ends: [f32; 2]) -> (L, L) {
    let slope = L::splat(0.0).sub(packet.shear[i]);
    let near = o[i].add(slope.mul(L::splat(ends[0]).sub(o[2])));
    let far = o[i].add(slope.mul(L::splat(ends[1]).sub(o[2])));
    (near, far)
}
