//! [`InForest`]: rays through trees that stand at several places.

use super::single_ray::{AnyHit, ClosestHit, Start};
use super::slabs::Slabs;
use super::space::Elsewhere;
use super::stack::Stack;
use crate::accel::tree::{Child, Forest, Place};
use crate::geometry::Ray;
use crate::interaction::Hit;
use crate::simd::{ARITY, Kernel, LaneMask, Lanes};

/// What rays hit in a forest, added to answers that are known from elsewhere.
pub struct InForest<'a, A> {
    /// As many as rays.
    pub answers: &'a mut [A],
}

impl Kernel for InForest<'_, Hit> {
    type Input = [Ray];
    type Data = Forest;
    type Scratch = Stack;
    type Output = ();

    /// Replaces hits by nearer ones. Of two at the same distance the one on the shape that comes first counts.
    #[inline(always)]
    fn run<L: Lanes>(self, rays: &[Ray], forest: &Forest, stack: &mut Stack) {
        for (ray, hit) in rays.iter().zip(self.answers) {
            walk::<L, false>(forest, stack, ray, hit);
        }
    }
}

impl Kernel for InForest<'_, bool> {
    type Input = [Ray];
    type Data = Forest;
    type Scratch = Stack;
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, rays: &[Ray], forest: &Forest, stack: &mut Stack) {
        for (ray, answer) in rays.iter().zip(self.answers) {
            *answer = *answer || walk::<L, true>(forest, stack, ray, &mut { Hit::MISS });
        }
    }
}

/// Visits the places that a ray meets, the nearest first. With `ANY`, returns whether it hits anything, and leaves `best` as it is.
#[inline(always)]
fn walk<L: Lanes, const ANY: bool>(
    forest: &Forest,
    stack: &mut Stack,
    ray: &Ray,
    best: &mut Hit,
) -> bool {
    let Some(mut node) = forest.nodes.first() else { return false };
    let mut ray = Ray { t_max: ray.t_max.min(best.t), ..*ray };
    let mut slabs = Slabs::<L::Boxes>::new(&ray, forest.largest_coordinate);
    let mut stack_len = 0;
    'nodes: loop {
        let (met, distances) = slabs.met(node);
        let slots = met.bits();
        let mut child;
        if slots & slots.wrapping_sub(1) != 0 {
            child = stack.push_children(&mut stack_len, met, &node.children, distances);
        } else if slots != 0 {
            child = node.children[slots.trailing_zeros() as usize % ARITY];
        } else if let Some(next) = stack.pop(&mut stack_len, 0, slabs.end) {
            child = next;
        } else {
            return false;
        }
        loop {
            match Child::unpack(child) {
                Child::Node(index) => {
                    node = &forest.nodes[index as usize];
                    continue 'nodes;
                }
                // An empty slot, which only rays that are not finite enter.
                Child::Leaf { index: 0, .. } => {}
                Child::Leaf { index, .. } => {
                    let place = &forest.places[index as usize - 1];
                    let start = Start { node: 0, stack_len };
                    if ANY {
                        if is_hit::<L>(forest, stack, &ray, place, start) {
                            return true;
                        }
                    } else if let Some(hit) = hit::<L>(forest, stack, &ray, place, start)
                        && (hit.t < best.t || hit.t == best.t && hit.shape < best.shape)
                    {
                        *best = hit;
                        ray.t_max = hit.t;
                        slabs.shorten(hit.t);
                    }
                }
            }
            match stack.pop(&mut stack_len, 0, slabs.end) {
                Some(next) => child = next,
                None => return false,
            }
        }
    }
}

#[inline(always)]
fn hit<L: Lanes>(
    forest: &Forest,
    stack: &mut Stack,
    ray: &Ray,
    place: &Place,
    start: Start,
) -> Option<Hit> {
    let tree = &forest.trees[place.tree as usize];
    let mut hit = Hit::MISS;
    L::call(tree, stack, ray, ClosestHit { space: Elsewhere(place), start, hit: &mut hit });
    hit.shape = place.shape;
    (hit.triangle != u32::MAX).then_some(hit)
}

#[inline(always)]
fn is_hit<L: Lanes>(
    forest: &Forest,
    stack: &mut Stack,
    ray: &Ray,
    place: &Place,
    start: Start,
) -> bool {
    let tree = &forest.trees[place.tree as usize];
    L::call(tree, stack, ray, AnyHit(Elsewhere(place), start))
}
