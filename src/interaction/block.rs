//! [`HitBlock`]: what is known about a block of hits.

use glam::{Vec2, Vec3};

use super::surfaces::{LastVertex, Surfaces};
use super::{Hit, Source, SurfaceInteraction, SurfacePlace, oriented, uv_at};
use crate::geometry::{Bounded, BoundedPoint, PixelCone, Ray, Xyz};
use crate::shape::{TriangleMesh, triangle_normal_wide};
use crate::simd::{
    Block, BlockKernel, InstructionSet, LaneMask, MAX_LANES, ROW, RowMask, Rows, groups, indices,
    lanes_within,
};

/// Most hits of a block.
pub const BLOCK: usize = ROW;

/// A block of hits, each of which is what [`SurfaceInteraction`] is. Kinds of materials and textures that answer for a block
/// get one.
pub struct HitBlock<'a> {
    surfaces: &'a Surfaces,
    cone: Option<&'a PixelCone>,
    pub(crate) instruction_set: InstructionSet,
    len: usize,
    /// Indices of shape and triangle.
    places: [[u32; 2]; ROW],
    b: Rows<3>,
    wo: Rows<3>,
    p: Rows<3>,
    p_error: Rows<3>,
    n: Rows<3>,
    pub(crate) shading_n: Rows<3>,
}

/// The geometry of hits in the lanes of vectors.
pub(crate) struct Hits<F> {
    pub wo: Xyz<F>,
    pub n: Xyz<F>,
    pub shading_n: Xyz<F>,
}

impl<'a> HitBlock<'a> {
    /// An empty block of hits on these surfaces, seen by a camera, to be processed with these instructions.
    pub(crate) fn new(
        surfaces: &'a Surfaces,
        cone: Option<&'a PixelCone>,
        instruction_set: InstructionSet,
    ) -> Self {
        let zero = Rows::splat(0.0);
        Self {
            surfaces,
            cone,
            instruction_set,
            len: 0,
            places: [[0; 2]; ROW],
            b: zero,
            wo: zero,
            p: zero,
            p_error: zero,
            n: zero,
            shading_n: zero,
        }
    }

    /// Replaces the hits by those of some rays, given by their indices.
    ///
    /// # Panics
    /// If there are none or more than [`BLOCK`], or a hit is not on the meshes.
    #[inline]
    pub(crate) fn fill(&mut self, which: &[u32], rays: &[Ray], found: &[Hit]) {
        self.len = which.len();
        for (place, &i) in self.places[..self.len].iter_mut().zip(which) {
            let Hit { shape, triangle, .. } = found[i as usize];
            *place = [shape, triangle];
        }
        let mut one_by_one =
            self.instruction_set.run_block(Locate { block: self, which, rays, found });
        if self.surfaces.has_instances() {
            for (i, [shape, _]) in self.places[..self.len].iter().enumerate() {
                one_by_one |= RowMask::from(self.surfaces.is_instance(*shape)) << i;
            }
        }
        for i in indices(one_by_one) {
            self.locate_one(i);
        }
    }

    /// Number of hits.
    #[inline]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no hits.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The hit with this index.
    ///
    /// # Panics
    /// If there is no such hit.
    #[inline]
    pub fn get(&self, i: usize) -> SurfaceInteraction<'a> {
        assert!(i < self.len, "hit {i} of {}", self.len);
        let place = self.place(i);
        SurfaceInteraction {
            p: BoundedPoint { p: self.p.get(i).into(), error: self.p_error.get(i).into() },
            wo: self.wo.get(i).into(),
            n: self.n.get(i).into(),
            shading_n: self.shading_n.get(i).into(),
            source: Source::Triangle { mesh: self.surfaces.placed(place.shape), place },
            cone: self.cone,
            displaced: None,
        }
    }

    /// Texture coordinates of the hit with this index.
    ///
    /// # Panics
    /// If there is no such hit.
    #[inline]
    pub fn uv(&self, i: usize) -> Vec2 {
        assert!(i < self.len, "hit {i} of {}", self.len);
        let SurfacePlace { shape, triangle, b } = self.place(i);
        uv_at(self.surfaces.placed(shape), triangle, b)
    }

    #[inline]
    fn place(&self, i: usize) -> SurfacePlace {
        let [shape, triangle] = self.places[i];
        SurfacePlace { shape, triangle, b: self.b.get(i) }
    }

    /// The unit direction from which a hit is seen.
    #[inline]
    pub(crate) fn wo(&self, i: usize) -> Vec3 {
        self.wo.get(i).into()
    }

    /// The geometric normal at a hit.
    #[inline]
    pub(crate) fn ng(&self, i: usize) -> Vec3 {
        self.n.get(i).into()
    }

    /// The points.
    #[inline(always)]
    pub(crate) fn p(&self) -> &Rows<3> {
        &self.p
    }

    /// The points in the lanes from `at` on.
    #[inline(always)]
    pub(crate) fn points<F: Block>(&self, at: usize) -> Bounded<F> {
        Bounded { p: self.p.load(at).into(), error: self.p_error.load(at).into() }
    }

    /// The geometry in the lanes from `at` on.
    #[inline(always)]
    pub(crate) fn load<F: Block>(&self, at: usize) -> Hits<F> {
        Hits {
            wo: self.wo.load(at).into(),
            n: self.n.load(at).into(),
            shading_n: self.shading_n.load(at).into(),
        }
    }

    /// Computes the geometry of one hit: where f32 is not precise enough for normals, and on instances.
    fn locate_one(&mut self, i: usize) {
        let place = self.place(i);
        let mesh = self.surfaces.placed(place.shape);
        let si = SurfaceInteraction::on_shape(mesh, place, self.wo(i));
        self.p.set(i, si.p.p.to_array());
        self.p_error.set(i, si.p.error.to_array());
        self.n.set(i, si.n.to_array());
        self.shading_n.set(i, si.shading_n.to_array());
    }
}

