//! [`Stack`]: the children that a ray has still to visit.

use std::cell::RefCell;

use crate::accel::tree::MAX_DEPTH;
use crate::simd::{Bits, LANES, Lanes, Mask};

/// Worst case: each level leaves all children but one on the stack, and the last push writes a whole vector. Twice, since a tree
/// is walked below those above the trees of a forest.
const CAPACITY: usize = 2 * (LANES - 1) * MAX_DEPTH + LANES;

/// Ids of children, and the distance at which the ray enters each. Single rays store encoded children and t; beams
/// store indices of slots and the distance along the frustum's axis. Traversal itself counts the entries.
pub struct Stack {
    /// As the bits of an f32.
    ids: [f32; CAPACITY],
    distances: [f32; CAPACITY],
}

thread_local! {
    /// Not cleared between rays: traversal reads only what it has pushed.
    static OF_THREAD: RefCell<Stack> =
        const { RefCell::new(Stack { ids: [0.0; CAPACITY], distances: [0.0; CAPACITY] }) };
}

impl Stack {
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

    /// Pushes the children in the lanes of `mask`, lowest first, with the distances in those lanes. Mask and distances are
    /// [flipped](Lanes::flip), the children are not. Returns the new length.
    #[inline(always)]
    pub fn push_children<L: Lanes>(
        &mut self,
        len: usize,
        mask: Mask,
        children: &[u32; LANES],
        distances: L,
        flip: u32,
    ) -> usize {
        self.push(
            len,
            mask,
            L::load(bytemuck::cast_ref::<_, [f32; LANES]>(children)),
            distances,
            flip,
        )
    }

    /// As [`Stack::push_children`], with `first + slot` in place of the child of a slot.
    #[inline(always)]
    pub fn push_slots<L: Lanes>(
        &mut self,
        len: usize,
        mask: Mask,
        first: u32,
        distances: L,
        flip: u32,
    ) -> usize {
        let slots: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let slots = L::load(bytemuck::cast_ref::<_, [f32; LANES]>(&slots));
        let slots = L::from_bits(slots.to_bits().wrapping_add(L::Bits::splat(first as i32)));
        self.push(len, mask, slots, distances, flip)
    }

    #[inline(always)]
    fn push<L: Lanes>(&mut self, len: usize, mask: Mask, ids: L, distances: L, flip: u32) -> usize {
        if L::SKIPS_EMPTY && mask == 0 {
            return len;
        }
        // Room for all lanes, of which the next push overwrites those that are unused.
        let range = len..len + LANES;
        let to_ids = (&mut self.ids[range.clone()]).try_into().expect("LANES entries");
        let to_distances = (&mut self.distances[range]).try_into().expect("LANES entries");
        L::compress([ids.flip(flip), distances], mask, flip, [to_ids, to_distances]);
        len + mask.count_ones() as usize
    }
}
