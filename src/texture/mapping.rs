//! [`Mapping`]: where on a flat texture a point of a surface lies.

use std::f32::consts::{FRAC_1_PI, TAU};

use arrayvec::ArrayVec;
use glam::{Affine2, Quat, Vec2, Vec3};

use crate::interaction::SurfaceInteraction;
use crate::params::{AnyKey, Choice, Fault, Key, Rotation, Table};

/// How the coordinates (s, t) of a flat texture follow from a point of a surface.
///
/// A projection gives coordinates, which are scaled, then rotated, then moved.
///
/// ```
/// use lobe::glam::{Quat, Vec2, Vec3};
/// use lobe::texture::{Mapping, Projection};
/// // Twice along u, once along v.
/// let twice = Mapping::default().scaled(Vec2::new(2.0, 1.0));
/// // From above, onto the plane of x and z.
/// let upright = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
/// let map = Mapping::new(Projection::Planar).placed(Vec3::ZERO, upright);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mapping {
    projection: Projection,
    /// Origin and axes of the projection, which is made in coordinates relative to them.
    center: Vec3,
    axes: Quat,
    /// From the coordinates of the projection.
    plane: Affine2,
}

/// A projection to coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// The texture coordinates of the surface.
    Uv,
    /// x and y.
    Planar,
    /// Longitude around z, once from 0 to 1 beginning at x, towards y, and z.
    Cylindrical,
    /// Longitude as of a cylinder, and latitude from the pole at -z, each from 0 to 1.
    Spherical,
    /// The planar projections along x, y and z, mixed by the fourth powers of the normal's coordinates.
    Triplanar,
}

impl Choice for Projection {
    const CHOICES: &'static [(&'static str, Self)] = &[
        ("uv", Self::Uv),
        ("planar", Self::Planar),
        ("cylindrical", Self::Cylindrical),
        ("spherical", Self::Spherical),
        ("triplanar", Self::Triplanar),
    ];
}

impl Default for Mapping {
    /// By the surface's texture coordinates, as they are.
    fn default() -> Self {
        Self::new(Projection::Uv)
    }
}

impl Mapping {
    /// By a projection in world space.
    pub const fn new(projection: Projection) -> Self {
        let (center, axes, plane) = (Vec3::ZERO, Quat::IDENTITY, Affine2::IDENTITY);
        Self { projection, center, axes, plane }
    }

    /// Moves the projection's origin to a point in world space and turns its axes. Texture coordinates of surfaces have none.
    pub const fn placed(self, center: Vec3, axes: Quat) -> Self {
        Self { center, axes, ..self }
    }

    /// Multiplies the coordinates: the texture repeats as many times in what was one unit.
    pub fn scaled(self, factors: Vec2) -> Self {
        Self { plane: Affine2::from_scale(factors) * self.plane, ..self }
    }

    /// Rotates the coordinates around (0, 0), from s to t, by an angle in radians.
    pub fn rotated(self, angle: f32) -> Self {
        Self { plane: Affine2::from_angle(angle) * self.plane, ..self }
    }

    /// Adds to the coordinates.
    pub fn moved(self, by: Vec2) -> Self {
        Self { plane: Affine2::from_translation(by) * self.plane, ..self }
    }

    /// From texture coordinates of the surface, if these are what it projects.
    #[inline]
    pub(super) fn of_uv(&self) -> Option<Affine2> {
        (self.projection == Projection::Uv).then_some(self.plane)
    }

    /// A step of the texture's coordinates for each of two steps along the surface, for each of the [`points`](Self::points).
    pub(super) fn steps(
        &self,
        si: &SurfaceInteraction,
        steps: [Vec3; 2],
    ) -> ArrayVec<[Vec2; 2], 3> {
        let linear = self.plane.matrix2;
        if let Projection::Uv = self.projection {
            return [steps.map(|step| linear * si.uv_step(step))].into_iter().collect();
        }
        let turn = self.axes.inverse();
        let d = steps.map(|step| turn * step);
        if let Projection::Triplanar = self.projection {
            let planes = [
                d.map(|d| Vec2::new(d.y, d.z)),
                d.map(|d| Vec2::new(d.x, d.z)),
                d.map(Vec3::truncate),
            ];
            return planes.into_iter().map(|d| d.map(|d| linear * d)).collect();
        }
        let q = turn * (si.p() - self.center);
        let at = self.projected(q);
        let difference = |d: Vec3| {
            let mut step = self.projected(q + d) - at;
            if self.projection != Projection::Planar {
                // Around the seam of the longitudes.
                step.x -= step.x.round();
            }
            linear * step
        };
        [d.map(difference)].into_iter().collect()
    }

