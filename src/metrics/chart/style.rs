//! Colours for light and dark pages, markers and dashes.

pub const STYLES: usize = 8;

/// Colours of the lines on light and on dark pages. The first three follow the colour-blind safe palette of Okabe and Ito
/// 2008; the others have hues between them and differ in lightness.
const LINES: [(&str, &str); STYLES] = [
    ("#0072b2", "#56b4e9"),
    ("#d55e00", "#e69f00"),
    ("#009e73", "#00c08b"),
    ("#b5578f", "#e79fca"),
    ("#111", "#f4f4f4"),
    ("#8a6d00", "#f0e442"),
    ("#4b3fae", "#a59cf5"),
    ("#7d7d7d", "#9a9a9a"),
];

const DASHES: [&str; STYLES] = ["", "", "", "", "5 3", "5 3", "2 2.5", "2 2.5"];

/// SVG paths of the markers, relative to their centre.
pub const MARKERS: [&str; STYLES] = [
    "m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0-6.8 0z",
    "m-3-3h6v6h-6z",
    "m0-4.2l3.9 6.8h-7.8z",
    "m0-4.4l4.4 4.4l-4.4 4.4l-4.4-4.4z",
    "m0 4.2l3.9-6.8h-7.8z",
    "m-4.2-1.8h8.4v3.6h-8.4z",
    "m-1.8-4.2h3.6v8.4h-3.6z",
    "m-3.8-3l3 3l-3 3l.8.8l3-3l3 3l.8-.8l-3-3l3-3l-.8-.8l-3 3l-3-3z",
];

/// CSS rules of a chart. Each is limited to the class `lobe`, so that charts can be embedded in a page.
pub fn css() -> String {
    let rules = |dark: bool| {
        let line = |(i, (light, deep)): (usize, &(&str, &str))| {
            let color = if dark { deep } else { light };
            format!(".lobe .l{i}{{stroke:{color}}}.lobe .m{i}{{fill:{color}}}\n")
        };
        LINES.iter().enumerate().map(line).collect::<String>()
    };
    let dashes = DASHES.iter().enumerate().filter(|(_, dash)| !dash.is_empty());
    let dashes = dashes.map(|(i, dash)| format!(".lobe .l{i}{{stroke-dasharray:{dash}}}\n"));
    format!(
        "{}{}{}@media(prefers-color-scheme:dark){{\n{}{}}}\n",
        LIGHT,
        rules(false),
        dashes.collect::<String>(),
        DARK,
        rules(true)
    )
}

const LIGHT: &str = "\
.lobe text{font:11.5px system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;fill:#222}
.lobe .strong{font-weight:600;font-size:13px}
.lobe .note{fill:#5a5a5a}
.lobe .page{fill:#fff}
.lobe .shade{fill:#f1f1f1}
.lobe .grid{stroke:#ddd;fill:none}
.lobe .mark{stroke:#5a5a5a;stroke-dasharray:4 3;fill:none}
.lobe .front{stroke:#cfcfcf;stroke-width:7;fill:none;stroke-linejoin:round;stroke-linecap:round}
.lobe .line{fill:none;stroke-width:1.6;stroke-linejoin:round}
.lobe .range{fill:none;stroke-width:1.2;stroke-dasharray:none}
.lobe .faint{opacity:.35}
";

const DARK: &str = "\
.lobe text{fill:#e6e6e6}
.lobe .note{fill:#a8b0ba}
.lobe .page{fill:#0d1117}
.lobe .shade{fill:#1a2029}
.lobe .grid{stroke:#30363d}
.lobe .mark{stroke:#a8b0ba}
.lobe .front{stroke:#3f4751}
";
