//! [`Forest`]: trees that stand at several places.

use glam::{Mat3, Vec3};

use super::aabb::Aabb;
use super::bvh::Bvh;
use super::node::Node;

/// Trees, and a tree over the places where they stand.
#[derive(Clone, Debug)]
pub struct Forest {
    /// The tree over the places, the root first. A leaf is a place: its index plus 1, with one vertex.
    pub nodes: Vec<Node>,
    /// Most nodes on the way from the root to a place.
    pub depth: usize,
    /// The box around everything, in the world.
    pub bounds: Aabb,
    /// The largest absolute coordinate of `bounds`.
    pub largest_coordinate: f32,
    pub trees: Vec<Bvh>,
    pub places: Vec<Place>,
}

/// Where a tree stands.
#[derive(Clone, Debug)]
pub struct Place {
    /// Index of the tree.
    pub tree: u32,
    /// What hits there are said to be on.
    pub shape: u32,
    /// From the tree to the world: see [`Placement::rows`](crate::shape::Placement::rows).
    pub rows: [[f32; 4]; 3],
    /// Whether the order of corners is reversed.
    pub is_mirrored: bool,
    /// Where the tree's origin stands.
    pub translation: Vec3,
    /// From the world back, but for the translation.
    pub inverse: Mat3,
    /// How far along each axis of the tree a unit along all axes of the world reaches.
    pub spread: Vec3,
    /// Of the numbers that are added to move a vertex, at most so large is the sum of all absolute ones.
    pub reach: f32,
}

impl Forest {
    /// Bytes of trees and places.
    pub fn memory(&self) -> usize {
        let trees: usize = self.trees.iter().map(Bvh::memory).sum();
        size_of_val(&self.nodes[..]) + size_of_val(&self.places[..]) + trees
    }
}
