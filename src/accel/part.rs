//! [`Plan`] and [`Part`]: the tree over some of the triangles, before and after it is laid out.

use arrayvec::ArrayVec;
use glam::Vec3;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::Aabb;
use super::bundle::{Bundle, bundle};
use super::collapse::Collapse;
use super::lanes::LANES;
use super::node::{Child, Node};
use super::stack::MOST_DEEP;
use super::triangles::{Triangle, Triangles};

/// Down to this depth the tree is the cheapest. What is deeper, which only degenerate scenes are, is laid out
/// with all leaves equally deep: those of all triangles that can be numbered are then no deeper than
/// [`MOST_DEEP`].
const CHEAPEST_DOWN_TO: usize = MOST_DEEP - 7;
const _: () = assert!(LANES.pow(7) >= super::node::MOST_TRIANGLES);

/// A tree that can be laid out.
pub struct Plan<'a> {
    source: &'a [Triangle],
    bundles: Vec<Bundle>,
    collapse: Collapse,
}

/// A piece of a tree below the root, with its triangles.
pub struct Part {
    /// What stands for it in the root.
    pub roots: ArrayVec<(Aabb, u32), LANES>,
    pub nodes: Vec<Node>,
    pub triangles: Triangles,
    /// The longest way from the root of the whole tree to a leaf, in nodes.
    pub depth: usize,
}

/// What is to become a child.
enum Below {
    /// A subtree of the binary tree.
    Subtree(u32),
    /// Triangles that no tree tells apart.
    Heap(Vec<Triangle>),
}

/// A node that waits to be laid out: its children, where its number is to go, and how deep it is.
struct Open {
    children: ArrayVec<Below, LANES>,
    parent: Parent,
    level: usize,
}

#[derive(Clone, Copy)]
enum Parent {
    Root(usize),
    Node(usize, usize),
}

impl<'a> Plan<'a> {
    /// Builds the binary tree over at least one triangle.
    pub fn new(triangles: &'a mut [Triangle]) -> Self {
        let bundles = bundle(triangles);
        let count = |primitive: u32| bundles[primitive as usize].range().len();
        let collapse = Collapse::new(binary_tree(&bundles), count);
        Self { source: triangles, bundles, collapse }
    }

    /// By how much the tree gets cheaper if it stands as `k` + 1 children in the root, not as `k`.
    pub fn gain(&self, k: usize) -> f32 {
        self.collapse.root_cost(k) - self.collapse.root_cost(k + 1)
    }

    /// Lays the tree out, as at most `k` children of the root.
    pub fn lay_out(self, k: usize) -> Part {
        let mut part = Part {
            roots: ArrayVec::new(),
            nodes: Vec::with_capacity(self.source.len() / 64 + 1),
            triangles: Triangles::with_capacity(self.source.len()),
            depth: 1,
        };
        let mut open = Vec::new();
        for place in self.collapse.roots(k) {
            let child = self.child(Below::Subtree(place), 1);
            let (bits, children) = child.add_to(&mut part.triangles);
            let parent = Parent::Root(part.roots.len());
            part.roots.push((self.collapse.bounds(place), bits));
            open.extend(children.map(|children| Open { children, parent, level: 2 }));
        }
        open.reverse();
        while let Some(Open { children, parent, level }) = open.pop() {
            let place = part.nodes.len();
            match parent {
                Parent::Root(root) => part.roots[root].1 = place as u32,
                Parent::Node(node, slot) => part.nodes[node].children[slot] = place as u32,
            }
            part.depth = part.depth.max(level);
            let boxes: ArrayVec<Aabb, LANES> = children.iter().map(|c| self.bounds(c)).collect();
            let mut node = Node::EMPTY;
            let first = open.len();
            for ((below, bounds), slot) in children.into_iter().zip(&boxes).zip(slots(&boxes)) {
                let child = self.child(below, level);
                let (bits, children) = child.add_to(&mut part.triangles);
                node.set(slot, bounds, bits);
                let parent = Parent::Node(place, slot);
                open.extend(children.map(|children| Open { children, parent, level: level + 1 }));
            }
            // Nodes follow one another in the order of the children.
            open[first..].reverse();
            part.nodes.push(node);
        }
        part
    }

    /// What becomes of a child of a node at a level.
    fn child(&self, below: Below, level: usize) -> Becomes {
        let mut heap = match below {
            Below::Subtree(place) if !self.collapse.is_leaf(place) && level < CHEAPEST_DOWN_TO => {
                let children = self.collapse.children(place).into_iter();
                return Becomes::Node(children.map(Below::Subtree).collect());
            }
            Below::Subtree(place) => self.triangles(place),
            Below::Heap(triangles) => triangles,
        };
        if heap.len() <= LANES {
            return Becomes::Leaf(heap);
        }
        // Sixteen shares, each of as many triangles as full nodes below them have.
        let mut share = LANES;
        while share * LANES < heap.len() {
            share *= LANES;
        }
        let mut shares = ArrayVec::new();
        while heap.len() > share {
            shares.push(Below::Heap(heap.split_off(heap.len() - share)));
        }
        shares.push(Below::Heap(heap));
        Becomes::Node(shares)
    }

    fn triangles(&self, place: u32) -> Vec<Triangle> {
        let primitives = self.collapse.primitives(place);
        let ranges = primitives.map(|primitive| self.bundles[primitive as usize].range());
        ranges.flat_map(|range| &self.source[range]).copied().collect()
    }

    fn bounds(&self, below: &Below) -> Aabb {
        match below {
            Below::Subtree(place) => self.collapse.bounds(*place),
            Below::Heap(triangles) => {
                triangles.iter().flat_map(|t| t.corners).fold(Aabb::EMPTY, Aabb::including)
            }
        }
    }
}

fn binary_tree(bundles: &[Bundle]) -> Bvh2 {
    let numbers = (0..bundles.len() as u32).collect();
    let mut builder = PlocBuilder::with_capacity(bundles.len());
    let mut tree =
        builder.build(PlocSearchDistance::Medium, bundles, numbers, SortPrecision::U64, 3);
    ReinsertionOptimizer::default().run(&mut tree, 0.05, None);
    tree
}

/// What a child turns out to be.
enum Becomes {
    Node(ArrayVec<Below, LANES>),
    Leaf(Vec<Triangle>),
}

impl Becomes {
    /// How nodes refer to it, as far as that is known yet, and the children of a node.
    fn add_to(self, triangles: &mut Triangles) -> (u32, Option<ArrayVec<Below, LANES>>) {
        match self {
            Self::Leaf(leaf) => (triangles.push(&leaf), None),
            Self::Node(children) => (Child::NOTHING, Some(children)),
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
