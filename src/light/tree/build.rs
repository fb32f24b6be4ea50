//! Building a [`LightTree`]: by the heuristic of Conty and Kulla.

use glam::DVec3;

use super::node::{Child, Node, WIDTH};
use super::{Leaf, LightTree, Place};
use crate::light::bounds::LightBounds;

/// Candidate planes are those between this many slabs per axis.
const SLABS: usize = 12;

/// Levels beyond which groups are halved, so that no tree is much deeper.
const FREE_LEVELS: u32 = 6;

/// A light while the tree is built.
#[derive(Clone, Copy)]
struct Item {
    light: u32,
    bounds: LightBounds,
    center: DVec3,
    intensity: f64,
}

/// Bounds of a group, and the sum of its intensities.
#[derive(Clone, Copy, Default)]
struct Group {
    bounds: Option<LightBounds>,
    intensity: f64,
}

impl Group {
    fn of(items: &[Item]) -> Self {
        let mut group = Self::default();
        items.iter().for_each(|item| group.add(&Self::from(item)));
        group
    }

    fn add(&mut self, other: &Self) {
        self.intensity += other.intensity;
        self.bounds = match (self.bounds, other.bounds) {
            (Some(a), Some(b)) => Some(a.union(&b)),
            (a, b) => a.or(b),
        };
    }

    /// Intensity times the spread of positions and directions. Squared radii take the place of areas, which are zero for a row
    /// of lamps.
    fn cost(&self) -> f64 {
        let spread = |bounds: LightBounds| bounds.sphere().1 * bounds.solid_angle();
        self.bounds.map_or(0.0, |bounds| self.intensity * spread(bounds))
    }
}

impl From<&Item> for Group {
    fn from(item: &Item) -> Self {
        Self { bounds: Some(item.bounds), intensity: item.intensity }
    }
}

impl LightTree {
    /// A tree of at least one light, of less than 2³¹.
    pub fn new(leaves: &[Leaf]) -> Self {
        let intensity = |leaf: &Leaf| leaf.power / leaf.bounds.solid_angle().max(1e-12);
        let sum: f64 = leaves.iter().map(intensity).sum();
        let item = |(light, leaf): (usize, &Leaf)| Item {
            light: light as u32,
            bounds: leaf.bounds,
            center: leaf.bounds.sphere().0,
            intensity: if sum > 0.0 { intensity(leaf) / sum } else { 1.0 },
        };
        let mut items: Vec<Item> = leaves.iter().enumerate().map(item).collect();
        let mut tree = Self {
            nodes: Vec::new(),
            parents: Vec::new(),
            leaves: vec![Place::default(); leaves.len()],
        };
        tree.add_node(&mut items, Place::default(), 0);
        tree
    }

    /// Adds the node of a group that hangs at `parent`, with all below it, and returns its index.
    fn add_node(&mut self, items: &mut [Item], parent: Place, level: u32) -> u32 {
        let index = self.nodes.len() as u32;
        self.nodes.push(Node::empty());
        self.parents.push(parent);
        let mut node = Node::empty();
        for group in groups(items, level >= FREE_LEVELS) {
            let Group { bounds, intensity } = Group::of(group);
            let (Some(bounds), &mut [first, ..]) = (bounds, &mut *group) else { continue };
            let lane = node.len();
            let child = if group.len() == 1 {
                self.leaves[first.light as usize] = Place { node: index, lane };
                Child::Light(first.light)
            } else {
                Child::Node(self.add_node(group, Place { node: index, lane }, level + 1))
            };
            node.push(child, &bounds, intensity);
        }
        self.nodes[index as usize] = node;
        index
    }
}

/// Up to eight groups of items: the group of the largest cost is split, again and again. In order, so that neighbours stay
/// neighbours.
fn groups(items: &mut [Item], halve: bool) -> Vec<&mut [Item]> {
    let mut groups = vec![(f64::INFINITY, items)];
    while groups.len() < WIDTH {
        let many = groups.iter().enumerate().filter(|(_, (_, group))| group.len() > 1);
        let largest = many.max_by(|(_, a), (_, b)| {
            let by_cost = a.0.total_cmp(&b.0);
            let by_count = a.1.len().cmp(&b.1.len());
            if halve { by_count } else { by_cost.then(by_count) }
        });
        let Some((place, _)) = largest else { break };
        let (_, group) = groups.remove(place);
        let middle = split(group, halve);
        let (left, right) = group.split_at_mut(middle);
        groups.insert(place, (Group::of(right).cost(), right));
        groups.insert(place, (Group::of(left).cost(), left));
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Orders items, of which there are several, so that those before the returned index and those from it on make two groups.
fn split(items: &mut [Item], halve: bool) -> usize {
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for item in &*items {
        (min, max) = (min.min(item.center), max.max(item.center));
    }
    let extent = max - min;
    let slab = |axis: usize, item: &Item| {
        let at = (item.center[axis] - min[axis]) / extent[axis] * SLABS as f64;
        (at as usize).min(SLABS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0 && !halve) {
        let mut slabs = [Group::default(); SLABS];
        items.iter().for_each(|item| slabs[slab(axis, item)].add(&item.into()));
        // Costs of what is right of each plane, then of what is left of it.
        let (mut right, mut costs) = (Group::default(), [0.0; SLABS]);
        for plane in (1..SLABS).rev() {
            right.add(&slabs[plane]);
            costs[plane] = right.cost();
        }
        let mut left = Group::default();
        // Long boxes are cut across.
        let regularity = extent.max_element() / extent[axis];
        for plane in 1..SLABS {
            left.add(&slabs[plane - 1]);
            let cost = regularity * (left.cost() + costs[plane]);
            if cost < best.0 {
                best = (cost, axis, plane);
            }
        }
    }
    let (_, axis, plane) = best;
    if plane > 0 {
        let middle = partition(items, |item| slab(axis, item) < plane);
        if 0 < middle && middle < items.len() {
            return middle;
        }
    }
    let axis = extent.max_position();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        a.center[axis].total_cmp(&b.center[axis]).then(a.light.cmp(&b.light))
    });
    middle
}

/// Moves the items for which `is_left` holds to the front, and returns their number.
fn partition(items: &mut [Item], is_left: impl Fn(&Item) -> bool) -> usize {
    items.sort_by_key(|item| !is_left(item));
    items.partition_point(is_left)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// 5000 lights whose powers and places grow by powers of two, or that are all in one place: the tree is not deep. Seen to fail
    /// with groups that are never halved.
    #[test]
    fn no_tree_is_deep() {
        let at = |x: f32, power| Leaf { bounds: LightBounds::new(Vec3::X * x, Vec3::X * x), power };
        let growing = |i: i32| at(2_f32.powi(i % 120 - 80) * (1.0 + i as f32), 2_f64.powi(i % 100));
        let cases = [(0..5000).map(growing).collect(), vec![at(1.0, 1.0); 5000]];
        for (case, leaves) in cases.into_iter().enumerate() {
            let depth = LightTree::new(&leaves).depth();
            assert!(depth <= FREE_LEVELS as usize + 5, "case {case}: {depth}");
        }
    }
}
