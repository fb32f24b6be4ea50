//! A beam of rays through the tree: packets of sixteen inside one frustum.

use super::frustum::Frustum;
use super::packet::Packet;
use super::single_ray::{AnyHit, ClosestHit, Start};
use super::space::World;
use super::stack::Stack;
use crate::accel::tree::{Bvh, Child, Leaf, Node};
use crate::interaction::Hit;
use crate::simd::{ARITY, Lanes, Mask};

/// Minimum mean rays per leaf for beam tracing to pay: of several packets, or of one that asks for any hit, which single
/// rays find soon.
const MIN_PER_LEAF: f32 = 2.0;
/// The same for one packet that asks for the closest hits.
const MIN_PER_LEAF_CLOSEST: f32 = 0.1;

/// At most so many rays of a beam in a node are traced on one by one.
const MAX_SINGLE_IN_NODE: u32 = 4;

/// At most so many rays of a packet in a leaf are tested one by one, each against all triangles.
const MAX_SINGLE_IN_LEAF: u32 = 4;

/// Finds the closest hits of the rays of some aligned packets, or with `any_hit` some hit of each. Returns false, with
/// nothing done, if the rays have too little in common.
///
/// The frustum tells which boxes the beam may enter, then each ray is tested against the box: only rays that meet it
/// count below.
#[inline(always)]
pub fn trace_beam<L: Lanes, const N: usize>(
    bvh: &Bvh,
    stack: &mut Stack,
    packets: &mut [Packet<L>; N],
    any_hit: bool,
) -> bool {
    let min_per_leaf = if N > 1 || any_hit { MIN_PER_LEAF } else { MIN_PER_LEAF_CLOSEST };
    let Some(mut frustum) = Frustum::new::<L, N>(packets, bvh, min_per_leaf) else { return false };
    let padding = L::splat(frustum.padding);
    let (mut stack_len, mut index) = (0, 0);
    'nodes: loop {
        let (met, distances) = frustum.met::<L::Boxes>(&bvh.nodes[index as usize]);
        let first_slot = index * ARITY as u32;
        stack_len = if any_hit {
            stack.push_any_slots(stack_len, met, first_slot, distances)
        } else {
            stack.push_slots(stack_len, met, first_slot, distances)
        };
        while let Some(slot) = stack.pop(&mut stack_len, 0, frustum.end()) {
            let (node, slot) = (&bvh.nodes[slot as usize / ARITY], slot as usize % ARITY);
            let mut any = false;
            match Child::unpack(node.children[slot]) {
                Child::Node(child) => {
                    let Some(rays) = few_that_enter(packets, node, slot, padding) else {
                        index = child;
                        continue 'nodes;
                    };
                    for (packet, rays) in packets.iter_mut().zip(rays) {
                        let start = Start { node: child, stack_len };
                        any |= trace_singly(bvh, stack, packet, rays, start, any_hit);
                    }
                }
                Child::Leaf { index, vertices } => {
                    let leaf = bvh.leaves.get(index, vertices);
                    for (i, packet) in packets.iter_mut().enumerate() {
                        let rays = packet.enters(node, slot, padding);
                        let hit = if rays.count_ones() <= MAX_SINGLE_IN_LEAF {
                            intersect_few(packet, rays, leaf)
                        } else {
                            intersect_all(packet, frustum.candidates::<L>(leaf, i), leaf)
                        };
                        any |= hit != 0;
                        if any_hit && hit != 0 {
                            packet.terminate(hit);
                        }
                    }
                }
            }
            if any {
                frustum.shorten::<L, N>(packets);
            }
        }
        return true;
    }
}

/// The rays that enter a box, if they are at most [`MAX_SINGLE_IN_NODE`].
#[inline(always)]
fn few_that_enter<L: Lanes, const N: usize>(
    packets: &[Packet<L>; N],
    node: &Node,
    slot: usize,
    padding: L,
) -> Option<[Mask; N]> {
    let (mut rays, mut count) = ([0; N], 0);
    for (packet, rays) in packets.iter().zip(&mut rays) {
        *rays = packet.enters(node, slot, padding);
        count += rays.count_ones();
        // Mostly true of the first packet.
        if count > MAX_SINGLE_IN_NODE {
            return None;
        }
    }
    Some(rays)
}

/// Traces some rays of a packet on one by one; returns whether one found a nearer hit.
#[inline(always)]
fn trace_singly<L: Lanes>(
    bvh: &Bvh,
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
        let ray = &packet.ray(i);
        if any_hit {
            if L::call(bvh, stack, ray, AnyHit(World, start)) {
                packet.set_hit(i, f32::NEG_INFINITY, [0.0; 3], 0);
                any = true;
            }
        } else {
            let mut hit = Hit::MISS;
            L::call(bvh, stack, ray, ClosestHit { space: World, start, hit: &mut hit });
            any |= hit.triangle != u32::MAX && packet.set_hit(i, hit.t, hit.b, hit.triangle);
        }
    }
    any
}

/// Tests a few rays of a packet against a leaf. Vectors find the triangles that each may hit, and those are tested
/// against all rays. Returns the rays that have a nearer hit.
#[inline(always)]
fn intersect_few<L: Lanes>(packet: &mut Packet<L>, mut rays: Mask, leaf: Leaf) -> Mask {
    let (mut tested, mut all) = (0, 0);
    while rays != 0 {
        let candidates = packet.candidates_of(leaf, rays.trailing_zeros()) & !tested;
        rays &= rays - 1;
        tested |= candidates;
        all |= intersect_all(packet, candidates, leaf);
    }
    all
}

/// Tests all rays of a packet against some triangles of a leaf; returns those that have a nearer hit.
#[inline(always)]
fn intersect_all<L: Lanes>(packet: &mut Packet<L>, mut triangles: Mask, leaf: Leaf) -> Mask {
    let mut all = 0;
    while triangles != 0 {
        let lane = triangles.trailing_zeros();
        triangles &= triangles - 1;
        all |= packet.intersect(leaf, lane);
    }
    all
}
