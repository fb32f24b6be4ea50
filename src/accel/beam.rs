//! How a beam of rays walks the tree: packets of sixteen rays inside one frustum.

use super::Accel;
use super::frustum::Frustum;
use super::lanes::{LANES, Lanes, Mask};
use super::node::Child;
use super::packet::Packet;
use super::stack::Stack;
use super::triangles::Leaf;
use super::walk::Start;

/// So many rays have to come to a leaf, on average, that it pays to trace them together: several packets, or one
/// that asks for any hit, which single rays find soon; and one that asks for the closest.
const MANY_PER_LEAF: f32 = 2.0;
const SOME_PER_LEAF: f32 = 0.1;

/// So few rays of a beam at a node walk on by themselves.
const FEW_AT_NODE: u32 = 4;

/// So few rays of a packet at a leaf are tested one by one, each against all triangles.
const FEW_AT_LEAF: u32 = 4;

impl Accel {
    /// What the rays of some packets hit: the closest, or if `any_hit` something. False, with nothing done, if
    /// they have too little in common to be traced together.
    ///
    /// The frustum says which boxes the beam meets, and then each ray whether it does: only so many walk on.
    #[inline(always)]
    pub(super) fn trace_beam<L: Lanes, const N: usize>(
        &self,
        stack: &mut Stack,
        packets: &mut [Packet<L>; N],
        any_hit: bool,
    ) -> bool {
        let per_leaf = if N > 1 || any_hit { MANY_PER_LEAF } else { SOME_PER_LEAF };
        let frustum =
            Frustum::new(packets, &self.bounds, self.largest_coordinate, self.grain, per_leaf);
        let Some(mut frustum) = frustum else { return false };
        let (mut waiting, mut place) = (0, 0);
        'nodes: loop {
            let (met, near) = frustum.enters(&self.nodes[place as usize]);
            waiting = near.push_slots(stack, waiting, met, place * LANES as u32, frustum.flip);
            while let Some(slot) = stack.pop(&mut waiting, 0, frustum.end()) {
                let (node, slot) = (&self.nodes[slot as usize / LANES], slot as usize % LANES);
                let (mut rays, mut count) = ([0; N], 0);
                for (packet, rays) in packets.iter().zip(&mut rays) {
                    *rays = packet.enters(node, slot, frustum.padding);
                    count += rays.count_ones();
                }
                if count == 0 {
                    continue;
                }
                let mut any = false;
                match Child::new(node.children[slot]) {
                    Child::Node(number) if count > FEW_AT_NODE => {
                        place = number;
                        continue 'nodes;
                    }
                    Child::Node(node) => {
                        for (packet, rays) in packets.iter_mut().zip(rays) {
                            any |=
                                self.walk_on(stack, packet, rays, Start { node, waiting }, any_hit);
                        }
                    }
                    Child::Leaf { place, vertices } => {
                        let leaf = self.triangles.leaf(place, vertices);
                        for (i, (packet, rays)) in packets.iter_mut().zip(rays).enumerate() {
                            let met = if rays.count_ones() <= FEW_AT_LEAF {
                                self.meet_few(packet, rays, leaf)
                            } else {
                                self.meet_all(packet, frustum.meets(leaf, i), leaf)
                            };
                            any |= met != 0;
                            if any_hit && met != 0 {
                                packet.end_met(met);
                            }
                        }
                    }
                }
                if any {
                    frustum.shorten(packets);
                }
            }
            return true;
        }
    }

    /// Lets some rays of a packet walk on alone; whether one met anything.
    #[inline(always)]
    fn walk_on<L: Lanes>(
        &self,
        stack: &mut Stack,
        packet: &mut Packet<L>,
        mut rays: Mask,
        start: Start,
        any_hit: bool,
    ) -> bool {
        let mut any = false;
        while rays != 0 {
            let i = rays.trailing_zeros();
            rays &= rays - 1;
            let ray = packet.ray(i);
            if any_hit {
                if self.any_of_one(stack, &ray, start) {
                    packet.keep_one(i, f32::NEG_INFINITY, [0.0; 3], 0);
                    any = true;
                }
            } else if let Some((hit, number)) = self.closest_of_one(stack, &ray, start) {
                any |= packet.keep_one(i, hit.t, hit.b, number);
            }
        }
        any
    }

    /// Tests a few rays of a packet, each against all triangles of a leaf at once; which met something.
    #[inline(always)]
    fn meet_few<L: Lanes>(&self, packet: &mut Packet<L>, mut rays: Mask, leaf: Leaf) -> Mask {
        let (mut seen, mut all) = (0, 0);
        while rays != 0 {
            let mut met = packet.meets(leaf, rays.trailing_zeros()) & !seen;
            rays &= rays - 1;
            seen |= met;
            while met != 0 {
                let lane = met.trailing_zeros();
                met &= met - 1;
                all |= packet.meet(leaf, lane, leaf.number(lane));
            }
        }
        all
    }

    /// Tests all rays of a packet at once against some triangles of a leaf; which met something.
    #[inline(always)]
    fn meet_all<L: Lanes>(&self, packet: &mut Packet<L>, mut lanes: Mask, leaf: Leaf) -> Mask {
        let mut all = 0;
        while lanes != 0 {
            let lane = lanes.trailing_zeros();
            lanes &= lanes - 1;
            all |= packet.meet(leaf, lane, leaf.number(lane));
        }
        all
    }
}
