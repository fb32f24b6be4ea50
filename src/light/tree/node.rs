//! [`Node`]: up to eight children, side by side.

use glam::Vec3;

use crate::light::bounds::LightBounds;

/// Children of a node.
pub(super) const WIDTH: usize = 8;

type Lanes = [f32; WIDTH];

/// Bounds of up to eight children. Lanes beyond the last are of zero intensity.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Node {
    /// Centre and squared radius of a sphere around each.
    center: [Lanes; 3],
    radius2: Lanes,
    axis: [Lanes; 3],
    /// Cosine and sine of the angle of normals.
    cos_normals: Lanes,
    sin_normals: Lanes,
    /// Cosine of the angle of emission.
    cos_emission: Lanes,
    /// 1 where the child shines against its axis too, else 0.
    two_sided: Lanes,
    /// Relative intensity along the normals.
    intensity: Lanes,
    children: [u32; WIDTH],
    len: u32,
}

/// What hangs on a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Child {
    Node(u32),
    Light(u32),
}

/// More than the rounding of cosines.
const MARGIN: f32 = 1e-6;

/// Set in the index of a light.
const LIGHT: u32 = 1 << 31;

impl Node {
    pub fn empty() -> Self {
        let zero = [0.0; WIDTH];
        Self {
            center: [zero; 3],
            radius2: zero,
            axis: [zero; 3],
            cos_normals: zero,
            sin_normals: zero,
            cos_emission: zero,
            two_sided: zero,
            intensity: zero,
            children: [0; WIDTH],
            len: 0,
        }
    }

    /// Adds a child, and returns its lane.
    pub fn push(&mut self, child: Child, bounds: &LightBounds, intensity: f64) -> u32 {
        let lane = self.len as usize;
        let (center, radius2) = bounds.sphere();
        for axis in 0..3 {
            self.center[axis][lane] = center[axis] as f32;
            self.axis[axis][lane] = bounds.cone.axis[axis] as f32;
        }
        self.radius2[lane] = radius2 as f32;
        let (sin, cos) = bounds.cone.normals.sin_cos();
        (self.cos_normals[lane], self.sin_normals[lane]) = (cos as f32, sin as f32);
        // A spot without a soft border has the cosine 1, which none of f32 is sure to exceed.
        self.cos_emission[lane] = bounds.cone.emission.cos() as f32 - MARGIN;
        self.two_sided[lane] = f32::from(bounds.two_sided);
        self.intensity[lane] = intensity as f32;
        self.children[lane] = match child {
            Child::Node(index) => index,
            Child::Light(index) => index | LIGHT,
        };
        self.len += 1;
        lane as u32
    }

    /// Number of children.
    pub fn len(&self) -> u32 {
        self.len
    }

    pub fn child(&self, lane: usize) -> Child {
        match self.children[lane] {
            index if index & LIGHT != 0 => Child::Light(index & !LIGHT),
            index => Child::Node(index),
        }
    }

    /// A bound on what each child sends to `p`, up to a factor. The same for all children if none seems to send anything.
    #[inline]
    pub fn weights(&self, p: Vec3) -> Lanes {
        let mut weights = self.importance(p);
        if weights.iter().all(|weight| *weight == 0.0) {
            weights[..self.len as usize].fill(1.0);
        }
        weights
    }

    /// PBRT 4th edition, `LightBounds::Importance`, where a point inside the sphere around a child sees it from the distance of
    /// the radius. (PBRT takes half the diagonal for a squared distance, so that its choice depends on the unit of length.)
    #[inline(always)]
    fn importance(&self, p: Vec3) -> Lanes {
        let mut weights = [0.0; WIDTH];
        for (i, to) in weights.iter_mut().enumerate() {
            let [x, y, z] =
                [p.x - self.center[0][i], p.y - self.center[1][i], p.z - self.center[2][i]];
            let distance2 = x * x + y * y + z * z;
            let axis = self.axis[0][i] * x + self.axis[1][i] * y + self.axis[2][i] * z;
            let cos_w = (axis / distance2.sqrt()).clamp(-1.0, 1.0);
            let cos_w = if self.two_sided[i] > 0.0 { cos_w.abs() } else { cos_w };
            let sin_w = (1.0 - cos_w * cos_w).max(0.0).sqrt();
            // The angle to the axis, less the normals' angle, less that of the sphere's radius: each at least 0.
            let (cos_o, sin_o) = (self.cos_normals[i], self.sin_normals[i]);
            let (cos_x, sin_x) = less([cos_w, sin_w], [cos_o, sin_o]);
            let sin2_b = (self.radius2[i] / distance2).min(1.0);
            let (cos_b, sin_b) = ((1.0 - sin2_b).sqrt(), sin2_b.sqrt());
            let (cos, _) = less([cos_x, sin_x], [cos_b, sin_b]);
            // Inside the sphere all directions are possible.
            let cos = if distance2 > self.radius2[i] { cos } else { 1.0 };
            let cos = if cos > self.cos_emission[i] { cos } else { 0.0 };
            let weight = self.intensity[i] * cos / distance2.max(self.radius2[i]);
            // A point source at p itself is infinitely bright, or not a number if it is dark.
            *to = if weight > 0.0 { weight.min(f32::MAX / 64.0) } else { 0.0 };
        }
        weights
    }
}

/// Cosine and sine of the difference of two angles, at least 0.
#[inline(always)]
fn less([cos_a, sin_a]: [f32; 2], [cos_b, sin_b]: [f32; 2]) -> (f32, f32) {
    let is_less = cos_a > cos_b;
    let (cos, sin) = (cos_a * cos_b + sin_a * sin_b, sin_a * cos_b - cos_a * sin_b);
    (if is_less { 1.0 } else { cos }, if is_less { 0.0 } else { sin })
}
