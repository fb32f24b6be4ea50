//! [`FilterSampler`]: draws positions in proportion to a filter.

use glam::Vec2;

use super::{Filter, FilterError};

/// Draws positions in proportion to a [`Filter`]. Prepared once, used for every sample.
///
/// On each axis the position depends on that axis' random number alone and never decreases with it, so stratification is
/// kept. Box and tent are inverted in closed form. The others are approximated by a piecewise linear density, which is
/// inverted exactly; it differs from the filter by less than 10⁻⁴ of its peak, and the cumulative distribution by less
/// than 5 · 10⁻⁶ (2 · 10⁻⁶ for the default parameters).
///
/// ```
/// use lobe::film::{Filter, FilterSampler};
/// use lobe::glam::Vec2;
///
/// let u = Vec2::new(0.25, 0.5);
/// assert_eq!(FilterSampler::new(Filter::Box)?.sample(u), Vec2::new(-0.25, 0.0));
/// assert_eq!(FilterSampler::new(Filter::Box)?.place(u), u);
/// assert!(FilterSampler::new(Filter::Tent { radius: 0.0 }).is_err());
/// # Ok::<(), lobe::film::FilterError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FilterSampler(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Box,
    Tent(f32),
    Table(Box<Table>),
}

impl FilterSampler {
    /// Prepares a filter.
    ///
    /// # Errors
    /// As for [`Filter::check`].
    pub fn new(filter: Filter) -> Result<Self, FilterError> {
        filter.check()?;
        Ok(Self(match filter {
            Filter::Box => Kind::Box,
            Filter::Tent { radius } => Kind::Tent(radius),
            // Beyond 6.5 standard deviations lies less than 2⁻³³ of a Gaussian.
            Filter::Gaussian { radius, sigma } => {
                Kind::Table(Box::new(Table::new(filter, radius.min(6.5 * sigma))))
            }
            Filter::BlackmanHarris { radius } => Kind::Table(Box::new(Table::new(filter, radius))),
        }))
    }

    /// Maps `u` in `[0, 1)²` to an offset from the pixel's centre, in pixels.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Vec2 {
        match &self.0 {
            Kind::Box => u - 0.5,
            Kind::Tent(radius) => Vec2::new(tent(u.x, *radius), tent(u.y, *radius)),
            Kind::Table(table) => Vec2::new(table.sample(u.x), table.sample(u.y)),
        }
    }

    /// Maps `u` in `[0, 1)²` to a position relative to the pixel's upper left corner, in pixels. For a box it is `u`
    /// itself, bit by bit.
    #[inline]
    pub fn place(&self, u: Vec2) -> Vec2 {
        match self.0 {
            Kind::Box => u,
            _ => self.sample(u) + 0.5,
        }
    }
}

/// Maps `u` to `[-1, 1)`: the sign is the half of the axis, the magnitude is uniform.
#[inline]
fn signed(u: f32) -> f32 {
    2.0 * u - 1.0
}

/// Inverts 1 - (1 - x / radius)², the cumulative distribution of a tent's positive half.
#[inline]
fn tent(u: f32, radius: f32) -> f32 {
    let t = signed(u);
    radius * (t / (1.0 + (1.0 - t.abs()).sqrt()))
}

/// Cells of a table; a power of two, so that dividing by it is exact.
const CELLS: usize = 512;

/// The positive half of a filter's profile, piecewise linear over cells of equal width.
#[derive(Clone, Debug)]
struct Table {
    extent: f32,
    /// The last one is a sentinel, which no sample reaches.
    cells: [Cell; CELLS + 1],
    /// For each of as many equal parts of `[0, 1]`, the cell where the search begins.
    first: [u16; CELLS],
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    /// Cumulative distribution at the cell's beginning.
    before: f32,
    /// Square of the density at the cell's beginning; densities are per cell width.
    square: f32,
    density: f32,
    /// Twice the change of the density over the cell; never positive.
    slope: f32,
}

impl Table {
    fn new(filter: Filter, extent: f32) -> Self {
        let knot = |i: usize| filter.profile(f64::from(extent) * i as f64 / CELLS as f64);
        let area = |i: usize| 0.5 * (knot(i) + knot(i + 1));
        let total: f64 = (0..CELLS).map(area).sum();
        let mut before = 0.0;
        let cells = std::array::from_fn(|i| {
            if i == CELLS {
                return Cell { before: f32::INFINITY, square: 0.0, density: 0.0, slope: 0.0 };
            }
            let density = (knot(i) / total) as f32;
            let slope = (2.0 * (knot(i + 1) - knot(i)) / total) as f32;
            let cell = Cell { before: before as f32, square: density * density, density, slope };
            before += area(i) / total;
            cell
        });
        let first = std::array::from_fn(|part| {
            let share = part as f32 / CELLS as f32;
            (cells.partition_point(|cell| cell.before <= share) - 1) as u16
        });
        Self { extent, cells, first }
    }

    /// Inverts the cumulative distribution. Each step is monotone in `u` even as rounded, because the density falls within
    /// each cell.
    #[inline]
    fn sample(&self, u: f32) -> f32 {
        let t = signed(u);
        let share = t.abs();
        let part = ((share * CELLS as f32) as usize).min(CELLS - 1);
        let mut i = usize::from(self.first[part]);
        while share >= self.cells[i + 1].before {
            i += 1;
        }
        let Cell { before, square, density, slope } = self.cells[i];
        let rest = share - before;
        // Root of density s + slope s² / 4 = rest, in the form without cancellation.
        let root = (square + slope * rest).max(0.0).sqrt();
        let within = (2.0 * rest / (density + root)).min(1.0);
        ((i as f32 + within) * (1.0 / CELLS as f32) * self.extent).copysign(t)
    }
}
