//! [`Collapse`]: which nodes of a binary tree become nodes of the wide one.

use arrayvec::ArrayVec;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;

use super::Aabb;
use super::lanes::LANES;

/// What the surface area heuristic takes a node and a leaf to cost: about the same, as measured.
const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// Decides for one tree after another in the same memory.
///
/// Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", section 3.1: the cheapest way to stand for a subtree by at most k children, for every k, follows
/// from the ways to stand for its two halves.
#[derive(Default)]
pub struct Collapse {
    order: Vec<u32>,
    known: Vec<Known>,
    choices: Vec<u8>,
    costs: Vec<f32>,
}

/// The choices that make the cheapest wide tree of a binary one, each of whose leaves has one primitive.
pub struct Choices<'a> {
    tree: &'a Bvh2,
    known: &'a [Known],
    /// For k = 1, whether the subtree is one leaf; for others how many of the k children stand for the left
    /// half, with [`FEWER`] where k - 1 are as good.
    choices: &'a [u8],
    /// What the whole tree costs as at most k children, for k from 1 on.
    root_costs: &'a [f32],
}

/// What is known of a node.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Where its choices begin, for k from 1 on.
    start: u32,
    /// How many there are: one for each primitive, up to [`LANES`]; where all may be one leaf, one for each
    /// [`SMALL`] items at most.
    ways: u8,
    /// How much there is below it, up to one more than fits into a leaf.
    items: u8,
}

/// What fits into a leaf is not split into more children than one for each three triangles: it would not pay.
const SMALL: u8 = 3;

const LEAF: u8 = 1;
const NODE: u8 = 0;
const FEWER: u8 = 0x80;
/// More than fits into a leaf.
pub const TOO_MANY: usize = LANES + 1;

impl Collapse {
    /// Decides for all nodes of the tree. `items` says how many a primitive has; a leaf is taken to
    /// have room for `most_in_leaf` of them, no more than [`LANES`], though it may refuse some.
    pub fn decide<'a>(
        &'a mut self,
        tree: &'a Bvh2,
        most_in_leaf: usize,
        items: impl Fn(u32) -> usize,
    ) -> Choices<'a> {
        parents_first(tree, &mut self.order);
        self.known.resize(tree.nodes.len(), Known::default());
        self.choices.clear();
        self.costs.clear();
        let Self { order, known, choices, costs } = self;
        for &place in order.iter().rev() {
            let node = &tree.nodes[place as usize];
            let area = node.aabb().half_area();
            let start = costs.len() as u32;
            let as_leaf = area * LEAF_COST;
            let [left, right] = if node.is_leaf() {
                let inside = items(primitive(tree, node)).min(TOO_MANY) as u8;
                [Known { start, ways: 1, items: inside }, Known::default()]
            } else {
                halves(node).map(|half| known[half as usize])
            };
            let inside = (left.items + right.items).min(TOO_MANY as u8);
            let most = if usize::from(inside) > most_in_leaf {
                LANES
            } else {
                usize::from(inside.div_ceil(SMALL))
            };
            let ways = usize::from(left.ways + right.ways).min(most);
            known[place as usize] = Known { start, ways: ways as u8, items: inside };
            if ways == 1 {
                costs.push(as_leaf);
                choices.push(LEAF);
                continue;
            }

            let costs_of = |half: Known| &costs[half.start as usize..][..usize::from(half.ways)];
            let (mut best, mut lefts) = ([f32::INFINITY; LANES + 1], [0; LANES + 1]);
            let of_right = costs_of(right);
            for (l, of_left) in (1..LANES).zip(costs_of(left)) {
                let ks = best[l + 1..].iter_mut().zip(&mut lefts[l + 1..]);
                for ((best, left), of_right) in ks.zip(of_right) {
                    let cost = of_left + of_right;
                    (*best, *left) = if cost < *best { (cost, l as u8) } else { (*best, *left) };
                }
            }
            // A node takes the best of all k.
            let split = best[2..=ways].iter().fold(f32::INFINITY, |a, &b| a.min(b));
            let as_node = area * NODE_COST + split;
            let as_leaf = if usize::from(inside) <= most_in_leaf { as_leaf } else { f32::INFINITY };
            let mut least = as_leaf.min(as_node);
            let choice = if as_leaf <= as_node { LEAF } else { NODE };
            (best[1], lefts[1]) = (least, choice);
            for k in 2..=ways {
                if best[k] < least {
                    least = best[k];
                } else {
                    (best[k], lefts[k]) = (least, lefts[k] | FEWER);
                }
            }
            costs.extend_from_slice(&best[1..=ways]);
            choices.extend_from_slice(&lefts[1..=ways]);
        }
        let Known { start, ways, .. } = known[0];
        let root_costs = &costs[start as usize..][..usize::from(ways)];
        Choices { tree, known, choices, root_costs }
    }
}

impl Choices<'_> {
    /// Whether a node of the tree becomes a leaf.
    pub fn is_leaf(&self, place: u32) -> bool {
        self.choices[self.known[place as usize].start as usize] == LEAF
    }

    /// The children that stand for the whole tree, if a place for a child costs so much.
    pub fn roots(&self, price: f32) -> ArrayVec<u32, LANES> {
        let with_price = (1..).zip(self.root_costs).map(|(k, cost)| (k, cost + price * k as f32));
        let cheapest = with_price.min_by(|(_, a), (_, b)| a.total_cmp(b));
        self.standing_for([(0, cheapest.map_or(1, |(k, _)| k))])
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

    /// Calls `act` with the primitives of a subtree, left ones first. `open` is room to work in.
    pub fn each_primitive(&self, place: u32, open: &mut Vec<u32>, mut act: impl FnMut(u32)) {
        open.clear();
        open.push(place);
        while let Some(place) = open.pop() {
            let node = &self.tree.nodes[place as usize];
            if node.is_leaf() {
                act(primitive(self.tree, node));
            } else {
                let [left, right] = halves(node);
                open.extend([right, left]);
            }
        }
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

/// The primitive of a leaf.
fn primitive(tree: &Bvh2, leaf: &Bvh2Node) -> u32 {
    tree.primitive_indices[leaf.first_index as usize]
}

/// Lists all nodes, parents before children.
fn parents_first(tree: &Bvh2, order: &mut Vec<u32>) {
    order.clear();
    order.push(0);
    let mut next = 0;
    while let Some(&place) = order.get(next) {
        next += 1;
        let node = &tree.nodes[place as usize];
        if !node.is_leaf() {
            order.extend(halves(node));
        }
    }
}
