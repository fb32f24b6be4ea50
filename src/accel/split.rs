//! [`Cuts`]: where a large scene is cut into parts.

use glam::Vec3A;
use obvhs::aabb::Aabb;

/// Planes that cut space into parts, chosen by some of the triangles.
pub struct Cuts {
    cuts: Vec<Cut>,
    /// The most planes on the way to a part.
    depth: usize,
    parts: usize,
    usual_area: f32,
}

/// A plane, or where there is none a part.
#[derive(Clone, Copy)]
struct Cut {
    axis: usize,
    /// NaN in a part, above which nothing lies.
    plane: f32,
    /// The cut below the plane, which the one above it follows; in a part, itself.
    below: u32,
    part: u32,
}

/// What is cut: boxes, which cut stands for them, and how many are above that.
struct Piece<'a> {
    boxes: &'a mut [Aabb],
    place: u32,
    level: usize,
}

const BINS: usize = 32;

impl Cuts {
    /// Cuts the boxes into at most so many parts, always the one that has the most of them.
    pub fn new(boxes: &mut [Aabb], parts: usize) -> Self {
        let mut cuts = vec![Cut::none(0)];
        let mut waiting = vec![Piece { boxes, place: 0, level: 0 }];
        let mut whole = Vec::new();
        while whole.len() + waiting.len() < parts {
            let largest = (0..waiting.len()).max_by_key(|&i| waiting[i].boxes.len());
            let Some(piece) = largest.map(|largest| waiting.swap_remove(largest)) else { break };
            let Some((axis, plane)) = cheapest(piece.boxes) else {
                whole.push(piece);
                continue;
            };
            let below = cuts.len() as u32;
            cuts.extend([Cut::none(below), Cut::none(below + 1)]);
            cuts[piece.place as usize] = Cut { axis, plane, below, part: 0 };
            let left = partition(piece.boxes, |b| middle(b)[axis] < plane);
            let (left, right) = piece.boxes.split_at_mut(left);
            let level = piece.level + 1;
            waiting.push(Piece { boxes: left, place: below, level });
            waiting.push(Piece { boxes: right, place: below + 1, level });
        }
        whole.extend(waiting);
        let depth = whole.iter().map(|piece| piece.level).max().unwrap_or(0);
        let mut areas: Vec<f32> =
            whole.iter().map(|piece| around(piece.boxes).half_area()).collect();
        areas.sort_by(f32::total_cmp);
        let usual_area = areas[areas.len() / 2];
        let parts = number_parts(&mut cuts);
        Self { cuts, depth, parts, usual_area }
    }

    /// How many parts there are.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// Half of the surface area of a part's box, the median.
    pub fn usual_area(&self) -> f32 {
        self.usual_area
    }

    /// The parts that boxes belong to. Each step down waits for the last one, but not for those of other boxes.
    pub fn parts_of<const N: usize>(&self, boxes: &[Aabb; N]) -> [u32; N] {
        let middles = boxes.map(|bounds| middle(&bounds).to_array());
        let mut places = [0; N];
        // As many steps for all, the last ones on the spot.
        for _ in 0..self.depth {
            for (place, middle) in places.iter_mut().zip(&middles) {
                let cut = &self.cuts[*place as usize];
                *place = cut.below + u32::from(middle[cut.axis] >= cut.plane);
            }
        }
        places.map(|place| self.cuts[place as usize].part)
    }
}

impl Cut {
    fn none(place: u32) -> Self {
        Self { axis: 0, plane: f32::NAN, below: place, part: 0 }
    }
}

/// Parts next to each other get numbers next to each other. How many there are.
fn number_parts(cuts: &mut [Cut]) -> usize {
    let mut parts = 0;
    let mut open = vec![0];
    while let Some(place) = open.pop() {
        let cut = &mut cuts[place as usize];
        if cut.below == place {
            cut.part = parts;
            parts += 1;
        } else {
            open.extend([cut.below + 1, cut.below]);
        }
    }
    parts as usize
}

/// The plane that is cheapest by the surface area heuristic (Wald 2007, "On fast Construction of SAH-based
/// Bounding Volume Hierarchies"), if there is any with boxes on both sides.
fn cheapest(boxes: &[Aabb]) -> Option<(usize, f32)> {
    let middles = boxes.iter().map(middle).fold(Aabb::empty(), |mut all, m| *all.extend(m));
    let extent = middles.max - middles.min;
    let mut best = (f32::INFINITY, None);
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0) {
        let mut bins = [(0.0_f32, Aabb::empty()); BINS];
        for one in boxes {
            let place = (middle(one)[axis] - middles.min[axis]) / extent[axis];
            let (count, bounds) = &mut bins[((place * BINS as f32) as usize).min(BINS - 1)];
            *count += 1.0;
            *bounds = bounds.union(one);
        }
        // The cost of all bins up to each, from both ends.
        let (left, right) = (costs(bins.iter()), costs(bins.iter().rev()));
        for split in 1..BINS {
            let cost = left[split - 1] + right[BINS - 1 - split];
            if cost < best.0 {
                let plane = middles.min[axis] + extent[axis] * (split as f32 / BINS as f32);
                best = (cost, Some((axis, plane)));
            }
        }
    }
    best.1.filter(|&(axis, plane)| {
        let is_left = |b: &Aabb| middle(b)[axis] < plane;
        boxes.iter().any(is_left) && !boxes.iter().all(is_left)
    })
}

fn around(boxes: &[Aabb]) -> Aabb {
    boxes.iter().fold(Aabb::empty(), |all, one| all.union(one))
}

fn costs<'a>(bins: impl Iterator<Item = &'a (f32, Aabb)>) -> [f32; BINS] {
    let (mut count, mut bounds) = (0.0, Aabb::empty());
    let mut costs = [0.0; BINS];
    for (cost, (more, also)) in costs.iter_mut().zip(bins) {
        count += more;
        bounds = bounds.union(also);
        *cost = if count > 0.0 { count * bounds.half_area() } else { 0.0 };
    }
    costs
}

/// Twice the middle of a box.
fn middle(bounds: &Aabb) -> Vec3A {
    bounds.min + bounds.max
}

/// Moves those that are to the left to the front; how many they are.
fn partition(boxes: &mut [Aabb], is_left: impl Fn(&Aabb) -> bool) -> usize {
    let mut left = 0;
    for i in 0..boxes.len() {
        if is_left(&boxes[i]) {
            boxes.swap(left, i);
            left += 1;
        }
    }
    left
}
