//! [`instances`]: which meshes are drawn once more, and which are copied.

use std::collections::HashMap;

use glam::{Affine3A, Vec3};

use super::error::SceneError;
use super::new_shape::{NewEmission, NewShape};
use crate::accel::Accel;
use crate::geometry::float::MAX_COORDINATE;
use crate::shape::{Instance, TriangleMesh};

/// An instance, before its scene is built.
pub(super) struct NewInstance {
    pub name: String,
    pub shape: String,
    pub transform: Affine3A,
}

/// The instances with their names. Shapes that have to be copied are added to `shapes`.
pub(super) fn instances(
    shapes: &mut Vec<NewShape>,
    all: Vec<NewInstance>,
) -> Result<(Vec<String>, Vec<Instance>), SceneError> {
    let mut by_name = HashMap::new();
    for (index, shape) in shapes.iter().enumerate() {
        by_name.entry(shape.name.clone()).or_insert(index);
    }
    if all.len() > Accel::MAX_INSTANCES {
        let reason = format!("is one of {}, more than {}", all.len(), Accel::MAX_INSTANCES);
        let instance = all.into_iter().next().map_or_else(String::new, |instance| instance.name);
        return Err(SceneError::Instance { instance, reason });
    }
    let (mut names, mut instances) = (Vec::new(), Vec::new());
    let mut boxes = HashMap::new();
    let mut triangles: usize = shapes.iter().map(|shape| shape.mesh.indices.len()).sum();
    let mut copies = Vec::new();
    for NewInstance { name, shape, transform } in all {
        let wrong = |reason: String| SceneError::Instance { instance: name.clone(), reason };
        let Some(&index) = by_name.get(&shape) else {
            return Err(wrong(format!("the scene has no shape \"{shape}\"")));
        };
        let original = &shapes[index];
        let corners = boxes.entry(index).or_insert_with(|| corners(&original.mesh.positions));
        let is_within = |p: Vec3| p.abs().max_element() <= MAX_COORDINATE && !p.is_nan();
        if !corners.iter().all(|p| is_within(transform.transform_point3(*p))) {
            return Err(wrong("coordinates have to be finite and up to 1e12".to_owned()));
        }
        let is_dark = original.emission.is_none();
        match Instance::new(index as u32, &transform).filter(|_| is_dark) {
            Some(instance) => {
                names.push(name);
                instances.push(instance);
            }
            None => {
                if let Some(NewEmission::Light(_)) = original.emission {
                    return Err(wrong("its shape has a light of its own kind".to_owned()));
                }
                triangles += original.mesh.indices.len();
                copies.push((name, index, transform));
            }
        }
    }
    // Before memory is taken for them.
    if triangles > Accel::MAX_TRIANGLES {
        return Err(SceneError::TooManyTriangles(triangles));
    }
    for (name, index, transform) in copies {
        let NewShape { mesh, material, emission, .. } = &shapes[index];
        let (mesh, material) = (copied(mesh, &transform), material.clone());
        let emission = emission.clone();
        shapes.push(NewShape { name, mesh, material, emission, copy_of: Some(index) });
    }
    Ok((names, instances))
}

/// A mesh in another place, without more vertices than triangles can have: these are what is counted.
fn copied(mesh: &TriangleMesh, transform: &Affine3A) -> TriangleMesh {
    let mut copy = if mesh.positions.len() > 3 * mesh.indices.len() {
        mesh.part(&(0..mesh.indices.len() as u32).collect::<Vec<_>>())
    } else {
        mesh.clone()
    };
    copy.transform(transform);
    copy
}

/// Corners of the box around some points.
fn corners(points: &[Vec3]) -> Vec<Vec3> {
    let Some(&first) = points.first() else { return Vec::new() };
    let (min, max) = points.iter().fold((first, first), |(min, max), p| (min.min(*p), max.max(*p)));
    let pick = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { min } else { max }[axis];
    (0..8).map(|i| Vec3::new(pick(i, 0), pick(i, 1), pick(i, 2))).collect()
}
