//! [`Density`]: directions by luminance.

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};

use super::error::EnvironmentError;
use super::map::{CellPoint, Corners, Map};
use super::orientation::Place;
use crate::sampling::{Discrete2d, bilinear};

/// A density over the sphere that is proportional to a map's luminance, but for the shape of its rise from row to row.
///
/// A cell is drawn by its solid angle times the mean of its four luminances, and a point in it by a density over solid angle
/// that is bilinear in longitude and z = cos θ: where radiance is above 0, so is the density. The radiance is bilinear in
/// longitude and θ. The ratio of both is constant but next to the poles, where it is at most 2.
pub struct Density {
    cells: Discrete2d,
    /// z of the edges of rows of cells, from 1 to -1.
    edges: Box<[f64]>,
}

impl Density {
    /// Bytes of a pixel.
    const BYTES: u64 = 4;

    /// `None` if the map is black.
    pub fn new(map: &Map) -> Result<Option<Self>, EnvironmentError> {
        let size = map.cells();
        let edges: Box<[f64]> = (0..=size.y).map(|row| map.edge(row)).collect();
        let weight = |column: u32, row: u32| {
            let [upper, lower] = [row, row + 1].map(|edge| edges[edge as usize]);
            let luminances = map.luminances(&map.corners([column, row].into()));
            luminances.into_iter().flatten().sum::<f64>() * (upper - lower)
        };
        let bytes = Self::BYTES * u64::from(size.x) * u64::from(size.y);
        let cells = Discrete2d::new(size, weight);
        let cells = cells.map_err(|_| EnvironmentError::OutOfMemory(bytes))?;
        Ok(cells.map(|cells| Self { cells, edges }))
    }

    /// The column, as [`Place::x`], and the height of a direction.
    #[inline]
    pub fn sample(&self, map: &Map, u: Vec2) -> (f64, f64) {
        let drawn = self.cells.sample(u);
        let corners = map.corners(drawn.cell);
        let within = bilinear::sample(drawn.within, map.luminances(&corners));
        let [upper, lower] = self.edges_of(drawn.cell.y);
        let x = (f64::from(drawn.cell.x) + 0.5 + within.x) / f64::from(map.cells().x);
        (if x < 1.0 { x } else { x - 1.0 }, upper + (lower - upper) * within.y)
    }

    /// Density over solid angle at a point of a cell with these corners.
    #[inline]
    pub fn pdf(&self, map: &Map, place: &Place, point: &CellPoint, corners: &Corners) -> f32 {
        let probability = self.cells.probability(point.cell);
        let [upper, lower] = self.edges_of(point.cell.y);
        let solid_angle = TAU / f64::from(map.cells().x) * (upper - lower);
        let t = ((upper - place.z) / (upper - lower)).clamp(0.0, 1.0);
        let within = DVec2::new(point.within.x, t);
        let pdf = bilinear::pdf(within, map.luminances(corners));
        (probability * pdf / solid_angle) as f32
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.cells.bytes() + size_of_val(&self.edges[..])
    }

    #[inline]
    fn edges_of(&self, row: u32) -> [f64; 2] {
        let row = row as usize;
        [self.edges[row], self.edges[row + 1]]
    }
}
