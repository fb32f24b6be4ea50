//! [`Collapse`]: which nodes of a binary tree become nodes and leaves of the eight-wide tree.

use arrayvec::ArrayVec;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;

use crate::accel::tree::Aabb;
use crate::simd::{ARITY, LANES};

/// Costs of visiting a node and a leaf in the surface area heuristic: about the same, as measured.
const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// Chooses for one tree after another in the same memory.
///
/// Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
/// section 3.1. Dynamic programming from the leaves up: the least cost of a subtree as at most k children of the node
/// above, for every k, follows from those of its two halves.
#[derive(Default)]
pub struct Collapse {
    order: Vec<u32>,
    nodes: Vec<NodeInfo>,
    choices: Vec<u8>,
    costs: Vec<f32>,
}

/// The choices that make the cheapest wide tree of a binary one, each of whose leaves has one primitive.
pub struct Choices<'a> {
    tree: &'a Bvh2,
    nodes: &'a [NodeInfo],
    /// For k = 1: [`LEAF`] or [`NODE`]. For larger k: how many of the k children stand for the left half, or'ed with
    /// [`FEWER`] if k - 1 children cost no more.
    choices: &'a [u8],
    /// Least cost of the whole tree as at most k children, for k from 1 on.
    root_costs: &'a [f32],
}

/// What is known of a node of the binary tree.
#[derive(Clone, Copy, Default)]
struct NodeInfo {
    /// Index of its choice for k = 1, after which come those for larger k.
    first: u32,
    /// Largest k: the number of primitives, up to [`ARITY`]; if one leaf has room for all, no more than one child for
    /// each [`MIN_PER_CHILD`] items.
    max_k: u8,
    /// Number of items below it, up to [`TOO_MANY`].
    items: u8,
}

/// What fits into a leaf is not split into children of fewer items than this: it would not pay.
const MIN_PER_CHILD: u8 = 3;

const LEAF: u8 = 1;
const NODE: u8 = 0;
const FEWER: u8 = 0x80;
/// A number of items that fits into no leaf.
pub const TOO_MANY: usize = LANES + 1;

impl Collapse {
    /// Chooses for all nodes of the tree. `items` gives the number of items of a primitive. A leaf is taken to have
    /// room for `max_in_leaf` of them, at most [`LANES`], though it may refuse some.
    pub fn choose<'a>(
        &'a mut self,
        tree: &'a Bvh2,
        max_in_leaf: usize,
        items: impl Fn(u32) -> usize,
    ) -> Choices<'a> {
        parents_first(tree, &mut self.order);
        self.nodes.resize(tree.nodes.len(), NodeInfo::default());
        self.choices.clear();
        self.costs.clear();
        let Self { order, nodes, choices, costs } = self;
        for &index in order.iter().rev() {
            let node = &tree.nodes[index as usize];
            let area = node.aabb().half_area();
            let first = costs.len() as u32;
            let as_leaf = area * LEAF_COST;
            let [left, right] = if node.is_leaf() {
                let items = items(primitive(tree, node)).min(TOO_MANY) as u8;
                [NodeInfo { first, max_k: 1, items }, NodeInfo::default()]
            } else {
                children(node).map(|child| nodes[child as usize])
            };
            let items = (left.items + right.items).min(TOO_MANY as u8);
            let limit = if usize::from(items) > max_in_leaf {
                ARITY
            } else {
                usize::from(items.div_ceil(MIN_PER_CHILD))
            };
            let max_k = usize::from(left.max_k + right.max_k).min(limit);
            nodes[index as usize] = NodeInfo { first, max_k: max_k as u8, items };
            if max_k == 1 {
                costs.push(as_leaf);
                choices.push(LEAF);
                continue;
            }

            // Exactly k children, shared out to both halves in the cheapest way.
            let costs_of =
                |half: NodeInfo| &costs[half.first as usize..][..usize::from(half.max_k)];
            let (mut best, mut lefts) = ([f32::INFINITY; ARITY + 1], [0; ARITY + 1]);
            let right_costs = costs_of(right);
            for (l, left_cost) in (1..ARITY).zip(costs_of(left)) {
                let ks = best[l + 1..].iter_mut().zip(&mut lefts[l + 1..]);
                for ((best, left), right_cost) in ks.zip(right_costs) {
                    let cost = left_cost + right_cost;
                    (*best, *left) = if cost < *best { (cost, l as u8) } else { (*best, *left) };
                }
            }
            // One child: a leaf, or a node with the best number of children of its own.
            let split = best[2..=max_k].iter().fold(f32::INFINITY, |a, &b| a.min(b));
            let as_node = area * NODE_COST + split;
            let as_leaf = if usize::from(items) <= max_in_leaf { as_leaf } else { f32::INFINITY };
            let mut least = as_leaf.min(as_node);
            let choice = if as_leaf <= as_node { LEAF } else { NODE };
            (best[1], lefts[1]) = (least, choice);
            // At most k children.
            for k in 2..=max_k {
                if best[k] < least {
                    least = best[k];
                } else {
                    (best[k], lefts[k]) = (least, lefts[k] | FEWER);
                }
            }
            costs.extend_from_slice(&best[1..=max_k]);
            choices.extend_from_slice(&lefts[1..=max_k]);
        }
        let NodeInfo { first, max_k, .. } = nodes[0];
        let root_costs = &costs[first as usize..][..usize::from(max_k)];
        Choices { tree, nodes, choices, root_costs }
    }
}

