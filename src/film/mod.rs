//! The film: samples of radiance are added to it and developed into a [`Picture`](crate::image::Picture).
//!
//! A [`Filter`] says how the radiance around a pixel's centre is weighted, and [`FilterSampler`] draws positions in
//! proportion to it, so that a [`Film`] only sums samples. [`FilmContents`] says what it keeps besides: how the
//! [`Variance`] of each pixel is estimated, and the first hits.

#[expect(clippy::module_inception, reason = "it is the file of `Film`")]
mod film;
mod filter;
mod first_hits;
mod largest;
mod pixel_sum;
mod planes;
mod pooled;
mod stored;
mod variance;

pub use film::{Film, FilmContents, FilmError};
pub use filter::{
    BlackmanHarrisFilter, BoxFilter, FILTERS, Filter, FilterError, FilterSampler, GaussianFilter,
    MAX_FILTER_RADIUS, ReadFilter, TentFilter,
};
pub use largest::Fireflies;
pub use variance::Variance;
