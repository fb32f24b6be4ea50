//! [`Discrete2d`]: a discrete distribution over the cells of a grid.

use std::collections::TryReserveError;

use glam::{DVec2, UVec2, Vec2};

use crate::geometry::float::ONE_MINUS_EPSILON;

/// Probabilities are whole multiples of 1/`UNITS`, so that sums are exact.
const UNITS: u32 = 1 << 31;

/// A discrete distribution over the cells of a grid: a row is drawn by its weight, and a column by its weight in that row.
///
/// Shares of rows, and of cells in their row, are whole numbers of 2⁻³¹: cumulative sums are exact, probabilities add up to 1
/// exactly, and `probability` is what `sample` draws by. Each cell with a weight gets at least one unit, so that its
/// probability is above 0 however small its weight is beside others: a share p of n cells is off by at most 2 + p n units. A
/// cell takes 4 bytes, where [`Discrete`](super::Discrete) takes 12.
///
/// As there, u has 24 bits, and a cell of a smaller probability may never be drawn.
///
/// ```
/// use lobe::glam::{DVec2, UVec2, Vec2};
/// use lobe::sampling::{Cell, Discrete2d};
///
/// let weights = [[1.0, 0.0, 1.0], [0.0, 0.0, 2.0]];
/// let weight = |column: u32, row: u32| weights[row as usize][column as usize];
/// let grid = Discrete2d::new(UVec2::new(3, 2), weight)?.unwrap();
/// let Cell { cell, within, probability } = grid.sample(Vec2::new(0.75, 0.25));
/// // u.x stands for a place from left to right, u.y for one from top to bottom.
/// assert_eq!((cell, within), (UVec2::new(2, 0), DVec2::new(0.5, 0.5)));
/// assert!((probability - 0.25).abs() < 1e-8);
/// assert_eq!(grid.probability(UVec2::new(1, 0)), 0.0);
/// assert_eq!(grid.inverse(cell, within), Vec2::new(0.75, 0.25));
/// # Ok::<(), std::collections::TryReserveError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Discrete2d {
    columns: usize,
    /// Where the share of each row begins, in units.
    rows: Box<[u32]>,
    /// Row by row, where the share of each cell begins in its row; zeros in a row without weight.
    cells: Box<[u32]>,
}

/// A cell that was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Column and row.
    pub cell: UVec2,
    /// u remapped to its position within the cell's share, which is again uniform in `[0, 1)²`.
    pub within: DVec2,
    /// The probability of the cell, above 0.
    pub probability: f64,
}

impl Discrete2d {
    /// The distribution over a grid of `size` columns and rows, with these weights by column and row, each asked for once. A
    /// weight that is negative or NaN counts as zero. `None` if the sum of the weights is zero or infinite.
    ///
    /// # Errors
    /// If memory is not available.
    ///
    /// # Panics
    /// If there are 2³⁰ columns or rows or more.
    pub fn new(
        size: UVec2,
        mut weight: impl FnMut(u32, u32) -> f64,
    ) -> Result<Option<Self>, TryReserveError> {
        assert!(size.max_element() < UNITS / 2, "a grid of {size} cells");
        let columns = size.x as usize;
        // Of 64 bits: what is too much is not available.
        let count = columns.saturating_mul(size.y as usize);
        let mut cells = Vec::new();
        cells.try_reserve_exact(count)?;
        cells.resize(count, 0);
        let mut of_row = vec![0.0; columns];
        let mut of_rows = vec![0.0; size.y as usize];
        for (row, total) in of_rows.iter_mut().enumerate() {
            for (column, of_cell) in of_row.iter_mut().enumerate() {
                *of_cell = weight(column as u32, row as u32);
            }
            *total = share_out(&of_row, &mut cells[row * columns..][..columns]);
        }
        let mut rows = vec![0; of_rows.len()];
        let sum = share_out(&of_rows, &mut rows);
        let is_distribution = sum > 0.0 && sum < f64::INFINITY;
        Ok(is_distribution.then(|| Self { columns, rows: rows.into(), cells: cells.into() }))
    }

    /// The cell that u in `[0, 1)²` selects: u.x the column, u.y the row.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Cell {
        let (row, of_row, down) = draw(&self.rows, u.y);
        let (column, of_cell, along) = draw(self.row(row), u.x);
        Cell {
            cell: UVec2::new(column as u32, row as u32),
            within: DVec2::new(along, down),
            probability: share(of_row) * share(of_cell),
        }
    }

    /// The probability of a cell.
    ///
    /// # Panics
    /// If there is no such cell.
    #[inline]
    pub fn probability(&self, cell: UVec2) -> f64 {
        let [column, row] = [cell.x, cell.y].map(|index| index as usize);
        share(units(&self.rows, row)) * share(units(self.row(row), column))
    }

    /// The inverse of [`sample`](Self::sample): the u that selects this cell and position.
    ///
    /// # Panics
    /// If there is no such cell.
    pub fn inverse(&self, cell: UVec2, within: DVec2) -> Vec2 {
        let [column, row] = [cell.x, cell.y].map(|index| index as usize);
        let place = |starts: &[u32], index: usize, within: f64| {
            let units = f64::from(units(starts, index));
            let u = (f64::from(starts[index]) + within * units) / f64::from(UNITS);
            (u as f32).min(ONE_MINUS_EPSILON)
        };
        Vec2::new(place(self.row(row), column, within.x), place(&self.rows, row, within.y))
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..]) + size_of_val(&self.cells[..])
    }

    #[inline]
    fn row(&self, row: usize) -> &[u32] {
        &self.cells[row * self.columns..][..self.columns]
    }
}

/// Writes where the share of each weight begins, and returns the sum of the weights.
fn share_out(weights: &[f64], starts: &mut [u32]) -> f64 {
    let weights = || weights.iter().map(|weight| weight.max(0.0));
    let sum: f64 = weights().sum();
    if !(sum > 0.0 && sum < f64::INFINITY) {
        return sum;
    }
    // One unit for each weight, and the others in proportion.
    let least = weights().filter(|weight| *weight > 0.0).count() as u32;
    let others = f64::from(UNITS - least);
    let (mut before, mut count) = (0.0, 0);
    for (weight, start) in weights().zip(starts) {
        *start = count + (before / sum * others) as u32;
        before += weight;
        count += u32::from(weight > 0.0);
    }
    sum
}

/// Units of the share with this index.
#[inline]
fn units(starts: &[u32], index: usize) -> u32 {
    starts.get(index + 1).copied().unwrap_or(UNITS) - starts[index]
}

#[inline]
fn share(units: u32) -> f64 {
    f64::from(units) / f64::from(UNITS)
}

/// The share that holds u, its units, and the position within it.
#[inline]
fn draw(starts: &[u32], u: f32) -> (usize, u32, f64) {
    let at = f64::from(u) * f64::from(UNITS);
    // The first share begins at 0.
    let index = starts.partition_point(|&start| start <= at as u32) - 1;
    let units = units(starts, index);
    let within = (at - f64::from(starts[index])) / f64::from(units);
    (index, units, within.min(1.0 - f64::EPSILON))
}
