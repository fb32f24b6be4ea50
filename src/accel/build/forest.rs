//! [`build_forest`]: trees of single meshes, and a tree over the places where they stand.

use glam::{DVec3, Vec3};

use super::assemble::build;
use super::layout::Root;
use super::parallel::available_threads;
use super::top_level::build_top_level;
use crate::accel::tree::{Aabb, Bvh, Child, Forest, Node, Place};
use crate::shape::{Instance, Placement, TriangleMesh};
use crate::simd::ARITY;

/// The trees of all meshes that have instances, there and where their instances stand. Instances are shapes that count on from the
/// meshes. Leaves hold at most `max_in_leaf` triangles.
pub fn build_forest(meshes: &[TriangleMesh], instances: &[Instance], max_in_leaf: usize) -> Forest {
    let mut tree_of_mesh = vec![None; meshes.len()];
    let (mut trees, mut places) = (Vec::new(), Vec::new());
    let here = Placement::new(&glam::Affine3A::IDENTITY);
    for (index, Instance { mesh, placement }) in instances.iter().enumerate() {
        let of_mesh = &mut tree_of_mesh[*mesh as usize];
        let tree = *of_mesh.get_or_insert_with(|| {
            trees.push(build(&[&meshes[*mesh as usize]], available_threads(), max_in_leaf));
            let tree = trees.len() as u32 - 1;
            places.extend(place(tree, *mesh, &here, &trees[tree as usize]));
            tree
        });
        let shape = (meshes.len() + index) as u32;
        places.extend(place(tree, shape, placement, &trees[tree as usize]));
    }
    let boxes: Vec<Aabb> = places.iter().map(|place| bounds(place, &trees)).collect();
    let root = |(index, &bounds): (usize, &Aabb)| Root {
        bounds,
        bits: Child::pack_leaf(index + 1, 1),
        depth: 0,
    };
    let roots: Vec<Root> = boxes.iter().enumerate().map(root).collect();
    let mut nodes = Vec::new();
    let mut depth = 0;
    if !roots.is_empty() {
        nodes.push(Node::EMPTY);
        depth = build_top_level(&roots, &mut nodes);
    }
    let bounds = nodes.first().map_or(Aabb::EMPTY, Node::bounds);
    Forest { nodes, depth, bounds, largest_coordinate: bounds.largest_coordinate(), trees, places }
}

/// Where a tree stands; `None` if it has no triangles.
fn place(tree: u32, shape: u32, placement: &Placement, bvh: &Bvh) -> Option<Place> {
    if bvh.nodes.is_empty() {
        return None;
    }
    let inverse = placement.inverse()?.matrix3;
    let rows = placement.rows();
    let translation = Vec3::from(rows.map(|row| row[3]));
    let spread = inverse.x_axis.abs() + inverse.y_axis.abs() + inverse.z_axis.abs();
    let size = f64::from(bvh.largest_coordinate);
    let reach = rows.map(|[x, y, z, t]| {
        let [x, y, z, t] = [x, y, z, t].map(|number| f64::from(number.abs()));
        (x + y + z) * size + t
    });
    Some(Place {
        tree,
        shape,
        rows,
        is_mirrored: placement.is_mirrored,
        translation,
        inverse: inverse.as_mat3(),
        spread: spread.as_vec3(),
        reach: reach.into_iter().fold(0.0, f64::max).next_up() as f32,
    })
}

/// The box around a tree where it stands: around the corners of the boxes of its root's children.
fn bounds(place: &Place, trees: &[Bvh]) -> Aabb {
    let root = &trees[place.tree as usize].nodes[0];
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for slot in 0..ARITY {
        if root.planes[0][slot] > root.planes[3][slot] {
            continue;
        }
        for corner in 0..8 {
            let p =
                [0, 1, 2].map(|axis| f64::from(root.planes[axis + 3 * (corner >> axis & 1)][slot]));
            let moved = place.rows.map(|[x, y, z, t]| {
                let [x, y, z, t] = [x, y, z, t].map(f64::from);
                p[0] * x + p[1] * y + p[2] * z + t
            });
            (min, max) = (min.min(moved.into()), max.max(moved.into()));
        }
    }
    // A vertex that is moved in f32 is off by three sums and a product.
    let error = DVec3::splat(4.0 * f64::from(f32::EPSILON) * f64::from(place.reach));
    Aabb { min: (min - error).as_vec3(), max: (max + error).as_vec3() }
}
