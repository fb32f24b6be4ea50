//! Large scenes in parts, whose trees are built apart.

use glam::Vec3A;

use super::parallel;
use super::triangles::Triangle;

/// Scenes with fewer triangles are built in one piece.
const LARGE: usize = 1 << 15;

/// Eight parts: the root has two children for each, more for those that it pays most for.
const HALVINGS: u32 = 3;

/// So many triangles say where to halve all of them.
const SAMPLES: usize = 1 << 13;
const BINS: usize = 32;

/// The triangles, moved such that those of each part follow one another.
pub fn split(triangles: &mut [Triangle]) -> Vec<&mut [Triangle]> {
    let halvings = if triangles.len() < LARGE { 0 } else { HALVINGS };
    let mut parts = vec![triangles];
    for _ in 0..halvings {
        parts = parallel::map(parts, |part| {
            let middle = halve(part);
            let (left, right) = part.split_at_mut(middle);
            [left, right]
        })
        .into_iter()
        .flatten()
        .filter(|part| !part.is_empty())
        .collect();
    }
    parts
}

/// Moves the triangles to two sides of the plane that is cheapest by the surface area heuristic, judged by
/// some of them (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"); how many are on
/// the first side.
fn halve(triangles: &mut [Triangle]) -> usize {
    let step = triangles.len().div_ceil(SAMPLES).max(1);
    let samples = || triangles.iter().step_by(step);
    let middles = samples().map(middle).fold(Bounds::EMPTY, Bounds::including);
    let extent = middles.max - middles.min;
    let mut best = (f32::INFINITY, 0, 0);
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0) {
        let mut bins = [(0.0_f32, Bounds::EMPTY); BINS];
        for triangle in samples() {
            let (count, bounds) = &mut bins[bin(triangle, axis, &middles)];
            *count += 1.0;
            *bounds = triangle.corners.iter().fold(*bounds, |b, &p| b.including(p.into()));
        }
        // The cost of all bins up to each, from both ends.
        let sweep = |bins: &mut dyn Iterator<Item = &(f32, Bounds)>| -> Vec<f32> {
            let all = bins.scan((0.0, Bounds::EMPTY), |(count, bounds), (more, also)| {
                *count += more;
                *bounds = bounds.union(also);
                Some(*count * bounds.half_area())
            });
            all.collect()
        };
        let (left, right) = (sweep(&mut bins.iter()), sweep(&mut bins.iter().rev()));
        for split in 1..BINS {
            let cost = left[split - 1] + right[BINS - 1 - split];
            if cost < best.0 {
                best = (cost, axis, split);
            }
        }
    }
    let (cost, axis, split) = best;
    if cost == f32::INFINITY {
        return triangles.len() / 2;
    }
    partition(triangles, |triangle| bin(triangle, axis, &middles) < split)
}

/// Twice the middle of a triangle's box.
fn middle(triangle: &Triangle) -> Vec3A {
    let [a, b, c] = triangle.corners.map(Vec3A::from);
    a.min(b).min(c) + a.max(b).max(c)
}

fn bin(triangle: &Triangle, axis: usize, middles: &Bounds) -> usize {
    let extent = middles.max[axis] - middles.min[axis];
    let place = (middle(triangle)[axis] - middles.min[axis]) / extent;
    ((place * BINS as f32) as usize).min(BINS - 1)
}

/// Moves those that `is_left` to the front; how many they are.
pub fn partition(triangles: &mut [Triangle], is_left: impl Fn(&Triangle) -> bool) -> usize {
    let (mut left, mut right) = (0, triangles.len());
    loop {
        while left < right && is_left(&triangles[left]) {
            left += 1;
        }
        while left < right && !is_left(&triangles[right - 1]) {
            right -= 1;
        }
        if left == right {
            return left;
        }
        triangles.swap(left, right - 1);
    }
}

#[derive(Clone, Copy)]
struct Bounds {
    min: Vec3A,
    max: Vec3A,
}

impl Bounds {
    const EMPTY: Self = Self { min: Vec3A::INFINITY, max: Vec3A::NEG_INFINITY };

    fn including(self, p: Vec3A) -> Self {
        Self { min: self.min.min(p), max: self.max.max(p) }
    }

    fn union(self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    fn half_area(self) -> f32 {
        let size = (self.max - self.min).max(Vec3A::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}
