//! The truth for rays, by a loop over all triangles, and comparison with the tree.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit, InstructionSet};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

use crate::common::Rng;

/// All triangles with an area, in order, each with the indices of shape and triangle.
pub struct Loop(Vec<([Vec3; 3], u32, u32)>);

impl Loop {
    pub fn new(meshes: &[TriangleMesh]) -> Self {
        let mut all = Vec::new();
        for (shape, mesh) in meshes.iter().enumerate() {
            for triangle in 0..mesh.indices.len() {
                if mesh.geometric_normal(triangle) != Vec3::ZERO {
                    all.push((mesh.corners(triangle), shape as u32, triangle as u32));
                }
            }
        }
        Self(all)
    }

    /// The closest hit; of equally close ones the first.
    pub fn closest(&self, ray: &Ray) -> Hit {
        let sheared = ShearedRay::new(ray);
        let mut closest = Hit::MISS;
        for (corners, shape, triangle) in &self.0 {
            if let Some(found) = sheared.intersect(corners, ray.t_min, ray.t_max)
                && (found.t < closest.t || !closest.is_hit())
            {
                closest = Hit { t: found.t, b: found.b, shape: *shape, triangle: *triangle };
            }
        }
        closest
    }
}

/// A hit as integers, to compare bits.
pub fn bits(hit: &Hit) -> (u32, [u32; 3], u32, u32) {
    (hit.t.to_bits(), hit.b.map(f32::to_bits), hit.shape, hit.triangle)
}

/// Fails unless the tree gives this hit, for the closest-hit and the any-hit query.
pub fn assert_single(accel: &Accel, ray: &Ray, truth: &Hit, what: &str) {
    let hit = accel.intersect1(ray);
    assert_eq!(bits(&hit), bits(truth), "{what}: {ray:?}: {hit:?}, expected {truth:?}");
    let mut tracer = accel.tracer();
    let (traced, occluded) = (tracer.intersect1(ray), tracer.occluded1(ray));
    assert_eq!(bits(&traced), bits(truth), "{what}: {ray:?}: by a tracer");
    assert_eq!(occluded, truth.is_hit(), "{what}: {ray:?}: occluded1 of a tracer");
    assert_eq!(accel.occluded1(ray), truth.is_hit(), "{what}: {ray:?}: occluded1, {truth:?}");
}

/// Fails unless the tree gives the same as the loop for each ray alone and for all of them as one batch, with each
/// instruction set of the processor. The index of a ray in the message is its trial.
pub fn assert_answers(accel: &Accel, truth: &Loop, rays: &[Ray], what: &str) {
    let truths: Vec<Hit> = rays.iter().map(|ray| truth.closest(ray)).collect();
    let order: Vec<usize> = (0..rays.len()).collect();
    for set in InstructionSet::available() {
        let accel = accel.clone().with_instruction_set(set);
        assert_eq!(accel.instruction_set(), set);
        for (trial, (ray, truth)) in rays.iter().zip(&truths).enumerate() {
            assert_single(&accel, ray, truth, &format!("{what}, {set}, trial {trial}"));
        }
        assert_batch(&accel, rays, &order, &truths, &format!("{what}, {set}"));
    }
}

/// Fails unless the tree gives these hits for the rays with these indices, as one batch.
pub fn assert_batch(accel: &Accel, rays: &[Ray], order: &[usize], truths: &[Hit], what: &str) {
    let batch: Vec<Ray> = order.iter().map(|&number| rays[number]).collect();
    let (hits, occluded) = ask(accel, &batch);
    for (place, &number) in order.iter().enumerate() {
        let (ray, hit, truth) = (&rays[number], &hits[place], &truths[number]);
        let of =
            || format!("{what}, trial {number}, {place} in a batch of {}: {ray:?}", order.len());
        assert_eq!(bits(hit), bits(truth), "{}: {hit:?}, expected {truth:?}", of());
        assert_eq!(occluded[place], truth.is_hit(), "{}: occluded, {truth:?}", of());
    }
}

/// Traces a batch. The results go into the middle of longer arrays with other contents: the whole
/// middle has to be written, and nothing around it.
pub fn ask(accel: &Accel, rays: &[Ray]) -> (Vec<Hit>, Vec<bool>) {
    const AROUND: usize = 17;
    let stale = Hit { t: -7.0, b: [f32::NAN; 3], shape: 0, triangle: u32::MAX - 7 };
    let middle = AROUND..AROUND + rays.len();
    let mut hits = vec![stale; rays.len() + 2 * AROUND];
    accel.intersect(rays, &mut hits[middle.clone()]);
    let mut occluded: Vec<bool> = (0..hits.len()).map(|place| place % 3 == 0).collect();
    accel.occluded(rays, &mut occluded[middle.clone()]);
    for place in (0..hits.len()).filter(|place| !middle.contains(place)) {
        assert_eq!(bits(&hits[place]), bits(&stale), "intersect wrote beside its answers");
        assert_eq!(occluded[place], place % 3 == 0, "occluded wrote beside its answers");
    }
    (hits[middle.clone()].to_vec(), occluded[middle].to_vec())
}

/// Orders of rays: unchanged; sorted by direction, as in a camera's tiles; and sorted runs with unrelated rays
/// between them, few or many.
pub fn orders(rays: &[Ray], rng: &mut Rng) -> [Vec<usize>; 3] {
    let as_they_are: Vec<usize> = (0..rays.len()).collect();
    let mut coherent = as_they_are.clone();
    coherent.sort_by_cached_key(|&number| direction_code(rays[number].d));
    let mut mixed = coherent.clone();
    let mut place = 0;
    while place < mixed.len() {
        let other = rng.below(mixed.len());
        mixed.swap(place, other);
        place += [1, 2, 5, 9, 16, 33][rng.below(6)];
    }
    [as_they_are, coherent, mixed]
}

/// A code whose neighbours have similar directions: the octant, then the bits of the coordinates, interleaved
/// (Morton's order).
fn direction_code(d: Vec3) -> u64 {
    let unit = d.normalize_or_zero().to_array();
    let octant = unit.iter().fold(0, |code, x| 2 * code + u64::from(x.is_sign_negative()));
    let cells = unit.map(|x| (x.abs() * 1023.0) as u64);
    (0..10).rev().fold(octant, |code, bit| {
        cells.iter().fold(code, |code, cell| 2 * code + ((cell >> bit) & 1))
    })
}

/// Cuts an order into batches: mostly a renderer's 1024, and lengths that no vector width divides.
pub fn cut(order: &[usize]) -> impl Iterator<Item = &[usize]> {
    let mut lengths =
        [1024, 1023, 64, 1, 1024, 7, 8, 9, 1000, 15, 16, 17, 1024, 31, 2, 33].iter().cycle();
    let mut rest = order;
    std::iter::from_fn(move || {
        let (batch, after) = rest.split_at(rest.len().min(*lengths.next()?));
        rest = after;
        (!batch.is_empty()).then_some(batch)
    })
}
