//! [`LightBounds`]: where a light is and which way it shines.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, Vec3};

/// Where a light is and which way it shines, as far as the choice among many lights needs it: a box, and a cone of directions
/// with a margin (PBRT 4th edition, section 12.6.3; Conty and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
/// Splitting").
///
/// Full intensity is assumed along the *normals*, directions within an angle of the axis. Beyond, it falls with the cosine of
/// the excess, up to the angle of *emission*. A wrong bound costs noise and loses no light.
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::light::LightBounds;
///
/// // A square meter of a ceiling 3 m above the floor, which shines down.
/// let (min, max) = (Vec3::new(0.0, 3.0, 0.0), Vec3::new(1.0, 3.0, 1.0));
/// let lamp = LightBounds::new(min, max).with_normals(Vec3::NEG_Y, 0.0);
/// // Lambert's law: an intensity with the integral π.
/// assert!((lamp.solid_angle() - std::f64::consts::PI).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    pub(super) min: Vec3,
    pub(super) max: Vec3,
    pub(super) cone: Cone,
    /// Whether it shines against the directions of the cone too.
    pub(super) two_sided: bool,
}

/// Directions around an axis. Angles are in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    pub axis: DVec3,
    /// Largest angle between axis and normals.
    pub normals: f64,
    /// Largest angle between a normal and emission.
    pub emission: f64,
}

impl LightBounds {
    /// A light in a box that may shine in all directions.
    pub fn new(min: Vec3, max: Vec3) -> Self {
        let cone = Cone { axis: DVec3::Z, normals: PI, emission: FRAC_PI_2 };
        Self { min, max, cone, two_sided: false }
    }

    /// A surface whose outward normals are within `angle` of `axis`, in radians, and which emits within a right angle of its
    /// normals. All directions if the axis is zero or not finite.
    pub fn with_normals(self, axis: Vec3, angle: f64) -> Self {
        self.with_emission(axis, angle, FRAC_PI_2)
    }

    /// Full intensity within `normals` of `axis`, in radians, and none beyond `normals + emission`, where `emission` is at most
    /// a right angle. All directions if the axis is zero or not finite.
    pub fn with_emission(mut self, axis: Vec3, normals: f64, emission: f64) -> Self {
        let axis = axis.as_dvec3().normalize_or_zero();
        let (normals, emission) = (normals.clamp(0.0, PI), emission.clamp(0.0, FRAC_PI_2));
        if axis != DVec3::ZERO && !normals.is_nan() && !emission.is_nan() {
            self.cone = Cone { axis, normals, emission };
        }
        self
    }

    /// The same on both sides.
    pub fn with_two_sides(self) -> Self {
        Self { two_sided: true, ..self }
    }

    /// Integral of the falloff over all directions: power divided by the intensity along the normals.
    pub fn solid_angle(&self) -> f64 {
        let Cone { normals: o, emission, .. } = self.cone;
        let end = (o + emission).min(PI);
        // 2π (1 - cos o) + 2π ∫ cos(θ - o) sin θ dθ from o to the end.
        let within = 2.0 * TAU * (o / 2.0).sin().powi(2);
        let beyond = FRAC_PI_2 * (2.0 * (end - o) * o.sin() - (2.0 * end - o).cos() + o.cos());
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * (within + beyond)
    }

    /// Bounds of both.
    pub(super) fn union(&self, other: &Self) -> Self {
        let two_sided = self.two_sided || other.two_sided;
        let mut cone = other.cone;
        // Both shine to two sides, so that the other side is as good.
        if two_sided && self.cone.axis.dot(cone.axis) < 0.0 {
            cone.axis = -cone.axis;
        }
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            cone: self.cone.union(&cone),
            two_sided,
        }
    }

    /// Centre and squared radius of the sphere around the box.
    pub(super) fn sphere(&self) -> (DVec3, f64) {
        let (min, max) = (self.min.as_dvec3(), self.max.as_dvec3());
        ((min + max) / 2.0, (max - min).length_squared() / 4.0)
    }

    /// Whether the box is finite and not empty.
    pub(super) fn is_valid(&self) -> bool {
        self.min.is_finite() && self.max.is_finite() && self.min.cmple(self.max).all()
    }
}

impl Cone {
    /// The smallest cone around both.
    fn union(&self, other: &Self) -> Self {
        let emission = self.emission.max(other.emission);
        let (a, b) = if self.normals >= other.normals { (self, other) } else { (other, self) };
        let across = a.axis.cross(b.axis);
        let between = across.length().atan2(a.axis.dot(b.axis));
        if between + b.normals <= a.normals {
            return Self { emission, ..*a };
        }
        let normals = (a.normals + between + b.normals) / 2.0;
        let turn = across.normalize_or_zero();
        if normals >= PI || turn == DVec3::ZERO {
            return Self { axis: a.axis, normals: PI, emission };
        }
        // The axis of `a`, turned towards that of `b` until the cone touches the far side of `a`.
        let (sin, cos) = (normals - a.normals).sin_cos();
        let axis = a.axis * cos + turn.cross(a.axis) * sin;
        Self { axis: axis.normalize(), normals, emission }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two sheets back to back, of which one shines to both sides, whichever is first. Caught: axes turned only if the second is the one.
    #[test]
    fn two_sides_of_either_light_turn_the_axis() {
        let sheet = |axis| LightBounds::new(Vec3::ZERO, Vec3::ONE).with_normals(axis, 0.1);
        let (one, two) = (sheet(Vec3::NEG_Y), sheet(Vec3::Y).with_two_sides());
        for union in
            [one.union(&two), two.union(&one), two.union(&sheet(Vec3::NEG_Y).with_two_sides())]
        {
            assert!(union.two_sided && union.cone.normals < 0.11, "{union:?}");
        }
        let apart = one.union(&sheet(Vec3::Y));
        assert!(!apart.two_sided && apart.cone.normals > 3.0, "{apart:?}");
    }
}
