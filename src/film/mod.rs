//! The film: samples of radiance are added to it and developed into a [`Picture`](crate::image::Picture).
//!
//! A [`Filter`] says how the radiance around a pixel's centre is weighted, and [`FilterSampler`] draws positions in
//! proportion to it, so that a [`Film`] only sums samples. [`FilmContents`] says what it keeps besides: how the
//! [`Variance`] of each pixel is estimated, and the first hits.

mod film_sums;
mod filter;
mod filter_kinds;
mod filter_sampler;
mod first_hits;
mod pixel_sum;
mod variance;

pub use film_sums::{Film, FilmContents, FilmError};
pub use filter::{Filter, FilterError};
pub use filter_kinds::{FILTERS, ReadFilter};
pub use filter_sampler::FilterSampler;
pub use variance::Variance;
