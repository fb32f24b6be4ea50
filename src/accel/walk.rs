//! How one ray walks the tree.

use super::Accel;
use super::lanes::{LANES, Lanes, Mask, Vector};
use super::needle::{Needle, hit};
use super::node::Child;
use super::slabs::Slabs;
use super::stack::Stack;
use super::triangles::Leaf;
use crate::geometry::Ray;
use crate::shape::{ShearedRay, TriangleHit};

/// A triangle in a leaf.
#[derive(Clone, Copy)]
struct Place {
    /// What the node refers to the leaf by.
    child: u32,
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
    /// The leaf that a node refers to.
    #[inline(always)]
    fn leaf_of(&self, child: u32) -> Leaf<'_> {
        let (place, vertices) = Child::place(child);
        self.triangles.leaf(place, vertices)
    }

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
        let narrow = Needle::<L::Narrow>::new(&sheared, ray.t_min);
        let mut slabs = Slabs::<L>::new(ray, self.largest_coordinate);
        let mut nearest = Nearest { t: ray.t_max, t_min: ray.t_min, place: None };
        let mut waiting = start.waiting;
        let mut node = &self.nodes[start.node as usize];
        'nodes: loop {
            let (lanes, enters) = slabs.enters(node);
            let mut child;
            if lanes != 0 {
                // The nearest child is the last lane; the others wait.
                let before_last = lanes.leading_zeros();
                let others = lanes ^ 1 << (LANES as u32 - 1) >> before_last;
                child = node.children[(before_last ^ slabs.backwards) as usize % LANES];
                waiting = enters.push(stack, waiting, others, &node.children, slabs.flip);
            } else if let Some(next) = stack.pop(&mut waiting, start.waiting, slabs.end) {
                child = next;
            } else {
                break;
            }
            loop {
                if let Child::Node(number) = Child::new(child) {
                    node = &self.nodes[number as usize];
                    continue 'nodes;
                }
                let leaf = self.leaf_of(child);
                let is_nearer = if leaf.fits::<L::Narrow>() {
                    nearest.meet::<_, SURE>(&narrow, &sheared, leaf, child)?
                } else {
                    nearest.meet::<_, SURE>(
                        &Needle::<L>::new(&sheared, ray.t_min),
                        &sheared,
                        leaf,
                        child,
                    )?
                };
                if is_nearer {
                    slabs.shorten(nearest.t);
                }
                match stack.pop(&mut waiting, start.waiting, slabs.end) {
                    Some(next) => child = next,
                    None => break 'nodes,
                }
            }
        }
        let Some(place) = nearest.place else { return Ok(None) };
        let leaf = self.leaf_of(place.child);
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
        let narrow = Needle::<L::Narrow>::new(&sheared, ray.t_min);
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
                if let Child::Node(number) = Child::new(child) {
                    node = &self.nodes[number as usize];
                    continue 'nodes;
                }
                let leaf = self.leaf_of(child);
                let mut lanes = if leaf.fits::<L::Narrow>() {
                    lanes_met(&narrow, leaf, ray.t_max)
                } else {
                    lanes_met(&Needle::<L>::new(&sheared, ray.t_min), leaf, ray.t_max)
                };
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

/// The nearest hit so far.
struct Nearest {
    t: f32,
    t_min: f32,
    place: Option<Place>,
}

impl Nearest {
    /// Tests a leaf; whether a hit in it is nearer.
    #[inline(always)]
    fn meet<V: Vector, const SURE: bool>(
        &mut self,
        needle: &Needle<V>,
        sheared: &ShearedRay,
        leaf: Leaf,
        child: u32,
    ) -> Result<bool, Unsure> {
        let Some(met) = needle.meets(leaf, V::splat(self.t)) else { return Ok(false) };
        if !SURE && met.unsure != 0 {
            return Err(Unsure);
        }
        let mut is_nearer = false;
        let mut lanes = met.lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros();
            lanes &= lanes - 1;
            let mut t = met.t.lane(lane);
            if SURE {
                let hit = hit(sheared, leaf, lane, self.t_min, self.t);
                let Some(hit) = hit else { continue };
                t = hit.t;
            }
            let number = leaf.number(lane);
            // Of two at the same distance the first triangle counts.
            if t < self.t || t == self.t && self.place.is_none_or(|n| number < n.number) {
                self.t = t;
                self.place = Some(Place { child, lane, number });
                is_nearer = true;
            }
        }
        Ok(is_nearer)
    }
}

/// The triangles that a ray meets, or may meet.
#[inline(always)]
fn lanes_met<V: Vector>(needle: &Needle<V>, leaf: Leaf, t_max: f32) -> Mask {
    needle.meets(leaf, V::splat(t_max)).map_or(0, |met| met.lanes)
}

/// Whether the ray is made of numbers and has a direction. No triangle is met by one that is not, and
/// every box would be.
#[inline(always)]
fn is_sound(ray: &Ray, sheared: &ShearedRay) -> bool {
    // 0 times what is not finite is NaN, which outlasts all that is added.
    let o = ray.o.x + ray.o.y + ray.o.z;
    !(0.0 * o + sheared.shear[0] + sheared.shear[1]).is_nan()
}
