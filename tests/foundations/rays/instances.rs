//! Instances of meshes give what copies give, bit by bit.

use lobe::TriangleMesh;
use lobe::accel::{Accel, InstructionSet};
use lobe::glam::{Affine3A, Quat, Vec3};
use lobe::shape::Instance;

use super::answers::{Loop, assert_answers};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::{grid, lumpy, mixture};

/// A place of some kind: near and of about the same size, far away, tiny or huge, mirrored, sheared, or hardly thick.
fn transform(kind: usize, rng: &mut Rng) -> Affine3A {
    let turn = Quat::from_axis_angle(rng.direction(), rng.within(0.0, 6.0));
    let factors = Vec3::new(rng.within(0.3, 3.0), rng.within(0.3, 3.0), rng.within(0.3, 3.0));
    let sheared = Affine3A::from_quat(turn) * Affine3A::from_scale(factors);
    let near = 2.0 * rng.direction();
    let place = |scale: f32, at: Vec3| {
        Affine3A::from_translation(at) * Affine3A::from_scale(Vec3::splat(scale))
    };
    match kind {
        0 => place(1.0, near),
        1 => place(1.0, near) * sheared * Affine3A::from_quat(turn),
        2 => place(1.0, 1e5 * rng.direction()) * sheared,
        3 => place(1e-6, near) * sheared,
        4 => place(1e6, near) * sheared,
        5 => place(1.0, near) * Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)) * sheared,
        6 => place(1.0, near) * sheared * Affine3A::from_scale(Vec3::new(1.0, 1e-5, 1.0)),
        _ => Affine3A::IDENTITY,
    }
}

/// Fails unless instances of some meshes give what a loop over copies gives, for rays of every kind.
fn assert_scene(
    meshes: &[TriangleMesh],
    count: usize,
    set: InstructionSet,
    test: u64,
    rays: usize,
) {
    let mut rng = Rng::new(test, 0);
    let (mut instances, mut copies) = (Vec::new(), meshes.to_vec());
    for i in 0..count {
        // The last mesh has none.
        let mesh = rng.below((meshes.len() - 1).max(1));
        let transform = transform(i % 8, &mut rng);
        instances.push(Instance::new(mesh as u32, &transform).expect("a place"));
        let mut copy = meshes[mesh].clone();
        copy.transform(&transform);
        copies.push(copy);
    }
    let (accel, truth) = (Accel::build_with_instances(set, meshes, &instances), Loop::new(&copies));
    for kind in Kind::ALL {
        let rays = many(kind, &copies, test, rays);
        assert_answers(&accel, &truth, &rays, &format!("test {test}, {count} instances, {kind:?}"));
    }
}

fn scenes(test: u64, rays: usize) {
    let scenes: [(&[TriangleMesh], usize); 4] = [
        (&[lumpy(2, 24), grid(8)], 8),
        (&[lumpy(3, 5)], 30),
        (&[grid(3), lumpy(1, 7), TriangleMesh::default(), grid(2)], 100),
        (&mixture(60, 1.0, &mut Rng::new(test, 1)), 16),
    ];
    for set in InstructionSet::available() {
        for (number, (meshes, count)) in scenes.iter().enumerate() {
            assert_scene(meshes, *count, set, test + number as u64, rays);
        }
    }
}

/// Caught: boxes padded for the tree's own numbers alone; corners of mirrored instances in the mesh's order; a sum in another order;
/// ties that the later shape wins; the original left out; a stack that an instance's tree overwrites.
#[test]
fn instances_give_what_copies_give() {
    scenes(400, 200);
}

/// As above, with more rays.
#[test]
#[ignore = "takes a minute"]
fn instances_give_what_copies_give_in_full() {
    scenes(500, 1500);
}

/// What cannot be undone is no instance.
#[test]
fn flat_places_are_none() {
    let scale = |x, y, z| Instance::new(0, &Affine3A::from_scale(Vec3::new(x, y, z)));
    assert!(scale(1.0, 1.0, 0.0).is_none());
    assert!(scale(1.0, 1e-20, 1.0).is_none());
    assert!(scale(1e20, 1.0, 1.0).is_none());
    assert!(scale(f32::NAN, 1.0, 1.0).is_none());
    assert!(Instance::new(0, &Affine3A::from_translation(Vec3::INFINITY)).is_none());
    assert!(scale(-1e-3, 1e3, 1.0).is_some());
}

/// Counts are those of the meshes, and memory hardly grows with instances: a thousand of a mesh take less than two copies.
#[test]
fn instances_take_little() {
    let lump = lumpy(5, 3);
    let places = |count: usize| -> Vec<Instance> {
        let place = |i: usize| Affine3A::from_translation(Vec3::X * (3 * i) as f32);
        (1..count).map(|i| Instance::new(0, &place(i)).expect("a place")).collect()
    };
    let set = InstructionSet::fastest();
    let thousand = Accel::build_with_instances(set, std::slice::from_ref(&lump), &places(1000));
    let one = Accel::build(std::slice::from_ref(&lump));
    assert_eq!(thousand.triangle_count(), one.triangle_count());
    let bound = one.memory() + 300 * 1000;
    assert!(thousand.memory() < bound, "{} and {}", thousand.memory(), one.memory());
    assert!(thousand.bounds().max.x > 2990.0);
}
