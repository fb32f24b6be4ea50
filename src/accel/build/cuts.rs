//! [`Cuts`]: the planes by which a large scene is cut into parts.

use glam::Vec3A;
use obvhs::aabb::Aabb;

/// A binary tree of cutting planes (a k-d tree) whose leaves are parts.
pub struct Cuts {
    cuts: Vec<Cut>,
    /// Most planes on the way to a part.
    depth: usize,
    parts: usize,
    median_half_area: f32,
}

/// A cutting plane, or a part.
#[derive(Clone, Copy)]
struct Cut {
    axis: usize,
    /// Coordinate of the plane, doubled; NaN for a part, which sends everything to `first_child`.
    plane: f32,
    /// Index of what lies below the plane; what lies above it is next. For a part, its own index.
    first_child: u32,
    part: u32,
}

/// Boxes that are still to be cut.
struct Piece<'a> {
    boxes: &'a mut [Aabb],
    /// Index of the cut that stands for them.
    cut: u32,
    level: usize,
}

const BINS: usize = 32;

impl Cuts {
    /// Cuts the boxes into at most so many parts, always the part with the most boxes.
    pub fn new(boxes: &mut [Aabb], parts: usize) -> Self {
        let mut cuts = vec![Cut::part(0)];
        let mut open = vec![Piece { boxes, cut: 0, level: 0 }];
        let mut done = Vec::new();
        while done.len() + open.len() < parts {
            let largest = (0..open.len()).max_by_key(|&i| open[i].boxes.len());
            let Some(piece) = largest.map(|largest| open.swap_remove(largest)) else { break };
            let Some((axis, plane)) = cheapest_plane(piece.boxes) else {
                done.push(piece);
                continue;
            };
            let first_child = cuts.len() as u32;
            cuts.extend([Cut::part(first_child), Cut::part(first_child + 1)]);
            cuts[piece.cut as usize] = Cut { axis, plane, first_child, part: 0 };
            let left = partition_in_place(piece.boxes, |b| doubled_center(b)[axis] < plane);
            let (left, right) = piece.boxes.split_at_mut(left);
            let level = piece.level + 1;
            open.push(Piece { boxes: left, cut: first_child, level });
            open.push(Piece { boxes: right, cut: first_child + 1, level });
        }
        done.extend(open);
        let depth = done.iter().map(|piece| piece.level).max().unwrap_or(0);
        let mut areas: Vec<f32> = done.iter().map(|piece| union(piece.boxes).half_area()).collect();
        areas.sort_by(f32::total_cmp);
        let median_half_area = areas[areas.len() / 2];
        let parts = number_parts(&mut cuts);
        Self { cuts, depth, parts, median_half_area }
    }

    /// Number of parts.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// Half the surface area of a part's box, the median over all parts.
    pub fn median_half_area(&self) -> f32 {
        self.median_half_area
    }

    /// The parts that the centers of some boxes lie in. Each step down waits for the previous one of the same box, but
    /// not for those of the others.
    pub fn parts_of<const N: usize>(&self, boxes: &[Aabb; N]) -> [u32; N] {
        let centers = boxes.map(|bounds| doubled_center(&bounds).to_array());
        let mut indices = [0; N];
        // The same number of steps for all: a part leads to itself.
        for _ in 0..self.depth {
            for (index, center) in indices.iter_mut().zip(&centers) {
                let cut = &self.cuts[*index as usize];
                *index = cut.first_child + u32::from(center[cut.axis] >= cut.plane);
            }
        }
        indices.map(|index| self.cuts[index as usize].part)
    }
}

impl Cut {
    /// A part, whose number is given later.
    fn part(index: u32) -> Self {
        Self { axis: 0, plane: f32::NAN, first_child: index, part: 0 }
    }
}

/// Numbers the parts, neighbours in sequence; returns how many there are.
fn number_parts(cuts: &mut [Cut]) -> usize {
    let mut parts = 0;
    let mut open = vec![0];
    while let Some(index) = open.pop() {
        let cut = &mut cuts[index as usize];
        if cut.first_child == index {
            cut.part = parts;
            parts += 1;
        } else {
            open.extend([cut.first_child + 1, cut.first_child]);
        }
    }
    parts as usize
}

/// The plane of least cost by the surface area heuristic, with binning (Wald 2007, "On fast Construction of SAH-based
/// Bounding Volume Hierarchies"): its axis and doubled coordinate. None if no plane has boxes on both sides.
fn cheapest_plane(boxes: &[Aabb]) -> Option<(usize, f32)> {
    let centers = boxes.iter().map(doubled_center).fold(Aabb::empty(), |mut all, c| *all.extend(c));
    let extent = centers.max - centers.min;
    let mut best = (f32::INFINITY, None);
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0) {
        let mut bins = [(0.0_f32, Aabb::empty()); BINS];
        for one in boxes {
            let position = (doubled_center(one)[axis] - centers.min[axis]) / extent[axis];
            let (count, bounds) = &mut bins[((position * BINS as f32) as usize).min(BINS - 1)];
            *count += 1.0;
            *bounds = bounds.union(one);
        }
        // Costs of all bins up to each, from both ends.
        let (left, right) = (prefix_costs(bins.iter()), prefix_costs(bins.iter().rev()));
        for split in 1..BINS {
            let cost = left[split - 1] + right[BINS - 1 - split];
            if cost < best.0 {
                let plane = centers.min[axis] + extent[axis] * (split as f32 / BINS as f32);
                best = (cost, Some((axis, plane)));
            }
        }
    }
    best.1.filter(|&(axis, plane)| {
        let is_left = |b: &Aabb| doubled_center(b)[axis] < plane;
        boxes.iter().any(is_left) && !boxes.iter().all(is_left)
    })
}

/// Number of boxes times half the area around them, for all bins up to each.
fn prefix_costs<'a>(bins: impl Iterator<Item = &'a (f32, Aabb)>) -> [f32; BINS] {
    let (mut count, mut bounds) = (0.0, Aabb::empty());
    let mut costs = [0.0; BINS];
    for (cost, (more, other)) in costs.iter_mut().zip(bins) {
        count += more;
        bounds = bounds.union(other);
        *cost = if count > 0.0 { count * bounds.half_area() } else { 0.0 };
    }
    costs
}

fn union(boxes: &[Aabb]) -> Aabb {
    boxes.iter().fold(Aabb::empty(), |all, one| all.union(one))
}

/// Twice the center of a box: the halving would change no comparison.
fn doubled_center(bounds: &Aabb) -> Vec3A {
    bounds.min + bounds.max
}

/// Moves the boxes for which `is_left` holds to the front; returns how many they are.
fn partition_in_place(boxes: &mut [Aabb], is_left: impl Fn(&Aabb) -> bool) -> usize {
    let mut left = 0;
    for i in 0..boxes.len() {
        if is_left(&boxes[i]) {
            boxes.swap(left, i);
            left += 1;
        }
    }
    left
}
