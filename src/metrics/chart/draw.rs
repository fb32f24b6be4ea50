//! Drawing a [`Chart`] as SVG.

use std::fmt::Write;

use super::axis::Span;
use super::style::{MARKERS, STYLES, css};
use super::{Chart, Line, Point};

const WIDTH: f64 = 600.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = WIDTH - 12.0;
const PLOT_HEIGHT: f64 = 300.0;
/// Height of a row of the legend.
const ROW: f64 = 18.0;

impl Chart {
    /// Number of different styles of lines.
    pub const STYLES: usize = STYLES;

    /// The chart as the text of an SVG file.
    pub fn svg(&self) -> String {
        svg(self)
    }
}

fn svg(chart: &Chart) -> String {
    let longest = chart.lines.iter().map(|line| line.name.chars().count()).max().unwrap_or(0);
    let columns = if longest > 24 { 2 } else { 3 };
    let top = 40.0 + ROW * chart.lines.len().div_ceil(columns) as f64;
    let height = top + PLOT_HEIGHT + 44.0;
    let title = escape(&chart.title);
    let mut pen = Pen(String::new());
    pen.put(format_args!(
        "<svg class=\"lobe\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\">\n\
         <title>{title}</title>\n<style>\n{}</style>\n\
         <rect class=\"page\" width=\"{WIDTH}\" height=\"{height}\"/>",
        css()
    ));
    pen.text("strong", (12.0, 20.0), "start", &chart.title);
    for (index, line) in chart.lines.iter().enumerate() {
        let (column, row) = (index % columns, index / columns);
        let x = 12.0 + column as f64 * (WIDTH - 24.0) / columns as f64;
        let y = 42.0 + ROW * row as f64;
        if !line.is_loose {
            pen.line(line.style, &[(x, y), (x + 26.0, y)]);
        }
        pen.marker(line.style, (x + 13.0, y), false);
        pen.text("", (x + 32.0, y + 4.0), "start", &line.name);
    }
    pen.plot(chart, top);
    pen.put(format_args!("</svg>"));
    pen.0
}

/// Escapes text for XML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Appends elements to the text of the file.
struct Pen(String);

