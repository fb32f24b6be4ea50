//! [`Collapse`]: which nodes of a binary tree become nodes of the wide one.

use arrayvec::ArrayVec;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;

use super::Aabb;
use super::lanes::LANES;

/// What the surface area heuristic takes a node and a leaf to cost: about the same, as measured.
const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// The choices that make the cheapest wide tree of a binary one, each of whose leaves has one primitive.
///
/// Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", section 3.1: the cheapest way to stand for a subtree by at most k children, for every k, follows
/// from the ways to stand for its two halves.
pub struct Collapse {
    tree: Bvh2,
    known: Vec<Known>,
    /// For k = 1, whether the subtree is one leaf; for others how many of the k children stand for the left
    /// half, with [`FEWER`] where k - 1 are as good.
    choices: Vec<u8>,
    /// What the whole tree costs as at most k children, for k from 1 on.
    root_costs: ArrayVec<f32, LANES>,
}

/// What is known of a node.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Where its choices begin, for k from 1 on.
    start: u32,
    /// How many there are: one for each primitive, up to [`LANES`].
    ways: u8,
    /// How many triangles are below it, up to one more than fit into a leaf.
    triangles: u8,
}

const LEAF: u8 = 1;
const NODE: u8 = 0;
const FEWER: u8 = 0x80;
const TOO_MANY: usize = LANES + 1;

impl Collapse {
    /// Decides for all nodes of the tree. `triangles` says how many are in a primitive.
    pub fn new(tree: Bvh2, triangles: impl Fn(u32) -> usize) -> Self {
        let mut known = vec![Known::default(); tree.nodes.len()];
        // Half of the nodes have one way, and a full node sixteen.
        let mut choices = Vec::with_capacity(4 * tree.nodes.len());
        let mut costs = Vec::with_capacity(4 * tree.nodes.len());
        for place in parents_first(&tree).into_iter().rev() {
            let node = &tree.nodes[place as usize];
            let area = node.aabb().half_area();
            let start = costs.len();
            if node.is_leaf() {
                let inside = triangles(tree.primitive_indices[node.first_index as usize]);
                costs.push(area * LEAF_COST);
                choices.push(LEAF);
                let triangles = inside.min(TOO_MANY) as u8;
                known[place as usize] = Known { start: start as u32, ways: 1, triangles };
                continue;
            }
            let [left, right] = halves(node).map(|half| known[half as usize]);
            let inside = (left.triangles + right.triangles).min(TOO_MANY as u8);
            let ways = usize::from(left.ways + right.ways).min(LANES);

            let cost_of = |half: Known, k: usize| costs[half.start as usize + k - 1];
            let (mut best, mut lefts) = ([f32::INFINITY; LANES + 1], [0; LANES + 1]);
            for l in 1..=usize::from(left.ways).min(LANES - 1) {
                for r in 1..=usize::from(right.ways).min(LANES - l) {
                    let cost = cost_of(left, l) + cost_of(right, r);
                    if cost < best[l + r] {
                        best[l + r] = cost;
                        lefts[l + r] = l as u8;
                    }
                }
            }
            // A node takes the best of all k.
            let split = best[2..=ways].iter().fold(f32::INFINITY, |a, &b| a.min(b));
            let as_node = area * NODE_COST + split;
            let as_leaf =
                if usize::from(inside) <= LANES { area * LEAF_COST } else { f32::INFINITY };
            choices.push(if as_leaf <= as_node { LEAF } else { NODE });
            let mut least = as_leaf.min(as_node);
            costs.push(least);
            for k in 2..=ways {
                choices.push(lefts[k] | if best[k] < least { 0 } else { FEWER });
                least = least.min(best[k]);
                costs.push(least);
            }
            known[place as usize] =
                Known { start: start as u32, ways: ways as u8, triangles: inside };
        }
        let Known { start, ways, .. } = known[0];
        let root_costs = costs[start as usize..][..usize::from(ways)].iter().copied().collect();
        Self { tree, known, choices, root_costs }
    }

    /// Whether a node of the tree becomes a leaf.
    pub fn is_leaf(&self, place: u32) -> bool {
        self.choices[self.known[place as usize].start as usize] == LEAF
    }

    /// What the whole tree costs as at most `k` children.
    pub fn root_cost(&self, k: usize) -> f32 {
        self.root_costs[k.min(self.root_costs.len()) - 1]
    }

    /// The at most `k` children that stand for the whole tree.
    pub fn roots(&self, k: usize) -> ArrayVec<u32, LANES> {
        self.standing_for([(0, k)])
    }

    /// The children that a node of the tree has when it becomes a node.
    pub fn children(&self, place: u32) -> ArrayVec<u32, LANES> {
        // As it was cheaper than a leaf, there is a k of at least 2 that is.
        let k = self.fewest(place, LANES).max(2);
        self.standing_for(self.split(place, k))
    }

    /// The children that stand for subtrees, at most so many for each.
    fn standing_for<const N: usize>(&self, subtrees: [(u32, usize); N]) -> ArrayVec<u32, LANES> {
        let mut children = ArrayVec::new();
        let mut open: ArrayVec<_, LANES> = subtrees.into_iter().collect();
        while let Some((place, k)) = open.pop() {
            match self.fewest(place, k) {
                1 => children.push(place),
                k => open.extend(self.split(place, k)),
            }
        }
        children
    }

    /// How many of k children each half gets, the left one last.
    fn split(&self, place: u32, k: usize) -> [(u32, usize); 2] {
        let choice = self.choices[self.known[place as usize].start as usize + k - 1];
        let left = usize::from(choice & !FEWER);
        let [l, r] = halves(&self.tree.nodes[place as usize]);
        [(r, k - left), (l, left)]
    }

    /// The primitives of a subtree, left ones first.
    pub fn primitives(&self, place: u32) -> impl Iterator<Item = u32> {
        let mut open = vec![place];
        std::iter::from_fn(move || {
            while let Some(place) = open.pop() {
                let node = &self.tree.nodes[place as usize];
                if node.is_leaf() {
                    return Some(self.tree.primitive_indices[node.first_index as usize]);
                }
                let [left, right] = halves(node);
                open.extend([right, left]);
            }
            None
        })
    }

    /// The box around a subtree.
    pub fn bounds(&self, place: u32) -> Aabb {
        let bounds = self.tree.nodes[place as usize].aabb();
        Aabb { min: bounds.min.into(), max: bounds.max.into() }
    }

    /// The least k that is as good as `k`.
    fn fewest(&self, place: u32, k: usize) -> usize {
        let known = self.known[place as usize];
        let choice = |k: usize| self.choices[known.start as usize + k - 1];
        let mut k = k.min(usize::from(known.ways));
        while k > 1 && choice(k) & FEWER != 0 {
            k -= 1;
        }
        k
    }
}

/// Where the children of an inner node are.
fn halves(node: &Bvh2Node) -> [u32; 2] {
    [node.first_index, node.first_index + 1]
}

fn parents_first(tree: &Bvh2) -> Vec<u32> {
    let mut order = Vec::with_capacity(tree.nodes.len());
    let mut open = vec![0];
    while let Some(place) = open.pop() {
        order.push(place);
        let node = &tree.nodes[place as usize];
        if !node.is_leaf() {
            open.extend(halves(node));
        }
    }
    order
}
