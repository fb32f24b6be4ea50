//! A triangle, uniformly, as barycentric weights of its first two corners.
//!
//! Heitz 2019, "A Low-Distortion Map Between Triangle and Square": the square is folded along its
//! diagonal by a shear of each half, which needs no root and moves samples less than the usual √u.

use glam::Vec2;

/// The weights (b₀, b₁) of a point; the third is 1 - b₀ - b₁.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    if u.x < u.y {
        let b0 = u.x / 2.0;
        Vec2::new(b0, u.y - b0)
    } else {
        let b1 = u.y / 2.0;
        Vec2::new(u.x - b1, b1)
    }
}

/// Density over the area of a triangle of this area.
#[inline]
pub fn pdf(area: f32) -> f32 {
    1.0 / area
}

/// The u that [`sample`] takes to `b`.
#[inline]
pub fn inverse(b: Vec2) -> Vec2 {
    if b.x < b.y { Vec2::new(2.0 * b.x, b.x + b.y) } else { Vec2::new(b.x + b.y, 2.0 * b.y) }
}
