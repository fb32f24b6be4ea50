//! The sphere of directions: cells to count in, and integrals over them.

use std::f64::consts::TAU;

use lobe::glam::Vec3;

/// The sphere cut into cells of equal solid angle, by z and by azimuth. The horizon is a border.
pub struct SphereCells;

pub fn sphere_cells() -> SphereCells {
    SphereCells
}

impl SphereCells {
    const ROWS: usize = 40;
    const COLUMNS: usize = 40;

    pub fn count(&self) -> usize {
        Self::ROWS * Self::COLUMNS
    }

    pub fn of(&self, w: Vec3) -> usize {
        let row = ((f64::from(w.z) + 1.0) / 2.0 * Self::ROWS as f64) as usize;
        let turn = (f64::from(w.y).atan2(f64::from(w.x)) / TAU).rem_euclid(1.0);
        let column = (turn * Self::COLUMNS as f64) as usize;
        row.min(Self::ROWS - 1) * Self::COLUMNS + column.min(Self::COLUMNS - 1)
    }

    /// The integral of `f` over the solid angle of one cell.
    pub fn integrate(&self, cell: usize, f: impl Fn(Vec3) -> f64) -> f64 {
        let (row, column) = (cell / Self::COLUMNS, cell % Self::COLUMNS);
        let z = |i: usize| 2.0 * i as f64 / Self::ROWS as f64 - 1.0;
        let phi = |i: usize| TAU * i as f64 / Self::COLUMNS as f64;
        integrate([z(row), z(row + 1)], [phi(column), phi(column + 1)], f)
    }
}

/// The integral of `f` over the directions with z and azimuth in these ranges.
fn integrate(z: [f64; 2], phi: [f64; 2], f: impl Fn(Vec3) -> f64) -> f64 {
    let mut sum = 0.0;
    for (z, z_weight) in gauss(z) {
        let r = (1.0 - z * z).max(0.0).sqrt();
        for (phi, phi_weight) in gauss(phi) {
            let w = Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32);
            sum += z_weight * phi_weight * f(w);
        }
    }
    sum
}

/// Nodes and weights of the 4-point Gauss-Legendre rule.
pub fn gauss([a, b]: [f64; 2]) -> [(f64, f64); 4] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    [
        (-0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
        (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
        (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
    ]
    .map(|(x, w)| (middle + half * x, half * w))
}
