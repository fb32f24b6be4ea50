//! Decimation by edge collapse, cheapest first.
//!
//! Costs and places come from error quadrics (Garland & Heckbert 1997). A collapse is refused if
//! it
//! - would change the topology: the two ends must have exactly two common neighbours (the link
//!   condition of Dey, Edelsbrunner, Guha & Nekhayev, "Topology preserving edge contraction",
//!   1999);
//! - would turn a triangle by more than about 75 degrees;
//! - would leave a triangle that is a sliver and worse than those before.
//!
//! So a closed two-manifold stays one, with the same genus. The order is fixed by cost and, among
//! equals, by edge number: the result does not depend on anything else.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::halfedge::{Defect, HalfEdges};
use crate::mesh::{Mesh, quality};
use crate::parallel;
use crate::quadric::Quadric;

/// Least quality of a triangle that a collapse may make, 1 being equilateral.
const QUALITY: f64 = 0.08;
/// Marks the corners of a removed triangle.
const REMOVED: [u32; 3] = [u32::MAX; 3];

/// A candidate on the heap. `stamp` tells whether its ends have changed since.
struct Candidate {
    cost: f32,
    edge: u32,
    stamp: u32,
}

impl Ord for Candidate {
    /// The cheapest is the greatest, as the heap wants it.
    fn cmp(&self, other: &Candidate) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then(other.edge.cmp(&self.edge))
            .then(other.stamp.cmp(&self.stamp))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Candidate) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Candidate) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// The mesh in the course of decimation.
struct Decimation<'a> {
    mesh: &'a mut Mesh,
    edges: HalfEdges,
    quadrics: Vec<Quadric>,
    /// Number of changes of each vertex.
    stamps: Vec<u32>,
    heap: BinaryHeap<Candidate>,
}

/// Collapses edges of the closed `mesh` until at most `target` triangles remain, or no collapse is
/// allowed.
///
/// Errors about a place count `weight` times, so that triangles gather where they are wanted. `stay`
/// is the weight of a vertex's own place against its planes. It keeps the minimum well defined on
/// flat ground and spreads the vertices evenly there.
pub fn decimate(
    mesh: &mut Mesh,
    target: usize,
    weight: impl Fn(DVec3) -> f64 + Sync,
    stay: f64,
    threads: usize,
) -> Result<(), Defect> {
    if mesh.triangles.len() <= target {
        return Ok(());
    }
    let mut remaining = mesh.triangles.len();
    let mut d = Decimation::new(mesh, &weight, stay, threads)?;
    while remaining > target
        && let Some(candidate) = d.heap.pop()
    {
        if d.is_current(&candidate) && d.collapse(candidate.edge) {
            remaining -= 2;
        }
    }
    mesh.triangles.retain(|t| *t != REMOVED);
    mesh.drop_unused_vertices();
    Ok(())
}

