//! The film: what a render leaves behind, and how it is written to files.

mod display;
mod picture;
mod sums;

pub use display::Display;
pub use picture::{Layers, Metadata, Picture, Window};
pub use sums::{Film, FilmError};
