//! [`Filter`]: how much the light around a pixel counts for it.

/// A reconstruction filter about the middle of a pixel (PBRT 3rd edition, section 7.8). None is negative.
///
/// Samples are drawn in proportion to it, and all count the same (Ernst, Stamminger and Greiner 2006,
/// "Filter Importance Sampling"): so each belongs to one pixel, and tiles know nothing of each other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Filter {
    /// The pixel itself, and nothing around it.
    #[default]
    Box,
}
