//! The film: what a render leaves behind, and how it is written to files.

mod picture;

pub use picture::{Layers, Metadata, Picture, Window};
