//! The film: what a render leaves behind, and how it is written to files.

mod display;
mod exr;
mod filter;
mod filter_sampler;
mod output;
mod picture;
mod png;
mod spread;
mod sums;

pub use display::Display;
pub use exr::write_exr;
pub use filter::{FILTERS, Filter, FilterError, ReadFilter};
pub use filter_sampler::FilterSampler;
pub use output::{OutputError, check_writable, write_file};
pub use picture::{Layers, Metadata, Picture, Window};
pub use png::{encode_png, write_png};
pub use spread::Variance;
pub use sums::{Film, FilmContents, FilmError};

/// The name that files give for their maker.
const SOFTWARE: &str = concat!("lobe ", env!("CARGO_PKG_VERSION"));
