//! The chart: six panels, a legend, and colours for light and dark pages.

use std::fmt::Write;

use crate::measure::{Failure, Row};
use crate::method::Method;
use crate::panel::{self, Panel, Sweep, draw_line, label};

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 724.0;
/// The panels' left edges, and the tops of their rows.
const COLUMNS: [(f64, Sweep); 2] = [(64.0, Sweep::Scale), (342.0, Sweep::Distance)];
const ROWS: [f64; 3] = [112.0, 322.0, 532.0];

/// Colours of Okabe and Ito, which the colour-blind can tell apart.
const STYLE: &str = "\
svg{--page:#fff;--ink:#222;--faint:#ddd;--band:#f1f1f1;--missing:#e3e3e3;\
--fixed:#d55e00;--wb:#0072b2;--bounds:#009e73;--control:#888}
@media(prefers-color-scheme:dark){svg{--page:#0d1117;--ink:#e6e6e6;--faint:#30363d;--band:#1a2029;\
--missing:#262c36;--fixed:#e69f00;--wb:#56b4e9;--bounds:#00c08b;--control:#999}}
text{font:11px system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;fill:var(--ink)}
.strong{font-weight:600}
.page{fill:var(--page)}
.band{fill:var(--band)}
.missing{fill:var(--missing)}
.grid{stroke:var(--faint)}
.line{fill:none;stroke-width:1.4}
.marker{fill:none;stroke-width:1.4}
.fixed-epsilon{stroke:var(--fixed)}
.waechter-binder{stroke:var(--wb)}
.error-bounds{stroke:var(--bounds)}
.marker.error-bounds{fill:var(--bounds)}
.unmoved{stroke:var(--control);stroke-dasharray:3 2}
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
    strong(&mut svg, 12.0, 20.0, "start", title);
    draw_legend(&mut svg);

    for (left, sweep) in COLUMNS {
        let (heading, axis) = match sweep {
            Sweep::Scale => ("at the origin", "scale of the scene (units)"),
            Sweep::Distance => ("at scale 1", "distance from the origin (units)"),
        };
        for (top, failure) in ROWS.into_iter().zip(Failure::ALL) {
            let name = match failure {
                Failure::SelfHit => "False self-hits".into(),
                Failure::LostContact(gap) => format!("Lost contacts, gap {gap:e} of the scale"),
            };
            strong(&mut svg, left, top - 8.0, "start", &format!("{name}, {heading}"));
            let decades = f64::from(rays).log10().ceil() as u32;
            let labelled = matches!(sweep, Sweep::Scale);
            Panel { left, top, sweep, failure, test, decades, labelled }.draw(&mut svg, rows);
            label(&mut svg, left + panel::WIDTH / 2.0, top + 182.0, "middle", axis);
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
        let (x, y) = (12.0 + 148.0 * place as f64, 44.0);
        draw_line(svg, method, &[(x, y), (x + 22.0, y)]);
        label(svg, x + 30.0, y + 4.0, "start", name);
    }
    let note = "Share of rays; both axes are logarithmic but for 0 and none. Each method has its lane in “none”.";
    label(svg, 12.0, 68.0, "start", note);
}

fn strong(svg: &mut String, x: f64, y: f64, anchor: &str, text: &str) {
    let _ = writeln!(
        svg,
        r#"<text class="strong" x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{text}</text>"#
    );
}
