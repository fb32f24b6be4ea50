//! [`lay_out`]: writes the nodes of a wide tree, once [`Choices`] has them.

use std::ops::Range;

use arrayvec::ArrayVec;

use super::collapse::Choices;
use crate::accel::tree::{Aabb, Child, Node};
use crate::simd::{ARITY, LANES};

/// The items of a tree, and how leaves are made of them.
pub trait Contents {
    /// So many items always fit into a leaf.
    const GUARANTEED: usize;

    /// Number of items.
    fn count(&self) -> usize;

    /// The items of a primitive of the binary tree.
    fn items(&self, primitive: u32) -> Range<u32>;

    /// The box around an item.
    fn bounds(&self, item: u32) -> Aabb;

    /// Makes a leaf, if the items fit into one: the encoded [`Child`], and the levels of nodes below it.
    fn leaf(&mut self, items: &[u32]) -> Option<(u32, usize)>;
}

/// A tree, or a piece of it, as a child of the node above.
#[derive(Clone, Copy)]
pub struct Root {
    pub bounds: Aabb,
    /// The encoded [`Child`].
    pub bits: u32,
    /// Most nodes on the way from here to a leaf.
    pub depth: usize,
}

/// What becomes a child.
enum Below {
    /// A subtree of the binary tree.
    Subtree(u32),
    /// Items that coincide, or that the tree has no levels left to sort: any of their trees is as good.
    Unsorted(Vec<u32>),
}

/// A node that is still to be written.
struct Open {
    below: Below,
    /// Node and slot that refer to it; none for a root.
    parent: Option<(usize, usize)>,
    /// Index of the root that it is below.
    root: usize,
    level: usize,
}

/// Appends the nodes of a tree to `nodes`. Returns what stands for it in the node above: up to eight children, as many
/// as cost least where each costs `child_cost`.
///
/// The tree has at most `levels` levels of nodes. Those must suffice for equally deep leaves of `C::GUARANTEED` items.
pub fn lay_out<C: Contents>(
    choices: &Choices,
    contents: &mut C,
    child_cost: f32,
    levels: usize,
    nodes: &mut Vec<Node>,
) -> ArrayVec<Root, ARITY> {
    let mut layout = Layout { choices, contents, items: Vec::new(), stack: Vec::new() };
    // From here down, whatever is no leaf yet is unsorted, which takes the remaining levels at most.
    let sorted_levels = levels - layout.unsorted_levels();
    let mut roots = ArrayVec::<Root, ARITY>::new();
    let mut open = Vec::new();
    for subtree in choices.roots(child_cost) {
        let root = roots.len();
        let below = Below::Subtree(subtree);
        let bounds = choices.bounds(subtree);
        let (bits, depth) = layout.leaf_or(below, sorted_levels > 0, |below| {
            open.push(Open { below, parent: None, root, level: 1 });
        });
        roots.push(Root { bounds, bits, depth });
    }
    open.reverse();
    while let Some(Open { below, parent, root, level }) = open.pop() {
        let index = nodes.len();
        match parent {
            None => roots[root].bits = index as u32,
            Some((node, slot)) => nodes[node].children[slot] = index as u32,
        }
        let children = layout.children(below);
        let mut node = Node::EMPTY;
        let first = open.len();
        let mut children: ArrayVec<(Aabb, Below), ARITY> =
            children.into_iter().map(|below| (layout.bounds(&below), below)).collect();
        smallest_first(&mut children, |(bounds, _)| bounds);
        for (slot, (bounds, below)) in children.into_iter().enumerate() {
            let (bits, depth) = layout.leaf_or(below, level < sorted_levels, |below| {
                open.push(Open { below, parent: Some((index, slot)), root, level: level + 1 });
            });
            node.set(slot, &bounds, bits);
            roots[root].depth = roots[root].depth.max(level + depth);
        }
        // Depth first: nodes follow one another in the order of the children.
        open[first..].reverse();
        nodes.push(node);
    }
    roots
}

struct Layout<'a, C> {
    choices: &'a Choices<'a>,
    contents: &'a mut C,
    // Scratch memory.
    items: Vec<u32>,
    stack: Vec<u32>,
}

impl<C: Contents> Layout<'_, C> {
    /// Levels of nodes that all items take as [`Below::Unsorted`].
    fn unsorted_levels(&self) -> usize {
        let count = self.contents.count();
        let (mut levels, mut room) = (0, C::GUARANTEED);
        while room < count {
            levels += 1;
            room *= ARITY;
        }
        levels
    }

    /// Makes a child a leaf: its bits, and the levels of nodes below it. Otherwise hands it to `open_node`, which sees to
    /// its bits later. Subtrees become nodes only if `is_sorted`.
    fn leaf_or(
        &mut self,
        child: Below,
        is_sorted: bool,
        open_node: impl FnOnce(Below),
    ) -> (u32, usize) {
        match child {
            Below::Subtree(index) if is_sorted && !self.choices.is_leaf(index) => {
                open_node(child);
                (Child::EMPTY, 0)
            }
            Below::Subtree(index) => {
                let Self { choices, contents, items, stack } = self;
                items.clear();
                choices.each_primitive(index, stack, |p| items.extend(contents.items(p)));
                if items.len() <= LANES
                    && let Some(leaf) = contents.leaf(items)
                {
                    return leaf;
                }
                open_node(Below::Unsorted(items.clone()));
                (Child::EMPTY, 0)
            }
            Below::Unsorted(ref items) => {
                let leaf = if items.len() <= LANES { self.contents.leaf(items) } else { None };
                leaf.unwrap_or_else(|| {
                    open_node(child);
                    (Child::EMPTY, 0)
                })
            }
        }
    }

    /// The children of a node.
    fn children(&self, node: Below) -> ArrayVec<Below, ARITY> {
        match node {
            Below::Subtree(index) => {
                self.choices.children(index).into_iter().map(Below::Subtree).collect()
            }
            Below::Unsorted(items) => {
                // At most eight shares, each as many items as always fit into full nodes below it.
                let mut share = C::GUARANTEED;
                while share * ARITY < items.len() {
                    share *= ARITY;
                }
                items.chunks(share).map(|share| Below::Unsorted(share.to_vec())).collect()
            }
        }
    }

    fn bounds(&self, child: &Below) -> Aabb {
        match child {
            Below::Subtree(index) => self.choices.bounds(*index),
            Below::Unsorted(items) => {
                let boxes = items.iter().map(|&item| self.contents.bounds(item));
                boxes.fold(Aabb::EMPTY, |all, one| all.including(one.min).including(one.max))
            }
        }
    }
}

/// Sorts children by the surface area of their boxes, as [`Node`] wants them.
pub fn smallest_first<T>(children: &mut [T], bounds: impl Fn(&T) -> &Aabb) {
    children.sort_by(|a, b| bounds(a).half_area().total_cmp(&bounds(b).half_area()));
}
