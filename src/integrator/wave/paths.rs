//! [`Paths`]: the paths of a wave, and the buffers of the stages that process them.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::by_material::ByMaterial;
use super::pushed::Pushed;
use crate::accel::Hit;
use crate::geometry::{Ray, Xyz};
use crate::sampling::SampleId;
use crate::scene::Scene;
use crate::simd::Block;
use crate::spectrum::Bands;

/// The state of a path, beside its ray and its sample.
#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
pub struct Path {
    /// β: path throughput divided by path density.
    pub beta: [f32; 3],
    /// Density over solid angle of the ray's direction; infinite for camera rays and delta events.
    pub pdf: f32,
    /// The surface point that its ray leaves, before the origin was offset. Not used for camera rays.
    pub p: Vec3,
    /// Product of η² over all interfaces crossed. Refraction scales radiance by 1/η². Russian roulette undoes
    /// this, since the factor is undone when the path leaves the medium again.
    pub eta_scale: f32,
}

/// The states of paths in the lanes of vectors.
#[derive(Clone, Copy)]
pub struct PathsWide<F> {
    pub beta: Bands<F>,
    pub pdf: F,
    pub p: Xyz<F>,
    pub eta_scale: F,
}

impl<F: Block> PathsWide<F> {
    /// Gathers the states that `path` returns for each lane.
    #[inline(always)]
    pub fn gather<'a>(path: impl Fn(usize) -> &'a Path) -> Self {
        let [r, g, b, pdf, x, y, z, eta_scale] =
            F::gather(|lane| bytemuck::cast_ref::<Path, [f32; 8]>(path(lane)));
        Self { beta: Bands([r, g, b]), pdf, p: Xyz { x, y, z }, eta_scale }
    }

    /// Writes the states of all lanes.
    #[inline(always)]
    pub fn scatter(self, to: &mut [Path]) {
        let Self { beta: Bands([r, g, b]), pdf, p: Xyz { x, y, z }, eta_scale } = self;
        F::scatter([r, g, b, pdf, x, y, z, eta_scale], bytemuck::cast_slice_mut(to));
    }
}

/// Sample values of the active paths, one buffer per use. Buffers that a scene does not need stay empty.
#[derive(Default)]
pub struct Values {
    pub ids: Vec<SampleId>,
    pub direction: Vec<Vec2>,
    pub light: Vec<Vec2>,
    pub choice: Vec<f32>,
    pub roulette: Vec<f32>,
}

/// The paths at one depth. Element i of `states`, `samples` and `rays` belongs to the same path.
#[derive(Default)]
pub struct PathList {
    pub states: Pushed<Path>,
    /// Indices of samples in the wave.
    pub samples: Pushed<u32>,
    pub rays: Pushed<Ray>,
}

impl PathList {
    /// The paths, before their hits are found.
    pub fn view(&self) -> PathsAt<'_> {
        PathsAt {
            states: self.states.as_slice(),
            samples: self.samples.as_slice(),
            rays: self.rays.as_slice(),
            hits: &[],
            at_camera: false,
        }
    }

    const fn bytes(paths: usize) -> usize {
        Pushed::<Path>::bytes(paths) + Pushed::<u32>::bytes(paths) + Pushed::<Ray>::bytes(paths)
    }

    fn with_capacity(paths: usize) -> Self {
        Self {
            states: Pushed::with_capacity(paths),
            samples: Pushed::with_capacity(paths),
            rays: Pushed::with_capacity(paths),
        }
    }

    /// Removes all paths.
    pub fn clear(&mut self) {
        self.states.clear();
        self.samples.clear();
        self.rays.clear();
    }
}

/// What is known about the paths at one depth. Element i of each slice belongs to the same path.
#[derive(Clone, Copy)]
pub struct PathsAt<'a> {
    pub states: &'a [Path],
    pub samples: &'a [u32],
    pub rays: &'a [Ray],
    /// Closest hits of the rays; empty before they are found.
    pub hits: &'a [Hit],
    /// Whether the paths are camera rays.
    pub at_camera: bool,
}

/// The paths of a wave.
#[derive(Default)]
pub struct Paths {
    /// Paths that start at the camera, the same in all waves: at least as many as the wave has. Their rays and hits are
    /// those of the wave.
    pub first: PathList,
    /// The paths at the present depth, beyond 0.
    pub list: PathList,
    /// Closest hits of their rays.
    pub hits: Vec<Hit>,
    /// The paths at the next depth.
    pub next: PathList,
    pub by_hit: PathsByHit,
    pub by_material: ByMaterial,
    pub values: Values,
}

impl Paths {
    /// Bytes of all buffers for that many paths.
    pub const fn bytes(paths: usize, materials: usize) -> usize {
        ByMaterial::bytes(paths, materials)
            + 3 * PathList::bytes(paths)
            + paths
                * (size_of::<Hit>()
                    + 2 * size_of::<u32>()
                    + size_of::<SampleId>()
                    + 2 * size_of::<Vec2>()
                    + 2 * size_of::<f32>())
    }

    /// Buffers with capacity for `paths` paths, in a scene of so many materials.
    pub fn with_capacity(paths: usize, materials: usize) -> Self {
        Self {
            first: PathList::with_capacity(paths),
            list: PathList::with_capacity(paths),
            hits: Vec::with_capacity(paths),
            next: PathList::with_capacity(paths),
            by_hit: PathsByHit {
                active: Vec::with_capacity(paths),
                escaped: Vec::with_capacity(paths),
            },
            by_material: ByMaterial::new(paths, materials),
            values: Values {
                ids: Vec::with_capacity(paths),
                direction: Vec::with_capacity(paths),
                light: Vec::with_capacity(paths),
                choice: Vec::with_capacity(paths),
                roulette: Vec::with_capacity(paths),
            },
        }
    }

    /// Starts as many paths at the camera as there are rays.
    pub fn start(&mut self, rays: usize) {
        for sample in self.first.samples.as_slice().len()..rays {
            self.first.samples.push(sample as u32);
            self.first.states.push(Path {
                beta: [1.0; 3],
                pdf: f32::INFINITY,
                p: Vec3::ZERO,
                eta_scale: 1.0,
            });
        }
    }

    /// Moves to the next depth: intersects the next rays, and returns their number.
    pub fn trace(&mut self, scene: &Scene) -> u64 {
        std::mem::swap(&mut self.list, &mut self.next);
        self.next.clear();
        let rays = self.list.rays.as_slice();
        // The previous contents are overwritten.
        self.hits.resize(rays.len(), Hit::MISS);
        scene.intersect(rays, &mut self.hits);
        rays.len() as u64
    }
}

/// Indices of paths, partitioned by whether their rays hit anything.
#[derive(Default)]
pub struct PathsByHit {
    /// Paths whose rays hit a surface.
    pub active: Vec<u32>,
    /// Paths whose rays hit nothing.
    pub escaped: Vec<u32>,
}

impl PathsByHit {
    /// Partitions all paths by their hits.
    #[inline(never)]
    pub fn partition(&mut self, hits: &[Hit]) {
        let Self { active, escaped } = self;
        active.resize(hits.len(), 0);
        escaped.resize(hits.len(), 0);
        // Branch-free: each index is written to both lists, and only one list grows. A branch would be
        // mispredicted often.
        let mut found = 0;
        for (i, hit) in (0..).zip(hits) {
            active[found] = i;
            escaped[i as usize - found] = i;
            found += usize::from(hit.is_hit());
        }
        active.truncate(found);
        escaped.truncate(hits.len() - found);
    }
}
