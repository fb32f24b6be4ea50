//! One ray through the tree: [`ClosestHit`] and [`AnyHit`].
//!
//! Vectors only pick the triangles that may be hit. The scalar test of [`crate::shape::ShearedRay`] is asked once, about
//! the nearest, and gives the hit. If it refuses, or if some triangle needs it to be decided, the ray is traced once more
//! with the scalar test for every candidate.

use super::leaf_test::{LeafTest, intersect_triangle};
use super::space::Space;
use super::stack::Stack;
use crate::accel::tree::{Bvh, Child, Leaf};
use crate::geometry::Ray;
use crate::shape::{ShearedRay, TriangleHit};
use crate::simd::{Kernel, LANES, Lanes, Mask, Vector};

/// Where traversal begins: at the root, or for rays that leave a beam further down.
#[derive(Clone, Copy)]
pub struct Start {
    pub node: u32,
    /// Length of the stack, whose entries are not this ray's.
    pub stack_len: usize,
}

impl Start {
    pub const ROOT: Self = Self { node: 0, stack_len: 0 };
}

/// A ray's hit, with the id of the triangle.
pub type Found = Option<(TriangleHit, u32)>;

/// The closest hit of a ray in a space, from some place of the tree on.
pub struct ClosestHit<S>(pub S, pub Start);

/// Whether a ray hits anything in a space, from some place of the tree on.
pub struct AnyHit<S>(pub S, pub Start);

/// As [`ClosestHit`], with the scalar test for every candidate. A function of its own, since it hardly ever runs.
struct ClosestHitExact<S>(S, Start);

/// As [`AnyHit`], with the scalar test for every candidate.
struct AnyHitExact<S>(S, Start);

impl<S: Space> Kernel for ClosestHit<S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = Found;

    #[inline(always)]
    fn run<L: Lanes>(self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) -> Found {
        match closest::<L, S, false>(self.0, ray, bvh, stack, self.1) {
            Ok(found) => found,
            Err(Undecided) => L::call(bvh, stack, ray, ClosestHitExact(self.0, self.1)),
        }
    }
}

impl<S: Space> Kernel for ClosestHitExact<S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = Found;

    #[inline(always)]
    fn run<L: Lanes>(self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) -> Found {
        closest::<L, S, true>(self.0, ray, bvh, stack, self.1).unwrap_or(None)
    }
}

impl<S: Space> Kernel for AnyHit<S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) -> bool {
        match any::<L, S, false>(self.0, ray, bvh, stack, self.1) {
            Ok(found) => found,
            Err(Undecided) => L::call(bvh, stack, ray, AnyHitExact(self.0, self.1)),
        }
    }
}

impl<S: Space> Kernel for AnyHitExact<S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) -> bool {
        any::<L, S, true>(self.0, ray, bvh, stack, self.1).unwrap_or(false)
    }
}

/// Only the scalar test of every candidate can tell: an edge function is zero, or rounding may have made the hit up.
struct Undecided;

/// The closest hit below a node. With `EXACT`, every candidate takes the scalar test, with its bound on the error of t.
/// Without, only the nearest does in the end, and nearly always passes.
#[inline(always)]
fn closest<L: Lanes, S: Space, const EXACT: bool>(
    space: S,
    ray: &Ray,
    bvh: &Bvh,
    stack: &mut Stack,
    start: Start,
) -> Result<Found, Undecided> {
    let sheared = ShearedRay::new(ray);
    if bvh.nodes.is_empty() || !is_valid(ray, &sheared) {
        return Ok(None);
    }
    let narrow = LeafTest::<L::Narrow>::new(&sheared, ray.t_min);
    let mut slabs = space.slabs::<L>(ray, bvh);
    let mut nearest = Nearest { t: ray.t_max, t_min: ray.t_min, triangle: None };
    let mut stack_len = start.stack_len;
    let mut node = &bvh.nodes[start.node as usize];
    'nodes: loop {
        let (lanes, distances) = slabs.lanes_met(node);
        let mut child;
        if lanes != 0 {
            // The nearest child is in the highest lane. The others go to the stack.
            let above = lanes.leading_zeros();
            let others = lanes ^ 1 << (Mask::BITS - 1) >> above;
            child = node.children[(above ^ slabs.flip_near_first) as usize % LANES];
            stack_len =
                stack.push_children(stack_len, others, &node.children, distances, slabs.flip);
        } else if let Some(next) = stack.pop(&mut stack_len, start.stack_len, slabs.end) {
            child = next;
        } else {
            break;
        }
        loop {
            if let Child::Node(index) = Child::unpack(child) {
                node = &bvh.nodes[index as usize];
                continue 'nodes;
            }
            let leaf = bvh.leaf(child);
            let is_nearer = if leaf.fits::<L::Narrow>() {
                nearest.update::<_, S, EXACT>(space, &narrow, &sheared, leaf, child)?
            } else {
                let wide = LeafTest::<L>::new(&sheared, ray.t_min);
                nearest.update::<_, S, EXACT>(space, &wide, &sheared, leaf, child)?
            };
            if is_nearer {
                slabs.shorten(nearest.t);
            }
            match stack.pop(&mut stack_len, start.stack_len, slabs.end) {
                Some(next) => child = next,
                None => break 'nodes,
            }
        }
    }
    let Some(LeafTriangle { child, lane, id }) = nearest.triangle else { return Ok(None) };
    let hit = intersect_triangle(space, &sheared, bvh.leaf(child), lane, ray.t_min, ray.t_max);
    Ok(Some((hit.ok_or(Undecided)?, id)))
}

