//! The chart: six panels, a legend, and colours for light and dark pages.

use std::fmt::Write;

use crate::measure::{Failure, Row};
use crate::method::Method;
use crate::panel::{Panel, Sweep, draw_line, label};

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 752.0;
/// The panels' left edges, and the tops of their rows.
const COLUMNS: [(f64, Sweep); 2] = [(64.0, Sweep::Scale), (342.0, Sweep::Distance)];
const ROWS: [f64; 3] = [108.0, 332.0, 556.0];

/// Colours of Okabe and Ito, which the colour-blind can tell apart; on dark pages the lighter ones.
const STYLE: &str = "\
text{font:11px system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;fill:#222}
.strong{font-weight:600}
.page{fill:#fff}
.band{fill:#f1f1f1}
.missing{fill:#e3e3e3}
.grid{stroke:#ddd}
.line,.marker{fill:none;stroke-width:1.4}
.fixed-epsilon{stroke:#d55e00}
.waechter-binder{stroke:#0072b2}
.error-bounds{stroke:#009e73}
.marker.error-bounds{fill:#009e73}
.unmoved{stroke:#888;stroke-dasharray:3 2}
@media(prefers-color-scheme:dark){
text{fill:#e6e6e6}
.page{fill:#0d1117}
.band{fill:#1a2029}
.missing{fill:#262c36}
.grid{stroke:#30363d}
.fixed-epsilon{stroke:#e69f00}
.waechter-binder{stroke:#56b4e9}
.error-bounds{stroke:#00c08b}
.marker.error-bounds{fill:#00c08b}
.unmoved{stroke:#999}
}
";

/// The chart of the failures with one of the two triangle tests. `rays` were asked for at each point.
pub fn svg(rows: &[Row], rays: u32, test: usize) -> String {
    let title = [
        "Ray origins, tried with this crate's triangle test",
        "Ray origins, tried with a plain triangle test (Möller-Trumbore, t &gt; 0)",
    ][test];
    let mut svg = String::new();
    let _ = writeln!(
        svg,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">
<title>{title}</title>
<style>
{STYLE}</style>
<rect class="page" width="{WIDTH}" height="{HEIGHT}"/>"#
    );
    strong(&mut svg, 12.0, 20.0, title);
    draw_legend(&mut svg);

    for (top, failure) in ROWS.into_iter().zip(Failure::ALL) {
        let heading = match failure {
            Failure::SelfHit => "False self-hits".into(),
            Failure::LostContact(gap) => {
                format!("Lost contacts across a gap of {gap:e} of the scale")
            }
        };
        strong(&mut svg, 12.0, top - 12.0, &heading);
        for (left, sweep) in COLUMNS {
            let decades = f64::from(rays).log10().ceil() as u32;
            let labelled = matches!(sweep, Sweep::Scale);
            Panel { left, top, sweep, failure, test, decades, labelled }.draw(&mut svg, rows);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw_legend(svg: &mut String) {
    let names = [
        (Method::FixedEpsilon, "fixed epsilon 1e-4"),
        (Method::WaechterBinder, "Waechter-Binder"),
        (Method::ErrorBounds, "error bounds (lobe)"),
        (Method::Unmoved, "no offset (control)"),
    ];
    for (place, (method, name)) in names.into_iter().enumerate() {
        let (x, y) = (18.0 + 146.0 * place as f64, 44.0);
        draw_line(svg, method, &[(x, y), (x + 22.0, y)]);
        label(svg, x + 30.0, y + 4.0, "start", name);
    }
    let note = "Share of rays; both axes are logarithmic but for 0 and none, where each method has a lane.";
    label(svg, 12.0, 66.0, "start", note);
}

fn strong(svg: &mut String, x: f64, y: f64, text: &str) {
    let _ = writeln!(svg, r#"<text class="strong" x="{x:.1}" y="{y:.1}">{text}</text>"#);
}
