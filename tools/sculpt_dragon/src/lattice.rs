//! Extraction of the surface: marching tetrahedra on the body-centred cubic lattice.
//!
//! The lattice has a point at every corner and every centre of a grid of cubes. Two cubes that
//! share a side give four tetrahedra, each of both centres and one edge of the side; all are
//! congruent and they fill space (Chan & Purisima, "A new tetrahedral tesselation scheme for
//! isosurface generation", 1998). A tetrahedron whose corners differ in sign is cut by one
//! triangle or two (Doi & Koide 1991).
//!
//! Guarantee: no sample counts as zero, so the cut is the zero set of a piecewise linear function
//! that vanishes at no lattice point. That is a closed two-manifold, and it is oriented from
//! negative to positive. A vertex is named by the lattice edge that it lies on, so that neighbours
//! agree on it without comparing coordinates.

use glam::DVec3;

use crate::field::Field;
use crate::mesh::Mesh;
use crate::parallel;

/// Cubes along the edge of a block, the unit of work.
const BLOCK: i64 = 12;
/// Samples along the edge of a block, of either kind.
const SIDE: usize = BLOCK as usize + 1;

/// A lattice point in half-cube steps (all even: a corner; all odd: a centre) and the field there.
#[derive(Clone, Copy)]
struct Sample {
    at: [i64; 3],
    value: f64,
}

/// A block's share of the mesh: vertices by the key of their lattice edge, triangles of keys.
#[derive(Default)]
struct Patch {
    vertices: Vec<(u64, DVec3)>,
    triangles: Vec<[u64; 3]>,
}

/// The zero surface of `field`, sampled on cubes of edge `h`.
pub fn extract(field: &Field, h: f64, threads: usize) -> Mesh {
    let (low, high) = field.bounds();
    let blocks = surface_blocks(field, low, high, h);
    let patches = parallel::map(&blocks, threads, |&block| march_block(field, low, h, block));
    let mut vertices: Vec<(u64, DVec3)> =
        patches.iter().flat_map(|p| p.vertices.iter().copied()).collect();
    vertices.sort_unstable_by_key(|v| v.0);
    vertices.dedup_by_key(|v| v.0);
    let number = |key: &u64| vertices.partition_point(|v| v.0 < *key) as u32;
    let named = parallel::map(&patches, threads, |patch| {
        patch
            .triangles
            .iter()
            .map(|t| [number(&t[0]), number(&t[1]), number(&t[2])])
            .collect::<Vec<_>>()
    });
    drop(patches);
    let triangles = named.into_iter().flatten().collect();
    Mesh { positions: vertices.into_iter().map(|v| v.1).collect(), triangles }
}

/// Blocks that the surface may pass through. The dragon keeps away from the sides of the prepared
/// box, where a last, incomplete layer of blocks is left out.
fn surface_blocks(field: &Field, low: DVec3, high: DVec3, h: f64) -> Vec<[i64; 3]> {
    let edge = h * BLOCK as f64;
    let [nx, ny, nz] = ((high - low) / edge).floor().to_array().map(|n| n as i64);
    let radius = 0.5 * edge * 3f64.sqrt() + h;
    let mut blocks = Vec::new();
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let centre = low + edge * (DVec3::new(i as f64, j as f64, k as f64) + 0.5);
                if !field.is_clear(centre, radius) {
                    blocks.push([i, j, k]);
                }
            }
        }
    }
    blocks
}

/// Samples one block and cuts its tetrahedra: those of each cube with its neighbours towards +x,
/// +y and +z.
fn march_block(field: &Field, low: DVec3, h: f64, block: [i64; 3]) -> Patch {
    let base = block.map(|b| 2 * BLOCK * b);
    let sample = |kind: i64| {
        let mut samples = Vec::with_capacity(SIDE * SIDE * SIDE);
        for n in 0..SIDE * SIDE * SIDE {
            let local = [n % SIDE, n / SIDE % SIDE, n / SIDE / SIDE];
            let at = [0, 1, 2].map(|a| base[a] + 2 * local[a] as i64 + kind);
            let p = low + DVec3::from_array(at.map(|c| c as f64)) * (0.5 * h);
            samples.push(Sample { at, value: field.value(p) });
        }
        samples
    };
    let (corners, centres) = (sample(0), sample(1));
    let mut patch = Patch::default();
    let place = |c: [usize; 3]| (c[2] * SIDE + c[1]) * SIDE + c[0];
    for n in 0..(BLOCK * BLOCK * BLOCK) as usize {
        let side = BLOCK as usize;
        let cube = [n % side, n / side % side, n / side / side];
        for axis in 0..3 {
            let (v, w) = ((axis + 1) % 3, (axis + 2) % 3);
            let step = |mut c: [usize; 3], axis: usize| {
                c[axis] += 1;
                c
            };
            let side = step(cube, axis);
            // The side's corners, counter-clockwise about the axis.
            let ring = [side, step(side, v), step(step(side, v), w), step(side, w)]
                .map(|c| corners[place(c)]);
            let (a, b) = (centres[place(cube)], centres[place(side)]);
            for r in 0..4 {
                patch.cut([a, b, ring[r], ring[(r + 1) % 4]], low, h);
            }
        }
    }
    patch.vertices.sort_unstable_by_key(|v| v.0);
    patch.vertices.dedup_by_key(|v| v.0);
    patch
}

impl Patch {
    /// Cuts a positively oriented tetrahedron. The orders below are even permutations that bring
    /// the corners of the lesser kind to the front.
    fn cut(&mut self, t: [Sample; 4], low: DVec3, h: f64) {
        const ONE: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]];
        const TWO: [[usize; 4]; 6] =
            [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];
        let inside = t.map(|s| s.value < 0.0);
        let count = inside.iter().filter(|&&i| i).count();
        if count == 0 || count == 4 {
            return;
        }
        let mut edge = |i: usize, j: usize| self.vertex(t[i], t[j], low, h);
        if count == 2 {
            for [a, b, c, d] in TWO {
                if inside[a] && inside[b] {
                    let quad = [edge(a, c), edge(a, d), edge(b, d), edge(b, c)];
                    self.triangles.push([quad[0], quad[1], quad[2]]);
                    self.triangles.push([quad[0], quad[2], quad[3]]);
                    return;
                }
            }
        }
        for [a, b, c, d] in ONE {
            if inside[a] == (count == 1) {
                let [x, y, z] = [edge(a, b), edge(a, c), edge(a, d)];
                self.triangles.push(if count == 1 { [x, y, z] } else { [x, z, y] });
                return;
            }
        }
    }

    /// The vertex on the lattice edge between `a` and `b`, which differ in sign: its key.
    fn vertex(&mut self, a: Sample, b: Sample, low: DVec3, h: f64) -> u64 {
        let sum = [0, 1, 2].map(|i| (a.at[i] + b.at[i]) as u64);
        let key = (sum[0] << 42) | (sum[1] << 21) | sum[2];
        // Taken in one direction only, so that the position has the same bits in every tetrahedron.
        let (a, b) = if a.at < b.at { (a, b) } else { (b, a) };
        let t = (a.value / (a.value - b.value)).clamp(0.02, 0.98);
        let [p, q] = [a, b].map(|s| DVec3::from_array(s.at.map(|c| c as f64)));
        self.vertices.push((key, low + p.lerp(q, t) * (0.5 * h)));
        key
    }
}
