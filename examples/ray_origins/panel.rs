//! One panel of the chart: failure rates over scales or over distances.

use std::fmt::Write;

use crate::measure::{Failure, Place, Row};
use crate::method::Method;

/// Width and height of the part with the axis of rates.
const WIDTH: f64 = 246.0;
const HEIGHT: f64 = 115.0;
/// The band below it, for counts of zero, with a lane for each method.
const BAND: f64 = 34.0;
const ABOVE_BAND: f64 = 9.0;
const BOTTOM: f64 = HEIGHT + ABOVE_BAND + BAND;
const LANE: f64 = 7.5;

/// What a panel's x axis shows. The other parameter is fixed.
#[derive(Clone, Copy)]
pub enum Sweep {
    Scale,
    Distance,
}

impl Sweep {
    /// The value of a place; `None` for one outside of this sweep.
    fn value(self, place: Place) -> Option<f64> {
        match self {
            Self::Scale => (place.distance == 0.0).then_some(place.scale),
            Self::Distance => (place.scale == 1.0).then_some(place.distance),
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Scale => "scale of a scene at the origin (units)",
            Self::Distance => "distance from the origin at scale 1 (units)",
        }
    }

    /// Where on the axis a value is, from 0 to 1. Distance 0 stands one power of ten before 1.
    fn position(self, value: f64) -> f64 {
        match self {
            Self::Scale => (value.log10() + 6.0) / 12.0,
            Self::Distance if value == 0.0 => 0.0,
            Self::Distance => (value.log10() + 1.0) / 7.0,
        }
    }

    /// Values with a grid line, and their labels.
    fn ticks(self) -> &'static [(f64, &'static str)] {
        match self {
            Self::Scale => &[
                (1e-6, "10⁻⁶"),
                (1e-4, "10⁻⁴"),
                (1e-2, "10⁻²"),
                (1e0, "1"),
                (1e2, "10²"),
                (1e4, "10⁴"),
                (1e6, "10⁶"),
            ],
            Self::Distance => &[
                (0.0, "0"),
                (1e0, "1"),
                (1e1, "10"),
                (1e2, "10²"),
                (1e3, "10³"),
                (1e4, "10⁴"),
                (1e5, "10⁵"),
                (1e6, "10⁶"),
            ],
        }
    }
}

/// A panel, with its upper left corner.
pub struct Panel {
    pub left: f64,
    pub top: f64,
    pub sweep: Sweep,
    pub failure: Failure,
    /// Which of the two triangle tests.
    pub test: usize,
    /// How many powers of ten the axis of rates goes down from 1.
    pub decades: u32,
    /// Whether the rates are written on the left.
    pub labelled: bool,
}

impl Panel {
    /// Draws it: first what is behind the lines, then a line for each method.
    pub fn draw(&self, svg: &mut String, rows: &[Row]) {
        self.draw_frame(svg);
        let rows = || rows.iter().filter(|row| row.failure == self.failure);
        let points = |method: Method| -> Vec<(f64, f64)> {
            let rows = rows().filter(|row| row.method == method);
            let point = |row: &Row| Some((self.x(self.sweep.value(row.place)?), self.y(row)));
            rows.filter_map(point).collect()
        };
        let last = points(Method::Unmoved).last().map_or(0.0, |&(x, _)| x);
        self.draw_missing(svg, last);
        // The control first: it is the least important.
        for method in
            [Method::Unmoved, Method::FixedEpsilon, Method::WaechterBinder, Method::ErrorBounds]
        {
            draw_line(svg, method, &points(method));
        }
    }

    fn x(&self, value: f64) -> f64 {
        self.left + 8.0 + self.sweep.position(value) * (WIDTH - 16.0)
    }

    fn rate_y(&self, log10: f64) -> f64 {
        self.top - log10 / f64::from(self.decades) * HEIGHT
    }

    fn y(&self, row: &Row) -> f64 {
        let failures = row.failures[self.test];
        if failures == 0 {
            let lane = Method::ALL.iter().position(|&m| m == row.method).unwrap_or_default();
            return self.top + BOTTOM - BAND / 2.0 + (lane as f64 - 1.5) * LANE;
        }
        self.rate_y((f64::from(failures) / f64::from(row.trials)).log10())
    }

    fn draw_frame(&self, svg: &mut String) {
        let (left, right, top) = (self.left, self.left + WIDTH, self.top);
        let (zero, bottom) = (top + BOTTOM - BAND, top + BOTTOM);
        let _ = writeln!(
            svg,
            r#"<rect class="band" x="{left}" y="{zero}" width="{WIDTH}" height="{BAND}"/>"#
        );
        for decade in 0..=self.decades {
            let y = self.rate_y(-f64::from(decade));
            let _ = writeln!(svg, r#"<path class="grid" d="M{left} {y:.1}H{right}"/>"#);
            if self.labelled {
                label(svg, left - 5.0, y + 4.0, "end", &percent(decade));
            }
        }
        if self.labelled {
            label(svg, left - 5.0, zero + BAND / 2.0 + 4.0, "end", "none");
        }
        for &(value, text) in self.sweep.ticks() {
            let x = self.x(value);
            let _ = writeln!(svg, r#"<path class="grid" d="M{x:.1} {top}V{bottom}"/>"#);
            label(svg, x, bottom + 13.0, "middle", text);
        }
        label(svg, left + WIDTH / 2.0, bottom + 28.0, "middle", self.sweep.title());
    }

    /// Covers what lies right of the last value that has a row.
    fn draw_missing(&self, svg: &mut String, last: f64) {
        let from = last + 8.0;
        let width = self.left + WIDTH - from;
        if width < 10.0 {
            return;
        }
        let top = self.top;
        let _ = writeln!(
            svg,
            r#"<rect class="missing" x="{from:.1}" y="{top}" width="{width:.1}" height="{BOTTOM}"/>"#
        );
        let middle = from + width / 2.0;
        for (line, text) in ["gap below", "spacing", "of floats"].into_iter().enumerate() {
            label(svg, middle, top + HEIGHT / 2.0 + 14.0 * line as f64, "middle", text);
        }
    }
}

/// 10⁻ⁿ in per cent.
fn percent(decade: u32) -> String {
    match decade {
        0 => "100 %".into(),
        1 => "10 %".into(),
        2 => "1 %".into(),
        n => format!("0.{}1 %", "0".repeat(n as usize - 3)),
    }
}

pub fn label(svg: &mut String, x: f64, y: f64, anchor: &str, text: &str) {
    let _ = writeln!(svg, r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{text}</text>"#);
}

/// A method's line with its markers.
pub fn draw_line(svg: &mut String, method: Method, points: &[(f64, f64)]) {
    let class = method.name();
    let path: Vec<_> = points.iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
    let _ = writeln!(svg, r#"<path class="line {class}" d="M{}"/>"#, path.join("L"));
    for (x, y) in points {
        // Shapes that can be told apart when they lie on each other.
        let shape = match method {
            Method::FixedEpsilon => "m-4.8 3.6h9.6l-4.8-8.4z",
            Method::WaechterBinder => "m-2.9-2.9h5.8v5.8h-5.8z",
            Method::ErrorBounds => "m-2.4 0a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0-4.8 0z",
            Method::Unmoved => continue,
        };
        let _ = writeln!(svg, r#"<path class="marker {class}" d="M{x:.1} {y:.1}{shape}"/>"#);
    }
}