impl Decimation<'_> {
    fn new<'a>(
        mesh: &'a mut Mesh,
        weight: &(impl Fn(DVec3) -> f64 + Sync),
        stay: f64,
        threads: usize,
    ) -> Result<Decimation<'a>, Defect> {
        let edges = HalfEdges::pair(mesh)?;
        let stamps = vec![0; mesh.positions.len()];
        let mut quadrics = vec![Quadric::default(); mesh.positions.len()];
        parallel::fill(&mut quadrics, threads, |v| {
            vertex_quadric(mesh, &edges, v as u32, weight, stay)
        });
        let mut d = Decimation { mesh, edges, quadrics, stamps, heap: BinaryHeap::new() };
        let mut costs = vec![f32::NAN; d.edges.twin.len()];
        parallel::fill(&mut costs, threads, |e| {
            if d.edges.twin[e] < e as u32 { d.place(e as u32).1 } else { 0.0 }
        });
        let candidates = costs.iter().enumerate().filter(|(e, _)| d.edges.twin[*e] < *e as u32);
        d.heap =
            candidates.map(|(e, &cost)| Candidate { cost, edge: e as u32, stamp: 0 }).collect();
        Ok(d)
    }

    fn triangle(&self, e: u32) -> [u32; 3] {
        self.mesh.triangles[e as usize / 3]
    }

    /// The vertices that half-edge `e` leaves and reaches.
    fn ends(&self, e: u32) -> (u32, u32) {
        let t = self.triangle(e);
        (t[e as usize % 3], t[(e as usize + 1) % 3])
    }

    fn is_current(&self, candidate: &Candidate) -> bool {
        if self.triangle(candidate.edge) == REMOVED {
            return false;
        }
        let (a, b) = self.ends(candidate.edge);
        self.stamps[a as usize].wrapping_add(self.stamps[b as usize]) == candidate.stamp
    }

    /// Where the ends of `e` would merge, and at what cost.
    fn place(&self, e: u32) -> (DVec3, f32) {
        let (a, b) = self.ends(e);
        let [p, q] = [a, b].map(|v| self.mesh.positions[v as usize]);
        let quadric = self.quadrics[a as usize].plus(&self.quadrics[b as usize]);
        let middle = p.midpoint(q);
        let place = match quadric.minimum() {
            // A minimum far off the edge is the fault of nearly parallel planes.
            Some(m) if m.distance(middle) < 1.5 * p.distance(q) => m,
            _ => middle,
        };
        (place, quadric.error(place) as f32)
    }

    /// Merges the ends of `e` if that is allowed.
    fn collapse(&mut self, e: u32) -> bool {
        let (a, b) = self.ends(e);
        let twin = self.edges.twin[e as usize];
        let (c, d) = (self.ends(HalfEdges::next(e)).1, self.ends(HalfEdges::next(twin)).1);
        let (place, _) = self.place(e);
        if !self.link_allows(a, b, [c, d])
            || !self.shape_allows(a, b, place)
            || !self.shape_allows(b, a, place)
        {
            return false;
        }
        let quadric = self.quadrics[a as usize].plus(&self.quadrics[b as usize]);
        self.join(e, a, b, [c, d]);
        self.mesh.positions[b as usize] = place;
        self.quadrics[b as usize] = quadric;
        self.stamps[b as usize] =
            self.stamps[b as usize].wrapping_add(self.stamps[a as usize]).wrapping_add(1);
        self.queue_around(b);
        true
    }

    /// The link condition, and no vertex left with fewer than three neighbours.
    fn link_allows(&self, a: u32, b: u32, wings: [u32; 2]) -> bool {
        let about_a: Vec<u32> = self.edges.around(a).map(|e| self.ends(e).1).collect();
        let common = self.edges.around(b).filter(|&e| about_a.contains(&self.ends(e).1)).count();
        common == 2 && wings.iter().all(|&w| self.edges.around(w).count() > 3)
    }

    /// Whether moving `v` to `place` leaves good triangles around it, those that also hold `other`
    /// aside.
    fn shape_allows(&self, v: u32, other: u32, place: DVec3) -> bool {
        self.edges.around(v).all(|e| {
            let (q, r) = (self.ends(e).1, self.ends(HalfEdges::next(e)).1);
            if q == other || r == other {
                return true;
            }
            let [p, q, r] = [v, q, r].map(|v| self.mesh.positions[v as usize]);
            let (before, after) = ((q - p).cross(r - p), (q - place).cross(r - place));
            let turned = before.dot(after) < 0.25 * before.length() * after.length();
            !turned && quality(place, q, r) > QUALITY.min(0.9 * quality(p, q, r))
        })
    }

    /// Removes the two triangles at `e`, glues what lay beyond them, and gives the triangles of
    /// `a` to `b`.
    fn join(&mut self, e: u32, a: u32, b: u32, wings: [u32; 2]) {
        let fan: Vec<u32> = self.edges.around(a).collect();
        for e in fan {
            self.mesh.triangles[e as usize / 3][e as usize % 3] = b;
        }
        let twin = self.edges.twin[e as usize];
        for (gone, wing) in [(e, wings[0]), (twin, wings[1])] {
            let x = self.edges.twin[HalfEdges::next(gone) as usize];
            let y = self.edges.twin[HalfEdges::previous(gone) as usize];
            self.edges.twin[x as usize] = y;
            self.edges.twin[y as usize] = x;
            // x leaves the wing on both sides; y leaves the merged vertex.
            self.edges.leaving[wing as usize] = x;
            self.edges.leaving[b as usize] = y;
            self.mesh.triangles[gone as usize / 3] = REMOVED;
        }
        self.edges.leaving[a as usize] = u32::MAX;
    }

    fn queue_around(&mut self, v: u32) {
        let fan: Vec<u32> = self.edges.around(v).collect();
        for e in fan {
            let cost = self.place(e).1;
            let w = self.ends(e).1;
            let stamp = self.stamps[v as usize].wrapping_add(self.stamps[w as usize]);
            self.heap.push(Candidate { cost, edge: e, stamp });
        }
    }
}

/// Planes of the triangles about `v`, weighted by area, and a weak wish to stay.
fn vertex_quadric(
    mesh: &Mesh,
    edges: &HalfEdges,
    v: u32,
    weight: impl Fn(DVec3) -> f64,
    stay: f64,
) -> Quadric {
    let p = mesh.positions[v as usize];
    let weight = weight(p);
    let mut sum = Quadric::default();
    for e in edges.around(v) {
        let normal = mesh.normal2(mesh.triangles[e as usize / 3]);
        let share = weight * 0.5 * normal.length();
        sum = sum.plus(&Quadric::plane(p, normal.normalize_or_zero(), share));
        sum = sum.plus(&Quadric::point(p, stay * share));
    }
    sum
}
