//! [`LightTree`]: one of many lights, by power, distance and direction.

mod build;
mod node;

use glam::Vec3;

use super::bounds::LightBounds;
use crate::geometry::float::ONE_MINUS_EPSILON;
use node::{Child, Node, WIDTH};

/// A tree over the bounds of lights (PBRT 4th edition, section 12.6.3; Conty and Kulla 2018). A walk from the root selects a
/// child of each node with a probability in proportion to a bound on the light that arrives at a point, power over squared
/// distance times the cosine on the light's side.
///
/// Nodes have eight children, so that a walk among 10,000 lights is five steps, each of eight bounds side by side. The
/// receiver's normal is not asked for: the probability of a light that a path finds is that at the point which the path came
/// from, and its state holds no normal.
#[derive(Clone, Debug)]
pub(super) struct LightTree {
    /// The root comes first.
    nodes: Vec<Node>,
    /// Per node, where it hangs; the root on itself.
    parents: Vec<Place>,
    /// Per light, where it hangs.
    leaves: Vec<Place>,
}

/// A child of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Place {
    node: u32,
    lane: u32,
}

/// A light in the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub bounds: LightBounds,
    /// Power, in any unit.
    pub power: f64,
}

impl LightTree {
    /// The light that `u` in `[0, 1)` selects for the point `p`, and its probability.
    #[inline]
    pub fn pick(&self, p: Vec3, u: f32) -> (usize, f32) {
        let (mut u, mut node, mut probability) = (u, 0, 1.0);
        loop {
            let of_node = &self.nodes[node as usize];
            let weights = of_node.weights(p);
            let sum = sum(&weights);
            let wanted = u * sum;
            let (mut lane, mut before) = (0, 0.0);
            // The last lane with a weight if rounding leads beyond it.
            let mut end = 0.0;
            for (i, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                (lane, before) = (i, end);
                end += weight;
                if wanted < end {
                    break;
                }
            }
            probability *= weights[lane] / sum;
            u = ((wanted - before) / weights[lane]).clamp(0.0, ONE_MINUS_EPSILON);
            match of_node.child(lane) {
                Child::Node(child) => node = child,
                Child::Light(light) => return (light as usize, probability),
            }
        }
    }

    /// The probability with which [`pick`](Self::pick) selects a light for the point `p`.
    #[inline]
    pub fn probability(&self, light: usize, p: Vec3) -> f32 {
        let (mut place, mut probability) = (self.leaves[light], 1.0);
        loop {
            let weights = self.nodes[place.node as usize].weights(p);
            probability *= weights[place.lane as usize] / sum(&weights);
            if place.node == 0 {
                return probability;
            }
            place = self.parents[place.node as usize];
        }
    }

    /// The most nodes that a walk visits.
    #[cfg(test)]
    fn depth(&self) -> usize {
        let of_leaf = |leaf: &Place| {
            let (mut depth, mut node) = (1, leaf.node);
            while node != 0 {
                (depth, node) = (depth + 1, self.parents[node as usize].node);
            }
            depth
        };
        self.leaves.iter().map(of_leaf).max().unwrap_or(0)
    }
}

/// In pairs, as vectors add.
#[inline(always)]
fn sum(weights: &[f32; WIDTH]) -> f32 {
    let [a, b, c, d, e, f, g, h] = *weights;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}
