//! [`Row`] and [`Rows`]: numbers for each hit of a block.

use bytemuck::Zeroable;

use super::float::Block;

/// Most hits of a block. Their data stay in the first-level cache.
pub const ROW: usize = 64;

/// Which hits of a block satisfy a condition: one bit each, the first lowest.
pub type RowMask = u64;

/// One number for each hit of a block.
#[derive(Clone, Copy, Zeroable)]
#[repr(align(64))]
pub struct Row([f32; ROW]);

impl Row {
    /// The same number for each hit.
    #[inline(always)]
    pub const fn splat(x: f32) -> Self {
        Self([x; ROW])
    }

    /// The numbers of the lanes from `at` on.
    #[inline(always)]
    pub fn load<F: Block>(&self, at: usize) -> F {
        F::load(&self.0[at..])
    }

    /// Replaces the numbers of the lanes from `at` on.
    #[inline(always)]
    pub fn store<F: Block>(&mut self, at: usize, x: F) {
        x.store(&mut self.0[at..]);
    }

    /// The number of a hit.
    #[inline(always)]
    pub fn get(&self, i: usize) -> f32 {
        self.0[i % ROW]
    }

    /// Replaces the number of a hit.
    #[inline(always)]
    pub fn set(&mut self, i: usize, x: f32) {
        self.0[i % ROW] = x;
    }

    /// The numbers of the first hits.
    #[inline(always)]
    pub fn first_mut(&mut self, len: usize) -> &mut [f32] {
        &mut self.0[..len]
    }
}

/// `N` numbers for each hit of a block, such as the coordinates of a vector: a row of each.
#[derive(Clone, Copy, Zeroable)]
pub struct Rows<const N: usize>([Row; N]);

impl<const N: usize> Rows<N> {
    /// The same numbers for each hit.
    #[inline(always)]
    pub const fn splat(x: f32) -> Self {
        Self([Row::splat(x); N])
    }

    /// These numbers for each hit.
    #[inline(always)]
    pub fn of(numbers: [f32; N]) -> Self {
        let mut rows = Self::splat(0.0);
        for (row, number) in rows.0.iter_mut().zip(numbers) {
            *row = Row::splat(number);
        }
        rows
    }

    /// The numbers of the lanes from `at` on.
    #[inline(always)]
    pub fn load<F: Block>(&self, at: usize) -> [F; N] {
        let mut x = [F::splat(0.0); N];
        for (x, row) in x.iter_mut().zip(&self.0) {
            *x = row.load(at);
        }
        x
    }

    /// Replaces the numbers of the lanes from `at` on.
    #[inline(always)]
    pub fn store<F: Block>(&mut self, at: usize, x: [F; N]) {
        for (row, x) in self.0.iter_mut().zip(x) {
            row.store(at, x);
        }
    }

    /// The numbers of a hit.
    #[inline(always)]
    pub fn get(&self, i: usize) -> [f32; N] {
        let mut x = [0.0; N];
        for (x, row) in x.iter_mut().zip(&self.0) {
            *x = row.get(i);
        }
        x
    }

    /// Replaces the numbers of a hit.
    #[inline(always)]
    pub fn set(&mut self, i: usize, x: [f32; N]) {
        for (row, x) in self.0.iter_mut().zip(x) {
            row.set(i, x);
        }
    }
}

/// Where the vectors of a block of `len` hits begin: 0, `F::LANES`, 2 `F::LANES` and so on.
#[inline(always)]
pub fn groups<F: Block>(len: usize) -> impl Iterator<Item = usize> {
    (0..len.min(ROW)).step_by(F::LANES)
}

/// Bits of those lanes from `at` on that belong to a block of `len` hits.
#[inline(always)]
pub fn lanes_within<F: Block>(at: usize, len: usize) -> u32 {
    let count = (len - at).min(F::LANES);
    (1 << count) - 1
}

/// The indices of the bits of a mask, lowest first.
#[inline(always)]
pub fn indices(mut mask: RowMask) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let index = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (index < ROW).then_some(index)
    })
}
