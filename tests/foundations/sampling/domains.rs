//! Domains cut into cells, in coordinates that are not those of the warps.

use std::f64::consts::TAU;

use lobe::glam::{Vec2, Vec3};

pub use crate::common::sphere::sphere_cells;

/// The share of a full turn at which (x, y) stands.
fn turn(x: f32, y: f32) -> f64 {
    (f64::from(y).atan2(f64::from(x)) / TAU).rem_euclid(1.0)
}

fn index(share: f64, count: usize) -> usize {
    ((share * count as f64) as usize).min(count - 1)
}

/// The unit disk in rings and sectors of equal area.
pub struct DiskCells;

pub fn disk_cells() -> DiskCells {
    DiskCells
}

impl DiskCells {
    const RINGS: usize = 31;
    const SECTORS: usize = 37;

    pub fn count(&self) -> usize {
        Self::RINGS * Self::SECTORS
    }

    pub fn of(&self, p: Vec2) -> usize {
        index(p.as_dvec2().length_squared(), Self::RINGS) * Self::SECTORS
            + index(turn(p.x, p.y), Self::SECTORS)
    }
}

/// A cone in rings and sectors of equal solid angle.
pub struct ConeCells {
    height: f64,
}

pub fn cone_cells(height: f32) -> ConeCells {
    ConeCells { height: height.into() }
}

impl ConeCells {
    pub fn count(&self) -> usize {
        DiskCells.count()
    }

    pub fn of(&self, w: Vec3) -> usize {
        let z = f64::from(w.z);
        // 1 - z without the loss of digits close to the axis.
        let below_top =
            if z > 0.0 { w.truncate().as_dvec2().length_squared() / (1.0 + z) } else { 1.0 - z };
        index(below_top / self.height, DiskCells::RINGS) * DiskCells::SECTORS
            + index(turn(w.x, w.y), DiskCells::SECTORS)
    }
}

/// The triangle in small triangles of equal area: squares of weights, each cut along its diagonal.
pub struct TriangleCells;

pub fn triangle_cells() -> TriangleCells {
    TriangleCells
}

impl TriangleCells {
    const ROWS: usize = 32;

    pub fn count(&self) -> usize {
        Self::ROWS * Self::ROWS
    }

    /// Row i has 2 (ROWS - i) - 1 triangles.
    pub fn of(&self, b: Vec2) -> usize {
        let scaled = b.as_dvec2() * Self::ROWS as f64;
        let (row, column) = ((scaled.x as usize).min(Self::ROWS - 1), scaled.y as usize);
        let upper = scaled.x.fract() + scaled.y.fract() > 1.0;
        let before = row * (2 * Self::ROWS - row);
        (before + 2 * column + usize::from(upper)).min(before + 2 * (Self::ROWS - row) - 2)
    }
}
