//! How one ray walks the tree.

use super::frustum::Frustum;
use super::lanes::{LANES, Lanes, Mask};
use super::needle::{Needle, hit};
use super::node::Child;
use super::packet::Packet;
use super::slabs::Slabs;
use super::stack::Stack;
use super::{Accel, Hit};
use crate::geometry::Ray;
use crate::shape::ShearedRay;

/// So many rays at a leaf are few.
const FEW: u32 = 4;

/// A triangle in a leaf.
#[derive(Clone, Copy)]
struct Place {
    first: u32,
    count: usize,
    lane: u32,
    number: u32,
}

impl Accel {
    /// The closest hit of each ray.
    #[inline(always)]
    pub(super) fn closest_singly<L: Lanes>(
        &self,
        stack: &mut Stack,
        rays: &[Ray],
        hits: &mut [Hit],
    ) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.closest::<L>(stack, ray);
        }
    }

    /// The closest hit of one ray.
    #[inline(always)]
    pub(super) fn closest<L: Lanes>(&self, stack: &mut Stack, ray: &Ray) -> Hit {
        match self.find::<L, false>(stack, ray) {
            Ok(hit) => hit,
            Err(Unsure) => self.surely_closest(stack, ray),
        }
    }

    #[cold]
    #[inline(never)]
    fn surely_closest(&self, stack: &mut Stack, ray: &Ray) -> Hit {
        self.surely_closest_of_one(stack, ray)
    }

    /// The closest hit. The bound on the error of t is asked of each triangle if `SURE`, else only of the
    /// nearest in the end, which nearly always passes.
    #[inline(always)]
    pub(super) fn find<L: Lanes, const SURE: bool>(
        &self,
        stack: &mut Stack,
        ray: &Ray,
    ) -> Result<Hit, Unsure> {
        let sheared = ShearedRay::new(ray);
        if self.nodes.is_empty() || !is_sound(ray, &sheared) {
            return Ok(Hit::MISS);
        }
        let needle = Needle::<L>::new(&sheared, ray.t_min);
        let mut slabs = Slabs::<L>::new(ray, self.largest_coordinate);
        let mut t_max = ray.t_max;
        let mut nearest: Option<Place> = None;
        let mut waiting = 0;
        let mut node = &self.nodes[0];
        'nodes: loop {
            let (lanes, enters) = slabs.enters(node);
            let mut child;
            if lanes != 0 {
                // The nearest child is the last lane; the others wait.
                let lane = Mask::BITS - 1 - lanes.leading_zeros();
                child = node.children[(lane ^ slabs.flip) as usize % LANES];
                let others = lanes ^ 1 << lane;
                waiting = enters.push(stack, waiting, others, &node.children, slabs.flip);
            } else if let Some(next) = pop(stack, &mut waiting, t_max) {
                child = next;
            } else {
                break;
            }
            loop {
                let (first, count) = match Child::new(child) {
                    Child::Node(number) => {
                        node = &self.nodes[number as usize];
                        continue 'nodes;
                    }
                    Child::Leaf { first, count } => (first, count),
                };
                let leaf = self.triangles.leaf(first, count);
                if let Some(met) = needle.meets(leaf, L::splat(t_max)) {
                    if !SURE && met.unsure != 0 {
                        return Err(Unsure);
                    }
                    let mut lanes = met.lanes;
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros();
                        lanes &= lanes - 1;
                        let mut t = met.t.lane(lane);
                        if SURE {
                            let hit = hit(&sheared, leaf, lane, ray.t_min, t_max);
                            let Some(hit) = hit else { continue };
                            t = hit.t;
                        }
                        let number = self.triangles.number(first + lane);
                        // Of two at the same distance the first triangle counts.
                        if t < t_max || t == t_max && nearest.is_none_or(|n| number < n.number) {
                            t_max = t;
                            slabs.shorten(t);
                            nearest = Some(Place { first, count, lane, number });
                        }
                    }
                }
                match pop(stack, &mut waiting, t_max) {
                    Some(next) => child = next,
                    None => break 'nodes,
                }
            }
        }
        let Some(place) = nearest else { return Ok(Hit::MISS) };
        let leaf = self.triangles.leaf(place.first, place.count);
        let hit = hit(&sheared, leaf, place.lane, ray.t_min, ray.t_max).ok_or(Unsure)?;
        let (shape, triangle) = self.outside(place.number);
        Ok(Hit { t: hit.t, b: hit.b, shape, triangle })
    }

    /// The closest hits of sixteen rays; false if they have too little in common to be traced together.
    #[inline(always)]
    pub(super) fn closest_of_packet<L: Lanes>(
        &self,
        stack: &mut Stack,
        rays: &[Ray; LANES],
        hits: &mut [Hit; LANES],
    ) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let Some(mut packet) = Packet::<L>::new(rays) else { return false };
        let frustum = Frustum::new(&packet, &self.bounds, self.largest_coordinate);
        let Some(mut frustum) = frustum else { return false };
        let mut waiting = 0;
        let mut place = 0;
        'nodes: loop {
            let (met, near) = frustum.enters(&self.nodes[place as usize]);
            let slots = place * LANES as u32;
            waiting = near.push_slots(stack, waiting, met, slots, frustum.flip);
            while let Some(slot) = pop(stack, &mut waiting, frustum.end()) {
                let (node, slot) = (&self.nodes[slot as usize / LANES], slot as usize % LANES);
                let (first, count) = match Child::new(node.children[slot]) {
                    Child::Node(number) => {
                        place = number;
                        continue 'nodes;
                    }
                    Child::Leaf { first, count } => (first, count),
                };
                let leaf = self.triangles.leaf(first, count);
                let mut rays = packet.enters(node, slot, frustum.padding);
                let mut any = false;
                if rays.count_ones() <= FEW {
                    // Few rays: each against all triangles at once.
                    let mut seen = 0;
                    while rays != 0 {
                        let mut met = packet.meets(leaf, rays.trailing_zeros()) & !seen;
                        rays &= rays - 1;
                        seen |= met;
                        while met != 0 {
                            let lane = met.trailing_zeros();
                            met &= met - 1;
                            any |= packet.meet(leaf, lane, self.triangles.number(first + lane));
                        }
                    }
                } else {
                    // Many rays: all at once against each triangle.
                    let mut lanes = frustum.meets(leaf);
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros();
                        lanes &= lanes - 1;
                        any |= packet.meet(leaf, lane, self.triangles.number(first + lane));
                    }
                }
                if any {
                    frustum.shorten(&packet);
                }
            }
            break;
        }
        packet.finish(self, hits);
        true
    }

    /// Whether one ray hits anything.
    #[inline(always)]
    pub(super) fn any<L: Lanes>(&self, stack: &mut Stack, ray: &Ray) -> bool {
        match self.find_any::<L, false>(stack, ray) {
            Ok(found) => found,
            Err(Unsure) => self.surely_any(stack, ray),
        }
    }

    #[cold]
    #[inline(never)]
    fn surely_any(&self, stack: &mut Stack, ray: &Ray) -> bool {
        self.surely_any_of_one(stack, ray)
    }

    /// Whether the ray hits anything. If `SURE`, all triangles that it may hit are asked, else the first.
    #[inline(always)]
    pub(super) fn find_any<L: Lanes, const SURE: bool>(
        &self,
        stack: &mut Stack,
        ray: &Ray,
    ) -> Result<bool, Unsure> {
        let sheared = ShearedRay::new(ray);
        if self.nodes.is_empty() || !is_sound(ray, &sheared) {
            return Ok(false);
        }
        let needle = Needle::<L>::new(&sheared, ray.t_min);
        let slabs = Slabs::<L>::new(ray, self.largest_coordinate);
        let mut waiting = 0;
        let mut node = &self.nodes[0];
        let found;
        'nodes: loop {
            let lanes = slabs.meets(node);
            let mut child;
            if lanes != 0 {
                let lane = lanes.trailing_zeros();
                child = node.children[lane as usize % LANES];
                let others = lanes & (lanes - 1);
                waiting = L::splat(0.0).push(stack, waiting, others, &node.children, 0);
            } else if let Some(next) = pop(stack, &mut waiting, f32::INFINITY) {
                child = next;
            } else {
                return Ok(false);
            }
            loop {
                let (first, count) = match Child::new(child) {
                    Child::Node(number) => {
                        node = &self.nodes[number as usize];
                        continue 'nodes;
                    }
                    Child::Leaf { first, count } => (first, count),
                };
                let leaf = self.triangles.leaf(first, count);
                if let Some(met) = needle.meets(leaf, L::splat(ray.t_max)) {
                    let mut lanes = met.lanes;
                    if !SURE && lanes != 0 {
                        found = (leaf, lanes.trailing_zeros());
                        break 'nodes;
                    }
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros();
                        if hit(&sheared, leaf, lane, ray.t_min, ray.t_max).is_some() {
                            return Ok(true);
                        }
                        lanes &= lanes - 1;
                    }
                }
                match pop(stack, &mut waiting, f32::INFINITY) {
                    Some(next) => child = next,
                    None => return Ok(false),
                }
            }
        }
        let (leaf, lane) = found;
        let hit = hit(&sheared, leaf, lane, ray.t_min, ray.t_max);
        hit.map(|_| true).ok_or(Unsure)
    }

    /// The mesh of a triangle, and its number there.
    #[inline(always)]
    pub(super) fn outside(&self, number: u32) -> (u32, u32) {
        let shape = match &self.shapes[..] {
            [_] => 0,
            shapes => shapes.partition_point(|&first| first <= number) - 1,
        };
        (shape as u32, number - self.shapes[shape])
    }
}

/// A triangle was met that only the test of one triangle can tell: an edge function is zero, or rounding may
/// have made the hit up. Such rays are rare, and walk once more.
pub(super) struct Unsure;

/// The next child that the ray enters before `t_max`.
#[inline(always)]
fn pop(stack: &Stack, waiting: &mut usize, t_max: f32) -> Option<u32> {
    loop {
        *waiting = waiting.checked_sub(1)?;
        let (child, enter) = stack.get(*waiting);
        if enter <= t_max {
            return Some(child);
        }
    }
}

/// Whether the ray is made of numbers and has a direction. No triangle is met by one that is not, and
/// every box would be.
#[inline(always)]
fn is_sound(ray: &Ray, sheared: &ShearedRay) -> bool {
    let [x, y, z] = sheared.shear;
    !(x + y + z).is_nan() && (ray.o.x + ray.o.y + ray.o.z).is_finite()
}
