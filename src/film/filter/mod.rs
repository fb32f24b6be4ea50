//! Reconstruction filters: the trait [`Filter`], one kind per file, and [`FilterSampler`], which draws positions in
//! proportion to one.

mod blackman_harris;
mod box_filter;
mod gaussian;
mod parameters;
mod sampler;
mod tent;
mod traits;

pub use blackman_harris::BlackmanHarrisFilter;
pub use box_filter::BoxFilter;
pub use gaussian::GaussianFilter;
pub use parameters::{FilterError, MAX_FILTER_RADIUS};
pub use sampler::FilterSampler;
pub use tent::TentFilter;
pub use traits::{Filter, ReadFilter};

use crate::params::Kind;

/// All kinds of filters; the first one is the default.
pub static FILTERS: &[Kind<ReadFilter>] =
    &[box_filter::KIND, tent::KIND, gaussian::KIND, blackman_harris::KIND];
