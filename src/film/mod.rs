//! The film: what a render leaves behind, and how it is written to files.

mod display;
mod exr;
mod filter;
mod output;
mod picture;
mod png;
mod sums;

pub use display::Display;
pub use exr::write_exr;
pub use filter::Filter;
pub use output::{OutputError, check_writable};
pub use picture::{Layers, Metadata, Picture, Window};
pub use png::write_png;
pub use sums::{Film, FilmContents, FilmError, Variance};

/// The name that files give for their maker.
const SOFTWARE: &str = concat!("lobe ", env!("CARGO_PKG_VERSION"));
