//! One ray through the tree: [`ClosestHit`] and [`AnyHit`].
//!
//! All triangles of a leaf are tested at once. If for one of them vectors can't tell what the scalar test of
//! [`crate::shape::ShearedRay`] would, the ray is traced once more with the scalar test for every candidate.

use super::leaf_test::{Candidates, candidates, intersect_triangle};
use super::space::Space;
use super::stack::Stack;
use crate::accel::tree::{Bvh, Child, Leaf};
use crate::geometry::Ray;
use crate::interaction::Hit;
use crate::shape::{ShearedRay, TriangleHit};
use crate::simd::{ARITY, Block, Kernel, LaneMask, Lanes, Vector};

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

/// Writes the closest hit of a ray in a space, from some place of the tree on. Leaves `hit` as it is if there is none.
pub struct ClosestHit<'a, S> {
    pub space: S,
    pub start: Start,
    /// Its triangle is told by its id, its shape is left as it is.
    pub hit: &'a mut Hit,
}

/// Whether a ray hits anything in a space, from some place of the tree on.
pub struct AnyHit<S>(pub S, pub Start);

/// As [`ClosestHit`], with the scalar test for every candidate. A function of its own, since it hardly ever runs.
struct ClosestHitExact<'a, S>(ClosestHit<'a, S>);

/// As [`AnyHit`], with the scalar test for every candidate.
struct AnyHitExact<S>(S, Start);

impl<S: Space> Kernel for ClosestHit<'_, S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) {
        if let Err(Undecided) = closest::<L, S, false>(&mut self, ray, bvh, stack) {
            L::call(bvh, stack, ray, ClosestHitExact(self));
        }
    }
}

impl<S: Space> Kernel for ClosestHitExact<'_, S> {
    type Input = Ray;
    type Data = Bvh;
    type Scratch = Stack;
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, ray: &Ray, bvh: &Bvh, stack: &mut Stack) {
        // Never undecided.
        let _ = closest::<L, S, true>(&mut self.0, ray, bvh, stack);
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

/// Only the scalar test can tell.
struct Undecided;

/// The closest hit below a node. With `EXACT`, every candidate takes the scalar test.
#[inline(always)]
fn closest<L: Lanes, S: Space, const EXACT: bool>(
    ClosestHit { space, start, hit }: &mut ClosestHit<S>,
    ray: &Ray,
    bvh: &Bvh,
    stack: &mut Stack,
) -> Result<(), Undecided> {
    let (space, start) = (*space, *start);
    let sheared = ShearedRay::new(ray);
    if bvh.nodes.is_empty() || !is_valid(ray, &sheared) {
        return Ok(());
    }
    let mut slabs = space.slabs::<L::Boxes>(ray, bvh);
    let mut nearest =
        Nearest { t: ray.t_max, t_min: ray.t_min, id: NONE, edges: [0.0; 3], determinant: 1.0 };
    let mut stack_len = start.stack_len;
    let mut child = start.node;
    'leaves: loop {
        while let Child::Node(index) = Child::unpack(child) {
            let node = &bvh.nodes[index as usize];
            let (met, distances) = slabs.met(node);
            let slots = met.bits();
            if slots & slots.wrapping_sub(1) != 0 {
                child = stack.push_children(&mut stack_len, met, &node.children, distances);
            } else if slots != 0 {
                child = node.children[slots.trailing_zeros() as usize % ARITY];
            } else if let Some(next) = stack.pop(&mut stack_len, start.stack_len, slabs.end) {
                child = next;
            } else {
                break 'leaves;
            }
        }
        let leaf = bvh.leaf(child);
        let is_nearer = nearest.update::<L, S, EXACT>(space, &sheared, leaf)?;
        if is_nearer {
            slabs.shorten(nearest.t);
        }
        match stack.pop(&mut stack_len, start.stack_len, slabs.end) {
            Some(next) => child = next,
            None => break,
        }
    }
    if nearest.id != NONE {
        let [a, b, c] = nearest.edges;
        let sum = nearest.determinant;
        (hit.t, hit.b, hit.triangle) = (nearest.t, [a / sum, b / sum, c / sum], nearest.id);
    }
    Ok(())
}

