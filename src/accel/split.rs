//! [`Cuts`]: where a large scene is cut into parts.

use glam::Vec3A;
use obvhs::aabb::Aabb;

/// Planes that cut space into parts, chosen by some of the triangles.
pub struct Cuts {
    cuts: Vec<Cut>,
    /// The most planes on the way to a part.
    depth: usize,
    parts: usize,
}

/// A plane, or where there is none a part, below which it is found again.
#[derive(Clone, Copy)]
struct Cut {
    axis: usize,
    plane: f32,
    /// What is on the two sides.
    below: [u32; 2],
    part: u32,
}

const BINS: usize = 32;

impl Cuts {
    /// Cuts the boxes into at most so many parts, always the one that has the most of them.
    pub fn new(boxes: &mut [Aabb], parts: usize) -> Self {
        let mut cuts = vec![Cut::none(0)];
        let mut waiting = vec![(0, 0, boxes)];
        let (mut depth, mut whole) = (0, 0);
        while whole + waiting.len() < parts {
            let largest = (0..waiting.len()).max_by_key(|&i| waiting[i].2.len());
            let Some(largest) = largest else { break };
            let (place, level, boxes) = waiting.swap_remove(largest);
            let Some((axis, plane)) = cheapest(boxes) else {
                whole += 1;
                continue;
            };
            let left = partition(boxes, |b| middle(b)[axis] < plane);
            if left == 0 || left == boxes.len() {
                whole += 1;
                continue;
            }
            let below = [cuts.len() as u32, cuts.len() as u32 + 1];
            cuts.extend(below.map(Cut::none));
            cuts[place as usize] = Cut { axis, plane, below, part: 0 };
            let (left, right) = boxes.split_at_mut(left);
            waiting.extend([(below[0], level + 1, left), (below[1], level + 1, right)]);
            depth = depth.max(level + 1);
        }
        let mut all = Self { cuts, depth, parts: 0 };
        all.number_parts();
        all
    }

    /// Parts next to each other get numbers next to each other.
    fn number_parts(&mut self) {
        let mut open = vec![0];
        while let Some(place) = open.pop() {
            let cut = &mut self.cuts[place as usize];
            if cut.below == [place; 2] {
                cut.part = self.parts as u32;
                self.parts += 1;
            } else {
                open.extend([cut.below[1], cut.below[0]]);
            }
        }
    }

    /// How many parts there are.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// The part that a box belongs to.
    pub fn part(&self, bounds: &Aabb) -> u32 {
        let middle = middle(bounds).to_array();
        // As many steps for each, the last ones on the spot: a loop whose end is not known costs more.
        let mut place = 0;
        for _ in 0..self.depth {
            let cut = &self.cuts[place as usize];
            place = cut.below[usize::from(middle[cut.axis] >= cut.plane)];
        }
        self.cuts[place as usize].part
    }
}

impl Cut {
    fn none(place: u32) -> Self {
        Self { axis: 0, plane: 0.0, below: [place; 2], part: 0 }
    }
}

/// The plane that is cheapest by the surface area heuristic (Wald 2007, "On fast Construction of SAH-based
/// Bounding Volume Hierarchies"), if there is any.
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
    best.1
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
