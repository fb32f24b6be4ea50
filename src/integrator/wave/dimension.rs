//! Assignment of sample dimensions.

/// Point in the pixel, 2D.
pub const FILM: u32 = 0;
/// Point on the lens, 2D.
pub const LENS: u32 = 1;
/// First dimension for integrators: those of the first hit, then those of the next.
pub const FIRST_LIGHT: u32 = 2;

/// Offset within a hit's dimensions: next direction, 2D.
pub(crate) const DIRECTION: u32 = 0;
/// Offset within a hit's dimensions: point on the light, 2D.
pub(crate) const LIGHT: u32 = 1;
/// Offset within a hit's dimensions: light selection, 1D.
pub(crate) const CHOICE: u32 = 2;
/// Offset within a hit's dimensions: Russian roulette, 1D.
pub(crate) const ROULETTE: u32 = 3;
/// Points on the second and all further lights, 2D, where a hit samples every light. Only direct light does so:
/// there is no second hit whose dimensions these could be.
pub(crate) const MORE_LIGHTS: u32 = of_depth(1);

/// Selection among lobes and their events (`uc`) at a hit of this depth, 1D. Its range is separate, so that the
/// other dimensions do not depend on whether a surface makes this selection.
pub(crate) const fn event(depth: u32) -> u32 {
    1 << 31 | depth
}

/// The first dimension of a hit at this depth.
pub(crate) const fn of_depth(depth: u32) -> u32 {
    FIRST_LIGHT.wrapping_add(depth.wrapping_mul(4))
}

/// Selection among events for the albedo of a first hit, 1D.
pub(crate) const ALBEDO_EVENT: u32 = 1 << 30;
/// Direction for the albedo of a first hit, 2D.
pub(crate) const ALBEDO: u32 = 1 << 30 | 1;