impl Pen {
    fn put(&mut self, element: std::fmt::Arguments) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.0, "{element}");
    }

    fn text(&mut self, class: &str, (x, y): (f64, f64), anchor: &str, content: &str) {
        let content = escape(content);
        self.put(format_args!(
            r#"<text class="{class}" x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{content}</text>"#
        ));
    }

    /// Text turned by 90 degrees, to be read from bottom to top.
    fn upright(&mut self, class: &str, (x, y): (f64, f64), content: &str) {
        let content = escape(content);
        self.put(format_args!(
            r#"<text class="{class}" x="{x:.1}" y="{y:.1}" text-anchor="middle" transform="rotate(-90 {x:.1} {y:.1})">{content}</text>"#
        ));
    }

    fn path(&mut self, class: &str, points: &[(f64, f64)]) {
        if points.len() > 1 {
            let points: Vec<_> = points.iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
            self.put(format_args!(r#"<path class="{class}" d="M{}"/>"#, points.join("L")));
        }
    }

    fn line(&mut self, style: usize, points: &[(f64, f64)]) {
        self.path(&format!("line l{}", style % STYLES), points);
    }

    fn marker(&mut self, style: usize, (x, y): (f64, f64), is_faint: bool) {
        let (index, faint) = (style % STYLES, if is_faint { " faint" } else { "" });
        let shape = MARKERS[index];
        self.put(format_args!(r#"<path class="m{index}{faint}" d="M{x:.1} {y:.1}{shape}"/>"#));
    }

    fn shade(&mut self, top: f64, bottom: f64) {
        let (width, height) = (RIGHT - LEFT, bottom - top);
        self.put(format_args!(
            r#"<rect class="shade" x="{LEFT}" y="{top:.1}" width="{width}" height="{height:.1}"/>"#
        ));
    }

    /// The axes and everything between them.
    fn plot(&mut self, chart: &Chart, top: f64) {
        let bottom = top + PLOT_HEIGHT;
        let (x, y) = spans(chart);
        let across = |position: f64| LEFT + (position - x.low) / (x.high - x.low) * (RIGHT - LEFT);
        let up = |position: f64| bottom - (position - y.low) / (y.high - y.low) * PLOT_HEIGHT;
        let at = |px: f64, py: f64| Some((across(x.position(px)?), up(y.position(py)?)));

        let floor =
            chart.floor.as_ref().and_then(|(height, note)| Some((y.position(*height)?, note)));
        if let Some((height, _)) = floor {
            self.shade(up(height), bottom);
        }
        if let Some(lane) = y.lane {
            self.shade(up(2.0 * lane - y.low), bottom);
        }
        for &tick in x.ticks() {
            let column = across(tick);
            self.path("grid", &[(column, top), (column, bottom)]);
            self.text("", (column, bottom + 15.0), "middle", &x.label(tick));
        }
        for &tick in y.ticks() {
            let row = up(tick);
            self.path("grid", &[(LEFT, row), (RIGHT, row)]);
            self.text("", (LEFT - 6.0, row + 4.0), "end", &y.label(tick));
        }
        self.text("", (0.5 * (LEFT + RIGHT), bottom + 34.0), "middle", &chart.x.title);
        self.upright("", (14.0, 0.5 * (top + bottom)), &chart.y.title);
        if let Some((height, note)) = floor {
            self.text("note", (LEFT + 4.0, up(height) + 13.0), "start", note);
        }
        for (value, note) in &chart.marks {
            let Some(column) = x.position(*value).map(across) else { continue };
            self.path("mark", &[(column, top), (column, bottom)]);
            self.upright("note", (column + 12.0, 0.5 * (top + bottom)), note);
        }
        let front: Vec<_> = chart.pareto_front.iter().filter_map(|&(px, py)| at(px, py)).collect();
        self.path("front", &front);
        // Points in the lane for zero are moved apart, so that lines do not hide each other.
        let lines = chart.lines.len() as f64;
        for (index, line) in chart.lines.iter().enumerate() {
            let aside = (index as f64 - 0.5 * (lines - 1.0)) * (22.0 / lines).min(7.0);
            self.draw(line, &|px, py| {
                let (column, row) = at(px, py)?;
                let is_zero = y.lane.is_some() && py == 0.0;
                Some((column, if is_zero { row + aside } else { row }))
            });
        }
    }

    fn draw(&mut self, line: &Line, at: &dyn Fn(f64, f64) -> Option<(f64, f64)>) {
        let shown: Vec<_> =
            line.points.iter().filter_map(|point| Some((point, at(point.x, point.y)?))).collect();
        if !line.is_loose {
            let claimed = shown.iter().filter(|(point, _)| !point.is_faint);
            self.line(line.style, &claimed.map(|&(_, at)| at).collect::<Vec<_>>());
        }
        let class = format!("range l{}", line.style % STYLES);
        for &(&Point { x, range, is_faint, .. }, position) in &shown {
            let end = |y: f64| at(x, y);
            if let Some((low, high)) = range.and_then(|(low, high)| Some((end(low)?, end(high)?))) {
                for end in [low, high] {
                    self.path(&class, &[(end.0 - 3.0, end.1), (end.0 + 3.0, end.1)]);
                }
                self.path(&class, &[low, high]);
            }
            self.marker(line.style, position, is_faint);
        }
    }
}

/// Ranges of both axes that hold everything drawn.
fn spans(chart: &Chart) -> (Span, Span) {
    let points = || chart.lines.iter().flat_map(|line| &line.points);
    let ranges = points().filter_map(|point| point.range).flat_map(|(low, high)| [low, high]);
    let heights = points().map(|point| point.y).chain(ranges);
    let floor = chart.floor.iter().map(|(height, _)| *height);
    let marks = chart.marks.iter().map(|(value, _)| *value);
    let x = Span::new(&chart.x, points().map(|point| point.x).chain(marks));
    (x, Span::new(&chart.y, heights.chain(floor)))
}
