//! [`Chart`]: what is to be drawn.

use super::Axis;

/// Lines over two axes, with annotations. [`Chart::svg`] draws it.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// The title.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The lines, in the order of the legend.
    pub lines: Vec<Line>,
    /// The region below this y is shaded, with a note: nothing is claimed there.
    pub floor: Option<(f64, String)>,
    /// Vertical marks: an x and a note.
    pub marks: Vec<(f64, String)>,
    /// Points of the Pareto front, drawn as a band behind the lines.
    pub pareto_front: Vec<(f64, f64)>,
}

/// A line of the chart.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its name in the legend.
    pub name: String,
    /// Index of its colour, marker and dash, modulo [`Chart::STYLES`].
    pub style: usize,
    /// Whether only the markers are drawn.
    pub is_loose: bool,
    /// Its points from left to right.
    pub points: Vec<Point>,
}

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Horizontal value.
    pub x: f64,
    /// Vertical value. On a logarithmic axis zero has a lane of its own below the others. Infinity is drawn at the upper
    /// end; other values that are not finite are left out.
    pub y: f64,
    /// Ends of an error bar, such as quartiles.
    pub range: Option<(f64, f64)>,
    /// Whether it is drawn as a faint marker and left out of the line, because its value is not claimed.
    pub is_faint: bool,
}

impl Point {
    /// A point without an error bar.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y, range: None, is_faint: false }
    }
}