/// Computes the geometry of all hits, and tells for which the normals are not precise enough.
struct Locate<'a, 'b> {
    block: &'a mut HitBlock<'b>,
    which: &'a [u32],
    rays: &'a [Ray],
    found: &'a [Hit],
}

impl BlockKernel for Locate<'_, '_> {
    type Output = RowMask;

    #[inline(always)]
    fn run<F: Block>(self) -> RowMask {
        let Self { block, which, rays, found } = self;
        let HitBlock { surfaces, len, places, b, wo, p, p_error, n, shading_n, .. } = block;
        let last = *len - 1;
        let mut of_shape = (places[0][0], Vertices::of(surfaces, places[0][0]));
        let mut imprecise = 0;
        for at in groups::<F>(*len) {
            // Vertices of each corner, and their normals.
            let mut corners = [[&NOTHING; MAX_LANES]; 3];
            let mut normals = [[&NOTHING; MAX_LANES]; 3];
            let mut has_normals = false;
            for lane in 0..F::LANES {
                let [shape, triangle] = places[(at + lane).min(last)];
                // Most neighbours are on the same shape, whose slices stay in registers.
                if shape != of_shape.0 {
                    of_shape = (shape, Vertices::of(surfaces, shape));
                }
                let Vertices { positions, normals: of_vertices, indices, last } = of_shape.1;
                let indices = indices[triangle as usize];
                for (of_corner, index) in corners.iter_mut().zip(indices) {
                    of_corner[lane] = four_numbers(positions, index, &last.position);
                }
                if !of_vertices.is_empty() {
                    has_normals = true;
                    for (of_corner, index) in normals.iter_mut().zip(indices) {
                        of_corner[lane] = four_numbers(of_vertices, index, &last.normal);
                    }
                }
            }
            let corners = gather(&corners);
            let [_, b0, b1, b2] =
                F::gather4(|lane| found[which[(at + lane).min(last)] as usize].t_and_b());
            let [.., dx, dy, dz, _] = F::gather(|lane| {
                bytemuck::cast_ref::<Ray, [f32; 8]>(&rays[which[(at + lane).min(last)] as usize])
            });
            let weights = [b0, b1, b2];
            let bounded = Bounded::on_triangle(corners, weights);
            let (ng, is_precise) = triangle_normal_wide(corners);
            let [ng, ns] =
                if has_normals { oriented(ng, gather(&normals), weights) } else { [ng, ng] };
            b.store(at, weights);
            wo.store(at, [-dx, -dy, -dz]);
            p.store(at, bounded.p.into());
            p_error.store(at, bounded.error.into());
            n.store(at, ng.into());
            shading_n.store(at, ns.into());
            let imprecise_lanes = (!is_precise).bits() & lanes_within::<F>(at, *len);
            imprecise |= RowMask::from(imprecise_lanes) << at;
        }
        imprecise
    }
}

/// Vectors of three corners.
#[inline(always)]
fn gather<F: Block>([a, b, c]: &[[&[f32; 4]; MAX_LANES]; 3]) -> [Xyz<F>; 3] {
    [gather_vector(a), gather_vector(b), gather_vector(c)]
}

#[inline(always)]
fn gather_vector<F: Block>(vectors: &[&[f32; 4]; MAX_LANES]) -> Xyz<F> {
    let [x, y, z, _] = F::gather4(|lane| vectors[lane]);
    Xyz { x, y, z }
}

/// What lanes without a vertex read.
const NOTHING: [f32; 4] = [0.0; 4];

/// The vertices of a mesh, as numbers.
#[derive(Clone, Copy)]
struct Vertices<'a> {
    positions: &'a [f32],
    normals: &'a [f32],
    indices: &'a [[u32; 3]],
    last: &'a LastVertex,
}

impl<'a> Vertices<'a> {
    #[inline(always)]
    fn of(surfaces: &'a Surfaces, shape: u32) -> Self {
        let (mesh, last) = surfaces.mesh(shape);
        let TriangleMesh { positions, normals, indices, .. } = mesh;
        Self {
            positions: bytemuck::cast_slice(positions),
            normals: bytemuck::cast_slice(normals),
            indices,
            last,
        }
    }
}

/// The coordinates of a vector and the number after them in memory, which are read at once. After the last vector there is
/// none: `last` is that vector with another number.
#[inline(always)]
fn four_numbers<'a>(vectors: &'a [f32], index: u32, last: &'a [f32; 4]) -> &'a [f32; 4] {
    let first = 3 * index as usize;
    let four = vectors.get(first..first + 4).and_then(|four| four.first_chunk());
    four.unwrap_or(last)
}
