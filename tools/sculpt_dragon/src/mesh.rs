//! A triangle mesh in memory, and what is read off it.

use glam::DVec3;

/// Triangles over shared vertices, counter-clockwise seen from outside.
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Vertex numbers of the corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Twice the area of triangle `t`, along its normal.
    pub fn normal2(&self, t: [u32; 3]) -> DVec3 {
        let [a, b, c] = t.map(|v| self.positions[v as usize]);
        (b - a).cross(c - a)
    }

    /// Surface area.
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|&t| 0.5 * self.normal2(t).length()).sum()
    }

    /// Enclosed volume; positive if the triangles look outwards.
    pub fn volume(&self) -> f64 {
        let tetrahedron = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.positions[v as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangles.iter().map(tetrahedron).sum()
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.positions.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)))
    }

    /// Sum of the normals of the triangles about each vertex, weighted by area.
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for &t in &self.triangles {
            let n = self.normal2(t);
            for v in t {
                normals[v as usize] += n;
            }
        }
        normals
    }

    /// Keeps only the triangles of the connected component that has most of them.
    pub fn keep_largest_component(&mut self) {
        let mut parent: Vec<u32> = (0..self.positions.len() as u32).collect();
        for t in &self.triangles {
            let a = root(&mut parent, t[0]);
            for &v in &t[1..] {
                let b = root(&mut parent, v);
                parent[b as usize] = a;
            }
        }
        let mut count = vec![0u32; self.positions.len()];
        for t in &self.triangles {
            count[root(&mut parent, t[0]) as usize] += 1;
        }
        // The lowest vertex number wins among equals.
        let best = (0..count.len()).rev().max_by_key(|&v| count[v]).unwrap_or(0) as u32;
        self.triangles.retain(|t| root(&mut parent, t[0]) == best);
        self.drop_unused_vertices();
    }

    /// Number of connected components.
    pub fn components(&self) -> usize {
        let mut parent: Vec<u32> = (0..self.positions.len() as u32).collect();
        let mut components = parent.len();
        for t in &self.triangles {
            for &v in &t[1..] {
                let (a, b) = (root(&mut parent, t[0]), root(&mut parent, v));
                if a != b {
                    parent[b as usize] = a;
                    components -= 1;
                }
            }
        }
        components
    }

    /// Renumbers the vertices so that each is used, in order of first use.
    pub fn drop_unused_vertices(&mut self) {
        const UNUSED: u32 = u32::MAX;
        let mut number = vec![UNUSED; self.positions.len()];
        let mut kept = Vec::new();
        for v in self.triangles.iter_mut().flatten() {
            let n = &mut number[*v as usize];
            if *n == UNUSED {
                *n = kept.len() as u32;
                kept.push(self.positions[*v as usize]);
            }
            *v = *n;
        }
        self.positions = kept;
    }

    /// The half-edges that leave each vertex (half-edge `3 t + k` leaves corner k of triangle t):
    /// the start of each vertex's run, with one more at the end, and the runs.
    pub fn fans(&self) -> (Vec<u32>, Vec<u32>) {
        let mut start = vec![0u32; self.positions.len() + 1];
        for &v in self.triangles.iter().flatten() {
            start[v as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut fill = start.clone();
        let mut runs = vec![0u32; 3 * self.triangles.len()];
        for (e, &v) in self.triangles.iter().flatten().enumerate() {
            let slot = &mut fill[v as usize];
            runs[*slot as usize] = e as u32;
            *slot += 1;
        }
        (start, runs)
    }
}

/// Root of `v` in a union-find forest, halving the path.
fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        let up = parent[parent[v as usize] as usize];
        parent[v as usize] = up;
        v = up;
    }
    v
}

/// Shape of a triangle: 1 if equilateral, 0 if degenerate (area over the sum of squared sides,
/// scaled).
pub fn quality(p: DVec3, q: DVec3, r: DVec3) -> f64 {
    let area2 = (q - p).cross(r - p).length();
    let sides = p.distance_squared(q) + q.distance_squared(r) + r.distance_squared(p);
    if sides == 0.0 { 0.0 } else { 2.0 * 3f64.sqrt() * area2 / sides }
}
