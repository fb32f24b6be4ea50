//! How a tree is laid out, once it is known what its nodes are.

use std::ops::Range;

use arrayvec::ArrayVec;
use glam::Vec3;

use super::Aabb;
use super::collapse::Choices;
use super::lanes::LANES;
use super::node::{Child, Node};

/// What the leaves of a tree hold.
pub trait Contents {
    /// How many items always fit into a leaf.
    const MOST: usize;

    /// How many items there are.
    fn count(&self) -> usize;

    /// The items of a primitive of the binary tree.
    fn items(&self, primitive: u32) -> Range<u32>;

    /// The box around an item.
    fn bounds(&self, item: u32) -> Aabb;

    /// Makes a leaf, if the items fit: what nodes refer to it by, and how many nodes are below that.
    fn leaf(&mut self, items: &[u32]) -> Option<(u32, usize)>;
}

/// What stands for a tree, or a piece of it, in the node above.
#[derive(Clone, Copy)]
pub struct Root {
    pub bounds: Aabb,
    pub bits: u32,
    /// The longest way from here to a leaf, in nodes.
    pub depth: usize,
}

/// A child.
enum Below {
    /// A subtree of the binary tree.
    Subtree(u32),
    /// Items that no tree tells apart, or that the tree has no levels left for.
    Heap(Vec<u32>),
}

/// A node that waits to be laid out.
struct Open {
    below: Below,
    /// Where its number is to go: a slot of a node, unless it is a root.
    parent: Option<(usize, usize)>,
    /// Which root it is below.
    root: usize,
    level: usize,
}

/// Lays a tree out, as up to sixteen children of nodes above, where each place has a price: adds its nodes to
/// `nodes`. It has at most so many levels of nodes, which must suffice for equally deep leaves of as
/// many items as always fit.
pub fn lay_out<C: Contents>(
    choices: &Choices,
    contents: &mut C,
    price: f32,
    levels: usize,
    nodes: &mut Vec<Node>,
) -> ArrayVec<Root, LANES> {
    let mut layout = Layout { choices, contents, items: Vec::new(), stack: Vec::new() };
    let cheapest_down_to = levels - layout.levels_of_heap();
    let mut roots = ArrayVec::<Root, LANES>::new();
    let mut open = Vec::new();
    for place in choices.roots(price) {
        let root = roots.len();
        let below = Below::Subtree(place);
        let bounds = choices.bounds(place);
        let (bits, depth) = layout.leaf_or(below, cheapest_down_to > 0, |below| {
            open.push(Open { below, parent: None, root, level: 1 });
        });
        roots.push(Root { bounds, bits, depth });
    }
    open.reverse();
    while let Some(Open { below, parent, root, level }) = open.pop() {
        let place = nodes.len();
        match parent {
            None => roots[root].bits = place as u32,
            Some((node, slot)) => nodes[node].children[slot] = place as u32,
        }
        let children = layout.children(below);
        let boxes: ArrayVec<Aabb, LANES> = children.iter().map(|c| layout.bounds(c)).collect();
        let mut node = Node::EMPTY;
        let first = open.len();
        for ((below, bounds), slot) in children.into_iter().zip(&boxes).zip(slots(&boxes)) {
            let (bits, depth) = layout.leaf_or(below, level < cheapest_down_to, |below| {
                open.push(Open { below, parent: Some((place, slot)), root, level: level + 1 });
            });
            node.set(slot, bounds, bits);
            roots[root].depth = roots[root].depth.max(level + depth);
        }
        // Nodes follow one another in the order of the children.
        open[first..].reverse();
        nodes.push(node);
    }
    roots
}

struct Layout<'a, C> {
    choices: &'a Choices<'a>,
    contents: &'a mut C,
    /// Room to work in.
    items: Vec<u32>,
    stack: Vec<u32>,
}

impl<C: Contents> Layout<'_, C> {
    /// How many levels of nodes all items need in equally deep leaves of as many as always fit.
    fn levels_of_heap(&self) -> usize {
        let count = self.contents.count();
        let (mut levels, mut room) = (0, C::MOST);
        while room < count {
            levels += 1;
            room *= LANES;
        }
        levels
    }

    /// Makes a child a leaf, or hands it on as a node, for which nothing is known yet.
    fn leaf_or(&mut self, child: Below, go_on: bool, hand_on: impl FnOnce(Below)) -> (u32, usize) {
        match child {
            Below::Subtree(place) if go_on && !self.choices.is_leaf(place) => {
                hand_on(child);
                (Child::NOTHING, 0)
            }
            Below::Subtree(place) => {
                let Self { choices, contents, items, stack } = self;
                items.clear();
                choices.each_primitive(place, stack, |p| items.extend(contents.items(p)));
                if items.len() <= LANES
                    && let Some(leaf) = contents.leaf(items)
                {
                    return leaf;
                }
                hand_on(Below::Heap(items.clone()));
                (Child::NOTHING, 0)
            }
            Below::Heap(ref items) => {
                let leaf = if items.len() <= LANES { self.contents.leaf(items) } else { None };
                leaf.unwrap_or_else(|| {
                    hand_on(child);
                    (Child::NOTHING, 0)
                })
            }
        }
    }

    fn children(&self, node: Below) -> ArrayVec<Below, LANES> {
        match node {
            Below::Subtree(place) => {
                self.choices.children(place).into_iter().map(Below::Subtree).collect()
            }
            Below::Heap(items) => {
                // At most sixteen shares, each of as many as always fit into full nodes below them.
                let mut share = C::MOST;
                while share * LANES < items.len() {
                    share *= LANES;
                }
                items.chunks(share).map(|share| Below::Heap(share.to_vec())).collect()
            }
        }
    }

    fn bounds(&self, child: &Below) -> Aabb {
        match child {
            Below::Subtree(place) => self.choices.bounds(*place),
            Below::Heap(items) => {
                let boxes = items.iter().map(|&item| self.contents.bounds(item));
                boxes.fold(Aabb::EMPTY, |all, one| all.including(one.min).including(one.max))
            }
        }
    }
}

/// A slot for each child such that its octant is near to where the child lies; see [`Node`].
pub fn slots(boxes: &[Aabb]) -> ArrayVec<usize, LANES> {
    let all = boxes.iter().fold(Aabb::EMPTY, |all, one| all.including(one.min).including(one.max));
    let from_middle = |one: &Aabb| one.min - all.min + (one.max - all.max);
    // Those that are farthest from the middle choose first.
    let mut order: ArrayVec<usize, LANES> = (0..boxes.len()).collect();
    let key = |&child: &usize| from_middle(&boxes[child]).abs().element_sum();
    order.sort_by(|a, b| key(b).total_cmp(&key(a)));
    let mut free = [2_u8; 8];
    let mut slots: ArrayVec<usize, LANES> = boxes.iter().map(|_| 0).collect();
    for child in order {
        let towards = from_middle(&boxes[child]);
        let fit = |octant: usize| {
            let sign = |axis: usize| if octant >> axis & 1 == 1 { 1.0 } else { -1.0 };
            towards.dot(Vec3::new(sign(0), sign(1), sign(2)))
        };
        let open = (0..8).filter(|&octant| free[octant] > 0);
        let best = open.max_by(|&a, &b| fit(a).total_cmp(&fit(b))).expect("16 slots");
        free[best] -= 1;
        slots[child] = 2 * best + usize::from(free[best]);
    }
    slots
}
