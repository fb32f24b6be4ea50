//! [`Stack`]: the children that a ray has still to visit.

use std::cell::RefCell;

use crate::accel::tree::MAX_DEPTH;
use crate::simd::{LANES, Lanes, Mask};

/// Worst case: each level leaves all children but one on the stack, and the last push writes a whole vector.
const CAPACITY: usize = (LANES - 1) * MAX_DEPTH + LANES;

/// Ids of children, and the distance at which the ray enters each. Single rays store encoded children and t; beams
/// store indices of slots and the distance along the frustum's axis. Traversal itself counts the entries.
pub struct Stack {
    ids: [u32; CAPACITY],
    distances: [f32; CAPACITY],
}

thread_local! {
    /// Not cleared between rays: traversal reads only what it has pushed.
    static OF_THREAD: RefCell<Stack> =
        const { RefCell::new(Stack { ids: [0; CAPACITY], distances: [0.0; CAPACITY] }) };
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
                return Some(self.ids[*len]);
            }
        }
        None
    }

    /// Pushes the children in the lanes of `mask`, lowest first, with the distances in those lanes; see
    /// [`Lanes::compress_children`]. Returns the new length.
    #[inline(always)]
    pub fn push_children<L: Lanes>(
        &mut self,
        len: usize,
        mask: Mask,
        children: &[u32; LANES],
        distances: L,
        flip: u32,
    ) -> usize {
        if L::SKIPS_EMPTY && mask == 0 {
            return len;
        }
        let (ids, to_distances) = self.room(len);
        distances.compress_children(mask, children, flip, ids, to_distances);
        len + mask.count_ones() as usize
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
        if L::SKIPS_EMPTY && mask == 0 {
            return len;
        }
        let (ids, to_distances) = self.room(len);
        distances.compress_slots(mask, first, flip, ids, to_distances);
        len + mask.count_ones() as usize
    }

    /// Where the next entries go: room for all lanes, of which the next push overwrites those that are unused.
    #[inline(always)]
    fn room(&mut self, len: usize) -> (&mut [u32; LANES], &mut [f32; LANES]) {
        let range = len..len + LANES;
        let ids = (&mut self.ids[range.clone()]).try_into().expect("LANES entries");
        (ids, (&mut self.distances[range]).try_into().expect("LANES entries"))
    }
}
