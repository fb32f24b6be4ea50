//! Which dimension of a sample is used for what.

/// The point in the pixel, 2D.
pub const FILM: u32 = 0;
/// The point on the lens, 2D.
pub const LENS: u32 = 1;
/// The first dimension for integrators: those of the first hit, then those of the next.
pub const FIRST_LIGHT: u32 = 2;

/// Of a hit: the next direction, 2D.
pub(crate) const DIRECTION: u32 = 0;
/// Of a hit: the point on the light, 2D.
pub(crate) const LIGHT: u32 = 1;
/// Of a hit: which light, 1D.
pub(crate) const CHOICE: u32 = 2;
/// Of a hit: Russian roulette, 1D.
pub(crate) const ROULETTE: u32 = 3;
/// The points on the second and all further lights, 2D, where a hit samples each light: direct light, which
/// has one reflection.
pub(crate) const MORE_LIGHTS: u32 = of_depth(1);

/// Of a hit at this depth: the choice among lobes and their events (`uc`), 1D. In a range of its own, so that
/// surfaces without such a choice leave the other dimensions as they are.
pub(crate) const fn event(depth: u32) -> u32 {
    1 << 31 | depth
}

/// The first dimension of a hit at this depth.
pub(crate) const fn of_depth(depth: u32) -> u32 {
    FIRST_LIGHT.wrapping_add(depth.wrapping_mul(4))
}
