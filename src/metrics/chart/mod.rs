//! Charts as SVG: lines with markers over one or two logarithmic axes.
//!
//! They are drawn for a column 600 pixels wide, on light and dark pages alike: colours of the dark ones stand in the
//! file and follow the reader's preference. Methods are told apart by colour, marker and dash.

mod axis;
mod draw;
mod style;

pub use axis::{Axis, Scale};
pub use draw::escape;

/// Lines over two axes, with what explains them.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The lines, in the order of the legend.
    pub lines: Vec<Line>,
    /// Below this height nothing is claimed: shaded, with a note.
    pub floor: Option<(f64, String)>,
    /// Places on the horizontal axis with a note.
    pub marks: Vec<(f64, String)>,
    /// Points that no other beats, joined behind the lines.
    pub front: Vec<(f64, f64)>,
}

/// A line of the chart.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its name in the legend.
    pub name: String,
    /// Which colour, marker and dash; eight are different.
    pub style: usize,
    /// Whether only the markers are drawn.
    pub is_loose: bool,
    /// Its points from left to right.
    pub points: Vec<Point>,
}

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Across.
    pub x: f64,
    /// Up. Zero stands in a lane of its own below a logarithmic axis; what is not finite is left out, but infinity stands
    /// at the upper end.
    pub y: f64,
    /// A range around it, such as the quartiles.
    pub range: Option<(f64, f64)>,
    /// Whether it is not claimed, and drawn as a faint marker alone.
    pub is_faint: bool,
}

impl Point {
    /// A point without a range.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y, range: None, is_faint: false }
    }
}

impl Chart {
    /// How many styles differ.
    pub const STYLES: usize = style::STYLES;

    /// The chart as the text of an SVG file.
    pub fn svg(&self) -> String {
        draw::svg(self)
    }
}