/// Whether the ray hits anything below a node. With `EXACT`, candidates take the scalar test until one passes; without,
/// only the first does.
#[inline(always)]
fn any<L: Lanes, S: Space, const EXACT: bool>(
    space: S,
    ray: &Ray,
    bvh: &Bvh,
    stack: &mut Stack,
    start: Start,
) -> Result<bool, Undecided> {
    let sheared = ShearedRay::new(ray);
    if bvh.nodes.is_empty() || !is_valid(ray, &sheared) {
        return Ok(false);
    }
    let narrow = LeafTest::<L::Narrow>::new(&sheared, ray.t_min);
    let slabs = space.slabs::<L>(ray, bvh);
    let mut stack_len = start.stack_len;
    let mut node = &bvh.nodes[start.node as usize];
    let (leaf, lane) = 'nodes: loop {
        let slots = slabs.slots_met(node);
        let mut child;
        if slots != 0 {
            // In any order: the first hit ends the search.
            let slot = slots.trailing_zeros();
            child = node.children[slot as usize % LANES];
            let others = slots & (slots - 1);
            stack_len = stack.push_children(stack_len, others, &node.children, L::splat(0.0), 0);
        } else if let Some(next) = stack.pop(&mut stack_len, start.stack_len, f32::INFINITY) {
            child = next;
        } else {
            return Ok(false);
        }
        loop {
            if let Child::Node(index) = Child::unpack(child) {
                node = &bvh.nodes[index as usize];
                continue 'nodes;
            }
            let leaf = bvh.leaf(child);
            let mut lanes = if leaf.fits::<L::Narrow>() {
                candidate_lanes(space, &narrow, leaf, ray.t_max)
            } else {
                candidate_lanes(space, &LeafTest::<L>::new(&sheared, ray.t_min), leaf, ray.t_max)
            };
            if !EXACT && lanes != 0 {
                break 'nodes (leaf, lanes.trailing_zeros());
            }
            while lanes != 0 {
                let lane = lanes.trailing_zeros();
                if intersect_triangle(space, &sheared, leaf, lane, ray.t_min, ray.t_max).is_some() {
                    return Ok(true);
                }
                lanes &= lanes - 1;
            }
            match stack.pop(&mut stack_len, start.stack_len, f32::INFINITY) {
                Some(next) => child = next,
                None => return Ok(false),
            }
        }
    };
    let hit = intersect_triangle(space, &sheared, leaf, lane, ray.t_min, ray.t_max);
    hit.map(|_| true).ok_or(Undecided)
}

/// A triangle in a leaf.
#[derive(Clone, Copy)]
struct LeafTriangle {
    /// The encoded child that is the leaf.
    child: u32,
    lane: u32,
    id: u32,
}

/// The nearest hit so far.
struct Nearest {
    t: f32,
    t_min: f32,
    triangle: Option<LeafTriangle>,
}

impl Nearest {
    /// Tests a leaf; returns whether it has a nearer hit.
    #[inline(always)]
    fn update<V: Vector, S: Space, const EXACT: bool>(
        &mut self,
        space: S,
        test: &LeafTest<V>,
        sheared: &ShearedRay,
        leaf: Leaf,
        child: u32,
    ) -> Result<bool, Undecided> {
        let Some(candidates) = test.candidates(space, leaf, V::splat(self.t)) else {
            return Ok(false);
        };
        if !EXACT && candidates.undecided != 0 {
            return Err(Undecided);
        }
        let mut is_nearer = false;
        let mut lanes = candidates.lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros();
            lanes &= lanes - 1;
            let mut t = candidates.t.lane(lane);
            if EXACT {
                let hit = intersect_triangle(space, sheared, leaf, lane, self.t_min, self.t);
                let Some(hit) = hit else { continue };
                t = hit.t;
            }
            let id = leaf.id(lane);
            // Of two at the same distance the one with the lower id counts.
            if t < self.t || t == self.t && self.triangle.is_none_or(|other| id < other.id) {
                self.t = t;
                self.triangle = Some(LeafTriangle { child, lane, id });
                is_nearer = true;
            }
        }
        Ok(is_nearer)
    }
}

/// The lanes of the triangles that the ray hits, or may hit.
#[inline(always)]
fn candidate_lanes<V: Vector, S: Space>(
    space: S,
    test: &LeafTest<V>,
    leaf: Leaf,
    t_max: f32,
) -> Mask {
    test.candidates(space, leaf, V::splat(t_max)).map_or(0, |candidates| candidates.lanes)
}

/// Whether the ray is finite, with a non-zero direction. Any other ray hits no triangle, yet would enter every box.
#[inline(always)]
fn is_valid(ray: &Ray, sheared: &ShearedRay) -> bool {
    // 0 · x is NaN unless x is finite, and a sum with a NaN is NaN.
    let o = ray.o.x + ray.o.y + ray.o.z;
    !(0.0 * o + sheared.shear[0] + sheared.shear[1]).is_nan()
}