/// Whether the ray hits anything below a node. With `EXACT`, every candidate takes the scalar test.
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
    let slabs = space.slabs::<L::Boxes>(ray, bvh);
    let mut stack_len = start.stack_len;
    let mut child = start.node;
    loop {
        while let Child::Node(index) = Child::unpack(child) {
            let node = &bvh.nodes[index as usize];
            let slots = slabs.met(node).0.bits();
            if slots != 0 {
                // The largest first: the first hit ends the search.
                let largest = slots.ilog2();
                child = node.children[largest as usize % ARITY];
                let others = slots ^ 1 << largest;
                if others != 0 {
                    stack_len = stack.push_any::<L::Boxes>(stack_len, others, &node.children);
                }
            } else if let Some(next) = stack.pop_any(&mut stack_len, start.stack_len) {
                child = next;
            } else {
                return Ok(false);
            }
        }
        let leaf = bvh.leaf(child);
        let is_hit = is_any_hit::<L, S, EXACT>(space, &sheared, leaf, ray)?;
        if is_hit {
            return Ok(true);
        }
        match stack.pop_any(&mut stack_len, start.stack_len) {
            Some(next) => child = next,
            None => return Ok(false),
        }
    }
}

/// Whether the ray hits a triangle of a leaf.
#[inline(always)]
fn is_any_hit<L: Lanes, S: Space, const EXACT: bool>(
    space: S,
    sheared: &ShearedRay,
    leaf: Leaf,
    ray: &Ray,
) -> Result<bool, Undecided> {
    let (t_min, t_max) = (ray.t_min, ray.t_max);
    for first in (0..leaf.triangles()).step_by(L::Narrow::LANES) {
        let found = candidates::<L, S>(space, sheared, leaf, first, t_min, t_max);
        let Some(Candidates { lanes, mut undecided, .. }) = found else { continue };
        if lanes & !undecided != 0 {
            return Ok(true);
        }
        if !EXACT && undecided != 0 {
            return Err(Undecided);
        }
        while undecided != 0 {
            let lane = first as u32 + undecided.trailing_zeros();
            undecided &= undecided - 1;
            if intersect_triangle(space, sheared, leaf, lane, t_min, t_max).is_some() {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// The id of no triangle.
const NONE: u32 = u32::MAX;

/// The nearest hit so far.
struct Nearest {
    t: f32,
    t_min: f32,
    id: u32,
    /// The barycentric coordinates, and by what they are still to be divided.
    edges: [f32; 3],
    determinant: f32,
}

impl Nearest {
    /// Tests a leaf; returns whether it has a nearer hit.
    #[inline(always)]
    fn update<L: Lanes, S: Space, const EXACT: bool>(
        &mut self,
        space: S,
        sheared: &ShearedRay,
        leaf: Leaf,
    ) -> Result<bool, Undecided> {
        let mut is_nearer = false;
        for first in (0..leaf.triangles()).step_by(L::Narrow::LANES) {
            let found = candidates::<L, S>(space, sheared, leaf, first, self.t_min, self.t);
            let Some(Candidates { mut lanes, undecided, crossing }) = found else { continue };
            if !EXACT && undecided != 0 {
                return Err(Undecided);
            }
            while lanes != 0 {
                let in_vector = lanes.trailing_zeros();
                let lane = first as u32 + in_vector;
                lanes &= lanes - 1;
                let id = leaf.id(lane);
                if EXACT && undecided >> in_vector & 1 == 1 {
                    let hit = intersect_triangle(space, sheared, leaf, lane, self.t_min, self.t);
                    let Some(TriangleHit { t, b }) = hit else { continue };
                    is_nearer |= self.take(t, id, b, 1.0);
                } else {
                    let [a, b, c] = crossing.edges;
                    let edges = [a.lane(in_vector), b.lane(in_vector), c.lane(in_vector)];
                    let t = crossing.t.lane(in_vector);
                    let sum = crossing.determinant.lane(in_vector);
                    is_nearer |= self.take(t, id, edges, sum);
                }
            }
        }
        Ok(is_nearer)
    }

    /// Takes a hit if it is nearer. Of two at the same distance the one with the lower id counts.
    #[inline(always)]
    fn take(&mut self, t: f32, id: u32, edges: [f32; 3], determinant: f32) -> bool {
        let is_nearer = t < self.t || t == self.t && id < self.id;
        if is_nearer {
            *self = Self { t, t_min: self.t_min, id, edges, determinant };
        }
        is_nearer
    }
}

/// Whether the ray is finite, with a non-zero direction. Any other ray hits no triangle, yet would enter every box.
#[inline(always)]
fn is_valid(ray: &Ray, sheared: &ShearedRay) -> bool {
    // 0 · x is NaN unless x is finite, and a sum with a NaN is NaN.
    let o = ray.o.x + ray.o.y + ray.o.z;
    !(0.0 * o + sheared.shear[0] + sheared.shear[1]).is_nan()
}