    /// Points of the texture and their weights, which add up to 1.
    #[inline]
    pub(super) fn points(&self, si: &SurfaceInteraction) -> ArrayVec<(Vec2, f32), 3> {
        let mut points = ArrayVec::new();
        if let Projection::Uv = self.projection {
            points.push((self.plane.transform_point2(si.uv()), 1.0));
            return points;
        }
        let turn = self.axes.inverse();
        let q = turn * (si.p() - self.center);
        if let Projection::Triplanar = self.projection {
            let n = turn * si.n();
            let n = (n * n) * (n * n);
            let sum = n.element_sum();
            let planes = [([q.y, q.z], n.x), ([q.x, q.z], n.y), ([q.x, q.y], n.z)];
            points.extend(
                planes.map(|(st, weight)| {
                    (self.plane.transform_point2(Vec2::from(st)), weight / sum)
                }),
            );
            return points;
        }
        points.push((self.plane.transform_point2(self.projected(q)), 1.0));
        points
    }

    fn projected(&self, q: Vec3) -> Vec2 {
        let longitude = || {
            let turns = q.y.atan2(q.x) / TAU;
            if turns < 0.0 { turns + 1.0 } else { turns }
        };
        match self.projection {
            Projection::Cylindrical => Vec2::new(longitude(), q.z),
            Projection::Spherical => {
                let latitude = q.z.atan2(q.truncate().length());
                Vec2::new(longitude(), latitude * FRAC_1_PI + 0.5)
            }
            _ => q.truncate(),
        }
    }
}

const PROJECTION: Key<Projection> =
    Key::new("projection", "how points of the surface get texture coordinates")
        .default(Projection::Uv);
const CENTER: Key<Vec3> =
    Key::new("center", "origin of a projection other than uv").default(Vec3::ZERO);
const TURN: Key<Option<Rotation>> =
    Key::optional("turn", "of the axes of a projection other than uv");
const SCALE: Key<[f32; 2]> = Key::new("scale", "factors of the coordinates").default([1.0; 2]);
const ROTATE: Key<f32> =
    Key::new("rotate", "of the scaled coordinates, from s to t").in_unit("degrees").default(0.0);
const OFFSET: Key<[f32; 2]> =
    Key::new("offset", "added to the scaled, rotated coordinates").default([0.0; 2]);

/// The keys of a mapping.
const KEYS: [&dyn AnyKey; 6] = [&PROJECTION, &CENTER, &TURN, &SCALE, &ROTATE, &OFFSET];

/// The keys of a kind and those of a mapping: `OWN` and six more.
pub(super) const fn with_keys<const OWN: usize, const ALL: usize>(
    own: [&'static dyn AnyKey; OWN],
) -> [&'static dyn AnyKey; ALL] {
    assert!(ALL == OWN + KEYS.len());
    let (mut keys, mut i): ([&dyn AnyKey; ALL], usize) = ([KEYS[0]; ALL], 0);
    while i < ALL {
        keys[i] = if i < OWN { own[i] } else { KEYS[i - OWN] };
        i += 1;
    }
    keys
}

pub(super) fn read(table: &Table) -> Result<Mapping, Fault> {
    let turn = table.get(&TURN)?.map_or(Quat::IDENTITY, Quat::from);
    Ok(Mapping::new(table.get(&PROJECTION)?)
        .placed(table.get(&CENTER)?, turn)
        .scaled(table.get(&SCALE)?.into())
        .rotated(table.get(&ROTATE)?.to_radians())
        .moved(table.get(&OFFSET)?.into()))
}
