//! How one ray walks the tree.

use super::Accel;
use super::lanes::{LANES, Lanes};
use super::needle::{Needle, hit};
use super::node::Child;
use super::slabs::Slabs;
use super::stack::Stack;
use crate::geometry::Ray;
use crate::shape::{ShearedRay, TriangleHit};

/// A triangle in a leaf.
#[derive(Clone, Copy)]
struct Place {
    place: u32,
    vertices: usize,
    lane: u32,
    number: u32,
}

/// What a ray hit, with the number of the triangle.
pub type Found = Option<(TriangleHit, u32)>;

/// A triangle was met that only the test of one triangle can tell: an edge function is zero, or rounding may
/// have made the hit up. Such rays are rare, and walk once more.
pub struct Unsure;

/// Where a walk begins: at the root, or for rays that leave a beam further down.
#[derive(Clone, Copy)]
pub struct Start {
    pub node: u32,
    /// How many children wait on the stack already, for others.
    pub waiting: usize,
}

impl Start {
    pub const ROOT: Self = Self { node: 0, waiting: 0 };
}

impl Accel {
    /// The closest hit below a node. The bound on the error of t is asked of each triangle if `SURE`, else
    /// only of the nearest in the end, which nearly always passes.
    #[inline(always)]
    pub(super) fn find<L: Lanes, const SURE: bool>(
        &self,
        stack: &mut Stack,
        ray: &Ray,
        start: Start,
    ) -> Result<Found, Unsure> {
        let sheared = ShearedRay::new(ray);
        if self.nodes.is_empty() || !is_sound(ray, &sheared) {
            return Ok(None);
        }
        let needle = Needle::<L>::new(&sheared, ray.t_min);
        let mut slabs = Slabs::<L>::new(ray, self.largest_coordinate);
        let mut t_max = ray.t_max;
        let mut nearest: Option<Place> = None;
        let mut waiting = start.waiting;
        let mut node = &self.nodes[start.node as usize];
        'nodes: loop {
            let (lanes, enters) = slabs.enters(node);
            let mut child;
            if lanes != 0 {
                // The nearest child is the last lane; the others wait.
                let lane = u32::from(lanes).ilog2();
                child = node.children[(lane ^ slabs.flip) as usize % LANES];
                let others = lanes ^ 1 << lane;
                waiting = enters.push(stack, waiting, others, &node.children, slabs.flip);
            } else if let Some(next) = stack.pop(&mut waiting, start.waiting, slabs.end) {
                child = next;
            } else {
                break;
            }
            loop {
                let (place, vertices) = match Child::new(child) {
                    Child::Node(number) => {
                        node = &self.nodes[number as usize];
                        continue 'nodes;
                    }
                    Child::Leaf { place, vertices } => (place, vertices),
                };
                let leaf = self.triangles.leaf(place, vertices);
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
                        let number = leaf.number(lane);
                        // Of two at the same distance the first triangle counts.
                        if t < t_max || t == t_max && nearest.is_none_or(|n| number < n.number) {
                            t_max = t;
                            slabs.shorten(t);
                            nearest = Some(Place { place, vertices, lane, number });
                        }
                    }
                }
                match stack.pop(&mut waiting, start.waiting, slabs.end) {
                    Some(next) => child = next,
                    None => break 'nodes,
                }
            }
        }
        let Some(place) = nearest else { return Ok(None) };
        let leaf = self.triangles.leaf(place.place, place.vertices);
        let hit = hit(&sheared, leaf, place.lane, ray.t_min, ray.t_max).ok_or(Unsure)?;
        Ok(Some((hit, place.number)))
    }

    /// Whether the ray hits anything below a node. If `SURE`, all triangles that it may hit are asked, else
    /// the first.
    #[inline(always)]
    pub(super) fn find_any<L: Lanes, const SURE: bool>(
        &self,
        stack: &mut Stack,
        ray: &Ray,
        start: Start,
    ) -> Result<bool, Unsure> {
        let sheared = ShearedRay::new(ray);
        if self.nodes.is_empty() || !is_sound(ray, &sheared) {
            return Ok(false);
        }
        let needle = Needle::<L>::new(&sheared, ray.t_min);
        let slabs = Slabs::<L>::new(ray, self.largest_coordinate);
        let mut waiting = start.waiting;
        let mut node = &self.nodes[start.node as usize];
        let (leaf, lane) = 'nodes: loop {
            let lanes = slabs.meets(node);
            let mut child;
            if lanes != 0 {
                let lane = lanes.trailing_zeros();
                child = node.children[lane as usize % LANES];
                let others = lanes & (lanes - 1);
                waiting = L::splat(0.0).push(stack, waiting, others, &node.children, 0);
            } else if let Some(next) = stack.pop(&mut waiting, start.waiting, f32::INFINITY) {
                child = next;
            } else {
                return Ok(false);
            }
            loop {
                let (place, vertices) = match Child::new(child) {
                    Child::Node(number) => {
                        node = &self.nodes[number as usize];
                        continue 'nodes;
                    }
                    Child::Leaf { place, vertices } => (place, vertices),
                };
                let leaf = self.triangles.leaf(place, vertices);
                if let Some(met) = needle.meets(leaf, L::splat(ray.t_max)) {
                    let mut lanes = met.lanes;
                    if !SURE && lanes != 0 {
                        break 'nodes (leaf, lanes.trailing_zeros());
                    }
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros();
                        if hit(&sheared, leaf, lane, ray.t_min, ray.t_max).is_some() {
                            return Ok(true);
                        }
                        lanes &= lanes - 1;
                    }
                }
                match stack.pop(&mut waiting, start.waiting, f32::INFINITY) {
                    Some(next) => child = next,
                    None => return Ok(false),
                }
            }
        };
        let hit = hit(&sheared, leaf, lane, ray.t_min, ray.t_max);
        hit.map(|_| true).ok_or(Unsure)
    }
}

/// Whether the ray is made of numbers and has a direction. No triangle is met by one that is not, and
/// every box would be.
#[inline(always)]
fn is_sound(ray: &Ray, sheared: &ShearedRay) -> bool {
    // 0 times what is not finite is NaN, which outlasts all that is added.
    let o = ray.o.x + ray.o.y + ray.o.z;
    !(0.0 * o + sheared.shear[0] + sheared.shear[1]).is_nan()
}
