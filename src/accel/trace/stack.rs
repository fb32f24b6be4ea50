//! [`Stack`]: the children that a ray has still to visit.

use std::cell::RefCell;

use crate::accel::tree::MAX_DEPTH;
use crate::simd::{ARITY, Bits, Block, Eight, LaneMask, Mask};

/// Worst case: each level leaves all children but one on the stack, and the last push writes a whole vector. Twice, since a tree
/// is walked below those above the trees of a forest.
const CAPACITY: usize = 2 * (ARITY - 1) * MAX_DEPTH + 2 * ARITY;

/// Ids of children, and the distance at which the ray enters each. Single rays store encoded children and t; beams
/// store indices of slots and the distance along the frustum's axis. Traversal itself counts the entries.
pub struct Stack {
    /// As the bits of an f32.
    ids: [f32; CAPACITY],
    distances: [f32; CAPACITY],
}

thread_local! {
    /// Not cleared between rays: traversal reads only what it has pushed.
    static OF_THREAD: RefCell<Stack> = const { RefCell::new(Stack::NEW) };
}

impl Stack {
    const NEW: Self = Self { ids: [0.0; CAPACITY], distances: [0.0; CAPACITY] };

    /// A stack of one's own.
    pub fn boxed() -> Box<Self> {
        Box::new(Self::NEW)
    }

    /// Calls `f` with the stack of this thread.
    #[inline]
    pub fn with<R>(f: impl FnOnce(&mut Self) -> R) -> R {
        OF_THREAD.with_borrow_mut(f)
    }

    /// Pops entries above `bottom` until one is entered no later than `end`.
    #[inline(always)]
    pub fn pop(&self, len: &mut usize, bottom: usize, end: f32) -> Option<u32> {
        while *len > bottom {
            *len -= 1;
            if self.distances[*len] <= end {
                return Some(self.ids[*len].to_bits());
            }
        }
        None
    }

    /// Pops the topmost entry above `bottom`, wherever the ray enters it.
    #[inline(always)]
    pub fn pop_any(&self, len: &mut usize, bottom: usize) -> Option<u32> {
        if *len <= bottom {
            return None;
        }
        *len -= 1;
        Some(self.ids[*len].to_bits())
    }

    /// Pushes the children of a mask but the nearest, the second nearest last. Returns the nearest.
    #[inline(always)]
    pub fn push_children<B: Eight>(
        &mut self,
        len: &mut usize,
        mask: B::Mask,
        children: &[u32; ARITY],
        distances: B,
    ) -> u32 {
        let nearest = self.push(len, mask, load_ids(children), distances);
        *len -= 1;
        children[nearest % ARITY]
    }

    /// Pushes `first + slot` for all slots of a mask, the nearest last. Returns the new length.
    #[inline(always)]
    pub fn push_slots<B: Eight>(
        &mut self,
        mut len: usize,
        mask: B::Mask,
        first: u32,
        distances: B,
    ) -> usize {
        self.push(&mut len, mask, slots_from(first), distances);
        len
    }

    /// As [`Stack::push_slots`], the highest slot last.
    #[inline(always)]
    pub fn push_any_slots<B: Eight>(
        &mut self,
        len: usize,
        mask: B::Mask,
        first: u32,
        distances: B,
    ) -> usize {
        let mask = mask.bits();
        distances.compress(mask).store(&mut self.distances[len..len + ARITY]);
        slots_from::<B>(first).compress(mask).store(&mut self.ids[len..len + ARITY]);
        len + mask.count_ones() as usize
    }

    #[inline(always)]
    fn push<B: Eight>(&mut self, len: &mut usize, mask: B::Mask, ids: B, distances: B) -> usize {
        let ([ids, distances], nearest) = B::largest_first(mask, ids, distances);
        // Room for all lanes, of which the next push overwrites those that are unused.
        ids.store(&mut self.ids[*len..*len + ARITY]);
        distances.store(&mut self.distances[*len..*len + ARITY]);
        *len += mask.bits().count_ones() as usize;
        nearest
    }

    /// Pushes the children of a mask in any order, without distances. Returns the new length.
    #[inline(always)]
    pub fn push_any<B: Eight>(&mut self, len: usize, mask: Mask, children: &[u32; ARITY]) -> usize {
        load_ids::<B>(children).compress(mask).store(&mut self.ids[len..len + ARITY]);
        len + mask.count_ones() as usize
    }
}

#[inline(always)]
fn slots_from<B: Block>(first: u32) -> B {
    let slots = load_ids::<B>(&[0, 1, 2, 3, 4, 5, 6, 7]);
    B::from_bits(slots.to_bits().wrapping_add(B::Bits::splat(first as i32)))
}

#[inline(always)]
fn load_ids<B: Block>(ids: &[u32; ARITY]) -> B {
    B::load(bytemuck::cast_ref::<_, [f32; ARITY]>(ids))
}
