//! Charts as SVG: lines with markers over linear or logarithmic axes.
//!
//! Charts are laid out for a column 600 pixels wide. They hold colours for light and dark pages and follow the reader's
//! preference (`prefers-color-scheme`). Lines differ in colour, marker and dash, so that they can be told apart without
//! colours.

mod axis;
mod data;
mod draw;
mod style;

pub use axis::{Axis, Scale};
pub use data::{Chart, Line, Point};
pub use draw::escape;
