//! [`Pushed`]: a list that grows by several elements at a time.

use bytemuck::Zeroable;

use crate::simd::MAX_LANES;

/// A list within a buffer that is allocated at once.
pub struct Pushed<T> {
    /// The elements, and room for [`MAX_LANES`] at least.
    buffer: Vec<T>,
    len: usize,
}

impl<T> Default for Pushed<T> {
    fn default() -> Self {
        Self { buffer: Vec::new(), len: 0 }
    }
}

impl<T: Copy + Zeroable> Pushed<T> {
    /// Bytes of a list for that many elements.
    pub const fn bytes(elements: usize) -> usize {
        (elements + MAX_LANES) * size_of::<T>()
    }

    /// An empty list with room for that many elements.
    pub fn with_capacity(elements: usize) -> Self {
        Self { buffer: vec![T::zeroed(); elements + MAX_LANES], len: 0 }
    }

    /// Adds an element.
    #[inline]
    pub fn push(&mut self, element: T) {
        self.reserve();
        self.buffer[self.len] = element;
        self.len += 1;
    }

    /// Adds those elements whose bits in the mask are set.
    ///
    /// Branch-free: each is written, and stays if its bit is set. Branches on the bits would be mispredicted.
    #[inline(always)]
    pub fn push_some(&mut self, mask: u32, elements: &[T]) {
        self.reserve();
        let room: &mut [T; MAX_LANES] =
            (&mut self.buffer[self.len..][..MAX_LANES]).try_into().expect("as many elements");
        let mut count = 0;
        for (i, &element) in elements.iter().enumerate() {
            room[count % MAX_LANES] = element;
            count += (mask >> i & 1) as usize;
        }
        self.len += count;
    }

    /// Makes room for [`MAX_LANES`] elements. Nothing to do if the list was made with enough.
    #[inline(always)]
    fn reserve(&mut self) {
        if self.buffer.len() < self.len + MAX_LANES {
            self.grow();
        }
    }

    #[cold]
    fn grow(&mut self) {
        self.buffer.resize(2 * self.len + 2 * MAX_LANES, T::zeroed());
    }

    /// Removes all elements.
    #[inline]
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// All elements.
    #[inline]
    pub fn as_slice(&self) -> &[T] {
        &self.buffer[..self.len]
    }
}