impl Choices<'_> {
    /// Whether a node of the binary tree becomes a leaf.
    pub fn is_leaf(&self, index: u32) -> bool {
        self.choices[self.nodes[index as usize].first as usize] == LEAF
    }

    /// The children that stand for the whole tree in the node above it, where each child costs `child_cost`.
    pub fn roots(&self, child_cost: f32) -> ArrayVec<u32, ARITY> {
        let costs = (1..).zip(self.root_costs).map(|(k, cost)| (k, cost + child_cost * k as f32));
        let cheapest = costs.min_by(|(_, a), (_, b)| a.total_cmp(b));
        self.expand([(0, cheapest.map_or(1, |(k, _)| k))])
    }

    /// The children of a node of the binary tree that becomes a node of the wide one.
    pub fn children(&self, index: u32) -> ArrayVec<u32, ARITY> {
        // A node was cheaper than a leaf, so some k of at least 2 is the cheapest.
        let k = self.fewest(index, ARITY).max(2);
        self.expand(self.split(index, k))
    }

    /// The children that stand for some subtrees, at most k for each.
    fn expand<const N: usize>(&self, subtrees: [(u32, usize); N]) -> ArrayVec<u32, ARITY> {
        let mut children = ArrayVec::new();
        let mut open: ArrayVec<_, ARITY> = subtrees.into_iter().collect();
        while let Some((index, k)) = open.pop() {
            match self.fewest(index, k) {
                1 => children.push(index),
                k => open.extend(self.split(index, k)),
            }
        }
        children
    }

    /// Both halves of a subtree with their shares of k children; the left one comes last, to be popped first.
    fn split(&self, index: u32, k: usize) -> [(u32, usize); 2] {
        let choice = self.choices[self.nodes[index as usize].first as usize + k - 1];
        let left_k = usize::from(choice & !FEWER);
        let [left, right] = children(&self.tree.nodes[index as usize]);
        [(right, k - left_k), (left, left_k)]
    }

    /// Calls `f` with the primitives of a subtree, from left to right. `open` is scratch memory.
    pub fn each_primitive(&self, index: u32, open: &mut Vec<u32>, mut f: impl FnMut(u32)) {
        open.clear();
        open.push(index);
        while let Some(index) = open.pop() {
            let node = &self.tree.nodes[index as usize];
            if node.is_leaf() {
                f(primitive(self.tree, node));
            } else {
                let [left, right] = children(node);
                open.extend([right, left]);
            }
        }
    }

    /// The box around a subtree.
    pub fn bounds(&self, index: u32) -> Aabb {
        let bounds = self.tree.nodes[index as usize].aabb();
        Aabb { min: bounds.min.into(), max: bounds.max.into() }
    }

    /// The least number of children that cost no more than `k` do.
    fn fewest(&self, index: u32, k: usize) -> usize {
        let NodeInfo { first, max_k, .. } = self.nodes[index as usize];
        let choice = |k: usize| self.choices[first as usize + k - 1];
        let mut k = k.min(usize::from(max_k));
        while k > 1 && choice(k) & FEWER != 0 {
            k -= 1;
        }
        k
    }
}

/// Indices of the left and the right child of an inner node.
fn children(node: &Bvh2Node) -> [u32; 2] {
    [node.first_index, node.first_index + 1]
}

/// The primitive of a leaf.
fn primitive(tree: &Bvh2, leaf: &Bvh2Node) -> u32 {
    tree.primitive_indices[leaf.first_index as usize]
}

/// Lists all nodes, parents before children.
fn parents_first(tree: &Bvh2, order: &mut Vec<u32>) {
    order.clear();
    order.push(0);
    let mut next = 0;
    while let Some(&index) = order.get(next) {
        next += 1;
        let node = &tree.nodes[index as usize];
        if !node.is_leaf() {
            order.extend(children(node));
        }
    }
}
