//! [`Stack`]: the children that a ray has still to see.

use std::cell::RefCell;

use super::lanes::LANES;

/// No tree is deeper than this, in nodes; see [`super::part`].
pub const MOST_DEEP: usize = 16;

/// How many children can wait: of each node on the way down all but the one that is entered, and of the last
/// one all. A whole vector is written at a time.
const CAPACITY: usize = (LANES - 1) * MOST_DEEP + LANES;

/// Children that wait, and where the ray enters them; for beams the slots of children, and where those begin
/// along z. How many there are the walk itself remembers.
pub struct Stack {
    children: [u32; CAPACITY],
    enters: [f32; CAPACITY],
}

thread_local! {
    /// Each walk writes what it reads, so that it need not be cleared.
    static OF_THREAD: RefCell<Stack> =
        const { RefCell::new(Stack { children: [0; CAPACITY], enters: [0.0; CAPACITY] }) };
}

impl Stack {
    /// Calls `act` with the stack of this thread.
    #[inline]
    pub fn with<R>(act: impl FnOnce(&mut Self) -> R) -> R {
        OF_THREAD.with_borrow_mut(act)
    }

    /// The last child of those above `bottom` that begins before `end`.
    #[inline(always)]
    pub fn pop(&self, waiting: &mut usize, bottom: usize, end: f32) -> Option<u32> {
        while *waiting > bottom {
            *waiting -= 1;
            if self.enters[*waiting] <= end {
                return Some(self.children[*waiting]);
            }
        }
        None
    }

    /// Puts a child at a place.
    #[inline(always)]
    pub fn set(&mut self, place: usize, child: u32, enter: f32) {
        (self.children[place], self.enters[place]) = (child, enter);
    }

    /// Where the next children go, all lanes of them.
    #[inline(always)]
    pub fn room(&mut self, place: usize) -> (&mut [u32; LANES], &mut [f32; LANES]) {
        let all = place..place + LANES;
        let children = (&mut self.children[all.clone()]).try_into().expect("all lanes");
        (children, (&mut self.enters[all]).try_into().expect("all lanes"))
    }
}
