//! A triangle, uniform over area, as barycentric coordinates.
//!
//! Heitz 2019, "A Low-Distortion Map Between Triangle and Square": each half of the square is
//! sheared onto one half of the triangle. That needs no square root and distorts less than the
//! usual map by √u.

use glam::Vec2;

/// Barycentric coordinates (b₀, b₁) of a point; b₂ = 1 - b₀ - b₁.
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

/// Density over area, for a triangle of this area: 1 / `area`.
#[inline]
pub fn pdf(area: f32) -> f32 {
    1.0 / area
}

/// The inverse of [`sample`]: the u whose image is the point with barycentric coordinates `b`.
#[inline]
pub fn inverse(b: Vec2) -> Vec2 {
    if b.x < b.y { Vec2::new(2.0 * b.x, b.x + b.y) } else { Vec2::new(b.x + b.y, 2.0 * b.y) }
}
